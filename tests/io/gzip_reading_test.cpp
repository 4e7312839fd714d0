#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

#include "io/ply_text.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using test::error_of;
using test::read_whole;
using test::TempFolder;

std::filesystem::path write_gzip(const TempFolder& folder, const std::string& name, const std::string& content) {
  const auto path = folder.path() / name;
  const gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, content.data(), static_cast<unsigned>(content.size())), static_cast<int>(content.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
  return path;
}

std::string many_lines() {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i) + " 0.5 " + std::to_string(i * 7919 % 1000) + "\n";
  return text;
}

TEST(GzipReading, GivesWhatIsPacked) {
  const TempFolder folder;
  const std::string text = many_lines();
  const auto plain = read_whole(folder.write("a.xyz", text));
  EXPECT_EQ(read_whole(write_gzip(folder, "a.xyz.gz", text)).block.points, plain.block.points);
  EXPECT_EQ(read_whole(write_gzip(folder, "b.xyz", text)).block.points, plain.block.points) << "whatever the name";
  const std::string ply = test::ply_header("binary_little_endian", test::xyz_vertices(1)) + test::bytes_of(1.F) +
                          test::bytes_of(2.F) + test::bytes_of(3.F);
  EXPECT_EQ(read_whole(write_gzip(folder, "a.ply.gz", ply)).block.points, Points({{1, 2, 3}}));
}

TEST(GzipReading, DamageIsFound) {
  const TempFolder folder;
  const std::string packed = test::read_text(write_gzip(folder, "a.xyz.gz", many_lines()));
  const auto message = [&](const std::string& content) {
    const auto path = folder.write("b.xyz.gz", content);
    return error_of<InputError>([&] { read_whole(path); });
  };
  EXPECT_NE(message(packed.substr(0, packed.size() / 2)).find("damaged or cut off"), std::string::npos);
  EXPECT_NE(message(packed.substr(0, packed.size() - 3)).find("damaged or cut off"), std::string::npos);
  std::string flipped = packed;
  flipped[packed.size() - 6] = static_cast<char>(flipped[packed.size() - 6] ^ 1);  // the check sum
  EXPECT_NE(message(flipped).find("damaged or cut off"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
