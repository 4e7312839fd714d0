#include "scalar.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tcm_icp {
namespace {

struct TypeInfo {
  std::string_view ply_name, sized_name;
  std::size_t size;
  double lowest, highest;  ///< of whole numbers; for floats, the range in which every whole number is exact
};

// In the order of ScalarType.
constexpr std::array<TypeInfo, 8> kTypes = {{
    {"char", "int8", 1, -128.0, 127.0},
    {"uchar", "uint8", 1, 0.0, 255.0},
    {"short", "int16", 2, -32768.0, 32767.0},
    {"ushort", "uint16", 2, 0.0, 65535.0},
    {"int", "int32", 4, -2147483648.0, 2147483647.0},
    {"uint", "uint32", 4, 0.0, 4294967295.0},
    {"float", "float32", 4, -16777216.0, 16777216.0},
    {"double", "float64", 8, -9007199254740992.0, 9007199254740992.0},
}};

const TypeInfo& info(ScalarType type) { return kTypes[static_cast<std::size_t>(type)]; }

template <typename T>
double load_as(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

template <typename T>
void store_as(double value, std::byte* bytes) {
  const T narrowed = static_cast<T>(value);
  std::memcpy(bytes, &narrowed, sizeof(T));
}

}  // namespace

std::size_t scalar_size(ScalarType type) { return info(type).size; }

std::size_t attribute_stride(const std::vector<Attribute>& attributes) {
  std::size_t stride = 0;
  for (const auto& attribute : attributes) stride += scalar_size(attribute.type);
  return stride;
}

std::string_view ply_type_name(ScalarType type) { return info(type).ply_name; }

std::optional<ScalarType> parse_ply_type(std::string_view name) {
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (name == kTypes[i].ply_name || name == kTypes[i].sized_name) return static_cast<ScalarType>(i);
  }
  return std::nullopt;
}

bool is_floating(ScalarType type) { return type == ScalarType::kFloat32 || type == ScalarType::kFloat64; }

bool holds(ScalarType outer, ScalarType inner) {
  if (is_floating(inner)) return is_floating(outer) && scalar_size(outer) >= scalar_size(inner);
  return info(outer).lowest <= info(inner).lowest && info(outer).highest >= info(inner).highest;
}

bool fits(double value, ScalarType type) {
  return is_floating(type) || (value >= info(type).lowest && value <= info(type).highest && value == std::floor(value));
}

double load_scalar(const std::byte* bytes, ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
      return load_as<std::int8_t>(bytes);
    case ScalarType::kUInt8:
      return load_as<std::uint8_t>(bytes);
    case ScalarType::kInt16:
      return load_as<std::int16_t>(bytes);
    case ScalarType::kUInt16:
      return load_as<std::uint16_t>(bytes);
    case ScalarType::kInt32:
      return load_as<std::int32_t>(bytes);
    case ScalarType::kUInt32:
      return load_as<std::uint32_t>(bytes);
    case ScalarType::kFloat32:
      return load_as<float>(bytes);
    case ScalarType::kFloat64:
      return load_as<double>(bytes);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void store_scalar(double value, ScalarType type, std::byte* bytes) {
  switch (type) {
    case ScalarType::kInt8:
      return store_as<std::int8_t>(value, bytes);
    case ScalarType::kUInt8:
      return store_as<std::uint8_t>(value, bytes);
    case ScalarType::kInt16:
      return store_as<std::int16_t>(value, bytes);
    case ScalarType::kUInt16:
      return store_as<std::uint16_t>(value, bytes);
    case ScalarType::kInt32:
      return store_as<std::int32_t>(value, bytes);
    case ScalarType::kUInt32:
      return store_as<std::uint32_t>(value, bytes);
    case ScalarType::kFloat32:
      return store_as<float>(value, bytes);
    case ScalarType::kFloat64:
      return store_as<double>(value, bytes);
  }
}

void copy_reversed(const std::byte* from, std::size_t size, std::byte* to) {
  for (std::size_t i = 0; i < size; ++i) to[i] = from[size - 1 - i];
}

std::optional<double> parse_number(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  double value = 0;
  const char* const end = token.data() + token.size();
  const auto [rest, error] = std::from_chars(token.data(), end, value);
  if (error != std::errc()) return std::nullopt;
  if (rest == end) return value;
  // 1.#QNAN, -1.#IND, 1.#INF: how older Windows programs write them.
  const std::string_view tail(rest, static_cast<std::size_t>(end - rest));
  for (const std::string_view special : {"#QNAN", "#SNAN", "#IND", "#INF"}) {
    if (tail == special) return std::numeric_limits<double>::quiet_NaN();
  }
  return std::nullopt;
}

std::string quoted(std::string_view token) {
  constexpr std::size_t kMaxLength = 40;
  std::string text = "'";
  for (const char c : token.substr(0, kMaxLength)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text + (token.size() > kMaxLength ? "...'" : "'");
}

}  // namespace tcm_icp
