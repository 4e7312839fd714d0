#pragma once
// Scans in, poses with verdicts out: the library in one call.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/core/verdict.hpp"
#include "tcm_icp/io/output_options.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/outliers/outlier_method.hpp"
#include "tcm_icp/scans/sampling_options.hpp"
#include "tcm_icp/survey/survey.hpp"

namespace tcm_icp {

/// Which method registers.
enum class Profile {
  kRobust,  ///< the paper's steps with statistics in place of minima, inference, decisions
  kPaper,   ///< the paper to the letter: it needs initial poses, and verifies nothing
};

/// T_common_scan of each scan for raw coordinates; nothing where no guess is given. Any common frame will do.
using InitialPoses = std::vector<std::optional<Eigen::Isometry3d>>;

/// What may be asked of a registration. The defaults serve scans of any sensor, anywhere.
struct RegistrationOptions {
  Profile profile = Profile::kRobust;    ///< which method registers
  double confidence = kLeastConfidence;  ///< 0..1, below 1; least probability of a scan that counts as registered
  std::string reference;                 ///< name or number of the scan whose frame the result is in; empty: chosen
  bool level = false;                    ///< z points up in every scan, within 10 degrees
  SamplingOptions sampling;              ///< how scans are thinned for what looks at them
  OutlierMethod outliers = OutlierMethod::kKMeans;  ///< what is left out of each scan, and of the merged cloud
  InitialPoses initial_poses;  ///< one a scan; empty: none. In the robust profile candidates like others
  Survey survey;               ///< what defines the frame in place of the reference scan; robust profile only
  void validate() const;       ///< throws InvalidOptions naming field, value and bound
};

/// What became of one scan.
struct RegisteredScan {
  std::string name;                               ///< file name, or that of its ScanInput
  ScanStatus status = ScanStatus::kUnregistered;  ///< whether it has a pose
  Verdict verdict = Verdict::kRejected;           ///< whether the pose can be trusted
  Reason reason = Reason::kNotDecided;            ///< what decided about it
  std::string text;                               ///< the reason for a person, with its figures
  double probability = 0;                         ///< 0..1, that its place is right; 0 where nothing was decided
  /// [m] Maps raw coordinates into the common frame; the identity where the scan is unregistered.
  Eigen::Isometry3d T_reference_scan = Eigen::Isometry3d::Identity();
  /// [m] The same into the frame of its component, for scans that hold together, but not with the reference.
  std::optional<Eigen::Isometry3d> T_component_scan;
  int component = 0;                         ///< scans of one number hold together; 0: with the reference
  std::uint64_t num_points = 0;              ///< finite points
  std::optional<double> overlap;             ///< 0..1, share of its points that have a neighbour in other scans
  std::optional<double> inlier_share;        ///< 0..1, share of these that agree within the noise
  std::optional<double> residual_m;          ///< [m] median distance to the other scans' surfaces
  std::optional<double> sigma_position_m;    ///< [m] standard deviation of its middle, over the three axes together
  std::optional<double> sigma_rotation_rad;  ///< [rad] of its rotation, likewise

  /// Whether it has a pose in the common frame.
  bool is_registered() const { return status != ScanStatus::kUnregistered; }
};

/// Two scans that overlap at their final poses, judged by themselves.
struct RegisteredLink {
  std::size_t a = 0;                     ///< position of one scan in the list
  std::size_t b = 0;                     ///< and of the other
  Verdict verdict = Verdict::kRejected;  ///< whether the pair supports its pose
  double probability = 0;                ///< 0..1, that the pose is right, by the pair alone
  double overlap = 0;                    ///< 0..1, of the direction that overlaps more
  double inlier_share = 0;               ///< 0..1, share of the overlapping points that agree within the noise
  double residual_m = 0;                 ///< [m] median distance to the other scan's surfaces
  std::string text;                      ///< the same for a person
};

struct PipelineResult;

/// What a registration found.
struct Registration {
  std::size_t reference = 0;                      ///< position of the reference scan in the list
  std::vector<RegisteredScan> scans;              ///< in the order they were given
  std::vector<RegisteredLink> links;              ///< pairs that overlap
  std::vector<std::string> warnings;              ///< of scans in another unit than the others, as it seems
  std::shared_ptr<const PipelineResult> details;  ///< all that the report says, for write_registration()

  bool all_registered() const;  ///< whether every scan has a pose
};

/// Registers scans of any source, two or more. Points stream by; memory follows the working clouds. The same points,
/// options and seed give the same bits, whatever the source and the number of threads.
/// @throws InvalidOptions  an option out of its bounds, a reference that is no scan, fewer than two scans
/// @throws InputError      a file that cannot be read
/// @throws InvalidInput    the same scan twice, fewer than three points, all points in one place
/// @throws Cancelled       context.on_progress asked to stop
Registration register_scans(std::span<const ScanInput> scans, const RegistrationOptions& options = {},
                            const RunContext& context = {});

/// Registers scans in files; each as ScanReader takes it ("hall.e57#2").
Registration register_scans(std::span<const std::filesystem::path> files, const RegistrationOptions& options = {},
                            const RunContext& context = {});

/// Registers clouds in memory, which are not copied. They are called "cloud_0", "cloud_1" and so on.
Registration register_scans(std::span<const Cloud> clouds, const RegistrationOptions& options = {},
                            const RunContext& context = {});

/// A folder for write_registration(), and how it is to be written.
struct RegistrationFolder {
  std::filesystem::path path;  ///< it appears when it is complete: a failed run leaves nothing
  bool overwrite = false;      ///< replace an earlier result
  OutputOptions clouds;        ///< format of the merged cloud
};

/// Writes what `tcm-icp register` writes: poses, merged cloud, report (docs/formats.md). The points stream by again.
/// @param folder        where to, and what of the clouds
/// @param scans         those that were registered, in the same order
/// @param registration  what register_scans() gave
/// @param options       those it was registered with
/// @param context       as for register_scans()
/// @throws InvalidOptions                      a folder option out of its bounds, another number of scans
/// @throws InputError, OutputError, Cancelled  reading, writing, on_progress
void write_registration(const RegistrationFolder& folder, std::span<const ScanInput> scans,
                        const Registration& registration, const RegistrationOptions& options = {},
                        const RunContext& context = {});

}  // namespace tcm_icp
