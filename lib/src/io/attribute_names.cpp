#include "attribute_names.hpp"

#include <algorithm>
#include <cctype>

namespace tcm_icp {

std::string attribute_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool keeps = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
    if (c != '"') name += keeps ? c : '_';
  }
  return name;
}

std::string unique_name(std::string name, const std::string& other, const std::vector<Attribute>& attributes) {
  const auto is_taken = [&](const std::string& text) {
    // A coordinate's name would be a second column x of the merged cloud.
    return text.empty() || text == "x" || text == "y" || text == "z" ||
           std::any_of(attributes.begin(), attributes.end(),
                       [&](const Attribute& attribute) { return attribute.name == text; });
  };
  if (is_taken(name)) name = other;
  while (is_taken(name)) name += '_';
  return name;
}

}  // namespace tcm_icp
