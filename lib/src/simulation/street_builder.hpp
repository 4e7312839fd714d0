#pragma once
// Builds up both sides of a street: ground, kerbs, what fronts it and what stands about in it.

#include <Eigen/Geometry>

#include "simulation/ground.hpp"
#include "simulation/site_plan.hpp"
#include "simulation/town_objects.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {

/// What tells one quarter of a town from another.
struct StreetStyle {
  double closed_front_share = 0.55;  ///< 0..1, of the stretches between side streets
  double detached_share = 0.27;      ///< likewise; the rest is open ground
  double avenue_share = 0.45;        ///< of the stretches that are lined with trees
  bool has_wires = false;            ///< on poles along one side
  void (*add_tree)(TriangleMesh&, const Eigen::Isometry3d&, Rng&) = tcm_icp::add_tree;
};

class StreetBuilder {
 public:
  /// @param middle  the street's middle line on the map; closed where the last point is the first
  StreetBuilder(const Points& middle, Rng& rng, const StreetStyle& style = {});
  Scene build();

 private:
  /// Stretches of one character follow each other: what tells one part of a street from the next.
  enum class Character { kClosedFront, kDetached, kOpen };

  void lay_road();
  void lay_kerbs();

  // street_front.cpp: what stands on the lots
  void line_side(double side);
  void build_stretch(Character character, double side, double begin_m, double end_m);
  double build_terraced(double side, double at_m, double setback_m, int num_storeys);
  double build_detached(double side, double at_m);
  void plant_open_ground(double side, double begin_m, double end_m);
  void enclose(double side, double at_m, double length_m);
  void build_second_row();

  // street_verge.cpp: what stands in the street
  void string_wires(double side);
  void furnish_side(double side);
  void park_cars(double side, double begin_m, double end_m, double occupancy);
  void plant_avenue(double side, double begin_m, double end_m, double spacing_m);
  void put_small_objects(double side, double begin_m, double end_m);

  double length_m() const { return length_m_; }
  PathPoint at(double distance_m) const;

  /// A site beside the street: its near edge `clearance_m` from the middle line, its front (-y) towards the street.
  Footprint site(double side, double begin_m, const Eigen::Vector2d& half_size_m, double clearance_m) const;
  bool claim(const Footprint& footprint, double margin_m);
  bool claim_lot(const Footprint& footprint, double margin_m);  ///< off road and pavement, too
  Eigen::Isometry3d standing(const Footprint& footprint) const;

  Rng& rng_;
  const Ground ground_;
  const Points middle_;
  const double length_m_;
  const bool is_closed_;
  const StreetStyle style_;
  const double half_road_m_;
  const double pavement_m_;
  SitePlan road_;  ///< with its pavements: no place for lots
  SitePlan plan_;
  Scene scene_;
};

}  // namespace tcm_icp
