// Options of `tcm-icp register`: what is refused, what is told, and what an option file does.

#include <algorithm>

#include "cli_test.hpp"

namespace tcm_icp::test {
namespace {

class Usage : public CliTest {
 protected:
  Usage() {
    folder_.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n");
    folder_.write("b.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  }
  void expect_bad(const Words& options, const Words& parts) const {
    expect_refusal(Words{"register", "a.xyz", "b.xyz", "--out", "result"} + options, 1, parts);
  }
  std::string config(const Words& options) const {
    const RunResult result = run(Words{"register", "--print-config"} + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }
};

TEST_F(Usage, RefusesUnknownCommandsAndOptions) {
  expect_refusal({"registr"}, 1, {"unknown command 'registr'", "--help"});
  expect_bad({"--bogus"}, {"'--bogus'", "register --help"});
  expect_bad({"--prof", "paper"}, {"'--prof'"});
  expect_bad({"--seed"}, {"--seed"});
  expect_refusal({"register", "a.xyz", "b.xyz"}, 1, {"--out DIR is missing"});
}

TEST_F(Usage, RefusesUnknownNamesAndTellsTheKnown) {
  expect_bad({"--profile", "best"}, {"--profile 'best'", "robust, paper"});
  expect_bad({"--paper.matches", "near"}, {"--paper.matches 'near'", "nearest, threshold, mutual"});
  expect_bad({"--paper.kept-share", "0"}, {"kept_share must be above 0"});
  expect_bad({"--solver", "soplex"}, {"--solver 'soplex'", "glpk, cgal"});
  expect_bad({"--outliers", "some"}, {"--outliers 'some'", "kmeans"});
  expect_bad({"--refinement", "icp"}, {"--refinement 'icp'", "descent"});
  expect_bad({"--lp.formulation", "13"}, {"--lp.formulation '13'", "plane, point, entries, squares"});
  expect_bad({"--without", "sides"}, {"--without 'sides'", "features, slides, implied"});
  expect_bad({"--merge-order", "size"}, {"--merge-order 'size'", "overlap, file, random"});
}

TEST_F(Usage, AsksForTheNameThatWasMeant) {
  expect_refusal({"registr"}, 1, {"did you mean 'register'? 'tcm-icp --help'"});
  expect_refusal({"inpsect"}, 1, {"did you mean 'inspect'?"});
  expect_bad({"--referense", "a.xyz"}, {"did you mean '--reference'? 'tcm-icp register --help'"});
  expect_bad({"--prof", "paper"}, {"did you mean '--profile'?"});
  expect_bad({"--fine-voxels", "1000"}, {"did you mean '--sampling.fine-voxels'?"});
  expect_bad({"--profile", "papper"}, {"robust, paper; did you mean 'paper'?"});
  expect_bad({"--bin", "kiti"}, {"did you mean 'kitti'?"});
  expect_refusal({"simulate", "--scene", "tonw", "--out", "new"}, 1, {"did you mean 'town'?"});
  expect_refusal({"simulate", "--scens", "3", "--out", "new"}, 1, {"did you mean '--scene'?"});
  expect_refusal({"degrade", "a.xyz", "--nose", "0.1", "--out", "new"}, 1, {"did you mean '--noise'?"});
  expect_refusal({"evaluate", "--thruth", "t.json"}, 1, {"did you mean '--truth'?"});
  folder_.write("options.ini", "profil = paper\n");
  expect_bad({"--config", "options.ini"}, {"options.ini", "did you mean 'profile'? --print-config"});
}

TEST_F(Usage, AsksForNothingWhereNoNameIsAlike) {
  for (const Words& arguments :
       {Words{"frobnicate"}, Words{"register", "--bogus"}, Words{"register", "-x"},
        Words{"inspect", "--scan", "a.xyz", "--qqq"}, Words{"register", "--" + std::string(5000, 'p')}}) {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments.back();
    EXPECT_EQ(result.err.find("did you mean"), std::string::npos) << result.err;
  }
}

TEST_F(Usage, EveryCommandRunsAlike) {
  for (const char* command : {"register", "evaluate", "degrade", "inspect", "simulate"}) {
    const RunResult help = run({command, "--help"});
    for (const char* option : {"--quiet", "--verbose", "--threads"}) {
      EXPECT_NE(help.out.find(option), std::string::npos) << command << ' ' << option;
    }
  }
  const Words none{"--threads", "-1"}, to{"--out", "new"};
  expect_bad(none, {"--threads", "-1"});
  expect_refusal(Words{"inspect", "a.xyz"} + none, 1, {"--threads", "-1"});
  expect_refusal(Words{"degrade", "a.xyz", "--noise", "0.1"} + none + to, 1, {"--threads", "-1"});
  expect_refusal(Words{"simulate"} + none + to, 1, {"--threads", "-1"});
  expect_refusal(Words{"evaluate", "--scans", ".", "--poses", "p", "--truth", "t"} + none, 1, {"--threads", "-1"});
  for (const char* size : {"many", "4", "4 G", "4GB", "1M", "nanG", "1e9T"}) {
    expect_bad({"--memory", size}, {"--memory", size});
  }
  for (const char* command : {"register", "degrade", "simulate"}) {
    EXPECT_NE(run({command, "--help"}).out.find("--force"), std::string::npos) << command;
  }
}

TEST_F(Usage, QuietCommandsSayNothing) {
  const RunResult made =
      run({"simulate", "--scans", "2", "--step", "4", "--out", "scene", "--quiet", "--threads", "0"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out + made.err, "");
  const RunResult worse = run({"degrade", "scene/000.ply", "--noise", "0.1", "--out", "worse", "-q", "--threads", "0"});
  EXPECT_EQ(worse.exit_code, 0) << worse.err;
  EXPECT_EQ(worse.out + worse.err, "");
}

TEST_F(Usage, RefusesNumbersOutOfBounds) {
  expect_bad({"--threads", "-1"}, {"threads", "-1"});
  expect_bad({"--threads", "two"}, {"threads", "two"});
  expect_bad({"--seed", "-1"}, {"--seed", "-1"});
  expect_bad({"--reference", "2"}, {"--reference 2", "0 to 1"});
  expect_bad({"--reference", "c.xyz"}, {"--reference c.xyz", "no scan of that name"});
  expect_bad({"--sampling.fine-voxels=-3"}, {"sampling.fine-voxels", "-3"});
  expect_bad({"--sampling.coarse-voxels", "5"}, {"coarse_voxels", "5", "100"});
  expect_bad({"--lp.max-pivots", "0"}, {"max_pivots", "0"});
  expect_bad({"--lp.max-seconds", "nan"}, {"max_seconds"});
  expect_bad({"--outliers.radius", "-0.5"}, {"radius", "-0.5"});
  expect_bad({"--graph-threshold", "-1"}, {"graph_threshold", "-1"});
  expect_bad({"--annealing.final-temperature", "0"}, {"final_temperature", "0"});
}

TEST_F(Usage, PrintConfigHasWhatWasAskedForAndReadsItBack) {
  const Words asked{"--each", "--level", "--format", "las", "--voxel", "0.05", "--colour", "scan"};
  const std::string text = config(asked);
  for (const char* const line : {"each = true", "level = true", "format = las", "voxel = 0.05", "colour = scan"}) {
    EXPECT_NE(text.find(std::string("\n") + line + '\n'), std::string::npos) << line;
  }
  folder_.write("options.ini", text);
  EXPECT_EQ(config({"--config", "options.ini"}), text);
}

TEST_F(Usage, HelpFitsAPage) {
  const RunResult help = run({"register", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_LT(std::count(help.out.begin(), help.out.end(), '\n'), 60) << help.out;
  for (const char* option : {"--out", "--reference", "--help-all"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
}

TEST_F(Usage, HelpGoesToStdoutAndNamesEveryOption) {
  const RunResult help = run({"register", "--help-all"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* option : {"--out", "--force", "--config", "--print-config", "--quiet", "--verbose", "--help"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
  std::istringstream lines(config({}));
  std::size_t num_options = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.front() == '#') continue;
    const std::string option = "--" + line.substr(0, line.find(' '));
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
    ++num_options;
  }
  EXPECT_GT(num_options, 20U);
}

TEST_F(Usage, AWholeHelpThatCannotBeWrittenIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  RunSettings full;
  full.stdout_file = "/dev/full";
  expect_refusal({"register", "--help"}, 4, {"standard output", "cannot be written"}, full);
}

TEST_F(Usage, PrintedOptionsGiveTheSameOptions) {
  const Words options{"--seed", "7",         "--solver", "cgal",   "--outliers.threshold",
                      "0.1",    "--profile", "paper",    "--level"};
  const std::string printed = config(options);
  EXPECT_NE(printed, config({}));
  folder_.write("options.ini", printed);
  EXPECT_EQ(config({"--config", "options.ini"}), printed);
}

TEST_F(Usage, CommandLineWinsOverTheFile) {
  folder_.write("options.ini", "seed = 7\nsolver = cgal\n");
  const std::string printed = config({"--config", "options.ini", "--seed", "8"});
  EXPECT_NE(printed.find("seed = 8\n"), std::string::npos) << printed;
  EXPECT_NE(printed.find("solver = cgal\n"), std::string::npos) << printed;
}

}  // namespace
}  // namespace tcm_icp::test
