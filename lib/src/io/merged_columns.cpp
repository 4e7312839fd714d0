#include "merged_columns.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "scalar.hpp"

namespace tcm_icp {
namespace {

constexpr std::array<std::string_view, 3> kColourNames = {"red", "green", "blue"};

bool is_colour_name(const std::string& name) {
  return std::find(kColourNames.begin(), kColourNames.end(), name) != kColourNames.end();
}

/// Red, green and blue, all bytes or all shorts.
bool has_colour(const std::vector<Attribute>& attributes) {
  const auto has_all = [&](ScalarType type) {
    return std::all_of(kColourNames.begin(), kColourNames.end(), [&](std::string_view name) {
      return std::find(attributes.begin(), attributes.end(), Attribute{std::string(name), type}) != attributes.end();
    });
  };
  return has_all(ScalarType::kUInt8) || has_all(ScalarType::kUInt16);
}

/// Names that the file gives to columns of its own.
std::set<std::string, std::less<>> own_names(const MergedColumns& merged, bool one_scan) {
  std::set<std::string, std::less<>> names = {"x", "y", "z"};
  if (!one_scan) names.insert("scan");
  if (merged.has_own_colour || merged.has_colour_by_scan) names.insert(kColourNames.begin(), kColourNames.end());
  // An alpha of 0, which scans without one would get, hides points.
  if (!one_scan || merged.has_colour_by_scan) names.insert("alpha");
  return names;
}

/// @param first  columns before it are the file's own
void give_way(std::vector<Attribute>& columns, std::size_t first, const std::set<std::string, std::less<>>& own) {
  std::set<std::string, std::less<>> taken;
  for (const auto& column : columns) taken.insert(column.name);
  for (std::size_t i = first; i < columns.size(); ++i) {
    if (!own.contains(columns[i].name)) continue;
    do {
      columns[i].name.insert(0, "input_");
    } while (!taken.insert(columns[i].name).second);
  }
}

}  // namespace

bool is_normal_component(const std::string& name) { return name == "nx" || name == "ny" || name == "nz"; }

ScalarType widened(ScalarType a, ScalarType b) {
  for (int i = 0; i < static_cast<int>(ScalarType::kFloat64); ++i) {
    const auto type = static_cast<ScalarType>(i);  // in the order of their size
    if (holds(type, a) && holds(type, b)) return type;
  }
  return ScalarType::kFloat64;
}

MergedColumns merge_columns(const std::vector<std::vector<Attribute>>& scan_attributes, CloudColour colour,
                            bool one_scan) {
  MergedColumns merged;
  merged.has_own_colour =
      colour == CloudColour::kKeep && std::any_of(scan_attributes.begin(), scan_attributes.end(), has_colour);
  merged.has_colour_by_scan = !merged.has_own_colour && (colour == CloudColour::kScan || !one_scan);
  std::size_t num_own = 0;
  if (merged.has_own_colour) {
    for (const auto name : kColourNames) merged.columns.push_back({std::string(name), ScalarType::kUInt8});
    num_own = merged.columns.size();
  }
  for (const auto& attributes : scan_attributes) {
    auto& column_of = merged.column_of.emplace_back();
    const bool keeps_colour = merged.has_own_colour && has_colour(attributes);
    for (const auto& attribute : attributes) {
      const bool is_own = keeps_colour && is_colour_name(attribute.name);
      const auto first = merged.columns.begin() + (is_own ? 0 : static_cast<std::ptrdiff_t>(num_own));
      const auto at = std::find_if(first, merged.columns.end(),
                                   [&](const Attribute& column) { return column.name == attribute.name; });
      column_of.push_back(static_cast<std::size_t>(at - merged.columns.begin()));
      if (at == merged.columns.end()) {
        merged.columns.push_back(attribute);
      } else {
        at->type = widened(at->type, attribute.type);
      }
    }
  }
  for (auto& column : merged.columns) {
    if (is_normal_component(column.name)) column.type = widened(column.type, ScalarType::kFloat32);
  }
  give_way(merged.columns, num_own, own_names(merged, one_scan));
  return merged;
}

}  // namespace tcm_icp
