// tcm-icp: the table of subcommands, and the one place where errors become exit codes.

#include <array>
#include <boost/program_options/errors.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#include "command.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/version.hpp"
#include "version.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace tcm_icp::app;

struct Command {
  std::string_view name;
  int (*run)(const Arguments&);
  std::string_view summary;
};

constexpr std::array kCommands{
    Command{"register", cmd_register, "put scans into one frame: poses, merged cloud and report"},
    Command{"evaluate", cmd_evaluate, "errors of poses against ground truth"},
    Command{"degrade", cmd_degrade, "copies of scans with noise, occlusion, sparsity and other defects"},
    Command{"inspect", cmd_inspect, "counts, extents, spacing, TCM and correspondence graph of scans"},
    Command{"render", cmd_render, "picture of a merged cloud, from above and obliquely"},
    Command{"simulate", cmd_simulate, "LiDAR scans of a made-up scene, with exact truth"},
    Command{"sample", cmd_sample, "steps of a registration, for many machines: 1, read scans"},
    Command{"plan", cmd_plan, "2, which pairs to search"},
    Command{"match", cmd_match, "3, search a block of pairs"},
    Command{"solve", cmd_solve, "4, poses and report"},
    Command{"write", cmd_write, "5, write scans in the common frame"},
};

void print_help(std::ostream& out) {
  out << "tcm-icp " << kVersion
      << ": registers many LiDAR scans into one frame\n\nUsage: tcm-icp COMMAND [OPTIONS]\n\n";
  for (const auto& c : kCommands) out << "  " << c.name << std::string(12 - c.name.size(), ' ') << c.summary << '\n';
  out << "\n'tcm-icp COMMAND --help' lists a command's options, 'tcm-icp --version' the version.\n"
         "Exit codes: 0 all scans registered; 1 wrong usage; 2 input cannot be read; 3 some scan is unregistered;\n"
         "            4 output cannot be written; 130 interrupted\n";
}

void print_version(std::ostream& out) {
  out << "tcm-icp " << kVersion << "\ncommit " << tcm_icp::commit() << '\n';
  const char* separator = "built on ";
  for (const auto& library : tcm_icp::linked_libraries()) {
    out << separator << library.name << ' ' << library.version;
    separator = ", ";
  }
  out << '\n';
}

int fail(ExitCode code, std::string_view message) {
  std::cerr << "tcm-icp: " << message << '\n';
  return code;
}

// A table that did not arrive (disk full) is a failure, too.
int with_stdout_written(int code) {
  if (std::cout.flush()) return code;
  return fail(kOutputError, "standard output: cannot be written; check the disk's free space");
}

int run(int argc, char** argv) {
  if (argc < 2) {
    print_help(std::cerr);
    return kUsageError;
  }
  const std::string_view name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    print_help(std::cout);
    return kSuccess;
  }
  if (name == "--version") {
    print_version(std::cout);
    return kSuccess;
  }
  for (const auto& c : kCommands) {
    if (c.name == name) return with_stdout_written(c.run(Arguments(argv + 2, argv + argc)));
  }
  std::vector<std::string> known;
  for (const auto& c : kCommands) known.emplace_back(c.name);
  return fail(kUsageError, joined("unknown command '" + std::string(name) + "'" + did_you_mean(name, known),
                                  "'tcm-icp --help' lists the commands"));
}

// A registration makes and frees arrays of megabytes a thousand times. Given back to the system each time, they come
// back as pages that have to be cleared, which is a tenth of the time of dense scans.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1024 * 1024;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);  // the most that is allowed
  mallopt(M_TRIM_THRESHOLD, 64 * kMegabyte);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of writing, to be cleaned up after
  try {
    return run(argc, argv);
  } catch (const tcm_icp::Cancelled& e) {
    return fail(kInterrupted, e.what());
  } catch (const tcm_icp::InvalidOptions& e) {
    return fail(kUsageError, e.what());
  } catch (const boost::program_options::error& e) {
    return fail(kUsageError,
                joined(e.what(), std::string("'tcm-icp ") + (argc > 1 ? argv[1] : "") + " --help' lists the options"));
  } catch (const tcm_icp::OutputError& e) {
    return fail(kOutputError, e.what());
  } catch (const tcm_icp::Error& e) {
    return fail(kInputError, e.what());
  } catch (const std::bad_alloc&) {
    return fail(kInternalError, "out of memory");
  } catch (const std::exception& e) {
    return fail(kInternalError, std::string("internal error: ") + e.what() + "; please report this");
  }
}
