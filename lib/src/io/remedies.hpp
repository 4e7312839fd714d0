#pragma once
// What readers advise.

namespace tcm_icp {

constexpr const char* kDamaged = "the file is damaged: write or copy it again";

}  // namespace tcm_icp
