#pragma once
// The numbers of an E57 scan's points: byte streams, one a column, cut into packets.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "e57_header.hpp"
#include "e57_pages.hpp"

namespace tcm_icp {

class E57Points {
 public:
  /// @param wanted  indices of the fields that are to be read, each once; the others are stepped over
  /// @throws InputError  if the section of the points is damaged
  E57Points(E57Pages& pages, const E57Scan& scan, const std::vector<std::size_t>& wanted);

  /// The next `n` <= kBatch values of each wanted field, in its order: values()[k][i].
  /// @throws InputError  where the packets end before, or are damaged
  void read(std::size_t n);

  const std::vector<std::vector<double>>& values() const { return values_; }

  static constexpr std::size_t kBatch = 1024;

 private:
  /// What of a column's bytes is read and not yet taken.
  struct Column {
    const E57Field* field = nullptr;
    std::vector<std::byte> bytes;
    std::uint64_t bit = 0;  ///< of the next value, in `bytes`
  };

  void check_room(const E57Scan& scan) const;
  void read_section(const E57Scan& scan);
  void read_packet();
  static void compact(Column& column);
  static void unpack(Column& column, std::span<double> values);
  [[noreturn]] void fail(const std::string& problem) const;

  E57Pages& pages_;
  std::size_t num_fields_;
  std::vector<int> column_of_;  ///< of each field; -1 where it is not wanted
  std::vector<Column> columns_;
  std::vector<std::vector<double>> values_;
  std::uint64_t next_packet_ = 0, end_ = 0;  ///< [bytes] logical
  std::vector<std::byte> packet_;
  std::uint64_t num_read_ = 0, num_points_;
};

}  // namespace tcm_icp
