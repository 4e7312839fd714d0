// PTX as Leica's programs write it: a cloud for each scan, here with all its points in one row, since neither rows and
// columns nor directions without a return are known.

#include <cstring>
#include <utility>

#include "number_text.hpp"
#include "output_file.hpp"
#include "posed_scans_sink.hpp"
#include "scalar.hpp"

namespace tcm_icp {
namespace {

constexpr double kNoIntensity = 0.5;    // as those programs write where they have none
constexpr double kBesideOrigin = 1e-9;  // 0 0 0 would say that there is no point

/// Of whole numbers the range becomes 0 to 1, which is what the format has; others are written as they are.
double ptx_intensity(double value, ScalarType type) {
  if (type == ScalarType::kUInt8) return value / 255;
  return type == ScalarType::kUInt16 ? value / 65535 : value;
}

class PtxSink : public PosedScansSink {
 public:
  explicit PtxSink(std::filesystem::path path) : file_(std::move(path)) {}

  void begin_scan(const std::string& /*name*/, const Eigen::Isometry3d& T_file_scan,
                  const RecordLayout& layout) override {
    end_scan();
    layout_ = layout;
    intensity_ = nullptr;
    for (std::size_t k = layout_.first_attribute(); k < layout_.columns.size(); ++k) {
      if (layout_.columns[k].name == "intensity") intensity_ = &layout_.columns[k];
    }
    is_begun_ = true;
    num_points_ = 0;
    count_position_ = file_.position();
    file_.put(counts());
    // Scanner and axes, then points as rows that are multiplied from the left: each line is a column of ours.
    const Eigen::Matrix4d& T = T_file_scan.matrix();
    put_column(T, 3, false);
    for (Eigen::Index column = 0; column < 3; ++column) put_column(T, column, false);
    for (Eigen::Index column = 0; column < 4; ++column) put_column(T, column, true);
  }

  void write(const std::byte* records, std::size_t count) override {
    text_.clear();
    for (std::size_t i = 0; i < count; ++i) append_point(records + i * layout_.size);
    file_.put(text_);
    num_points_ += count;
  }

  void finish(const std::string& /*description*/, const std::string& /*coordinate_system*/) override {
    if (!is_begun_) begin_scan("", Eigen::Isometry3d::Identity(), {});  // readers want one cloud at least
    end_scan();
    file_.close();
  }

 private:
  /// Columns, then rows, always as long: spaces behind the number take the digits' room.
  std::string counts() const {
    constexpr std::size_t kCountDigits = 20;  // of the largest 64-bit number
    std::string text = std::to_string(num_points_);
    text.resize(kCountDigits, ' ');
    return text + "\n1\n";
  }

  void put_column(const Eigen::Matrix4d& T, Eigen::Index column, bool is_whole) {
    std::string text;
    for (Eigen::Index row = 0; row < (is_whole ? 4 : 3); ++row) {
      if (row > 0) text += ' ';
      text += digits17(T(row, column));
    }
    file_.put(text + '\n');
  }

  void append_point(const std::byte* record) {
    Eigen::Vector3d point;
    std::memcpy(point.data(), record, 3 * sizeof(double));
    if (point.isZero(0)) point.x() = kBesideOrigin;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      append_shortest(point[axis], text_);
      text_ += ' ';
    }
    append_intensity(record);
    for (std::size_t k = 0; layout_.has_colour && k < 3; ++k) {
      const RecordColumn& column = layout_.columns[layout_.first_colour() + k];
      text_ += ' ' + std::to_string(colour_byte(record + column.offset, column.type));
    }
    text_ += '\n';
  }

  void append_intensity(const std::byte* record) {
    if (intensity_ == nullptr) return append_shortest(kNoIntensity, text_);
    const std::byte* const at = record + intensity_->offset;
    if (intensity_->type == ScalarType::kFloat32) return append_shortest(at, intensity_->type, text_);
    append_shortest(ptx_intensity(load_scalar(at, intensity_->type), intensity_->type), text_);
  }

  void end_scan() {
    if (!is_begun_) return;
    const std::uint64_t end = file_.position();
    file_.go_to(count_position_);
    file_.put(counts());
    file_.go_to(end);
  }

  OutputFile file_;
  RecordLayout layout_;                      ///< of the present scan
  const RecordColumn* intensity_ = nullptr;  ///< in it
  bool is_begun_ = false;
  std::uint64_t num_points_ = 0, count_position_ = 0;  ///< of the present scan
  std::string text_;                                   ///< of one block
};

}  // namespace

std::unique_ptr<PosedScansSink> open_ptx(std::filesystem::path path) {
  return std::make_unique<PtxSink>(std::move(path));
}

}  // namespace tcm_icp
