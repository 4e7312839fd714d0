#include "text_width.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

namespace tcm_icp::app {
namespace {

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

// Byte at which character number `count` starts.
std::size_t offset_of(const std::string& text, std::size_t count) {
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    if (starts_character(text[at]) && count-- == 0) break;
  }
  return at;
}

}  // namespace

std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80, kNarrowest = 40;
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
  return std::max<std::size_t>(kNarrowest, size.ws_col);
}

std::size_t num_characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

std::string shortened(const std::string& text, std::size_t width) {
  const std::string dots = "...";
  const std::size_t length = num_characters(text);
  if (length <= width) return text;
  const std::size_t kept = width - dots.size(), front = kept / 2;
  return text.substr(0, offset_of(text, front)) + dots + text.substr(offset_of(text, length - (kept - front)));
}

std::string right(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, num_characters(text)), ' ') + text;
}

std::string left(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, num_characters(text)), ' ');
}

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream words(text);
  const std::string margin(indent, ' ');
  std::string out, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + num_characters(line) + 1 + num_characters(word) > width) {
      out += margin + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? out : out + margin + line + '\n';
}

}  // namespace tcm_icp::app
