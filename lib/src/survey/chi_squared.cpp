#include <array>
#include <cmath>

#include "survey/survey_adjustment.hpp"

namespace tcm_icp {

double chi_squared_limit(int degrees_of_freedom) {
  constexpr double kNormalQuantile = 3.0902;  // exceeded once in a thousand times
  constexpr std::array kFew{0.0,    10.828, 13.816, 16.266,
                            18.467, 20.515, 22.458};  // for which the equation is too coarse
  if (degrees_of_freedom <= 0) return 0;
  if (static_cast<std::size_t>(degrees_of_freedom) < kFew.size()) {
    return kFew[static_cast<std::size_t>(degrees_of_freedom)];
  }
  const double k = degrees_of_freedom, spread = 2 / (9 * k);
  return k * std::pow(1 - spread + kNormalQuantile * std::sqrt(spread), 3);
}

}  // namespace tcm_icp
