#include "tcm_icp/core/version.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace tcm_icp {
namespace {

TEST(Version, NamesEveryLibraryWithANumber) {
  const auto libraries = linked_libraries();
  ASSERT_EQ(libraries.size(), 8u);  // those of third_party_notes that the library links
  for (const auto& library : libraries) {
    EXPECT_FALSE(library.name.empty());
    EXPECT_GE(std::count(library.version.begin(), library.version.end(), '.'), 1) << library.name;
    EXPECT_NE(library.version.find_first_of("123456789"), std::string::npos) << library.name;
  }
  const std::string number = version();
  EXPECT_EQ(std::count(number.begin(), number.end(), '.'), 2);
  EXPECT_FALSE(commit().empty());
}

}  // namespace
}  // namespace tcm_icp
