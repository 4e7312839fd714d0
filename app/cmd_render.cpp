// tcm-icp render: a picture of a merged cloud.

#include <boost/program_options.hpp>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "command.hpp"
#include "console.hpp"
#include "option_binding.hpp"
#include "parse_arguments.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/cloud_render.hpp"

namespace tcm_icp::app {
namespace {

namespace po = boost::program_options;

struct Request {
  std::vector<std::string> clouds;
  std::string out, view = "both", size = "1600x800";
  RenderOptions render;
  bool force = false;
  RunOptions run;
};

RenderView parse_view(const std::string& text) {
  if (text == "both") return RenderView::kBoth;
  if (text == "top") return RenderView::kTop;
  if (text == "oblique") return RenderView::kOblique;
  throw InvalidOptions("--view '" + text + "': choose one of both, top, oblique" +
                       did_you_mean(text, {"both", "top", "oblique"}));
}

void parse_size(const std::string& text, RenderOptions& options) {
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, options.height);
    if (height.ec == std::errc() && height.ptr == end) return;
  }
  throw InvalidOptions("--size '" + text + "': give width and height in pixels: 1600x800");
}

po::options_description describe(Request& r) {
  po::options_description options("Options");
  options.add_options()("cloud", po::value(&r.clouds), "")("out,o", po::value(&r.out), "file of the picture (PNG)")(
      "view", bind_option(&r.view), "top (y up), oblique (from the south-west), or both side by side")(
      "size", bind_option(&r.size), "of the picture, in pixels")("points", bind_option(&r.render.max_points),
                                                                 "most points drawn, evenly over the cloud")(
      "force", po::bool_switch(&r.force), "replace the file");
  add_run_options(r.run, options);
  options.add_options()("help,h", "this text");
  return options;
}

}  // namespace

int cmd_render(const Arguments& arguments) {
  Request request;
  const po::options_description description = describe(request);
  po::variables_map given;
  po::store(parse_arguments(arguments, description, "cloud"), given);
  if (given.count("help") > 0) {
    std::cout
        << "Usage: tcm-icp render CLOUD --out FILE.png [OPTIONS]\n"
           "A picture of a merged cloud, each scan in its colour. CLOUD is a folder that tcm-icp register wrote, or "
           "a file.\n\n"
        << description << "\nExample: tcm-icp render out/town --out town.png --view oblique --size 1200x800\n";
    return kSuccess;
  }
  po::notify(given);
  if (request.clouds.size() != 1) throw InvalidOptions("render draws one cloud: tcm-icp render CLOUD --out FILE.png");
  if (request.out.empty()) throw InvalidOptions("--out FILE.png is missing: where is the picture to go?");
  request.render.view = parse_view(request.view);
  parse_size(request.size, request.render);
  request.render.validate();
  if (!request.force && std::filesystem::exists(request.out)) {
    throw OutputError(request.out, "is there already", "choose another name, or --force");
  }
  catch_interrupts();
  Console console(request.run.quiet, request.run.verbose);
  RunContext context;
  context.num_threads = num_threads(request.run.threads);
  context.on_progress = [&](const Progress& p) { return console.progress(p); };
  render_cloud(request.clouds.front(), request.out, request.render, context);
  console.finish();
  return kSuccess;
}

}  // namespace tcm_icp::app
