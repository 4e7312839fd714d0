#pragma once
// Text that has to fit a terminal's width.

#include <cstddef>
#include <string>

namespace tcm_icp::app {

/// Columns of the terminal that stderr is; 80 where it is none, or does not tell.
std::size_t terminal_width();

/// Characters of UTF-8 text; a stray byte counts as one.
std::size_t num_characters(const std::string& text);

/// The text where it has at most `width` characters, else its beginning and its end with "..." between: names of scans
/// differ at their ends. @pre width >= 5
std::string shortened(const std::string& text, std::size_t width);

/// Spaces before, or behind, up to `width` characters.
std::string right(const std::string& text, std::size_t width);
std::string left(const std::string& text, std::size_t width);

/// Lines of at most `width` characters, broken at spaces where there are any, each behind `indent` spaces; with a line
/// feed at the end of each.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);

}  // namespace tcm_icp::app
