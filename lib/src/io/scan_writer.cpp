#include "tcm_icp/io/scan_writer.hpp"

#include <bit>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <string>

#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

static_assert(std::endian::native == std::endian::little, "scans are written as they lie in memory");

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return extension;
}

bool is_text(const std::string& extension) {
  static const std::set<std::string> kText{".xyz", ".txt", ".asc", ".pts", ".csv"};
  return kText.contains(extension);
}

void write_ply(std::ostream& out, const PointBlock& block, const std::vector<Attribute>& attributes) {
  out << "ply\nformat binary_little_endian 1.0\ncomment made by tcm-icp\nelement vertex " << block.size()
      << "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const auto& a : attributes) out << "property " << ply_type_name(a.type) << ' ' << a.name << '\n';
  out << "end_header\n";
  const std::size_t stride = attribute_stride(attributes);
  for (std::size_t i = 0; i < block.size(); ++i) {
    out.write(reinterpret_cast<const char*>(block.points[i].data()), 3 * sizeof(double));
    out.write(reinterpret_cast<const char*>(block.attributes.data() + i * stride),
              static_cast<std::streamsize>(stride));
  }
}

void write_text(std::ostream& out, const PointBlock& block, const std::vector<Attribute>& attributes) {
  out << "# x y z";
  for (const auto& a : attributes) out << ' ' << a.name;
  out << '\n';
  const std::byte* at = block.attributes.data();
  char number[40];
  const auto print = [&](double value, char before) {
    std::snprintf(number, sizeof number, "%.17g", value);
    if (before != '\0') out << before;
    out << number;
  };
  for (const auto& p : block.points) {
    for (int axis = 0; axis < 3; ++axis) print(p[axis], axis == 0 ? '\0' : ' ');
    for (const auto& a : attributes) {
      print(load_scalar(at, a.type), ' ');
      at += scalar_size(a.type);
    }
    out << '\n';
  }
}

}  // namespace

bool can_write_scan(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".ply" || is_text(extension);
}

void write_scan(const std::filesystem::path& path, const PointBlock& block, const std::vector<Attribute>& attributes) {
  if (block.attributes.size() != block.size() * attribute_stride(attributes))
    throw InvalidInput("scan writer: the attributes do not fit the points");
  const std::string extension = lower_extension(path);
  if (!can_write_scan(path)) throw InvalidInput("scan writer: unknown extension '" + extension + "'");
  std::ofstream out(path, std::ios::binary);
  extension == ".ply" ? write_ply(out, block, attributes) : write_text(out, block, attributes);
  out.close();
  if (!out) throw OutputError(path, "cannot be written", "check the folder, its permissions and free space");
}

}  // namespace tcm_icp
