// Files packed by gzip: any bytes behind the head of one, or, where the first byte is even, any bytes packed.

#include <zlib.h>

#include "fuzz_file.hpp"

namespace {

std::string packed(std::string_view content) {
  z_stream stream{};
  constexpr int kGzip = 16 + 15;
  tcm_icp::fuzz::require(deflateInit2(&stream, 1, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) == Z_OK, "zlib starts");
  std::string out(deflateBound(&stream, static_cast<uLong>(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string bytes = data[0] % 2 == 0 ? packed(rest) : "\x1f\x8b" + std::string(rest);
  constexpr const char* kExtensions[] = {".xyz.gz", ".ptx.gz", ".las", ".pcd.gz"};
  const tcm_icp::fuzz::FuzzFile file(bytes, kExtensions[data[0] / 2 % 4]);
  tcm_icp::fuzz::read_all(file.path());
  return 0;
}
