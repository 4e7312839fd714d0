#pragma once
// What somebody who mistyped a name probably meant.

#include <string>
#include <string_view>
#include <vector>

namespace tcm_icp::app {

/// "; did you mean 'register'?" where one of `known` is like `typed`, else nothing. Alike are: one that begins with it,
/// one that it ends behind a dot (fine-voxels, sampling.fine-voxels), and else the first of those with the fewest
/// letters to change, put in, leave out or swap, where those are at most a third of the longer name.
/// @param dashes  what names are shown with in front
std::string did_you_mean(std::string_view typed, const std::vector<std::string>& known, const char* dashes = "");

/// An error's text and the sentence behind it: after a question no semicolon.
std::string joined(const std::string& text, const std::string& sentence);

}  // namespace tcm_icp::app
