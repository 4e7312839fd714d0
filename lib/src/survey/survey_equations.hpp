#pragma once
// The observation equations of a survey frame at a given pose of it: y = A g + B x + e.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "survey/survey_adjustment.hpp"

namespace tcm_icp {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// About which point of the local frame the survey frame turns, and by which arc its rotation is measured.
TwistFrame frame_of_network(const ScanNetwork& network);

/// Unknowns are a step g of T_survey_local about frame_of_network(), and the steps x of all scans, whose covariance is
/// the network's. Rows are those of the points that are used, three each in their order, then the poses that are, and
/// levels.
struct SurveyEquations {
  /// @param whole  frame_of_network()
  SurveyEquations(const ScanNetwork& network, const TwistFrame& whole, const SurveyObservations& observations,
                  const UsedObservations& used, const Eigen::Isometry3d& T_survey_local);

  Eigen::Index num_rows() const { return y.size(); }

  Eigen::VectorXd y;                      ///< [m], for levels [rad]: observed less computed
  Eigen::MatrixXd A;                      ///< by the frame's step
  Eigen::MatrixXd R;                      ///< covariance of e
  Eigen::MatrixXd BC;                     ///< B times the covariance of x
  Eigen::LDLT<Eigen::MatrixXd> S;         ///< of R + B C B'
  std::vector<Eigen::Index> row_of;       ///< first row of each point; -1 where it is not used
  std::vector<Eigen::Index> row_of_pose;  ///< first row of each pose; -1 where it is not used

 private:
  /// A few rows that are about one scan.
  struct Part {
    Eigen::Index row, rows;
    std::size_t scan;
    Eigen::MatrixXd by_scan;  ///< rows x 6
  };
  void add(const ScanNetwork& network, const PointObservation& point, const Eigen::Isometry3d& T_survey_local);
  void add(const ScanNetwork& network, const PoseObservation& pose, const Eigen::Isometry3d& T_survey_local);
  void add(const ScanNetwork& network, const LevelObservation& level, const Eigen::Isometry3d& T_survey_local);
  void begin(Eigen::Index rows, std::size_t scan);
  void factorize(const ScanNetwork& network);

  TwistFrame frame_;  ///< in the survey frame
  std::vector<Part> parts_;
  Eigen::Index next_ = 0;
};

}  // namespace tcm_icp
