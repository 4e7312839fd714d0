#pragma once
// The points of a LAS file, one after the other.

#include <cstdint>
#include <string>
#include <vector>

#include "input_buffer.hpp"
#include "las_header.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

class LasSource : public ScanSource {
 public:
  explicit LasSource(InputBuffer input);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;
  std::string coordinate_system() const override { return header_.coordinate_system; }

 private:
  /// How an attribute comes out of a record.
  enum class Rule {
    kCopy,      ///< bytes as they are
    kBits,      ///< `mask` of a byte, from its bit `shift` on
    kAngle,     ///< degrees as a whole number
    kAngle006,  ///< in steps of 0.006 degrees
    kExtra,     ///< number of LasHeader::extras[index], as double
  };
  struct Field {
    Rule rule;
    std::size_t from, to, size;  ///< [bytes] in the record, in the attributes, of the value
    unsigned mask = 0, shift = 0;
    std::size_t index = 0;
  };

  void lay_out();
  void add(const char* name, ScalarType type, Rule rule, std::size_t from, unsigned mask = 0, unsigned shift = 0);
  void add_extras();
  void fill(const std::byte* record, std::byte* attributes) const;

  InputBuffer input_;
  LasHeader header_;
  std::vector<Attribute> attributes_;
  std::vector<Field> fields_;
  std::size_t stride_ = 0;
  std::uint64_t num_read_ = 0;
};

}  // namespace tcm_icp
