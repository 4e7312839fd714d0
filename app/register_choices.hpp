#pragma once
// Options that stand on the command line as text and are something else in the library's structs: enumerations by name,
// lengths and shares with their unit.

#include <string>

#include "register_options.hpp"

namespace tcm_icp::app {

struct Choices {
  std::string profile, solver, outliers, refinement, formulation, merge_order, without;
  std::string paper_matches, paper_slack, paper_end, paper_points, paper_unknowns, paper_descent;
  std::string method, format, colour, voxel, accept_residual, accept_overlap, accept_sigma;  ///< of a registration

  explicit Choices(const PipelineOptions& options);
  explicit Choices(const RegisterOptions& options);

  /// @throws InvalidOptions where one is none that there is
  void apply(PipelineOptions& to) const;
  /// What a registration has beside its pipeline's options. @throws InvalidOptions, as above
  void apply_beside_pipeline(RegisterOptions& to) const;

  /// The published rivals have no outlier removal: none unless it is asked for. @throws InvalidOptions where a profile
  /// is chosen, which they have none of
  void use_conventional_defaults(bool asks_for_outliers);
};

}  // namespace tcm_icp::app
