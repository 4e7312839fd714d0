#include "well_known_text.hpp"

#include <charconv>

namespace tcm_icp {
namespace {

struct Datum {
  const char* name;
  const char* geographic;  ///< well-known text of the geographic system
};

constexpr Datum kWgs84{"WGS 84",
                       R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,)"
                       R"(AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,)"
                       R"(AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],)"
                       R"(AUTHORITY["EPSG","4326"]])"};
constexpr Datum kEtrs89{"ETRS89",
                        R"(GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_1989",)"
                        R"(SPHEROID["GRS 1980",6378137,298.257222101,AUTHORITY["EPSG","7019"]],)"
                        R"(AUTHORITY["EPSG","6258"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],)"
                        R"(UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4258"]])"};

std::string utm(const Datum& datum, int zone, bool is_north, int code) {
  return R"(PROJCS[")" + std::string(datum.name) + " / UTM zone " + std::to_string(zone) + (is_north ? "N" : "S") +
         R"(",)" + datum.geographic +
         R"(,PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",)" +
         std::to_string(6 * zone - 183) + R"(],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)" +
         R"(PARAMETER["false_northing",)" + (is_north ? "0" : "10000000") +
         R"(],UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],)" +
         R"(AUTHORITY["EPSG",")" + std::to_string(code) + R"("]])";
}

}  // namespace

std::optional<std::string> well_known_text(const std::string& crs) {
  const std::string start = "EPSG:";
  if (!crs.starts_with(start)) return crs.find('[') != std::string::npos ? std::optional(crs) : std::nullopt;
  int code = 0;
  const char* const end = crs.data() + crs.size();
  const auto [rest, error] = std::from_chars(crs.data() + start.size(), end, code);
  if (error != std::errc() || rest != end) return std::nullopt;
  const int zone = code % 100, family = code / 100;
  if ((family == 326 || family == 327) && zone >= 1 && zone <= 60) return utm(kWgs84, zone, family == 326, code);
  if (family == 258 && zone >= 28 && zone <= 38) return utm(kEtrs89, zone, true, code);
  return std::nullopt;
}

}  // namespace tcm_icp
