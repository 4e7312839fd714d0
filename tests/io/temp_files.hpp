#pragma once
// A folder that goes away with the test, and files in it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp::test {

/// A folder of its own for each test; removed at its end.
class TempFolder {
 public:
  TempFolder() {
    const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("tcm_icp_") + info->test_suite_name() + "_" + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() {
    std::error_code ignored;  // a destructor must not throw; a folder that stays does no harm
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

/// All of a file, in one block.
struct WholeScan {
  std::vector<Attribute> attributes;
  PointBlock block;
  std::uint64_t num_dropped = 0;
};

inline WholeScan read_whole(const std::filesystem::path& path, ReadAttributes read_attributes = ReadAttributes::kYes) {
  ScanReader reader(path, read_attributes);
  WholeScan scan;
  scan.attributes = reader.attributes();
  reader.read(scan.block, 100'000'000);
  PointBlock rest;
  EXPECT_FALSE(reader.read(rest));
  scan.num_dropped = reader.num_dropped();
  return scan;
}

/// The message of the error that `action` throws; the test fails where it throws another or none.
template <typename ExpectedError, typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const ExpectedError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// One attribute of one point, as a number.
template <typename T>
T attribute_of(const WholeScan& scan, std::size_t point, const std::string& name) {
  std::size_t offset = point * attribute_stride(scan.attributes);
  for (const auto& attribute : scan.attributes) {
    if (attribute.name != name) {
      offset += scalar_size(attribute.type);
      continue;
    }
    EXPECT_EQ(scalar_size(attribute.type), sizeof(T));
    T value{};
    std::memcpy(&value, scan.block.attributes.data() + offset, sizeof(T));
    return value;
  }
  ADD_FAILURE() << "there is no attribute " << name;
  return {};
}

}  // namespace tcm_icp::test
