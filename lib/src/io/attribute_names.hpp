#pragma once
// Names of attributes as a PLY property may have them.

#include <string>
#include <string_view>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// What is not a letter, digit or one of _.- becomes '_'; quotes go.
std::string attribute_name(std::string_view text);

/// `name`, or `other` where that is empty or there is one of that name; with '_' behind it until there is none.
std::string unique_name(std::string name, const std::string& other, const std::vector<Attribute>& attributes);

}  // namespace tcm_icp
