#include "array_source.hpp"

#include <filesystem>
#include <memory>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp::python {
namespace {

// Reads plain memory: no Python object is touched while other threads run Python.
class ArraySource : public ScanSource {
 public:
  ArraySource(const double* points, std::size_t num_points) : next_(points), end_(points + 3 * num_points) {}

  const std::vector<Attribute>& attributes() const override { return attributes_; }

  bool next(Eigen::Vector3d& point, std::byte* /*attributes*/) override {
    if (next_ == end_) return false;
    point = {next_[0], next_[1], next_[2]};
    next_ += 3;
    return true;
  }

 private:
  const double* next_;
  const double* end_;
  std::vector<Attribute> attributes_;
};

}  // namespace

void PythonScans::add_file(const std::string& file) { inputs.emplace_back(std::filesystem::path(file)); }

void PythonScans::add_array(const std::string& name, const PointArray& points) {
  if (points.ndim() != 2 || points.shape(1) != 3) {
    throw InvalidInput(name + ": a cloud is an array of the shape (N, 3); choose the columns x, y, z");
  }
  arrays.push_back(points);
  const double* const data = points.data();
  const auto num_points = static_cast<std::size_t>(points.shape(0));
  inputs.emplace_back(name, [data, num_points] { return std::make_unique<ArraySource>(data, num_points); });
}

}  // namespace tcm_icp::python
