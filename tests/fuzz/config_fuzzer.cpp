// Any bytes as the file of --config.

#include <boost/program_options/errors.hpp>
#include <sstream>

#include "fuzz_file.hpp"
#include "register_options.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tcm_icp;
  const fuzz::FuzzFile file({reinterpret_cast<const char*>(data), size}, ".ini");
  try {
    const auto options = app::parse_register_options({"a.ply", "b.ply", "--config", file.path().string()});
    std::ostringstream out;
    app::print_register_config(options, out);
  } catch (const Error&) {
    // refused: as good
  } catch (const boost::program_options::error&) {
  }
  return 0;
}
