#pragma once
// The street side of a town building.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

struct FacadeStyle {
  double ground_storey_m = 3.6;
  double storey_m = 3.0;
  double column_m = 2.8;  ///< from window to window
  double window_width_m = 1.2;
  double window_height_m = 1.7;
  double sill_m = 0.8;
  double recess_m = 0.2;     ///< of the windows
  double cornice_m = 0;      ///< stands out by this; 0 for none
  double balcony_m = 0;      ///< likewise
  double blank_share = 0.1;  ///< of the places for windows
  bool has_shops = false;    ///< wide openings and awnings on the ground floor
  bool has_bands = false;    ///< a moulding at each storey
  double reflectivity = 0.6;
};

/// Any of the above, within what towns have.
FacadeStyle random_facade_style(Rng& rng);

/// The same walls without what only a street side has.
FacadeStyle plain_back(const FacadeStyle& style);

double facade_height_m(const FacadeStyle& style, int num_storeys);

/// A wall of `width_m` from the origin of its frame along x, facing -y: windows in columns, runs of columns that stand
/// out (bays) or back (loggias), a door or gateway, balconies, and a footing below the ground, which is not level.
void add_facade(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_wall, double width_m, int num_storeys,
                const FacadeStyle& style, Rng& rng);

}  // namespace tcm_icp
