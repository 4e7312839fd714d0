#include <utility>

#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {
namespace {

class CloudSource : public ScanSource {
 public:
  explicit CloudSource(const Points& points) : points_(points) {}

  const std::vector<Attribute>& attributes() const override { return attributes_; }

  bool next(Eigen::Vector3d& point, std::byte* /*attributes*/) override {
    if (next_ == points_.size()) return false;
    point = points_[next_++];
    return true;
  }

 private:
  const Points& points_;
  std::vector<Attribute> attributes_;
  std::size_t next_ = 0;
};

}  // namespace

ScanInput scan_in_memory(std::string name, const Cloud& cloud) {
  return {std::move(name), [&points = cloud.points] { return std::make_unique<CloudSource>(points); }};
}

std::vector<ScanInput> scans_in_files(std::span<const std::filesystem::path> files) {
  return {files.begin(), files.end()};
}

}  // namespace tcm_icp
