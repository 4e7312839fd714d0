#pragma once
// The correspondence graph G = (V, E) of the paper, and the reference scan it picks.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace tcm_icp {

struct CorrespondenceGraph {
  Eigen::MatrixXd measure;  ///< n x n, symmetric; smaller is closer; infinite where a pair has none; diagonal unused
  double threshold = 0;     ///< pairs below it are connected
  bool threshold_from_data = false;
  std::vector<std::vector<std::size_t>> adjacency;  ///< for each scan its connected scans, ascending
  std::vector<std::size_t> component;               ///< for each scan its group, numbered in file order from 0
  std::size_t num_components = 0;
  std::size_t reference = 0;  ///< see choose_reference

  std::size_t size() const { return adjacency.size(); }
  std::size_t degree(std::size_t scan) const { return adjacency[scan].size(); }
};

/// A threshold from the measures alone: just above the median of the finite ones of different scans, so the nearer half
/// of the pairs is connected, whatever the unit. 0 (nothing connected) where none is finite.
/// @note Made for distances. Overlaps mean something by themselves: give 1 - (least overlap that counts) instead.
double correspondence_threshold(const Eigen::MatrixXd& measure);

/// Connects scans i and j where measure(i, j) < threshold; the threshold comes from the data where none is given.
/// @throws InvalidInput  if the matrix is empty, not square, not symmetric or has a NaN off the diagonal, or the
/// threshold is NaN
CorrespondenceGraph build_correspondence_graph(const Eigen::MatrixXd& measure, std::optional<double> threshold = {});

/// The scan with the most connections; among equals the one nearest the middle of the file list, then the earlier one.
/// @throws InvalidInput  if there is no scan
std::size_t choose_reference(const std::vector<std::vector<std::size_t>>& adjacency);

}  // namespace tcm_icp
