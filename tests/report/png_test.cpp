#include "report/png.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include "report/base64.hpp"
#include "report/cloud_picture.hpp"

namespace tcm_icp {
namespace {

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = (value << 8U) | static_cast<std::uint8_t>(bytes.at(at + k));
  return value;
}

TEST(Png, HoldsThePixelsRowByRow) {
  Image image(3, 2, {1, 2, 3});
  image.at(2, 1) = {250, 251, 252};
  const std::string bytes = png(image);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(12, 4), "IHDR");
  EXPECT_EQ(big_endian(bytes, 16), 3U);
  EXPECT_EQ(big_endian(bytes, 20), 2U);
  const std::size_t data = bytes.find("IDAT") + 4;
  std::string rows(2 * (3 * 3 + 1), '?');
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                       reinterpret_cast<const Bytef*>(bytes.data() + data), big_endian(bytes, data - 8)),
            Z_OK);
  ASSERT_EQ(size, rows.size());
  EXPECT_EQ(rows.substr(0, 10), std::string("\0\x01\x02\x03\x01\x02\x03\x01\x02\x03", 10));
  EXPECT_EQ(rows.substr(17), "\xfa\xfb\xfc");
  const std::uint32_t sum = big_endian(bytes, data + big_endian(bytes, data - 8));
  EXPECT_EQ(sum, crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + data - 4), big_endian(bytes, data - 8) + 4));
}

TEST(Base64, IsThatOfRfc4648) {
  const auto of = [](std::string_view text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xff\xfe"), "///+");
}

TEST(CloudPicture, ShowsTheUpperPointFromAboveAndYUp) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1));
  const std::vector<PicturePoint> points{
      {{0, 0, 0.5F}, {200, 0, 0}}, {{0, 0, -0.5F}, {0, 200, 0}}, {{0, 0.9F, 0}, {0, 0, 200}}};
  const Image image = draw_cloud(points, box, PictureView::kTop, 101, 101);
  EXPECT_EQ(image.at(50, 50)[1], 0) << "hidden by the point above it";
  EXPECT_GT(image.at(50, 50)[0], 100);
  int north = 0, south = 0;
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 101; ++x) {
      const Rgb c = image.at(x, y);
      if (c[2] > 50 && c[0] == 0) ++(y < 50 ? north : south);
    }
  }
  EXPECT_GT(north, 0);
  EXPECT_EQ(south, 0);
  EXPECT_EQ(draw_cloud({}, box, PictureView::kOblique, 20, 10).pixels.size(), 200U) << "of no points: paper";
}

}  // namespace
}  // namespace tcm_icp
