#pragma once
// Where the paper's text leaves its registration open: one field a question, the default as measured best.
// docs/decisions/0009-paper-profile-readings.md has what the text allows, and the figures.

namespace tcm_icp {

/// Which points of the scan the simplex gets a counterpart for.
enum class PaperMatches {
  kNearest,    ///< every point, with its nearest neighbour in S
  kThreshold,  ///< those whose neighbour is within the threshold of the correspondence graph
  kMutual,     ///< those that are their neighbour's nearest, too
};

/// What slack P' = R P + T leaves in each coordinate.
enum class PaperSlack {
  kBoth,     ///< = with slack both ways: least sum of absolute residuals
  kAbove,    ///< P' < R P + T for all points, least slack
  kBelow,    ///< P' > R P + T for all points, least slack
  kBetween,  ///< the mean of the two above
};

/// What ends the rounds of matching and simplex.
enum class PaperEnd {
  kMotion,  ///< points no longer move
  kSlack,   ///< the mean slack no longer falls; the best round's pose is taken
};

enum class PaperPoints { kSample, kAll };           ///< of the scan, at the coarse voxel
enum class PaperUnknowns { kEntries, kTwist };      ///< 12 entries of R and T, or 6 of a small motion
enum class PaperDescent { kWholeScans, kMatches };  ///< what the descent takes tau over

struct PaperOptions {
  PaperMatches matches = PaperMatches::kMutual;
  double kept_share = 1;  ///< in (0, 1]; of the matches, those with the least distances
  int max_rounds = 100;   ///< >= 1; of matching and simplex
  PaperEnd end = PaperEnd::kMotion;
  PaperPoints points = PaperPoints::kAll;
  PaperSlack slack = PaperSlack::kBoth;
  PaperUnknowns unknowns = PaperUnknowns::kEntries;
  PaperDescent descent = PaperDescent::kWholeScans;
  double marginal_share = 0.001;  ///< > 0; of the coarse voxel: the first marginal change of the descent
  void validate() const;          ///< throws InvalidOptions
};

}  // namespace tcm_icp
