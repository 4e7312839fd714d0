#pragma once
// Text and tables of report.html.

#include <string>
#include <string_view>
#include <vector>

#include "core/xml_text.hpp"
#include "report_parts.hpp"

namespace tcm_icp::html {

inline std::string escaped(std::string_view text) { return xml_escaped(text); }

/// A file's name, set apart from the text around it, whatever direction its letters run in.
std::string file_name(const Json& name);

/// A reason as the report has it, its numbers not torn from their signs.
std::string sentence(const Json& text);

// Numbers; a dash for null.
/// Three significant digits, without an exponent where the value has fewer than seven digits.
std::string figure(double value);
std::string figure(const Json& value, double factor = 1);
/// Euclidean norm of an array; a dash where it or an entry is null.
std::string norm(const Json& vector, double factor = 1);
std::string percent(const Json& share);
std::string count(const Json& value);  ///< thousands set apart

/// A verdict or status with the colour of `kind`: good, fair, bad or plain.
std::string badge(std::string_view kind, std::string_view text);

struct Column {
  std::string_view title;  ///< HTML
  std::string_view kind;   ///< class of its cells: number, text, name, trace or wide
};
using Rows = std::vector<std::vector<std::string>>;  ///< of cells that are HTML already

/// Columns without any content are left out. The first line is repeated on each printed page.
/// @param attributes  of the rows' elements, where there are any: " data-link=\"3\""
std::string table(const std::vector<Column>& columns, const Rows& rows,
                  const std::vector<std::string>& attributes = {});

/// A length in the unit a person would say it in: "4.2 mm", "31 cm", "2.5 m"; a dash for null.
std::string length(const Json& metres);

/// Pairs of a name and a value, both HTML, in columns.
std::string facts(const std::vector<std::pair<std::string, std::string>>& pairs);

std::string section(std::string_view title, const std::string& content);
std::string note(std::string_view html);

}  // namespace tcm_icp::html
