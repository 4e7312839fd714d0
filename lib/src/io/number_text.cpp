#include "number_text.hpp"

#include <array>
#include <charconv>
#include <cstring>

#include "scalar.hpp"

namespace tcm_icp {
namespace {

void append(auto value, std::string& text) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

}  // namespace

std::string shortest_digits(double value) {
  std::string text;
  append(value, text);
  return text;
}

void append_shortest(double value, std::string& text) { append(value, text); }

void append_shortest(const std::byte* bytes, ScalarType type, std::string& text) {
  if (type != ScalarType::kFloat32) return append(load_scalar(bytes, type), text);
  float value = 0;
  std::memcpy(&value, bytes, sizeof value);
  append(value, text);
}

std::string digits17(double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 17);
  return {text.data(), result.ptr};
}

}  // namespace tcm_icp
