#include "tcm_icp/core/verdict.hpp"

namespace tcm_icp {

std::string_view to_string(ScanStatus status) {
  switch (status) {
    case ScanStatus::kReference:
      return "reference";
    case ScanStatus::kRegistered:
      return "registered";
    case ScanStatus::kUnregistered:
      return "unregistered";
  }
  return "unknown";
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAccepted:
      return "accepted";
    case Verdict::kDoubtful:
      return "doubtful";
    case Verdict::kRejected:
      return "rejected";
  }
  return "unknown";
}

std::string_view to_string(Reason reason) {
  switch (reason) {
    case Reason::kNotDecided:
      return "not decided";
    case Reason::kReference:
      return "the reference";
    case Reason::kAccepted:
      return "accepted";
    case Reason::kNoLink:
      return "no link to another scan was found";
    case Reason::kAmbiguous:
      return "ambiguous";
    case Reason::kMisfit:
      return "misfit";
    case Reason::kSlides:
      return "slides";
    case Reason::kSeenThrough:
      return "seen through walls";
    case Reason::kInexact:
      return "inexact";
    case Reason::kTooFewPoints:
      return "too few of its points lie on surfaces";
  }
  return "unknown";
}

}  // namespace tcm_icp
