#include "tcm_icp/links/link_residuals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

// A wall shows an error of the plan, a floor one of height alone: it takes so many times more points to be preferred.
constexpr double kWallByFloor = 4;

struct Cell {
  std::array<std::size_t, 2> num_matches{};  // of each direction
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();

  // The direction that the fewer matches come from counts: both scans have to be there.
  double worth() const {
    const auto n = static_cast<double>(num_matches[0] + num_matches[1]);
    const double upright = normals(2, 2) / n;  // mean squared z of the normals
    return static_cast<double>(std::min(num_matches[0], num_matches[1])) * (1 + (kWallByFloor - 1) * (1 - upright));
  }
};

using Key = std::array<long long, 3>;

Key key_of(const Eigen::Vector3d& point, double cell_m) {
  const Eigen::Array3d at = (point.array() / cell_m).floor();
  return {static_cast<long long>(at.x()), static_cast<long long>(at.y()), static_cast<long long>(at.z())};
}

// The match nearest to the middle of its cell, of those on the surface that most are on.
LinkContact on_surface(const std::vector<JointLink>& links, double cell_m, const Key& key, const Cell& cell) {
  constexpr double kSameNormal = 0.9;  // cosine
  const std::size_t n = cell.num_matches[0] + cell.num_matches[1];
  const Eigen::Vector3d normal = symmetric_eigen3(cell.normals).vectors.col(2);
  const Eigen::Vector3d middle = cell.sum / static_cast<double>(n);
  LinkContact out{middle, normal, n};
  double nearest = std::numeric_limits<double>::infinity();
  for (const JointLink& link : links) {
    for (const Correspondence& m : link.matches) {
      const double distance = (m.source - middle).squaredNorm();
      if (distance >= nearest || std::abs(m.normal.dot(normal)) < kSameNormal || key_of(m.source, cell_m) != key) {
        continue;
      }
      nearest = distance;
      out.point = m.source;
      out.normal = m.normal;
    }
  }
  return out;
}

std::optional<LinkContact> find_contact(const std::vector<JointLink>& links, double cell_m) {
  std::map<Key, Cell> cells;  // ordered: of equal cells the same one wins everywhere
  for (std::size_t k = 0; k < links.size(); ++k) {
    for (const Correspondence& m : links[k].matches) {
      Cell& cell = cells[key_of(m.source, cell_m)];
      ++cell.num_matches[k % 2];
      cell.sum += m.source;
      cell.normals += m.normal * m.normal.transpose();
    }
  }
  auto best = cells.end();
  for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
    if (best == cells.end() || cell->second.worth() > best->second.worth()) best = cell;
  }
  if (best == cells.end() || best->second.worth() <= 0) return std::nullopt;
  return on_surface(links, cell_m, best->first, best->second);
}

}  // namespace

LinkResiduals link_residuals(const std::vector<JointLink>& links, const std::vector<Eigen::Isometry3d>& T_common_scan,
                             double cell_m) {
  LinkResiduals out;
  for (const JointLink& link : links) {
    const Eigen::Isometry3d T_scan_common = T_common_scan[link.source].inverse();
    for (const Correspondence& m : link.matches) {
      out.matches.push_back({link.source == links.front().source, static_cast<float>(m.normal.dot(m.source - m.target)),
                             (T_scan_common * m.source).cast<float>()});
    }
  }
  out.contact = find_contact(links, cell_m);
  if (out.contact) {
    const Eigen::Isometry3d T_a_common = T_common_scan[links.front().target].inverse();
    out.contact->point = T_a_common * out.contact->point;
    out.contact->normal = T_a_common.linear() * out.contact->normal;
  }
  return out;
}

}  // namespace tcm_icp
