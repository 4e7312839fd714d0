#include "merged_columns.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "scalar.hpp"

namespace tcm_icp {
namespace {

constexpr std::array<std::string_view, 8> kOwnNames = {"x", "y", "z", "scan", "red", "green", "blue", "alpha"};

void give_way(std::vector<Attribute>& columns) {
  std::set<std::string, std::less<>> taken;
  for (const auto& column : columns) taken.insert(column.name);
  for (auto& column : columns) {
    if (std::find(kOwnNames.begin(), kOwnNames.end(), column.name) == kOwnNames.end()) continue;
    do {
      column.name.insert(0, "input_");
    } while (!taken.insert(column.name).second);
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

MergedColumns merge_columns(const std::vector<std::vector<Attribute>>& scan_attributes) {
  MergedColumns merged;
  for (const auto& attributes : scan_attributes) {
    auto& column_of = merged.column_of.emplace_back();
    for (const auto& attribute : attributes) {
      const auto at = std::find_if(merged.columns.begin(), merged.columns.end(),
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
  give_way(merged.columns);
  return merged;
}

}  // namespace tcm_icp
