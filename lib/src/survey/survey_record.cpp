#include "tcm_icp/survey/survey_record.hpp"

namespace tcm_icp {

const char* to_string(PointStatus status) {
  switch (status) {
    case PointStatus::kUsed:
      return "used";
    case PointStatus::kBlunder:
      return "blunder";
    case PointStatus::kCheck:
      return "check";
    case PointStatus::kNotRegistered:
      return "not registered";
  }
  return "unknown";
}

}  // namespace tcm_icp
