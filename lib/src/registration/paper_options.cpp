#include "tcm_icp/registration/paper_options.hpp"

#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

void PaperOptions::validate() const {
  if (!(kept_share > 0) || !(kept_share <= 1)) {
    throw InvalidOptions("paper kept_share must be above 0 and at most 1, not " + std::to_string(kept_share));
  }
  if (!(marginal_share > 0)) {
    throw InvalidOptions("paper marginal_share must be above 0, not " + std::to_string(marginal_share));
  }
  if (unknowns == PaperUnknowns::kTwist && slack != PaperSlack::kBoth) {
    throw InvalidOptions("paper unknowns twist goes with slack both alone: one-sided slack is of the 12 entries");
  }
  if (max_rounds < 1) throw InvalidOptions("paper max_rounds must be at least 1, not " + std::to_string(max_rounds));
}

}  // namespace tcm_icp
