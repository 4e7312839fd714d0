#pragma once
// Pictures as PNG (ISO/IEC 15948).

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tcm_icp {

using Rgb = std::array<std::uint8_t, 3>;

struct Image {
  Image(int image_width, int image_height, Rgb background)
      : width(image_width),
        height(image_height),
        pixels(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height), background) {}

  Rgb& at(int x, int y) { return pixels[position(x, y)]; }
  const Rgb& at(int x, int y) const { return pixels[position(x, y)]; }
  std::size_t position(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  int width, height;
  std::vector<Rgb> pixels;  ///< row by row, from the top
};

/// The bytes of a PNG file; 8 bits a channel, no alpha. The same image gives the same bytes.
std::string png(const Image& image);

}  // namespace tcm_icp
