#include "tcm_icp/core/memory_limit.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace tcm_icp {
namespace {

// So many are kept in memory as they are where it holds them: to put them away and take them back is 5 % of their time,
// of a street of 60 it is 2 to 4.
constexpr std::size_t kFewScans = 25;
constexpr std::size_t kOfFewScans = std::size_t{2} << 30;
constexpr std::size_t kOfLargeSet = std::size_t{256} << 20, kOfEachScan = std::size_t{2} << 20;

// The number a file begins with; the largest there is where it has none, as where the limit is "max".
std::size_t number_in(const std::string& path) {
  std::ifstream in(path);
  std::size_t number = 0;
  return in >> number ? number : std::numeric_limits<std::size_t>::max();
}

// Of the control group and all above it: inside a container the group's own files lie at the root.
std::size_t group_limit() {
  std::size_t least =
      std::min(number_in("/sys/fs/cgroup/memory.max"), number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const bool version_2 = line.starts_with("0::/");
    const std::size_t version_1 = line.find(":memory:/");
    if (!version_2 && version_1 == std::string::npos) continue;
    std::string path = line.substr(version_2 ? 3 : version_1 + 8);
    for (; path.size() > 1; path.resize(std::max<std::size_t>(1, path.rfind('/')))) {
      least = std::min(least, version_2 ? number_in("/sys/fs/cgroup" + path + "/memory.max")
                                        : number_in("/sys/fs/cgroup/memory" + path + "/memory.limit_in_bytes"));
    }
  }
  return least;
}

std::size_t page_bytes() { return static_cast<std::size_t>(std::max(0L, sysconf(_SC_PAGESIZE))); }

}  // namespace

std::size_t available_memory() {
  const auto pages = static_cast<std::size_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  return std::min(pages * page_bytes(), group_limit());
}

std::size_t default_memory_limit(std::size_t num_scans) {
  const std::size_t most = num_scans <= kFewScans ? kOfFewScans : kOfLargeSet + num_scans * kOfEachScan;
  return std::min(available_memory() / 2, most);
}

std::size_t resident_memory() {
  std::ifstream in("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  return in >> size >> resident ? resident * page_bytes() : 0;
}

}  // namespace tcm_icp
