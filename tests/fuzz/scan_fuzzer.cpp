// Any bytes as a file of scans, of the extension TCM_ICP_FUZZ_EXTENSION, and of TCM_ICP_FUZZ_LAYOUT where that is .bin.

#include "fuzz_file.hpp"

namespace {

/// CRC-32C, bit by bit.
std::uint32_t check_sum(std::string_view bytes) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0x82F63B78U : 0U);
  }
  return ~sum;
}

/// With the check sums an E57 file must have: what is behind them is to be tried.
std::string with_check_sums(std::string bytes) {
  if (!bytes.starts_with("ASTM-E57")) return bytes;
  for (std::size_t page = 0; page + 1024 <= bytes.size(); page += 1024) {
    const std::uint32_t sum = check_sum(std::string_view(bytes).substr(page, 1020));
    for (unsigned i = 0; i < 4; ++i) bytes[page + 1020 + i] = static_cast<char>(sum >> (24 - 8 * i));
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string layout = TCM_ICP_FUZZ_LAYOUT;
  const std::string bytes = with_check_sums({reinterpret_cast<const char*>(data), size});
  const tcm_icp::fuzz::FuzzFile file(bytes, TCM_ICP_FUZZ_EXTENSION);
  tcm_icp::fuzz::read_all(file.path(), layout.empty() ? layout : "#" + layout);
  return 0;
}
