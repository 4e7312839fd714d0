#include "tcm_icp/io/scan_inputs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using test::error_of;
using test::TempFolder;

constexpr const char* kPoints = "1 2 3\n4 5 6\n";

/// Relative to `folder`.
std::vector<std::string> found_in(const TempFolder& folder, const std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  for (const auto& path : find_scans(inputs).scans) names.push_back(path.lexically_relative(folder.path()).string());
  return names;
}

TEST(NaturalOrder, NumbersCompareAsNumbers) {
  std::vector<std::string> names{"scan10.ply", "scan2.ply", "scan1b",  "scan1",
                                 "scan02.ply", "a",         "scan1a2", "scan1a10"};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_EQ(names, std::vector<std::string>(
                       {"a", "scan1", "scan1a2", "scan1a10", "scan1b", "scan02.ply", "scan2.ply", "scan10.ply"}));
}

TEST(NaturalOrder, IsOneOrder) {
  const std::vector<std::string> names{"", "0", "00", "01", "1", "1a", "a1", "a01", "99999999999999999999999", "a"};
  for (const auto& a : names) {
    EXPECT_FALSE(natural_less(a, a));
    for (const auto& b : names) {
      if (a != b) {
        EXPECT_NE(natural_less(a, b), natural_less(b, a)) << a << ' ' << b;
      }
    }
  }
}

TEST(FindScans, FilesStayInTheirOrder) {
  const TempFolder folder;
  const auto b = folder.write("b.xyz", kPoints), a = folder.write("a.xyz", kPoints);
  EXPECT_EQ(found_in(folder, {b, a}), std::vector<std::string>({"b.xyz", "a.xyz"}));
}

TEST(FindScans, AFolderGivesAllScansBelowItInNaturalOrder) {
  const TempFolder folder;
  for (const char* const sub : {"Setup10", "Setup2", ".hidden", "result"}) {
    std::filesystem::create_directory(folder.path() / sub);
  }
  folder.write("Setup10/scan.xyz", kPoints);
  folder.write("Setup2/scan.xyz", kPoints);
  folder.write("Setup2/two.pts", "1\n1 2 3\n1\n4 5 6\n");
  folder.write("Setup2/notes.txt", "taken in the rain\n");
  folder.write("Setup2/photo.jpg", "no scan");
  folder.write(".hidden/scan.xyz", kPoints);
  folder.write("result/poses.json", "{}");
  folder.write("result/registered.ply", "ply\n");
  EXPECT_EQ(found_in(folder, {folder.path()}),
            std::vector<std::string>({"Setup2/scan.xyz", "Setup2/two.pts#1", "Setup2/two.pts#2", "Setup10/scan.xyz"}));
  const auto left_out = find_scans({folder.path()}).left_out;
  ASSERT_EQ(left_out.size(), 2u);
  EXPECT_NE(left_out[0].find("notes.txt"), std::string::npos);
  EXPECT_NE(left_out[1].find("photo.jpg"), std::string::npos);
}

TEST(FindScans, ADamagedScanInAFolderIsAnErrorAndNotLeftOut) {
  const TempFolder folder;
  folder.write("a.xyz", kPoints);
  const auto message = [&](const std::string& name, const std::string& content) {
    const auto path = folder.write(name, content);
    const std::string text = error_of<InputError>([&] { find_scans({folder.path()}); });
    std::filesystem::remove(path);
    return text;
  };
  EXPECT_NE(message("b.ply", "ply\nformat ascii 1.0\n").find("b.ply: header line 2"), std::string::npos);
  EXPECT_NE(message("b.xyz", "1 2\n").find("b.xyz: line 1"), std::string::npos);
  EXPECT_NE(message("b.xyz", "").find("b.xyz: is empty"), std::string::npos);
  EXPECT_NE(message("b.dat", "LASF").find("b.dat: header: ends within its header"), std::string::npos);
}

TEST(FindScans, APatternGivesWhatItMatches) {
  const TempFolder folder;
  for (const char* const name : {"scan10.xyz", "scan2.xyz", "other.xyz"}) folder.write(name, kPoints);
  EXPECT_EQ(found_in(folder, {folder.path() / "scan*.xyz"}), std::vector<std::string>({"scan2.xyz", "scan10.xyz"}));
  EXPECT_EQ(found_in(folder, {folder.path() / "scan[0-9].xyz"}), std::vector<std::string>({"scan2.xyz"}));
  folder.write("a[1].xyz", kPoints);
  EXPECT_EQ(found_in(folder, {folder.path() / "a[1].xyz"}), std::vector<std::string>({"a[1].xyz"}))
      << "a file of that name comes first";
}

TEST(FindScans, NothingFoundIsAnError) {
  const TempFolder folder;
  const auto message = [&](const std::string& input) {
    return error_of<InputError>([&] { find_scans({folder.path() / input}); });
  };
  EXPECT_NE(message("").find("is a folder without a scan"), std::string::npos);
  EXPECT_NE(message("*.ply").find("no file matches"), std::string::npos);
  EXPECT_NE(message("none.ply").find("there is no such file"), std::string::npos);
  folder.write("notes.txt", "taken in the rain\n");
  EXPECT_NE(message("").find("notes.txt"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
