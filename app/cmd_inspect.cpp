// tcm-icp inspect: what is known of scans before they are registered, as tables or JSON.

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "command.hpp"
#include "console.hpp"
#include "figure.hpp"
#include "register_options.hpp"
#include "run_setup.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/inspection.hpp"
#include "version.hpp"

namespace tcm_icp::app {
namespace {

std::string four_digits(double value) { return figure("%.4g", value); }

enum class LastColumn { kNumber, kText };

// Columns as wide as their widest cell; text to the left, numbers to the right.
void print_columns(const std::vector<std::vector<std::string>>& rows, std::ostream& out,
                   LastColumn last = LastColumn::kNumber) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  for (const auto& row : rows) {
    out << std::left << std::setw(static_cast<int>(widths[0])) << row[0] << std::right;
    for (std::size_t c = 1; c < row.size(); ++c) {
      const bool text = last == LastColumn::kText && c + 1 == row.size();
      out << "  " << std::setw(text ? 0 : static_cast<int>(widths[c])) << row[c];
    }
    out << '\n';
  }
}

void print_scans(const Inspection& inspection, std::ostream& out) {
  std::vector<std::vector<std::string>> counts{
      {"scan", "points", "dropped", "working", "outliers", "spacing", "noise", "extent", "voxel"}};
  std::vector<std::vector<std::string>> boxes{{"scan", "box min x", "y", "z", "size x", "y", "z"}};
  for (std::size_t i = 0; i < inspection.scans.size(); ++i) {
    const ScanSummary& s = inspection.scans[i];
    counts.push_back({s.file, std::to_string(s.num_points), std::to_string(s.num_dropped_points),
                      std::to_string(s.num_working_points), std::to_string(s.outliers.summary().num_outliers),
                      four_digits(s.spacing_m), four_digits(s.noise_m), four_digits(s.extent_m),
                      four_digits(s.voxel_size_m)});
    std::vector<std::string> row{s.file};
    for (const double v : inspection.boxes_m[i].min()) row.push_back(figure("%.3f", v));
    for (const double v : inspection.boxes_m[i].sizes()) row.push_back(figure("%.3f", v));
    boxes.push_back(row);
  }
  out << "Scans. Lengths are in the unit of the scans; working: points left of the sample after outlier removal;\n"
         "outliers: points it took from the sample; extent: 90 % of the points lie this near the median point\n";
  print_columns(counts, out);
  out << "\nBox of the working points, in the coordinates of the file\n";
  print_columns(boxes, out);
}

void print_matrix(const Inspection& inspection, const Eigen::MatrixXd& matrix, std::ostream& out) {
  std::vector<std::vector<std::string>> rows{{""}};
  for (const auto& s : inspection.scans) rows[0].push_back(s.file);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    std::vector<std::string> row{inspection.scans[static_cast<std::size_t>(i)].file};
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(i == j ? "-" : four_digits(matrix(i, j)));
    rows.push_back(row);
  }
  print_columns(rows, out);
}

void print_graph(const Inspection& inspection, const CorrespondenceGraph& graph, bool paper, std::ostream& out) {
  out << "\nCorrespondence measure: " << (paper ? "mean distance of nearest neighbours" : "1 - overlap")
      << "; smaller is closer\n";
  print_matrix(inspection, graph.measure, out);
  out << "\nCorrespondence graph: measure below " << four_digits(graph.threshold)
      << (graph.threshold_from_data ? ", from the median of the pairs" : "") << "; " << graph.num_components
      << (graph.num_components == 1 ? " component\n" : " components\n");
  std::vector<std::vector<std::string>> rows{{"scan", "degree", "component", "connected to"}};
  for (std::size_t i = 0; i < graph.size(); ++i) {
    std::string neighbors;
    for (const std::size_t j : graph.adjacency[i])
      neighbors += (neighbors.empty() ? "" : " ") + inspection.scans[j].file;
    rows.push_back({inspection.scans[i].file, std::to_string(graph.degree(i)), std::to_string(graph.component[i]),
                    neighbors.empty() ? "-" : neighbors});
  }
  print_columns(rows, out, LastColumn::kText);
  out << "\nreference: " << inspection.scans[graph.reference].file << '\n';
}

void print_text(const Inspection& inspection, bool paper, std::ostream& out) {
  print_scans(inspection, out);
  if (!inspection.comparison) return;
  const ScanComparison& c = *inspection.comparison;
  out << "\nTCM as printed in the paper [length^4], at the initial poses; smaller is more compatible\n";
  print_matrix(inspection, c.paper_tcm_m4, out);
  out << "\nTCM with statistics in place of minima [length^2]\n";
  print_matrix(inspection, c.robust_tcm_m2, out);
  print_graph(inspection, c.graph, paper, out);
}

}  // namespace

int cmd_inspect(const Arguments& arguments) {
  const InspectOptions o = parse_inspect_options(arguments);
  if (o.help) {
    print_inspect_help(std::cout);
    return kSuccess;
  }
  if (o.scans.empty()) throw InvalidOptions("no scan is given; name the files: tcm-icp inspect SCAN...");
  const ScanInputs inputs = find_scans(o.scans, parse_bin(o.bin));
  const auto paths = with_units(inputs.scans, o.units);
  const InitialPoses guess = read_guess(o, paths);

  catch_interrupts();
  Console console(o.quiet, o.verbose);
  const RunContext context = run_context(o, paths.size(), console);
  report_left_out(inputs, context);
  report_coordinate_systems(paths, "which results do not keep", context);
  const Inspection inspection = inspect_scans(paths, guess, o.pipeline, context);
  console.finish();
  if (o.json) {
    std::cout << inspection_json(inspection, o.pipeline, context,
                                 {kVersion, command_line("inspect", arguments), o.initial_poses, {}});
  } else {
    print_text(inspection, o.pipeline.profile == Profile::kPaper, std::cout);
  }
  return kSuccess;
}

}  // namespace tcm_icp::app
