#pragma once
// How many of the poses that a search finds are looked at.

namespace tcm_icp {

/// Five of a pair; and how many times as many where these left a scan without a clear place: among equal rows, shelves
/// or bays the right pose is one of dozens that look alike, which free space tells from the rest.
constexpr int kUsualDepth = 1, kGreatDepth = 4;

}  // namespace tcm_icp
