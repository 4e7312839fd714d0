#pragma once
// Values as bytes, as they lie in memory: for this program's own files, where every bit has to come back.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Thrown by RecordReader: the bytes are not such a record.
struct BrokenRecord {};

/// Numbers, enumerations, text, Eigen's vectors and poses, and vectors, arrays and optionals of them. Any other type
/// has a function `transfer(record, value)`, which hands its fields to `record`: one function to write and to read it.
class RecordWriter {
 public:
  template <typename... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void raw(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  void size(std::size_t n) { put(std::uint64_t{n}); }

  void put(std::string_view text) {
    size(text.size());
    raw(text.data(), text.size());
  }
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(const char* text) { put(std::string_view(text)); }
  void put(const Eigen::Vector3d& v) { raw(v.data(), 3 * sizeof(double)); }
  void put(const Eigen::Isometry3d& T) { raw(T.data(), 16 * sizeof(double)); }
  void put(const Points& points) {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
    size(points.size());
    raw(points.data(), points.size() * sizeof(Eigen::Vector3d));
  }
  template <typename T>
  void put(const std::vector<T>& values) {
    size(values.size());
    if constexpr (std::is_arithmetic_v<T>) {
      raw(values.data(), values.size() * sizeof(T));
    } else {
      for (const auto& value : values) put(value);
    }
  }
  template <typename T, std::size_t N>
  void put(const std::array<T, N>& values) {
    for (const auto& value : values) put(value);
  }
  template <typename A, typename B>
  void put(const std::pair<A, B>& value) {
    put(value.first);
    put(value.second);
  }
  template <typename T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <typename T>
  void put(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      raw(&value, sizeof value);
    } else {
      transfer(*this, value);
    }
  }

  std::string bytes_;
};

/// The values in the order in which they were written.
class RecordReader {
 public:
  explicit RecordReader(std::string_view bytes) : bytes_(bytes) {}

  /// @throws BrokenRecord
  template <typename... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  /// @throws BrokenRecord  if bytes are left
  void finish() const {
    if (!bytes_.empty()) throw BrokenRecord();
  }

 private:
  void raw(void* to, std::size_t size) {
    if (size > bytes_.size()) throw BrokenRecord();
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  /// Of things that take at least `least` bytes each.
  std::size_t size(std::size_t least) {
    std::uint64_t n = 0;
    get(n);
    if (n > bytes_.size() / least) throw BrokenRecord();
    return n;
  }

  void get(std::string& text) {
    text.resize(size(1));
    raw(text.data(), text.size());
  }
  void get(Eigen::Vector3d& v) { raw(v.data(), 3 * sizeof(double)); }
  void get(Eigen::Isometry3d& T) { raw(T.data(), 16 * sizeof(double)); }
  void get(Points& points) {
    points.resize(size(sizeof(Eigen::Vector3d)));
    raw(static_cast<void*>(points.data()), points.size() * sizeof(Eigen::Vector3d));
  }
  template <typename T>
  void get(std::vector<T>& values) {
    if constexpr (std::is_arithmetic_v<T>) {
      values.resize(size(sizeof(T)));
      raw(values.data(), values.size() * sizeof(T));
    } else {
      values.resize(size(1));
      for (auto& value : values) get(value);
    }
  }
  template <typename T, std::size_t N>
  void get(std::array<T, N>& values) {
    for (auto& value : values) get(value);
  }
  template <typename A, typename B>
  void get(std::pair<A, B>& value) {
    get(value.first);
    get(value.second);
  }
  template <typename T>
  void get(std::optional<T>& value) {
    bool has_value = false;
    get(has_value);
    value.reset();
    if (has_value) get(value.emplace());
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    if (byte > 1) throw BrokenRecord();
    value = byte != 0;
  }
  template <typename T>
  void get(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      raw(&value, sizeof value);
    } else {
      transfer(*this, value);
    }
  }

  std::string_view bytes_;
};

/// For the functions `transfer`: both Thing and const Thing, so that one function writes and reads.
template <typename T, typename Thing>
concept MaybeConst = std::is_same_v<std::remove_const_t<T>, Thing>;

}  // namespace tcm_icp
