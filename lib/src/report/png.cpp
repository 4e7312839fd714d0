#include "report/png.hpp"

#include <zlib.h>

#include <stdexcept>

namespace tcm_icp {
namespace {

void append_big_endian(std::uint32_t value, std::string& to) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) to += static_cast<char>((value >> shift) & 255U);
}

void append_chunk(const std::string& type, const std::string& data, std::string& to) {
  append_big_endian(static_cast<std::uint32_t>(data.size()), to);
  const std::string body = type + data;
  to += body;
  append_big_endian(
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))),
      to);
}

std::string deflated(const std::string& bytes) {
  constexpr int kLevel = 4;  // higher ones take twice the time for a tenth of the size
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                kLevel) != Z_OK) {
    throw std::runtime_error("zlib cannot compress a picture");
  }
  out.resize(size);
  return out;
}

}  // namespace

std::string png(const Image& image) {
  std::string header;
  append_big_endian(static_cast<std::uint32_t>(image.width), header);
  append_big_endian(static_cast<std::uint32_t>(image.height), header);
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, red green blue, deflate, filters by row, not interlaced
  std::string rows;
  rows.reserve(3 * image.pixels.size() + static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    rows += '\0';  // points stand alone: no filter predicts them from their neighbours
    for (int x = 0; x < image.width; ++x) {
      for (const std::uint8_t c : image.at(x, y)) rows += static_cast<char>(c);
    }
  }
  std::string out("\x89PNG\r\n\x1a\n", 8);
  append_chunk("IHDR", header, out);
  append_chunk("IDAT", deflated(rows), out);
  append_chunk("IEND", "", out);
  return out;
}

}  // namespace tcm_icp
