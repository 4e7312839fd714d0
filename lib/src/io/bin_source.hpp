#pragma once
// Points as bare floats without a header: the .bin files of KITTI and nuScenes.

#include <cstdint>
#include <vector>

#include "input_buffer.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

class BinSource : public ScanSource {
 public:
  /// @throws InputError  if the file has no whole number of points
  BinSource(InputBuffer input, BinLayout layout);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;

 private:
  InputBuffer input_;
  std::vector<Attribute> attributes_;
  std::size_t record_size_;  ///< [bytes]
};

}  // namespace tcm_icp
