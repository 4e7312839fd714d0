#include "pair_methods.hpp"

#include "tcm_icp/core/error.hpp"
#ifdef TCM_ICP_HAVE_PCL
#include "pcl_methods.hpp"
#endif

namespace tcm_icp::app {

std::string name_of(Method method) {
  if (method == Method::kIcp) return "icp";
  return method == Method::kFeatures ? "features" : "tcm";
}

#ifdef TCM_ICP_HAVE_PCL

void check_built_in(Method) {}

PairMethod pair_method(Method method) { return method == Method::kIcp ? icp_pairs : features_pairs; }

#else

void check_built_in(Method method) {
  throw InvalidOptions("--method " + name_of(method) +
                       ": this tcm-icp was built without PCL; install libpcl-dev (Debian) and configure with "
                       "-DTCM_ICP_WITH_PCL=ON");
}

PairMethod pair_method(Method method) {
  check_built_in(method);
  return {};
}

#endif

}  // namespace tcm_icp::app
