// A reader of one's own: scans that are in no file, here the inside of a room as a scanner at two places would measure
// it.
//   own_reader

#include <iostream>
#include <memory>
#include <random>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

// A device would be asked for its next point; each pass has to give the same ones.
class RoomScan : public tcm_icp::ScanSource {
 public:
  explicit RoomScan(std::uint64_t seed) : random_(seed) {}
  const std::vector<tcm_icp::Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* /*attributes*/) override {
    if (++count_ > 30000) return false;
    const int box = static_cast<int>(random_() % 6);  // the room, and five cupboards in it
    const Eigen::Vector3d corner(box * 1.3, box * box * 0.23, 0), edges(7.0 - box, 5.0 - 0.9 * box, 2.6 - 0.3 * box);
    Eigen::Vector3d on_face(unit_(random_), unit_(random_), unit_(random_));
    on_face[count_ % 3] = static_cast<double>(count_ % 2);
    point = corner + on_face.cwiseProduct(edges);
    return true;
  }

 private:
  std::vector<tcm_icp::Attribute> attributes_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0, 1};
  int count_ = 0;
};

int main() {
  try {
    const std::vector<tcm_icp::ScanInput> scans{{"first", [] { return std::make_unique<RoomScan>(1); }},
                                                {"second", [] { return std::make_unique<RoomScan>(2); }}};
    for (const auto& scan : tcm_icp::register_scans(scans).scans) {
      std::cout << scan.name << ": " << to_string(scan.status) << " (" << scan.text << ")\n";
    }
    return 0;
  } catch (const tcm_icp::Error& e) {
    std::cerr << e.what() << '\n';
    return 2;
  }
}
