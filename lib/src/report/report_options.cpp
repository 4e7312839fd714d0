#include "tcm_icp/pipeline/report_options.hpp"

#include <cmath>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

void AcceptanceLimits::validate() const {
  const auto check = [](double value, double most, const char* name, const char* bound) {
    if (value >= 0 && value <= most && std::isfinite(value)) return;
    throw InvalidOptions(std::string(name) + " must be " + bound + ", not " + std::to_string(value));
  };
  check(residual_m, HUGE_VAL, "residual_m", "a length of at least 0");
  check(sigma_m, HUGE_VAL, "sigma_m", "a length of at least 0");
  check(overlap, 1, "overlap", "a share from 0 to 1");
}

}  // namespace tcm_icp
