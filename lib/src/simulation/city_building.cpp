#include "simulation/city_building.hpp"

#include <algorithm>
#include <numbers>

#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTiles = 0.35;

class Roof {
 public:
  Roof(TriangleMesh& mesh, const Isometry3d& T_world_building, const CityBuilding& building, Rng& rng)
      : mesh_(mesh),
        T_(T_world_building),
        x_(building.half_size_m.x()),
        y_(building.half_size_m.y()),
        eaves_(facade_height_m(building.facade, building.num_storeys)),
        building_(building),
        rng_(rng) {}

  void build() {
    switch (building_.roof) {
      case RoofKind::kFlat:
        return add_flat();
      case RoofKind::kGabled:
        add_slopes(0, building_.roof_rise_m);
        break;
      case RoofKind::kMansard:
        add_slopes(0.7 * y_, building_.roof_rise_m);
        break;
    }
    add_dormers();
    add_chimneys(eaves_ + building_.roof_rise_m);
  }

 private:
  Vector3d at(double x, double y, double z) const { return T_ * Vector3d(x, y, z); }
  void box(const Vector3d& low, const Vector3d& high, double reflectivity) {
    add_box(mesh_, T_, AlignedBox3d(low, high), reflectivity);
  }

  void add_flat() {
    add_quad(mesh_, at(-x_, -y_, eaves_), at(x_, -y_, eaves_), at(x_, y_, eaves_), at(-x_, y_, eaves_), 0.3);
    const double parapet = uniform(rng_, 0.2, 1.1);
    box({-x_, -y_, eaves_}, {x_, -y_ + 0.25, eaves_ + parapet}, building_.facade.reflectivity);
    if (uniform01(rng_) < 0.5) {  // a storey that stands back
      const double back = uniform(rng_, 1.2, 2.5);
      box({-x_ + 0.5, -y_ + back, eaves_}, {x_ - 0.5, y_ - 0.5, eaves_ + 2.8}, 0.5);
    }
    add_chimneys(eaves_ + 0.5);
  }

  /// Slopes to the front and the back up to a flat strip from -`half_top_m` to `half_top_m`, and both gables.
  void add_slopes(double half_top_m, double rise_m) {
    const double top = eaves_ + rise_m;
    for (const double side : {-1.0, 1.0}) {
      add_quad(mesh_, at(-x_, side * y_, eaves_), at(x_, side * y_, eaves_), at(x_, side * half_top_m, top),
               at(-x_, side * half_top_m, top), kTiles);
      const double x = side * x_;
      add_quad(mesh_, at(x, -y_, eaves_), at(x, y_, eaves_), at(x, half_top_m, top), at(x, -half_top_m, top),
               building_.facade.reflectivity);
    }
    if (half_top_m > 0)
      add_quad(mesh_, at(-x_, -half_top_m, top), at(x_, -half_top_m, top), at(x_, half_top_m, top),
               at(-x_, half_top_m, top), kTiles);
  }

  void add_dormers() {
    const int count = static_cast<int>(uniform_index(rng_, 4));
    for (int i = 0; i < count; ++i) {
      const double middle = x_ * (2 * (i + 0.5) / count - 1);
      const double half = std::min(0.6 * x_ / count, 0.9);
      const double top = eaves_ + std::min(1.7, 0.8 * building_.roof_rise_m);
      box({middle - half, -0.9 * y_, eaves_}, {middle + half, -0.2 * y_, top}, 0.5);
    }
  }

  void add_chimneys(double base_m) {
    const int count = 1 + static_cast<int>(uniform_index(rng_, 3));
    for (int i = 0; i < count; ++i) {
      const double x = uniform(rng_, -0.8, 0.8) * x_;
      const double y = uniform(rng_, -0.5, 0.3) * y_;
      const double height = uniform(rng_, 0.5, 1.5);
      box({x - 0.35, y - 0.3, eaves_}, {x + 0.35, y + 0.3, base_m + height}, 0.4);
    }
  }

  TriangleMesh& mesh_;
  const Isometry3d T_;
  const double x_, y_, eaves_;
  const CityBuilding& building_;
  Rng& rng_;
};

}  // namespace

CityBuilding random_city_building(const Vector2d& half_size_m, int num_storeys, Rng& rng) {
  CityBuilding b{half_size_m, num_storeys, random_facade_style(rng), RoofKind::kFlat, 3};
  b.roof = static_cast<RoofKind>(uniform_index(rng, 3));
  b.roof_rise_m = (b.roof == RoofKind::kMansard ? 0.5 : 0.7) * half_size_m.y() * uniform(rng, 0.7, 1.2);
  return b;
}

void add_city_building(TriangleMesh& mesh, const Isometry3d& T_world_building, const CityBuilding& building, Rng& rng) {
  const double x = building.half_size_m.x(), y = building.half_size_m.y();
  // Counter-clockwise, so that each wall's -y faces out; the first is the street's.
  const Vector3d corners[] = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  for (int side = 0; side < 4; ++side) {
    const Isometry3d T_world_wall = T_world_building * upright_pose(corners[side], side * std::numbers::pi / 2);
    FacadeStyle style = side == 0 ? building.facade : plain_back(building.facade);
    if (side % 2 == 1) style.balcony_m = 0;  // a neighbour may stand there
    add_facade(mesh, T_world_wall, side % 2 == 0 ? 2 * x : 2 * y, building.num_storeys, style, rng);
  }
  Roof(mesh, T_world_building, building, rng).build();
}

}  // namespace tcm_icp
