#include "tcm_icp/coarse/scan_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

// `count` columns of length 1.
Descriptors random_columns(Eigen::Index count, Rng& rng) {
  Descriptors out(kFpfhSize, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < kFpfhSize; ++i) out(i, k) = static_cast<float>(std::abs(standard_normal(rng)));
    out.col(k).normalize();
  }
  return out;
}

Descriptors beside(const Descriptors& a, const Descriptors& b) {
  Descriptors out(kFpfhSize, a.cols() + b.cols());
  out << a, b;
  return out;
}

DescribedScan described(const std::vector<Descriptors>& levels) {
  DescribedScan out;
  for (const Descriptors& d : levels) out.levels.push_back({1, {}, d});
  return out;
}

// On a road: each scan has the surfaces of two stretches, one of them that of the next scan; and the noise of
// measuring.
std::vector<DescribedScan> road(std::size_t num_scans, float noise, Rng& rng) {
  std::vector<Descriptors> stretches;
  for (std::size_t i = 0; i <= num_scans; ++i) stretches.push_back(random_columns(150, rng));
  std::vector<DescribedScan> out;
  for (std::size_t i = 0; i < num_scans; ++i) {
    Descriptors both = beside(stretches[i], stretches[i + 1]);
    for (Eigen::Index k = 0; k < both.cols(); ++k) {
      for (Eigen::Index d = 0; d < kFpfhSize; ++d) both(d, k) += noise * static_cast<float>(standard_normal(rng));
      both.col(k).normalize();
    }
    out.push_back(described({both}));
  }
  return out;
}

TEST(ScanWords, ScansThatShareSurfacesAreTheMostAlike) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng = make_stream(seed, "scan words");
    const std::size_t n = 40;
    const ScanWords words(road(n, 0.01F, rng), 1);
    ASSERT_EQ(words.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double> likeness = words.likeness(i);
      EXPECT_NEAR(likeness[i], 1, 1e-5) << "itself";
      double neighbours = 1, others = 0;
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        EXPECT_NEAR(likeness[j], words.likeness(j)[i], 1e-6) << "as alike the other way";
        if (j + 1 == i || i + 1 == j) {
          neighbours = std::min(neighbours, likeness[j]);
        } else {
          others = std::max(others, likeness[j]);
        }
      }
      EXPECT_GT(neighbours, 1.5 * others) << "scan " << i;
    }
  }
}

TEST(ScanWords, WhatAllScansHaveSaysNothing) {
  Rng rng = make_stream(4, "scan words");
  // A floor of one kind everywhere, and few surfaces that tell.
  Descriptors floor(kFpfhSize, 400);
  floor.colwise() = random_columns(1, rng).col(0);
  const Descriptors shared = random_columns(20, rng);
  std::vector<DescribedScan> scans;
  for (int i = 0; i < 4; ++i) {
    scans.push_back(described({beside(floor, i < 2 ? shared : random_columns(20, rng))}));
  }
  const std::vector<double> likeness = ScanWords(scans, 1).likeness(0);
  EXPECT_GT(likeness[1], 2 * std::max(likeness[2], likeness[3]));
}

TEST(ScanWords, LevelsCountAlike) {
  Rng rng = make_stream(5, "scan words");
  const Descriptors coarse = random_columns(50, rng), fine = random_columns(500, rng);
  const ScanWords words({described({coarse, fine}), described({coarse, random_columns(500, rng)}),
                         described({random_columns(50, rng), fine})},
                        1);
  const std::vector<double> likeness = words.likeness(0);
  EXPECT_NEAR(likeness[1], likeness[2], 0.15);
  EXPECT_GT(likeness[1], 0.45);
}

TEST(ScanWords, IsTheSameForAnyNumberOfThreads) {
  Rng rng = make_stream(6, "scan words");
  const std::vector<DescribedScan> scans = road(30, 0.05F, rng);
  const ScanWords one(scans, 1), five(scans, 5);
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(one.likeness(i), five.likeness(i));
}

TEST(ScanWords, AnswersForScansWithoutKeypoints) {
  Rng rng = make_stream(7, "scan words");
  const DescribedScan nothing = described({Descriptors(kFpfhSize, 0)});
  const ScanWords words({nothing, described({random_columns(10, rng)}), nothing}, 1);
  EXPECT_EQ(words.likeness(0), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(words.likeness(1)[2], 0);
  EXPECT_EQ(ScanWords({}, 1).size(), 0u);
  EXPECT_EQ(ScanWords({nothing, nothing}, 1).likeness(1), (std::vector<double>{0, 0}));
}

TEST(ScanWords, RefusesScansOfDifferentLevels) {
  Rng rng = make_stream(8, "scan words");
  const Descriptors d = random_columns(5, rng);
  EXPECT_THROW(ScanWords({described({d}), described({d, d})}, 1), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
