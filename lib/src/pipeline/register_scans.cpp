#include "tcm_icp/pipeline/register_scans.hpp"

#include <utility>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/version.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/pipeline/result_writer.hpp"

namespace tcm_icp {
namespace {

PipelineOptions pipeline_options(const RegistrationOptions& o) {
  PipelineOptions out;
  out.profile = o.profile;
  out.reference = o.reference;
  out.level = o.level;
  out.sampling = o.sampling;
  out.outliers.method = o.outliers;
  out.decision.confidence = o.confidence;
  return out;
}

RegisteredScan registered_scan(const PipelineResult& result, std::size_t i) {
  const ScanPose& pose = result.poses[i];
  RegisteredScan out;
  out.name = pose.file;
  out.status = pose.status;
  out.verdict = pose.verdict;
  out.text = pose.reason;
  if (out.is_registered()) out.T_reference_scan = pose.T_reference_scan;
  out.T_component_scan = pose.pose_in_component;
  out.component = pose.component;
  out.num_points = result.scans[i].num_points;
  if (i < result.decisions.size()) {  // the paper's profile decides nothing
    out.reason = result.decisions[i].reason;
    out.probability = result.decisions[i].probability;
  }
  // Accepted within a group that nothing joins to the reference, or beside scans that were set aside.
  if (!out.is_registered() && out.reason == Reason::kAccepted) out.reason = Reason::kNoLink;
  if (pose.status == ScanStatus::kReference) {
    out.reason = Reason::kReference;
    out.probability = 1;  // it is where it is by definition
  }
  if (i < result.evidence.size() && result.evidence[i]) {
    const auto& evidence = result.evidence[i];
    out.overlap = evidence->overlap;
    out.inlier_share = evidence->inlier_share;
    out.residual_m = evidence->median_residual_m;
  }
  if (i < result.uncertainty.poses.size() && out.is_registered() && result.uncertainty.poses[i].determined) {
    out.sigma_position_m = result.uncertainty.poses[i].sigma_position_m().norm();
    out.sigma_rotation_rad = result.uncertainty.poses[i].sigma_rotation_rad().norm();
  }
  return out;
}

RegisteredLink registered_link(const LinkRecord& link) {
  return {link.a,
          link.b,
          link.verdict,
          link.probability,
          link.evidence.overlap,
          link.evidence.inlier_share,
          link.evidence.median_residual_m,
          link.reason};
}

}  // namespace

void RegistrationOptions::validate() const { pipeline_options(*this).validate(); }

bool Registration::all_registered() const { return details != nullptr && details->all_registered(); }

Registration register_scans(std::span<const ScanInput> scans, const RegistrationOptions& options,
                            const RunContext& context) {
  const Pipeline pipeline(pipeline_options(options));
  const InitialPoses poses = options.initial_poses.empty() ? InitialPoses(scans.size()) : options.initial_poses;
  auto result = std::make_shared<PipelineResult>(pipeline.run(scans, poses, context, options.survey));
  Registration out;
  out.reference = result->reference;
  for (std::size_t i = 0; i < scans.size(); ++i) out.scans.push_back(registered_scan(*result, i));
  for (const auto& link : result->links) out.links.push_back(registered_link(link));
  out.warnings = result->warnings;
  out.details = std::move(result);
  return out;
}

Registration register_scans(std::span<const std::filesystem::path> files, const RegistrationOptions& options,
                            const RunContext& context) {
  return register_scans(scans_in_files(files), options, context);
}

Registration register_scans(std::span<const Cloud> clouds, const RegistrationOptions& options,
                            const RunContext& context) {
  std::vector<ScanInput> scans;
  for (const auto& cloud : clouds) scans.push_back(scan_in_memory("cloud_" + std::to_string(scans.size()), cloud));
  return register_scans(scans, options, context);
}

void write_registration(const RegistrationFolder& folder, std::span<const ScanInput> scans,
                        const Registration& registration, const RegistrationOptions& options,
                        const RunContext& context) {
  folder.clouds.validate();
  if (!registration.details)
    throw InvalidOptions("the registration is empty: register_scans() makes one to be written");
  if (scans.size() != registration.scans.size()) {
    throw InvalidOptions(std::to_string(scans.size()) + " scans for a registration of " +
                         std::to_string(registration.scans.size()));
  }
  PipelineResult result = *registration.details;  // the time of writing is added
  write_result(folder.path, folder.overwrite, scans, result, pipeline_options(options), folder.clouds, context,
               {version(), "register_scans()", options.initial_poses.empty() ? "" : "given by the caller", ""});
}

}  // namespace tcm_icp
