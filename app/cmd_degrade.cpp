// tcm-icp degrade: scans with noise, occlusion, sparsity, isolated points and blurred features, as in the paper's
// experiments.

#include <boost/program_options.hpp>
#include <cstring>
#include <iostream>
#include <set>

#include "command.hpp"
#include "console.hpp"
#include "degradation_report.hpp"
#include "option_binding.hpp"
#include "parse_arguments.hpp"
#include "run_setup.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/evaluation/degradation.hpp"
#include "tcm_icp/io/output_folder.hpp"
#include "tcm_icp/io/scan_inputs.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/io/scan_writer.hpp"

namespace tcm_icp::app {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

struct Request {
  std::vector<std::string> scans;
  std::string out, bin;
  DegradationOptions options;
  RunOptions run;
  RunContext context;
};

po::options_description describe(Request& r) {
  DegradationOptions& o = r.options;
  po::options_description what("Defects (shares are 0..1 of a scan's points; several may be combined)", 110);
  what.add_options()("occlusion", bind_option(&o.occlusion_share),
                     "share hidden, by two sectors about the vertical (z) and two boxes")  //
      ("remove", bind_option(&o.removal_share), "share removed, anywhere")                 //
      ("noise", bind_option(&o.noise_share), "share moved by normal noise")                //
      ("sigma", bind_option(&o.sigma_m),
       "standard deviation of the noise on each axis, in the unit of the scans; 0: the "
       "scan's median point spacing")                                                                   //
      ("blur", bind_option(&o.blur_share), "share added about edges and corners, to conceal features")  //
      ("isolated", bind_option(&o.isolated_share), "share added away from all surfaces");
  po::options_description run("Run", 110);
  run.add_options()("out", po::value(&r.out)->required(),
                    "folder to make: the scans under their names, degraded.json")   //
      ("bin", po::value(&r.bin), kBinHelp)                                          //
      ("force", "replace an earlier result in that folder")                         //
      ("seed", bind_option(&r.context.seed), "the same seed gives the same bytes")  //
      ("help,h", "this text");
  add_run_options(r.run, run);
  return what.add(run);
}

po::options_description with_scans(Request& r, const po::options_description& visible) {
  po::options_description all;
  all.add(visible).add_options()("scan", po::value(&r.scans));
  return all;
}

ScanInputs find_and_check(const std::vector<std::string>& named, BinLayout bin) {
  if (named.empty()) throw InvalidOptions("no scan is named: tcm-icp degrade SCAN... --out DIR --noise 0.1");
  ScanInputs inputs = find_scans(named, bin);
  std::set<std::string> names;
  for (const auto& name : scan_names(inputs.scans)) {
    if (!names.insert(name).second) throw InvalidInput(name + ": named twice; name each scan once");
  }
  // A missing last file should not cost the work on all others.
  for (const auto& scan : inputs.scans) const ScanReader opened(scan, ReadAttributes::kYes);
  return inputs;
}

/// PLY and text keep their format and name; what cannot be written becomes PLY.
std::string written_name(const std::string& name) { return can_write_scan(name) ? name : name + ".ply"; }

struct WholeScan {
  PointBlock block;
  std::vector<Attribute> attributes;
};

WholeScan read_whole(const fs::path& path) {
  ScanReader reader(path, ReadAttributes::kYes);
  WholeScan scan{{}, reader.attributes()};
  for (PointBlock block; reader.read(block);) {
    scan.block.points.insert(scan.block.points.end(), block.points.begin(), block.points.end());
    scan.block.attributes.insert(scan.block.attributes.end(), block.attributes.begin(), block.attributes.end());
  }
  return scan;
}

/// Attributes go with their points; those of points that were added are 0.
PointBlock with_attributes(DegradedCloud&& cloud, const WholeScan& scan) {
  const std::size_t stride = attribute_stride(scan.attributes);
  PointBlock block;
  block.attributes.resize(cloud.points.size() * stride);
  for (std::size_t i = 0; stride > 0 && i < cloud.source.size(); ++i) {
    if (cloud.source[i] == DegradedCloud::kAdded) continue;
    std::memcpy(block.attributes.data() + i * stride, scan.block.attributes.data() + cloud.source[i] * stride, stride);
  }
  block.points = std::move(cloud.points);
  return block;
}

/// Degrades one file and writes it; what was done.
DegradedFile degrade_file(const fs::path& path, const std::string& name, const fs::path& to, const Request& request) {
  const WholeScan scan = read_whole(path);
  DegradedCloud cloud;
  try {
    cloud = degrade(scan.block.points, request.options, request.context.seed, name, request.context.num_threads);
  } catch (const InvalidInput& e) {
    throw InputError(path, "", e.what(), "");
  }
  DegradedFile file{written_name(name), scan.block.size(), cloud.points.size(), cloud.steps};
  fs::create_directories((to / file.name).parent_path());
  write_scan(to / file.name, with_attributes(std::move(cloud), scan), scan.attributes);
  return file;
}

}  // namespace

int cmd_degrade(const Arguments& arguments) {
  Request request;
  const po::options_description visible = describe(request);
  const po::options_description all = with_scans(request, visible);
  po::variables_map given;
  po::store(parse_arguments(arguments, all, "scan"), given);
  if (given.count("help") > 0) {
    std::cout
        << "Usage: tcm-icp degrade SCAN... --out DIR [--noise P] [--isolated P] [--occlusion P] [--remove P] [--blur "
           "P] ...\n"
           "Copies of scans with defects put in, in this order: occlusion, removal, noise, blurring, isolated points.\n"
           "Names and attributes stay, and so do PLY and text; other formats become PLY (.ply behind the name); a "
           "point that was added has 0 for every attribute, noise moves no "
           "normals.\n\n"
        << visible;
    return kSuccess;
  }
  po::notify(given);
  request.options.validate();
  request.context.num_threads = num_threads(request.run.threads);
  const ScanInputs inputs = find_and_check(request.scans, parse_bin(request.bin));
  const std::vector<std::string> names = scan_names(inputs.scans);
  catch_interrupts();
  Console console(request.run.quiet, request.run.verbose);
  request.context.log = [&](LogLevel level, std::string_view message) { console.log(level, message); };
  report_left_out(inputs, request.context);
  request.context.on_progress = [&](const Progress& p) { return console.progress(p); };
  OutputFolder folder(request.out, given.count("force") > 0, "degraded.json");
  DegradationReport report{command_line("degrade", arguments), request.context.seed, {}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    request.context.report("degrade", i, names.size());
    report.files.push_back(degrade_file(inputs.scans[i], names[i], folder.work(), request));
  }
  write_degradation(report, folder.work() / "degraded.json");
  folder.commit();
  console.finish();
  if (!request.run.quiet) print_degradation(report, std::cout);
  return kSuccess;
}

}  // namespace tcm_icp::app
