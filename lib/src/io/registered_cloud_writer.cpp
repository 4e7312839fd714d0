#include "tcm_icp/io/registered_cloud_writer.hpp"

#include <array>
#include <optional>
#include <utility>

#include "cloud_sink.hpp"
#include "e57_writer.hpp"
#include "merged_record.hpp"
#include "posed_scans_sink.hpp"
#include "tcm_icp/core/error.hpp"
#include "well_known_text.hpp"

namespace tcm_icp {

struct RegisteredCloudWriter::Impl {
  explicit Impl(std::vector<std::vector<Attribute>> attributes) : scan_attributes(std::move(attributes)) {}
  virtual ~Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  virtual void write(std::size_t scan, const PointBlock& block, const Eigen::Isometry3d& T_reference_scan) = 0;
  virtual void finish() = 0;
  virtual std::uint64_t num_replaced() const = 0;

  void check_block(std::size_t scan, const PointBlock& block, const std::vector<Attribute>& attributes) const {
    if (scan >= scan_attributes.size()) throw InvalidInput("scan " + std::to_string(scan) + " was not announced");
    if (attributes != scan_attributes[scan] || block.attributes.size() != block.size() * attribute_stride(attributes)) {
      throw InvalidInput("the attributes of scan " + std::to_string(scan) + " are not those announced");
    }
  }

  /// Fills `bytes` with the records of a block.
  void fill(MergedRecord& record, std::size_t scan, const PointBlock& block, const Eigen::Isometry3d& T) {
    const std::size_t stride = record.stride(scan), size = record.layout().size;
    bytes.assign(block.size() * size, std::byte{});
    for (std::size_t i = 0; i < block.size(); ++i) {
      record.fill(scan, block.points[i], block.attributes.data() + i * stride, T, bytes.data() + i * size);
    }
  }

  std::vector<std::vector<Attribute>> scan_attributes;
  std::vector<std::byte> bytes;  ///< of the records of one block
  std::uint64_t num_points = 0;
};

namespace {

std::unique_ptr<CloudSink> open_sink(std::filesystem::path path, const RecordLayout& layout,
                                     const RegisteredCloudOptions& options) {
  switch (options.format) {
    case CloudFormat::kLas:
      return open_las(std::move(path), layout, options);
    case CloudFormat::kPcd:
      return open_pcd(std::move(path), layout, options);
    case CloudFormat::kText:
      return open_text(std::move(path), layout);
    default:
      return open_ply(std::move(path), layout, options);
  }
}

std::unique_ptr<PosedScansSink> open_posed_sink(std::filesystem::path path, CloudFormat format) {
  if (format == CloudFormat::kPtx) return open_ptx(std::move(path));
  return std::make_unique<E57Writer>(std::move(path));
}

}  // namespace

/// All scans as one list of points.
struct RegisteredCloudWriter::OneCloud : RegisteredCloudWriter::Impl {
  OneCloud(std::filesystem::path path, std::vector<std::vector<Attribute>> attributes,
           const RegisteredCloudOptions& options)
      : Impl(std::move(attributes)),
        record(scan_attributes, options.colour, options.one_scan),
        sink(open_sink(std::move(path), record.layout(), options)) {}

  void write(std::size_t scan, const PointBlock& block, const Eigen::Isometry3d& T_reference_scan) override {
    fill(record, scan, block, T_reference_scan);
    sink->write(bytes.data(), block.size());
  }
  void finish() override { sink->finish(num_points); }
  std::uint64_t num_replaced() const override { return record.num_replaced(); }

  MergedRecord record;
  std::unique_ptr<CloudSink> sink;
};

/// Each scan by itself, in its own frame with its pose.
struct RegisteredCloudWriter::ScansWithPoses : RegisteredCloudWriter::Impl {
  ScansWithPoses(std::filesystem::path path, std::vector<std::vector<Attribute>> attributes,
                 RegisteredCloudOptions cloud_options)
      : Impl(std::move(attributes)),
        options(std::move(cloud_options)),
        times_begun(scan_attributes.size(), 0),
        sink(open_posed_sink(std::move(path), options.format)) {}

  void write(std::size_t scan, const PointBlock& block, const Eigen::Isometry3d& T_reference_scan) override {
    if (!record || scan != present) begin(scan, T_reference_scan);
    fill(*record, scan, block, Eigen::Isometry3d::Identity());
    sink->write(bytes.data(), block.size());
  }

  void begin(std::size_t scan, const Eigen::Isometry3d& T_reference_scan) {
    present = scan;
    if (record) replaced_before += record->num_replaced();
    std::vector<std::vector<Attribute>> attributes(scan + 1);
    attributes[scan] = scan_attributes[scan];
    record.emplace(attributes, options.colour, true);
    std::string name = scan < options.scan_names.size() ? options.scan_names[scan] : "scan " + std::to_string(scan + 1);
    if (++times_begun[scan] > 1) name += " (" + std::to_string(times_begun[scan]) + ")";
    sink->begin_scan(name, T_reference_scan, record->layout());
  }

  void finish() override {
    sink->finish(
        "registered by tcm-icp; pose in the frame of " + (options.frame.empty() ? options.reference : options.frame),
        well_known_text(options.crs).value_or(""));
  }
  std::uint64_t num_replaced() const override { return replaced_before + (record ? record->num_replaced() : 0); }

  RegisteredCloudOptions options;
  std::vector<int> times_begun;  ///< of each scan
  std::optional<MergedRecord> record;
  std::size_t present = 0;  ///< scan whose record that is
  std::uint64_t replaced_before = 0;
  std::unique_ptr<PosedScansSink> sink;
};

std::string_view extension_of(CloudFormat format) {
  constexpr std::array<std::string_view, 6> kExtensions{".ply", ".las", ".pcd", ".xyz", ".e57", ".ptx"};
  return kExtensions[static_cast<std::size_t>(format)];
}

bool keeps_scans_apart(CloudFormat format) { return format == CloudFormat::kE57 || format == CloudFormat::kPtx; }

bool needs_box(CloudFormat format) { return format == CloudFormat::kLas || format == CloudFormat::kPcd; }

RegisteredCloudWriter::RegisteredCloudWriter(std::filesystem::path path,
                                             std::vector<std::vector<Attribute>> scan_attributes,
                                             const RegisteredCloudOptions& options) {
  if (keeps_scans_apart(options.format)) {
    impl_ = std::make_unique<ScansWithPoses>(std::move(path), std::move(scan_attributes), options);
  } else {
    impl_ = std::make_unique<OneCloud>(std::move(path), std::move(scan_attributes), options);
  }
}
RegisteredCloudWriter::~RegisteredCloudWriter() = default;
RegisteredCloudWriter::RegisteredCloudWriter(RegisteredCloudWriter&&) noexcept = default;
RegisteredCloudWriter& RegisteredCloudWriter::operator=(RegisteredCloudWriter&&) noexcept = default;

std::uint64_t RegisteredCloudWriter::num_points() const { return impl_->num_points; }
std::uint64_t RegisteredCloudWriter::num_replaced() const { return impl_->num_replaced(); }

void RegisteredCloudWriter::write(std::size_t scan_index, const PointBlock& block,
                                  const std::vector<Attribute>& attributes, const Eigen::Isometry3d& T_reference_scan) {
  impl_->check_block(scan_index, block, attributes);
  impl_->write(scan_index, block, T_reference_scan);
  impl_->num_points += block.size();
}

void RegisteredCloudWriter::finish() { impl_->finish(); }

}  // namespace tcm_icp
