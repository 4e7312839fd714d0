#pragma once
// How far each match of a joint adjustment can be trusted, by how well the normals of its two points agree.

#include <vector>

#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Sets the precision of every match: the standard deviation of all residuals by that of the matches whose normals
/// agree about as well, both robust. A road or a wall gives the same normal to both scans, a crown or a bush, which no
/// plane stands for, does not: there residuals are larger, and by how much is read from them, so that least squares
/// weigh each match by its own variance (Aitken, 1935). Where residuals do not depend on the normals, as in scans bent
/// by motion, all precisions are about 1. Eight classes of as many matches each, fewer where there are not enough; at
/// most kMaxPrecision. Precisions that were set before count for nothing. Cost O(N log N). The result does not depend
/// on the links' order.
/// @param doubted  of each link, whether each match may be none, two faces of one thing: they weigh by their own
///                 deviation as well, where that is larger. Empty: none
void set_precisions(std::vector<JointLink>& links, const std::vector<std::vector<bool>>& doubted = {});

/// Surfaces that fit without error do not silence the others, which may be alone in determining some direction.
constexpr double kMaxPrecision = 10;

}  // namespace tcm_icp
