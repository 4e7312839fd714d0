#pragma once
// Where the clouds of a text file begin that holds several, one behind the other: PTX, and PTS with counts.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "input_buffer.hpp"
#include "scan_format.hpp"

namespace tcm_icp {

struct CloudStart {
  std::uint64_t offset = 0;        ///< [bytes] of what is in the file
  std::uint64_t lines_before = 0;  ///< lines of the file before it
};

/// Whether a cloud is meant to be all there is in its file: then another one behind it is an error.
enum class CloudIs { kAll, kOneOfSeveral };

/// @throws InputError  that the file holds several scans, of which one is to be named
[[noreturn]] void refuse_several(const InputBuffer& input);

/// The starts of all clouds, by their counts; at least one. A file of several clouds is read to its end, once for each
/// state of it a process meets: every one of its scans is opened several times, and would walk over all before it.
/// Damage is not looked for: what follows it belongs to the last cloud found.
/// @param format  kPtx or kText
std::vector<CloudStart> find_clouds(const std::filesystem::path& path, ScanFormat format);

/// True for a line of one whole number, which is a count.
bool is_count_line(std::string_view line, std::uint64_t& count);

}  // namespace tcm_icp
