#include "tcm_icp/core/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace tcm_icp {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 8}) {
    for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
      std::vector<int> visits(count, 0);
      parallel_for(threads, count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
  }
}

TEST(ParallelFor, PassesExceptionsOn) {
  for (const int threads : {1, 4}) {
    EXPECT_THROW(parallel_for(threads, 100, [](std::size_t, std::size_t) { throw std::runtime_error("body"); }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace tcm_icp
