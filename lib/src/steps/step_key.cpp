#include "steps/step_key.hpp"

#include "io/sha256.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/version.hpp"

namespace tcm_icp {

std::string sha256_of(std::string_view bytes) {
  Sha256 sum;
  sum.add({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  return sum.digest();
}

const std::string& program_identity() {
  static const std::string identity = [] {
    const std::string text = version() + " " + commit();
    if (!text.ends_with('+')) return text;
    try {
      return text + " " + sha256_of_file("/proc/self/exe");
    } catch (const InputError&) {
      return text;
    }
  }();
  return identity;
}

}  // namespace tcm_icp
