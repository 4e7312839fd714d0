#include "report_html_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace tcm_icp::html {
namespace {

constexpr const char* kDash = "\u2013";

// Independent of the locale.
std::string text_of(double value, std::chars_format format, int digits) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, digits).ptr;
  return {buffer, end};
}

// Digits in threes, by a space that neither breaks nor is as wide as the one between words.
std::string grouped(const std::string& digits) {
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += "\u202F";
    out += digits[i];
  }
  return out;
}

}  // namespace

std::string file_name(const Json& name) {
  std::string text = escaped(name.get_ref<const std::string&>());
  // Long names break after a folder rather than anywhere.
  const std::string may_break = "<wbr/>";
  for (auto at = text.find('/'); at != std::string::npos; at = text.find('/', at + 1 + may_break.size())) {
    text.insert(at + 1, may_break);
  }
  return "<bdi class=\"file\">" + text + "</bdi>";
}

std::string sentence(const Json& text) {
  std::string out = escaped(text.get_ref<const std::string&>());
  for (auto at = out.find(" %"); at != std::string::npos; at = out.find(" %", at)) out.replace(at, 1, "\u00A0");
  return out;
}

std::string figure(double value) {
  if (!std::isfinite(value)) return kDash;
  if (value == 0) return "0";
  const double size = std::floor(std::log10(std::abs(value)));
  if (size < -4 || size > 6) return text_of(value, std::chars_format::scientific, 1);
  return text_of(value, std::chars_format::fixed, static_cast<int>(std::max(0.0, 2 - size)));
}

std::string figure(const Json& value, double factor) {
  return value.is_number() ? figure(factor * value.get<double>()) : kDash;
}

std::string norm(const Json& vector, double factor) {
  if (!vector.is_array()) return kDash;
  double square = 0;
  for (const auto& entry : vector) {
    if (!entry.is_number()) return kDash;
    square += std::pow(entry.get<double>(), 2);
  }
  return figure(factor * std::sqrt(square));
}

std::string percent(const Json& share) {
  if (!share.is_number()) return kDash;
  return text_of(100 * share.get<double>(), std::chars_format::fixed, 0) + "\u202F%";
}

std::string count(const Json& value) {
  return value.is_number_integer() ? grouped(std::to_string(value.get<long long>())) : kDash;
}

std::string badge(std::string_view kind, std::string_view text) {
  return "<span class=\"badge " + std::string(kind) + "\">" + escaped(text) + "</span>";
}

std::string length(const Json& metres) {
  if (!metres.is_number()) return kDash;
  const double m = metres.get<double>(), size = std::abs(m);
  if (!std::isfinite(m)) return kDash;
  const auto text = [](double value, double whole_from, const char* unit) {
    return text_of(value, std::chars_format::fixed, std::abs(value) >= whole_from ? 0 : 1) + "\u00A0" + unit;
  };
  if (size >= 1) return text(m, 10, "m");
  return size >= 0.1 ? text(100 * m, 10, "cm") : text(1000 * m, 10, "mm");
}

std::string table(const std::vector<Column>& columns, const Rows& rows, const std::vector<std::string>& attributes) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (std::any_of(rows.begin(), rows.end(), [k](const auto& row) { return !row[k].empty(); })) shown.push_back(k);
  }
  std::string out = "<div class=\"scroll\"><table>\n<thead><tr>";
  const auto cell = [&](const std::string& element, std::size_t k, std::string_view content) {
    out += "<" + element + " class=\"" + std::string(columns[k].kind) + "\">" + std::string(content) + "</" + element +
           ">";
  };
  for (const std::size_t k : shown) cell("th", k, columns[k].title);
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto& row = rows[r];
    out += "<tr" + (r < attributes.size() ? attributes[r] : "") + ">";
    for (const std::size_t k : shown) cell("td", k, row[k]);
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table></div>\n";
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::string out = "<dl class=\"facts\">\n";
  for (const auto& [name, value] : pairs) out += "<div><dt>" + name + "</dt><dd>" + value + "</dd></div>\n";
  return out + "</dl>\n";
}

std::string section(std::string_view title, const std::string& content) {
  return "<section>\n<h2>" + std::string(title) + "</h2>\n" + content + "</section>\n";
}

std::string note(std::string_view html) { return "<p class=\"note\">" + std::string(html) + "</p>\n"; }

}  // namespace tcm_icp::html
