#include "line_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMaxLooks = 6000;
// Of variances: noise is well below the distance of the neighbours, so that the plane is one.
constexpr double kMaxOffPlane = 0.05;
constexpr std::size_t kInARow = 5;
// Widths of a piece across by its length: what is left of the directions' error, in radians.
constexpr float kMaxWidth = 0.05F;
// Sines of the angle of rays with a plane: flatter ones move points too far.
constexpr double kFlattestRay = 0.05;

struct FlatPiece {
  Eigen::Vector2d middle, direction;  ///< on the plane
};

// Moved along rays to the plane; false where a point lies beyond the place that it was seen from.
bool move_to_plane(const FlatPatch& patch, const Eigen::Vector3f& from, FlatPatch::Coordinates& x,
                   FlatPatch::Coordinates& y) {
  float least = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < FlatPatch::kPoints; ++k) {
    const float height = from.z() - patch.z[k];
    least = std::min(least, height * from.z());
    const float share = patch.z[k] / height;
    x[k] = patch.x[k] + (patch.x[k] - from.x()) * share;
    y[k] = patch.y[k] + (patch.y[k] - from.y()) * share;
  }
  return least > 0;
}

// The first and those nearest to it.
std::array<std::size_t, kInARow> nearest_to_first(const FlatPatch::Coordinates& x, const FlatPatch::Coordinates& y) {
  FlatPatch::Coordinates squares;
  for (std::size_t k = 0; k < FlatPatch::kPoints; ++k) {
    squares[k] = (x[k] - x[0]) * (x[k] - x[0]) + (y[k] - y[0]) * (y[k] - y[0]);
  }
  std::array<std::size_t, kInARow> nearest{};
  std::array<float, kInARow> square;
  square.fill(std::numeric_limits<float>::max());
  for (std::size_t k = 0; k < FlatPatch::kPoints; ++k) {
    if (!(squares[k] < square.back())) continue;
    std::size_t at = kInARow - 1;
    for (; at > 0 && squares[k] < square[at - 1]; --at) square[at] = square[at - 1], nearest[at] = nearest[at - 1];
    square[at] = squares[k], nearest[at] = k;
  }
  return nearest;
}

std::optional<FlatPiece> find_piece(const FlatPatch& patch, const Eigen::Vector3d& from) {
  const Eigen::Vector3d to_place = from - patch.middle;
  const Eigen::Vector3d local = patch.axes.transpose() * to_place;
  if (!(std::abs(local.z()) > kFlattestRay * to_place.norm())) return std::nullopt;
  FlatPatch::Coordinates x, y;
  if (!move_to_plane(patch, local.cast<float>(), x, y)) return std::nullopt;
  constexpr float kShare = 1.0F / kInARow;
  const auto row = nearest_to_first(x, y);
  float mean_x = 0, mean_y = 0;
  for (const std::size_t k : row) mean_x += kShare * x[k], mean_y += kShare * y[k];
  float xx = 0, xy = 0, yy = 0;
  for (const std::size_t k : row) {
    const float dx = x[k] - mean_x, dy = y[k] - mean_y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  const float middle = (xx + yy) / 2, off = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  if (!(middle - off < kMaxWidth * kMaxWidth * (middle + off))) return std::nullopt;
  // Of the two ways to write the longer axis the one that does not vanish.
  const Eigen::Vector2f along =
      xx > yy ? Eigen::Vector2f(middle + off - yy, xy) : Eigen::Vector2f(xy, middle + off - xx);
  return FlatPiece{Eigen::Vector2d(mean_x, mean_y), along.cast<double>().normalized()};
}

}  // namespace

std::vector<FlatPatch> find_flat_patches(const Points& points, const NeighborIndex& index, const UnitFrame& frame) {
  const Eigen::Isometry3d T_axes_cloud = frame.T_cloud_axes.inverse();
  std::vector<FlatPatch> patches;
  std::vector<Neighbor> neighbors;
  const std::size_t count = std::min(kMaxLooks, points.size());
  Eigen::Matrix<double, 3, FlatPatch::kPoints> near;
  for (std::size_t i = 0; i < count; ++i) {
    index.nearest_k(points[i * points.size() / count], FlatPatch::kPoints, neighbors);
    if (neighbors.size() < FlatPatch::kPoints) continue;
    for (std::size_t k = 0; k < FlatPatch::kPoints; ++k) {
      near.col(static_cast<Eigen::Index>(k)) = T_axes_cloud * points[neighbors[k].index] / frame.unit_m;
    }
    FlatPatch patch;
    patch.middle = near.rowwise().mean();
    near.colwise() -= patch.middle;
    const auto [variances, axes] = symmetric_eigen3(near * near.transpose());
    if (!(variances[0] < kMaxOffPlane * variances[1])) continue;
    patch.axes << axes.col(2), axes.col(1), axes.col(0);
    near = patch.axes.transpose() * near.eval();
    for (std::size_t k = 0; k < FlatPatch::kPoints; ++k) {
      const Eigen::Vector3f p = near.col(static_cast<Eigen::Index>(k)).cast<float>();
      patch.x[k] = p.x(), patch.y[k] = p.y(), patch.z[k] = p.z();
    }
    patches.push_back(patch);
  }
  return patches;
}

LinePieces find_line_pieces(const std::vector<FlatPatch>& patches, const Eigen::Vector3d& from, std::size_t stride) {
  LinePieces pieces;
  for (std::size_t i = 0; i < patches.size(); i += stride) {
    const FlatPatch& patch = patches[i];
    const std::optional<FlatPiece> piece = find_piece(patch, from);
    if (!piece) continue;
    const auto plane = patch.axes.leftCols<2>();
    pieces.middles.push_back(patch.middle + plane * piece->middle);
    pieces.directions.push_back(plane * piece->direction);
    pieces.normals.push_back(patch.axes.col(2));
  }
  return pieces;
}

}  // namespace tcm_icp
