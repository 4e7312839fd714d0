#include "pipeline/registered_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include "pipeline/value_range.hpp"
#include "pipeline/voxel_thinner.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

/// Leaves the points of a block for which `keep` is not 0.
void select(const PointBlock& block, std::size_t stride, const std::vector<char>& keep, PointBlock& kept) {
  kept.points.clear();
  kept.attributes.clear();
  for (std::size_t k = 0; k < block.size(); ++k) {
    if (keep[k] == 0) continue;
    kept.points.push_back(block.points[k]);
    const auto* const bytes = block.attributes.data() + k * stride;
    kept.attributes.insert(kept.attributes.end(), bytes, bytes + stride);
  }
}

using Use = std::function<void(const PointBlock&)>;

/// The raw points of a scan, without its outliers.
void stream_kept(std::span<const ScanInput> inputs, std::size_t i, const PipelineResult& result,
                 ReadAttributes read_attributes, const RunContext& context, const Use& use) {
  const ScanSummary& scan = result.scans[i];
  ScanReader reader(inputs[i], read_attributes);
  PointBlock block, kept;
  std::vector<char> keep;
  while (reader.read(block)) {
    context.report("writing", i, inputs.size());
    keep.resize(block.size());
    parallel_for(context.num_threads, block.size(), [&](std::size_t begin, std::size_t end) {
      std::uint32_t near = 0;
      for (std::size_t k = begin; k < end; ++k) {
        keep[k] = scan.outliers.is_outlier(block.points[k] - scan.origin, near) ? 0 : 1;
      }
    });
    select(block, reader.attribute_stride(), keep, kept);
    if (kept.size() > 0) use(kept);
  }
}

class CloudOutput {
 public:
  CloudOutput(const fs::path& folder, std::span<const ScanInput> inputs, const PipelineResult& result,
              const OutputOptions& options, const RunContext& context, const PointWatcher& watcher,
              std::optional<std::size_t> only = std::nullopt)
      : folder_(folder),
        inputs_(inputs),
        result_(result),
        options_(options),
        context_(context),
        watcher_(watcher),
        only_(only) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      attributes_.push_back(is_written(i) ? ScanReader(inputs_[i]).attributes() : std::vector<Attribute>());
    }
    cloud_.format = options.format;
    cloud_.colour = options.colour;
    cloud_.reference = result.scans[result.reference].file;
    for (const auto& pose : result.poses) cloud_.scan_names.push_back(pose.file);
    if (result.survey.has_frame) {
      cloud_.frame = result.survey.defined_by;
      cloud_.crs = result.survey.crs;
      const bool needs_text = wants_text() && !cloud_.crs.empty() && !las_names_crs(cloud_.crs);
      if (needs_text && las_names_crs(options.crs_text)) cloud_.crs = options.crs_text;
    } else if (options.format == CloudFormat::kE57 && !only_) {
      name_coordinate_system();
    }
  }

  fs::path write_one() {
    const std::size_t i = only_.value();
    if (needs_box(options_.format)) measure_boxes();
    for (std::size_t k = 0; k < i; ++k) {
      if (is_registered(k)) file_of(result_.poses[k].file);  // names that others take
    }
    std::string name;
    RegisteredCloudWriter own = open_scan(i, name);
    stream(i, ReadAttributes::kYes,
           [&](const PointBlock& block) { own.write(i, block, attributes_[i], result_.poses[i].T_reference_scan); });
    own.finish();
    warn_of_replaced(own.num_replaced(), "scans/");
    return fs::path("scans") / name;
  }

  void write(std::uint64_t most_voxels) {
    if (needs_box(options_.format)) measure_boxes();
    const std::uint64_t num_parts = count_parts(most_voxels);
    const std::string name = "registered" + std::string(extension_of(options_.format));
    std::optional<RegisteredCloudWriter> merged;
    if (options_.merged) merged.emplace(folder_ / name, attributes_, cloud_);
    for (std::uint64_t part = 0; part < num_parts; ++part) write_part(part, num_parts, merged);
    if (merged) merged->finish();
    if (merged) warn_of_replaced(merged->num_replaced(), name);
    warn_of_replaced(num_replaced_in_scans_, "scans/");
    if (wants_text() && !cloud_.crs.empty() && !las_names_crs(cloud_.crs)) {
      context_.warn(name + " does not name the coordinate system " + cloud_.crs + ": the format wants its " +
                    "well-known text, which is not known here; give a file with it to --crs");
    }
    if (options_.format == CloudFormat::kPtx) warn_of_left_out(name);
    if (options_.format == CloudFormat::kPcd && pcd_needs_doubles(cloud_.box, cloud_.largest_step)) {
      context_.warn(name + " has its coordinates as doubles, which PCL does not read: floats would round them to " +
                    "more than a millionth of a scan; choose a --reference near the origin, or --format las");
    }
  }

 private:
  bool wants_text() const { return options_.format == CloudFormat::kLas || options_.format == CloudFormat::kE57; }

  bool is_written(std::size_t i) const { return !only_ || *only_ == i; }

  bool is_registered(std::size_t i) const { return result_.poses[i].status != ScanStatus::kUnregistered; }

  /// The coordinates of the reference scan are those of the result: what its file says of them holds for both. E57 has
  /// well-known text there, and no codes.
  void name_coordinate_system() {
    const ScanReader reader(inputs_[result_.reference], ReadAttributes::kNo);
    const std::string system = reader.coordinate_system();
    if (system.find('[') == std::string::npos || result_.scans[result_.reference].unit != "m") return;
    const Eigen::Isometry3d& T = result_.poses[result_.reference].T_reference_scan;
    if (T.matrix() == Eigen::Matrix4d::Identity() && is_in_file_frame(reader)) cloud_.crs = system;
  }

  /// What an E57 file says of coordinates holds for points moved by the pose in its header.
  static bool is_in_file_frame(const ScanReader& reader) {
    try {
      const auto pose = reader.header_pose();
      return !pose || pose->matrix() == Eigen::Matrix4d::Identity();
    } catch (const InputError&) {  // it is no rigid motion, and surely not the identity
      return false;
    }
  }

  void stream(std::size_t i, ReadAttributes read_attributes, const Use& use) const {
    stream_kept(inputs_, i, result_, read_attributes, context_, use);
  }

  /// Whether intensities have to be scaled to fit the field that LAS has for them.
  bool scales_intensity() const {
    if (options_.format != CloudFormat::kLas) return false;
    return std::any_of(attributes_.begin(), attributes_.end(), [](const std::vector<Attribute>& attributes) {
      return std::any_of(attributes.begin(), attributes.end(), [](const Attribute& attribute) {
        return attribute.name == "intensity" && attribute.type != ScalarType::kUInt16;
      });
    });
  }

  void measure_boxes() {
    const bool scales = scales_intensity();
    ValueRange intensity("intensity");
    double smallest_extent = std::numeric_limits<double>::infinity();
    boxes_.resize(inputs_.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (!is_registered(i) || !is_written(i)) continue;
      const Eigen::Isometry3d& T = result_.poses[i].T_reference_scan;
      stream(i, scales ? ReadAttributes::kYes : ReadAttributes::kNo, [&](const PointBlock& block) {
        for (const auto& point : block.points) boxes_[i].extend(Eigen::Vector3d(T * point));
        if (scales) intensity.add(block, attributes_[i]);
      });
      if (boxes_[i].isEmpty()) continue;
      smallest_extent = std::min(smallest_extent, boxes_[i].sizes().maxCoeff());
      cloud_.box.extend(boxes_[i]);
    }
    cloud_.largest_step = kLargestStep * smallest_extent;
    if (scales) std::tie(cloud_.least_intensity, cloud_.most_intensity) = las_intensity_range(intensity);
  }

  /// In how many parts the voxels have to be gone through.
  std::uint64_t count_parts(std::uint64_t most_voxels) const {
    if (options_.voxel_m == 0) return 1;
    std::uint64_t num_points = 0;
    for (std::size_t i = 0; i < inputs_.size(); ++i) num_points += is_registered(i) ? result_.scans[i].num_points : 0;
    if (num_points <= most_voxels) return 1;
    constexpr std::uint64_t kSample = 64;  // counting one voxel in 64 tells their number to a thousandth and better
    VoxelThinner sample(options_.voxel_m, 0, kSample);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (!is_registered(i)) continue;
      const Eigen::Isometry3d& T = result_.poses[i].T_reference_scan;
      stream(i, ReadAttributes::kNo, [&](const PointBlock& block) {
        for (const auto& point : block.points) sample.takes(T * point);
      });
    }
    return sample.num_voxels() * kSample / most_voxels + 1;
  }

  void write_part(std::uint64_t part, std::uint64_t num_parts, std::optional<RegisteredCloudWriter>& merged) {
    std::optional<VoxelThinner> thinner;
    if (options_.voxel_m > 0) thinner.emplace(options_.voxel_m, part, num_parts);
    std::vector<char> keep;
    PointBlock thinned;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (!is_registered(i)) continue;
      const Eigen::Isometry3d& T = result_.poses[i].T_reference_scan;
      std::optional<RegisteredCloudWriter> own;
      std::string name;
      if (options_.each && part == 0) own.emplace(open_scan(i, name));
      stream(i, ReadAttributes::kYes, [&](const PointBlock& block) {
        if (watcher_ && part == 0) watcher_(i, block.points);
        if (own) own->write(i, block, attributes_[i], T);
        if (!merged) return;
        if (!thinner) return merged->write(i, block, attributes_[i], T);
        keep.resize(block.size());
        for (std::size_t k = 0; k < block.size(); ++k) keep[k] = thinner->takes(T * block.points[k]) ? 1 : 0;
        select(block, attribute_stride(attributes_[i]), keep, thinned);
        if (thinned.size() > 0) merged->write(i, thinned, attributes_[i], T);
      });
      if (!own) continue;
      own->finish();
      num_replaced_in_scans_ += own->num_replaced();
    }
  }

  RegisteredCloudWriter open_scan(std::size_t i, std::string& name) {
    RegisteredCloudOptions options = cloud_;
    options.one_scan = true;
    options.point_source_id = static_cast<std::uint16_t>(i < 65535 ? i + 1 : 0);
    if (!boxes_.empty()) {
      options.box = boxes_[i];
      options.largest_step = options.box.isEmpty() ? 0 : kLargestStep * options.box.sizes().maxCoeff();
    }
    name = file_of(result_.poses[i].file);
    const fs::path path = folder_ / "scans" / name;
    fs::create_directories(path.parent_path());  // "Setup1/scan.ply" is the name of one of several scan.ply
    std::vector<std::vector<Attribute>> attributes(i + 1);
    attributes[i] = attributes_[i];
    return {path, attributes, options};
  }

  /// "a.ply" stays "a.ply" as PLY and becomes "a.ply.las" as LAS.
  std::string file_of(const std::string& scan) {
    const std::string extension(extension_of(options_.format));
    std::string name = scan.ends_with(extension) ? scan : scan + extension;
    while (!names_.insert(name).second) name += extension;
    return name;
  }

  void warn_of_replaced(std::uint64_t number, const std::string& where) const {
    if (number == 0) return;
    context_.warn(std::to_string(number) + " attribute values were NaN or infinite and are 0 in " + where);
  }

  void warn_of_left_out(const std::string& where) const {
    const std::set<std::string> kept{"intensity", "red", "green", "blue"};
    std::set<std::string> left_out;
    for (std::size_t i = 0; i < attributes_.size(); ++i) {
      if (!is_registered(i)) continue;
      for (const auto& attribute : attributes_[i]) {
        if (!kept.contains(attribute.name)) left_out.insert(attribute.name);
      }
    }
    if (left_out.empty()) return;
    std::string names;
    for (const auto& name : left_out) names += (names.empty() ? "" : ", ") + name;
    context_.warn(where + " is without " + names + ": PTX has intensity and colour alone; --format e57 keeps all");
  }

  static constexpr double kLargestStep = 1e-6;  // of a scan's extent: coordinates may be rounded by that

  const fs::path& folder_;
  const std::span<const ScanInput> inputs_;
  const PipelineResult& result_;
  const OutputOptions& options_;
  const RunContext& context_;
  const PointWatcher& watcher_;
  const std::optional<std::size_t> only_;  ///< the scan that is written alone
  std::vector<std::vector<Attribute>> attributes_;
  RegisteredCloudOptions cloud_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of each registered scan, where the format asks for it
  std::set<std::string> names_;
  std::uint64_t num_replaced_in_scans_ = 0;
};

}  // namespace

void OutputOptions::validate() const {
  if (std::isfinite(voxel_m) && voxel_m >= 0) return;
  throw InvalidOptions("voxel must be a length of at least 0, in the unit of the scans (0: all points), not " +
                       std::to_string(voxel_m));
}

void write_registered_clouds(const fs::path& folder, std::span<const ScanInput> inputs, const PipelineResult& result,
                             const OutputOptions& options, const RunContext& context, std::uint64_t most_voxels,
                             const PointWatcher& watcher) {
  CloudOutput(folder, inputs, result, options, context, watcher).write(most_voxels);
}

void watch_scan(std::span<const ScanInput> inputs, std::size_t scan, const PipelineResult& result,
                const RunContext& context, const PointWatcher& watcher) {
  stream_kept(inputs, scan, result, ReadAttributes::kNo, context,
              [&](const PointBlock& block) { watcher(scan, block.points); });
}

fs::path write_registered_scan(const fs::path& folder, const ScanInput& input, std::size_t scan,
                               const PipelineResult& result, const OutputOptions& options, const RunContext& context) {
  const std::vector<ScanInput> inputs(result.poses.size(), input);
  const PointWatcher nobody;
  return CloudOutput(folder, inputs, result, options, context, nobody, scan).write_one();
}

}  // namespace tcm_icp
