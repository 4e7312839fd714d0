#include "suggestion.hpp"

#include <algorithm>
#include <cstddef>

namespace tcm_icp::app {
namespace {

// Optimal string alignment distance: letters changed, put in or left out, and neighbours that changed places.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string question(const std::string& name) { return "; did you mean '" + name + "'?"; }

}  // namespace

std::string did_you_mean(std::string_view typed, const std::vector<std::string>& known, const char* dashes) {
  constexpr std::size_t kLongestTyped = 64;  // nobody mistypes a novel; the table above is quadratic
  constexpr std::size_t kFewestLetters = 2;
  if (typed.size() > kLongestTyped || typed.size() < kFewestLetters) return {};
  std::string part(".");
  part += typed;
  for (const auto& name : known) {
    if (name.starts_with(typed) || name.ends_with(part)) return question(dashes + name);
  }
  const std::string* best = nullptr;
  std::size_t fewest = kLongestTyped;
  for (const auto& name : known) {
    const std::size_t changes = distance(typed, name);
    if (changes >= fewest || 3 * changes > std::max(typed.size(), name.size())) continue;
    fewest = changes;
    best = &name;
  }
  return best == nullptr ? std::string() : question(dashes + *best);
}

std::string joined(const std::string& text, const std::string& sentence) {
  return text + (text.ends_with('?') ? " " : "; ") + sentence;
}

}  // namespace tcm_icp::app
