#include "epsg_text.hpp"

#ifdef TCM_ICP_HAVE_PROJ
#include <proj.h>

#include <memory>
#include <string_view>
#endif

namespace tcm_icp::app {

#ifdef TCM_ICP_HAVE_PROJ

std::optional<std::string> epsg_text(const std::string& crs) {
  constexpr std::string_view kStart = "EPSG:";
  if (!crs.starts_with(kStart)) return std::nullopt;
  const std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context(proj_context_create(),
                                                                             proj_context_destroy);
  proj_log_level(context.get(), PJ_LOG_NONE);  // a code that is not there is no error
  const std::unique_ptr<PJ, decltype(&proj_destroy)> system(
      proj_create_from_database(context.get(), "EPSG", crs.c_str() + kStart.size(), PJ_CATEGORY_CRS, 0, nullptr),
      proj_destroy);
  if (!system) return std::nullopt;
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* const text = proj_as_wkt(context.get(), system.get(), PJ_WKT1_GDAL, options);
  return text != nullptr ? std::optional<std::string>(text) : std::nullopt;
}

#else

std::optional<std::string> epsg_text(const std::string& /*crs*/) { return std::nullopt; }

#endif

}  // namespace tcm_icp::app
