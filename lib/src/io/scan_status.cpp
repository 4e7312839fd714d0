#include "scan_status.hpp"

namespace tcm_icp {

std::optional<ScanStatus> status_from_name(std::string_view name) {
  for (const ScanStatus status : {ScanStatus::kReference, ScanStatus::kRegistered, ScanStatus::kUnregistered}) {
    if (name == to_string(status)) return status;
  }
  return std::nullopt;
}

std::optional<Verdict> verdict_from_name(std::string_view name) {
  for (const Verdict verdict : {Verdict::kAccepted, Verdict::kDoubtful, Verdict::kRejected}) {
    if (name == to_string(verdict)) return verdict;
  }
  return std::nullopt;
}

}  // namespace tcm_icp
