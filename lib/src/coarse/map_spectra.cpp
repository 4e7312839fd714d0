#include "map_spectra.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

// Half a cell's weight: a turned cell of which less was seen counts as unseen.
constexpr float kMinWeight = 0.5F;

std::size_t at(int row, int column, int size) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
}

MapImages blank_images(int size) {
  const std::size_t n = at(size, 0, size);
  return {Image(n, 0.0F), Image(n, 0.0F), Image(n, 0.0F)};
}

}  // namespace

MapImages turned_images(const HeightMap& map, double heading_rad, int grid_size) {
  MapImages out = blank_images(grid_size);
  const auto c = static_cast<float>(std::cos(heading_rad)), s = static_cast<float>(std::sin(heading_rad));
  const int middle = grid_size / 2, reach = std::min(middle - 1, map.size / 2 + 1);
  const float half = static_cast<float>(map.size / 2), last = static_cast<float>(map.size - 1);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      // Backwards: where in the map the turned cell came from.
      const float u = c * static_cast<float>(x) + s * static_cast<float>(y) + half;
      const float v = c * static_cast<float>(y) - s * static_cast<float>(x) + half;
      if (!(u >= 0 && v >= 0 && u < last && v < last)) continue;
      const int column = static_cast<int>(u), row = static_cast<int>(v);
      const float du = u - static_cast<float>(column), dv = v - static_cast<float>(row);
      const std::size_t k = at(row, column, map.size), below = k + static_cast<std::size_t>(map.size);
      const float w00 = (1 - du) * (1 - dv), w01 = du * (1 - dv), w10 = (1 - du) * dv, w11 = du * dv;
      const auto interpolated = [&](const auto& image) {
        return w00 * image[k] + w01 * image[k + 1] + w10 * image[below] + w11 * image[below + 1];
      };
      const float weight = interpolated(map.mask);
      if (weight < kMinWeight) continue;
      const std::size_t to = at(y + middle, x + middle, grid_size);
      out.mask[to] = 1;
      out.detail[to] = interpolated(map.detail) / weight;
      out.structure[to] = interpolated(map.structure) / weight;
    }
  }
  return out;
}

MapImages upright_images(const HeightMap& map, bool quarter_turn, int grid_size) {
  MapImages out = blank_images(grid_size);
  const int middle = grid_size / 2, half = map.size / 2;
  for (int row = 0; row < map.size; ++row) {
    for (int column = 0; column < map.size; ++column) {
      const int x = quarter_turn ? half - row : column - half, y = quarter_turn ? column - half : row - half;
      if (x <= -middle || x >= middle || y <= -middle || y >= middle) continue;
      const std::size_t from = at(row, column, map.size), to = at(y + middle, x + middle, grid_size);
      out.detail[to] = map.detail[from];
      out.structure[to] = map.structure[from];
      out.mask[to] = map.mask[from];
    }
  }
  return out;
}

MapSpectra transform(const MapImages& images, const Fourier& fourier) {
  MapSpectra out;
  fourier.forward(images.detail, out.detail);
  fourier.forward(images.structure, out.structure);
  Spectrum full;
  fourier.forward(images.mask, full);
  const int size = fourier.size(), low = size / kMaskStep;
  const auto full_width = static_cast<std::size_t>(size / 2 + 1), low_width = static_cast<std::size_t>(low / 2 + 1);
  out.mask.assign(static_cast<std::size_t>(low) * low_width, {0, 0});
  // Frequencies below the coarse grid's highest, of both signs; the highest itself is left out.
  for (int f = -(low / 2 - 1); f < low / 2; ++f) {
    const auto from = static_cast<std::size_t>(f < 0 ? f + size : f),
               to = static_cast<std::size_t>(f < 0 ? f + low : f);
    for (std::size_t g = 0; g + 1 < low_width; ++g) out.mask[to * low_width + g] = full[from * full_width + g];
  }
  return out;
}

}  // namespace tcm_icp
