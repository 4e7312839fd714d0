// Reads a cloud, and writes it as PLY where a second file is named, for scripts/bench.py:
//   tcm_icp_cloud_io tcm-icp|pcl IN [OUT.ply]
// The coordinates alone, all of them in memory. Prints one line of JSON: points, and the processor time of each in
// seconds.

#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/io/scan_writer.hpp"
#ifdef TCM_ICP_HAVE_PCL
#include <pcl/io/ascii_io.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#endif

namespace tcm_icp {
namespace {

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Cost {
  std::size_t points = 0;
  double read_s = 0, write_s = 0;
};

Cost by_tcm_icp(const std::string& in, const std::string& out) {
  PointBlock cloud;
  const double begin_s = cpu_s();
  ScanReader reader(in, ReadAttributes::kNo);
  for (PointBlock block; reader.read(block);) {
    cloud.points.insert(cloud.points.end(), block.points.begin(), block.points.end());
  }
  const double read_s = cpu_s();
  if (!out.empty()) write_scan(out, cloud, {});
  return {cloud.size(), read_s - begin_s, cpu_s() - read_s};
}

#ifdef TCM_ICP_HAVE_PCL
using PclPoints = pcl::PointCloud<pcl::PointXYZ>;

int pcl_read(const std::string& file, PclPoints& cloud) {
  const std::string kind = std::filesystem::path(file).extension().string();
  if (kind == ".ply") return pcl::io::loadPLYFile(file, cloud);
  if (kind == ".pcd") return pcl::io::loadPCDFile(file, cloud);
  pcl::ASCIIReader reader;
  reader.setExtension(kind);
  reader.setInputFields<pcl::PointXYZ>();
  reader.setSepChars(" ");
  pcl::PCLPointCloud2 fields;
  const int status = reader.read(file, fields);
  if (status >= 0) pcl::fromPCLPointCloud2(fields, cloud);
  return status;
}

Cost by_pcl(const std::string& in, const std::string& out) {
  PclPoints cloud;
  const double begin_s = cpu_s();
  if (pcl_read(in, cloud) < 0) throw std::runtime_error(in + ": PCL cannot read it");
  const double read_s = cpu_s();
  if (!out.empty() && pcl::io::savePLYFileBinary(out, cloud) < 0)
    throw std::runtime_error(out + ": PCL cannot write it");
  return {cloud.size(), read_s - begin_s, cpu_s() - read_s};
}
#endif

Cost measure(const std::string& library, const std::string& in, const std::string& out) {
  if (library == "tcm-icp") return by_tcm_icp(in, out);
#ifdef TCM_ICP_HAVE_PCL
  if (library == "pcl") return by_pcl(in, out);
#endif
  throw std::runtime_error(library + ": not a library that this program was built with");
}

}  // namespace
}  // namespace tcm_icp

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "Usage: tcm_icp_cloud_io tcm-icp|pcl IN [OUT]\n";
    return 1;
  }
  try {
    const auto cost = tcm_icp::measure(argv[1], argv[2], argc == 4 ? argv[3] : "");
    std::cout << "{\"points\": " << cost.points << ", \"read_s\": " << cost.read_s << ", \"write_s\": " << cost.write_s
              << "}\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}
