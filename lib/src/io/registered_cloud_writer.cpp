#include "tcm_icp/io/registered_cloud_writer.hpp"

#include <array>
#include <utility>

#include "cloud_sink.hpp"
#include "merged_record.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
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
    case CloudFormat::kPly:
      break;
  }
  return open_ply(std::move(path), layout, options);
}

}  // namespace

std::string_view extension_of(CloudFormat format) {
  constexpr std::array<std::string_view, 4> kExtensions{".ply", ".las", ".pcd", ".xyz"};
  return kExtensions[static_cast<std::size_t>(format)];
}

bool needs_box(CloudFormat format) { return format == CloudFormat::kLas || format == CloudFormat::kPcd; }

struct RegisteredCloudWriter::Impl {
  Impl(std::filesystem::path path, std::vector<std::vector<Attribute>> attributes,
       const RegisteredCloudOptions& options)
      : scan_attributes(std::move(attributes)),
        record(scan_attributes, options.colour, options.one_scan),
        sink(open_sink(std::move(path), record.layout(), options)) {}

  void check_block(std::size_t scan, const PointBlock& block, const std::vector<Attribute>& attributes) const {
    if (scan >= scan_attributes.size()) throw InvalidInput("scan " + std::to_string(scan) + " was not announced");
    if (attributes != scan_attributes[scan] || block.attributes.size() != block.size() * record.stride(scan)) {
      throw InvalidInput("the attributes of scan " + std::to_string(scan) + " are not those announced");
    }
  }

  std::vector<std::vector<Attribute>> scan_attributes;
  MergedRecord record;
  std::unique_ptr<CloudSink> sink;
  std::vector<std::byte> bytes;  ///< of the records of one block
  std::uint64_t num_points = 0;
};

RegisteredCloudWriter::RegisteredCloudWriter(std::filesystem::path path,
                                             std::vector<std::vector<Attribute>> scan_attributes,
                                             const RegisteredCloudOptions& options)
    : impl_(std::make_unique<Impl>(std::move(path), std::move(scan_attributes), options)) {}
RegisteredCloudWriter::~RegisteredCloudWriter() = default;
RegisteredCloudWriter::RegisteredCloudWriter(RegisteredCloudWriter&&) noexcept = default;
RegisteredCloudWriter& RegisteredCloudWriter::operator=(RegisteredCloudWriter&&) noexcept = default;

std::uint64_t RegisteredCloudWriter::num_points() const { return impl_->num_points; }
std::uint64_t RegisteredCloudWriter::num_replaced() const { return impl_->record.num_replaced(); }

void RegisteredCloudWriter::write(std::size_t scan_index, const PointBlock& block,
                                  const std::vector<Attribute>& attributes, const Eigen::Isometry3d& T_reference_scan) {
  Impl& impl = *impl_;
  impl.check_block(scan_index, block, attributes);
  const std::size_t stride = impl.record.stride(scan_index), size = impl.record.layout().size;
  impl.bytes.assign(block.size() * size, std::byte{});
  for (std::size_t i = 0; i < block.size(); ++i) {
    impl.record.fill(scan_index, block.points[i], block.attributes.data() + i * stride, T_reference_scan,
                     impl.bytes.data() + i * size);
  }
  impl.sink->write(impl.bytes.data(), block.size());
  impl.num_points += block.size();
}

void RegisteredCloudWriter::finish() { impl_->sink->finish(impl_->num_points); }

}  // namespace tcm_icp
