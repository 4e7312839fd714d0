#include "report/view_data.hpp"

#include <algorithm>
#include <cmath>

#include "report/base64.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp {
namespace {

Json floats(const Eigen::Vector3d& v) {
  const Eigen::Vector3f f = v.cast<float>();
  return {f.x(), f.y(), f.z()};
}

// Column by column, as WebGL has it.
Json matrix_json(const Eigen::Isometry3d& T) {
  Json out = Json::array();
  for (Eigen::Index c = 0; c < 4; ++c) {
    for (Eigen::Index r = 0; r < 4; ++r) out.push_back(T.matrix()(r, c));
  }
  return out;
}

void add_points(const SceneScan& scan, Json& to) {
  constexpr float kMost = 65535;
  Eigen::AlignedBox3f box;
  for (const auto& p : scan.points) box.extend(p);
  if (box.isEmpty()) box = Eigen::AlignedBox3f(Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero());
  const Eigen::Vector3f size = box.sizes().cwiseMax(1e-6F);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(6 * scan.points.size());
  for (const auto& p : scan.points) {
    const Eigen::Vector3f at = (p - box.min()).cwiseQuotient(size) * kMost;
    for (int k = 0; k < 3; ++k) {
      const auto value = static_cast<std::uint16_t>(std::lround(std::clamp(at[k], 0.0F, kMost)));
      bytes.push_back(static_cast<std::uint8_t>(value & 255U));
      bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
    }
  }
  to["count"] = scan.points.size();
  to["least"] = floats(box.min().cast<double>());
  to["size"] = floats(size.cast<double>());
  to["xyz"] = base64(bytes);
  to["distances"] = base64(scan.distances);
}

std::string colour_text(std::size_t scan) {
  char text[8];
  const auto c = scan_colour(scan);
  std::snprintf(text, sizeof text, "#%02x%02x%02x", c[0], c[1], c[2]);
  return text;
}

// Inside a script element nothing may look like markup.
std::string without_markup(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else if (c == '>')
      out += "\\u003e";
    else if (c == '&')
      out += "\\u0026";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string view_data(const Scene& scene, const Json& report) {
  Json data{{"most_m", scene.most_m}};
  for (const SceneGroup& group : scene.groups) {
    data["groups"].push_back(
        {{"component", group.component}, {"box", {floats(group.box.min()), floats(group.box.max())}}});
  }
  data["scans"] = Json::array();
  for (std::size_t i = 0; i < scene.scans.size(); ++i) {
    const SceneScan& scan = scene.scans[i];
    const Json& told = report.at("scans").at(i);
    Json j{{"file", told.at("file")},
           {"status", told.at("status")},
           {"group", scan.group},
           {"colour", colour_text(i)},
           {"registered", matrix_json(scan.T_view_scan)},
           {"input", matrix_json(scan.T_input_scan)},
           {"setup", scan.setup ? floats(*scan.setup) : Json(nullptr)},
           {"middle", floats(scan.middle)}};
    add_points(scan, j);
    data["scans"].push_back(std::move(j));
  }
  data["links"] = Json::array();
  const auto number_of = [&](const Json& file) {
    std::size_t i = 0;
    while (report.at("scans").at(i).at("file") != file) ++i;
    return i;
  };
  for (const auto& link : report.at("links")) {
    Json j = link;
    j["a"] = number_of(link.at("a"));
    j["b"] = number_of(link.at("b"));
    if (link.contains("strength")) {
      const Json& centre = link.at("strength").at("centre_m");
      const Eigen::Vector3d& origin = scene.groups[scene.scans[j["a"].get<std::size_t>()].group].origin;
      Eigen::Vector3d at;
      for (int k = 0; k < 3; ++k)
        at[k] = centre.at(static_cast<std::size_t>(k)).is_number()
                    ? centre.at(static_cast<std::size_t>(k)).get<double>()
                    : 0;
      j["strength"] = {{"centre", floats(at - origin)},
                       {"radius_m", link.at("strength").at("radius_m")},
                       {"axis", link.at("strength").at("axes").at(0)}};
    }
    data["links"].push_back(std::move(j));
  }
  return without_markup(data.dump(-1, ' ', true, Json::error_handler_t::replace));
}

}  // namespace tcm_icp
