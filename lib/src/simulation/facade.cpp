#include "simulation/facade.hpp"

#include <algorithm>
#include <vector>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/town_objects.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFooting_m = 1.2;
constexpr double kFacadeGlass = 0.06;
constexpr double kShutter = 0.45;

AlignedBox2d area(double x0, double x1, double z0, double z1) { return {Vector2d(x0, z0), Vector2d(x1, z1)}; }

class Facade {
 public:
  Facade(TriangleMesh& mesh, const Isometry3d& T_world_wall, double width_m, int num_storeys, const FacadeStyle& style,
         Rng& rng)
      : mesh_(mesh),
        T_world_wall_(T_world_wall),
        width_m_(width_m),
        num_storeys_(num_storeys),
        num_columns_(std::max(1, static_cast<int>(width_m / style.column_m))),
        column_m_(width_m / num_columns_),
        style_(style),
        rng_(rng) {}

  void build() {
    plain(area(0, width_m_, -kFooting_m, 0), 0);
    add_ground_storey();
    for (int first = 0; first < num_columns_;) first = add_run(first);
    add_mouldings();
  }

 private:
  double floor_m(int storey) const { return storey == 0 ? 0 : style_.ground_storey_m + (storey - 1) * style_.storey_m; }

  void plain(const AlignedBox2d& a, double y) {
    const auto at = [&](double x, double z) -> Vector3d { return T_world_wall_ * Vector3d(x, y, z); };
    add_quad(mesh_, at(a.min().x(), a.min().y()), at(a.max().x(), a.min().y()), at(a.max().x(), a.max().y()),
             at(a.min().x(), a.max().y()), style_.reflectivity);
  }

  void box(double x0, double x1, double y0, double y1, double z0, double z1) {
    add_box(mesh_, T_world_wall_, tcm_icp::box(x0, x1, y0, y1, z0, z1), style_.reflectivity);
  }

  void opening(const AlignedBox2d& outer, const AlignedBox2d& hole, double y, double recess_m, double back) {
    add_panel(mesh_, T_world_wall_ * Eigen::Translation3d(0, y, 0), {outer, hole, recess_m}, style_.reflectivity, back);
  }

  void add_ground_storey() {
    const int door = static_cast<int>(uniform_index(rng_, static_cast<std::uint64_t>(num_columns_)));
    const bool is_gateway = uniform01(rng_) < 0.25;
    const double top = style_.ground_storey_m;
    for (int column = 0; column < num_columns_; ++column) {
      const double x0 = column * column_m_, x1 = x0 + column_m_, middle = (x0 + x1) / 2;
      const AlignedBox2d cell = area(x0, x1, 0, top);
      if (column == door) {
        const double half = is_gateway ? 0.42 * column_m_ : 0.55;
        const double height = is_gateway ? top - 0.5 : 2.2;
        opening(cell, area(middle - half, middle + half, 0.02, height), 0, is_gateway ? 4 : 0.3, 0.35);
      } else if (style_.has_shops) {
        opening(cell, area(x0 + 0.2, x1 - 0.2, 0.4, top - 0.8), 0, 0.15, 2 * kFacadeGlass);
        if (uniform01(rng_) < 0.35) {
          const double reach = uniform(rng_, 0.6, 1.6);
          box(x0 + 0.1, x1 - 0.1, -reach, 0, top - 0.75, top - 0.65);
        }
      } else {
        add_window(cell, 0, 0);
      }
    }
  }

  /// Columns from `first` on that stand out or back together, up to the roof; the column after them.
  int add_run(int first) {
    const int length = 1 + static_cast<int>(uniform_index(rng_, 3));
    const int last = std::min(num_columns_, first + length);
    const double kind = uniform01(rng_);
    const double out = uniform(rng_, 0.4, 1.2);
    const double in = uniform(rng_, 0.5, 1.6);
    const double y = kind < 0.18 ? -out : kind < 0.28 ? in : 0;
    const bool has_balconies = style_.balcony_m > 0 && uniform01(rng_) < 0.45;
    const double x0 = first * column_m_, x1 = last * column_m_, top = facade_height_m(style_, num_storeys_);
    if (y != 0) add_sides(area(x0, x1, floor_m(1), top), y);
    for (int storey = 1; storey < num_storeys_; ++storey) {
      const double floor = floor_m(storey);
      for (int column = first; column < last; ++column)
        add_window(area(column * column_m_, (column + 1) * column_m_, floor, floor + style_.storey_m), y, 0.12);
      if (has_balconies) add_balcony(x0 + 0.15, x1 - 0.15, y, floor);
    }
    return last;
  }

  /// What closes a run that stands out or back: both sides, top and bottom.
  void add_sides(const AlignedBox2d& run, double y) {
    const double x0 = run.min().x(), x1 = run.max().x(), z0 = run.min().y(), z1 = run.max().y();
    const auto at = [&](double x, double depth, double z) -> Vector3d { return T_world_wall_ * Vector3d(x, depth, z); };
    for (const double x : {x0, x1})
      add_quad(mesh_, at(x, 0, z0), at(x, y, z0), at(x, y, z1), at(x, 0, z1), style_.reflectivity);
    for (const double z : {z0, z1})
      add_quad(mesh_, at(x0, 0, z), at(x1, 0, z), at(x1, y, z), at(x0, y, z), style_.reflectivity);
  }

  void add_window(const AlignedBox2d& cell, double y, double shutter_share) {
    if (uniform01(rng_) < style_.blank_share) return plain(cell, y);
    const bool is_shut = uniform01(rng_) < shutter_share;
    const double middle = cell.center().x(), sill = cell.min().y() + style_.sill_m;
    const double half = std::min(style_.window_width_m / 2, 0.45 * cell.sizes().x());
    const double top = std::min(sill + style_.window_height_m, cell.max().y() - 0.15);
    opening(cell, area(middle - half, middle + half, sill, top), y, is_shut ? 0.05 : style_.recess_m,
            is_shut ? kShutter : kFacadeGlass);
  }

  /// A slab and a railing of bars that light passes between.
  void add_balcony(double x0, double x1, double y, double floor) {
    const double front = y - style_.balcony_m;
    box(x0, x1, front, y, floor - 0.15, floor);
    box(x0, x1, front, front + 0.05, floor + 0.95, floor + 1.05);
    for (double x = x0; x <= x1; x += 0.3) box(x, x + 0.04, front, front + 0.04, floor, floor + 0.95);
  }

  void add_mouldings() {
    const double top = facade_height_m(style_, num_storeys_);
    if (style_.cornice_m > 0) box(0, width_m_, -style_.cornice_m, 0, top - 0.4, top);
    for (int storey = 1; style_.has_bands && storey < num_storeys_; ++storey)
      box(0, width_m_, -0.12, 0, floor_m(storey) - 0.2, floor_m(storey));
    box(0.05, 0.17, -0.14, -0.02, 0, top);  // the downpipe
  }

  TriangleMesh& mesh_;
  const Isometry3d T_world_wall_;
  const double width_m_;
  const int num_storeys_;
  const int num_columns_;
  const double column_m_;
  const FacadeStyle& style_;
  Rng& rng_;
};

}  // namespace

FacadeStyle random_facade_style(Rng& rng) {
  FacadeStyle s;
  s.ground_storey_m = uniform(rng, 3.1, 4.6);
  s.storey_m = uniform(rng, 2.6, 3.7);
  s.column_m = uniform(rng, 2.1, 4.2);
  s.window_width_m = s.column_m * uniform(rng, 0.3, 0.6);
  s.window_height_m = s.storey_m * uniform(rng, 0.42, 0.66);
  s.sill_m = uniform(rng, 0.3, 1.0);
  s.recess_m = uniform(rng, 0.08, 0.4);
  const double cornice = uniform(rng, 0.2, 0.7);
  s.cornice_m = uniform01(rng) < 0.6 ? cornice : 0;
  const double balcony = uniform(rng, 0.8, 1.6);
  s.balcony_m = uniform01(rng) < 0.5 ? balcony : 0;
  s.blank_share = uniform(rng, 0, 0.25);
  s.has_shops = uniform01(rng) < 0.35;
  s.has_bands = uniform01(rng) < 0.4;
  s.reflectivity = uniform(rng, 0.35, 0.8);
  return s;
}

FacadeStyle plain_back(const FacadeStyle& style) {
  FacadeStyle back = style;
  back.cornice_m = 0;
  back.has_shops = back.has_bands = false;
  back.blank_share = 0.5;
  return back;
}

double facade_height_m(const FacadeStyle& style, int num_storeys) {
  return style.ground_storey_m + (num_storeys - 1) * style.storey_m;
}

void add_facade(TriangleMesh& mesh, const Isometry3d& T_world_wall, double width_m, int num_storeys,
                const FacadeStyle& style, Rng& rng) {
  Facade(mesh, T_world_wall, width_m, num_storeys, style, rng).build();
}

}  // namespace tcm_icp
