#pragma once
// A file with the bytes that are to be tried, and what reading a scan must keep to.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp::fuzz {

/// Gone with its end. Each has a name of its own: readers remember by name and time what they saw in a file.
class FuzzFile {
 public:
  FuzzFile(std::string_view bytes, const std::string& extension) {
    static std::uint64_t number = 0;
    static const std::filesystem::path folder = [] {
      auto path = std::filesystem::temp_directory_path() / ("tcm_icp_fuzz_" + std::to_string(::getpid()));
      std::filesystem::create_directories(path);
      return path;
    }();
    path_ = folder / (std::to_string(++number) + extension);
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~FuzzFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Reads all scans of a file: each must come out whole and finite, or be refused by an error of ours.
/// @param suffix  of the path that says more than its name, as "#kitti"
inline void read_all(const std::filesystem::path& file, const std::string& suffix = "") {
  try {
    for (const auto& scan : scans_in(file.string() + suffix)) {
      ScanReader reader(scan);
      PointBlock block;
      while (reader.read(block, 1000)) {
        require(block.size() <= 1000, "no more points than asked for");
        require(block.attributes.size() == block.size() * reader.attribute_stride(), "attributes of each point");
        for (const auto& point : block.points) require(point.allFinite(), "coordinates are finite");
      }
      const auto pose = reader.header_pose();
      require(!pose || pose->matrix().allFinite(), "the pose is finite");
      (void)reader.coordinate_system();
    }
  } catch (const Error&) {
    // refused: as good
  }
}

}  // namespace tcm_icp::fuzz
