// Values come back bit by bit; bytes that are no such record are refused.

#include "steps/step_record.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace tcm_icp {

struct Named {
  int number = 0;
  std::string name;
};

template <typename Record, MaybeConst<Named> T>
void transfer(Record& record, T& value) {
  auto& [number, name] = value;
  record(number, name);
}

namespace {

enum class Colour { kRed, kGreen };

template <typename T>
T there_and_back(const T& value) {
  RecordWriter out;
  out(value);
  T back{};
  RecordReader in(out.bytes());
  in(back);
  in.finish();
  return back;
}

TEST(StepRecord, KeepsEveryBitOfADouble) {
  for (const double value : {0.1, -0.0, 1e-320, std::numeric_limits<double>::infinity(), std::nan("7")}) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(there_and_back(value)), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(StepRecord, KeepsValuesOfAllKinds) {
  EXPECT_EQ(there_and_back(std::string("a\0b", 3)), std::string("a\0b", 3));
  EXPECT_EQ(there_and_back(Colour::kGreen), Colour::kGreen);
  EXPECT_TRUE(there_and_back(true));
  const Points points{{1, 2, 3}, {0.1, -0.2, 1e300}};
  EXPECT_EQ(there_and_back(points), points);
  EXPECT_TRUE(there_and_back(Points()).empty());
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  EXPECT_EQ(there_and_back(bytes), bytes);
  const std::array<double, 3> three{0.1, 0.2, 0.3};
  EXPECT_EQ(there_and_back(three), three);
  EXPECT_EQ(there_and_back(std::optional<int>(7)), std::optional<int>(7));
  EXPECT_EQ(there_and_back(std::optional<int>()), std::optional<int>());
  Eigen::Isometry3d pose = Eigen::Translation3d(0.1, 0.2, 0.3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
  EXPECT_EQ(there_and_back(pose).matrix(), pose.matrix());
  const std::vector<Named> named = there_and_back(std::vector<Named>{{1, "one"}, {2, "two"}});
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[1].number, 2);
  EXPECT_EQ(named[1].name, "two");
}

TEST(StepRecord, TellsValuesApartThatFollowOneAnother) {
  RecordWriter a, b;
  a(std::string("ab"), std::string("c"));
  b(std::string("a"), std::string("bc"));
  EXPECT_NE(a.bytes(), b.bytes());
}

TEST(StepRecord, RefusesBytesThatAreNoSuchRecord) {
  RecordWriter out;
  out(Points{{1, 2, 3}, {4, 5, 6}}, std::vector<Named>{{1, "one"}}, std::optional<bool>(true));
  for (std::size_t size = 0; size < out.bytes().size(); ++size) {
    Points points;
    std::vector<Named> named;
    std::optional<bool> flag;
    RecordReader in(std::string_view(out.bytes()).substr(0, size));
    EXPECT_THROW(in(points, named, flag), BrokenRecord) << size;
  }
  const std::string longer = out.bytes() + "x";
  Points points;
  std::vector<Named> named;
  std::optional<bool> flag;
  RecordReader in(longer);
  in(points, named, flag);
  EXPECT_THROW(in.finish(), BrokenRecord);
  const std::string huge(8, '\xff');  // a size that no memory has
  RecordReader sizes(huge);
  EXPECT_THROW(sizes(points), BrokenRecord);
}

}  // namespace
}  // namespace tcm_icp
