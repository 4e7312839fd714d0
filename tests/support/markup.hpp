#pragma once
// Whether a page is well-formed, as far as pages that the program writes can go wrong.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace tcm_icp::testing {

/// The page with script elements emptied.
inline std::string without_scripts(std::string_view page) {
  constexpr std::string_view kBegin = "<script", kEnd = "</script>";
  std::string out;
  for (std::size_t at = page.find(kBegin); at != std::string_view::npos; at = page.find(kBegin)) {
    const std::size_t content = page.find('>', at) + 1, end = page.find(kEnd, content);
    if (content == 0 || end == std::string_view::npos) break;
    out += page.substr(0, content);
    page.remove_prefix(end);
    out += kEnd;
    page.remove_prefix(kEnd.size());
  }
  return out + std::string(page);
}

/// What is wrong with `page`, and where; empty where every element is closed in its order, every attribute's quotes
/// are, and every reference is one that both HTML and XML know. A document type is passed over, and so is what scripts
/// hold: it is no markup, and may not look like its end.
inline std::string markup_error(std::string_view whole) {
  const std::string page = without_scripts(whole);
  const auto wrong = [&](const char* what, std::size_t at) { return what + (": " + page.substr(at, 60)); };
  for (std::size_t i = page.find('&'); i < page.size(); i = page.find('&', i + 1)) {
    const std::string_view name = std::string_view(page).substr(i + 1, page.find(';', i) - i - 1);
    if (name != "amp" && name != "lt" && name != "gt" && name != "quot" && name != "#39") return wrong("reference", i);
  }
  std::vector<std::string_view> open;
  for (std::size_t i = page.find_first_of("<>"); i < page.size(); i = page.find_first_of("<>", i + 1)) {
    const std::size_t end = page.find_first_of("<>", i + 1);
    if (page[i] == '>' || end >= page.size() || page[end] == '<') return wrong("not escaped", i);
    const std::string_view tag = std::string_view(page).substr(i + 1, end - i - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return wrong("quotes", i);
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) return wrong("closes what is not open", i);
      open.pop_back();
    } else if (!tag.starts_with('!') && !tag.ends_with('/')) {
      open.push_back(tag.substr(0, tag.find_first_of(" \n")));
    }
    i = end;
  }
  return open.empty() ? "" : "left open: " + std::string(open.back());
}

}  // namespace tcm_icp::testing
