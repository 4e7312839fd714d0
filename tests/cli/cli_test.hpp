#pragma once
// The fixture of the tests that run the executable: a folder of its own, and what every refusal must keep to.

#include <gtest/gtest.h>

#include "io/temp_files.hpp"
#include "run_program.hpp"

namespace tcm_icp::test {

// Small samples: a registration in a fraction of a second.
inline const Words kSmall{"--sampling.working-points", "20000", "--sampling.coarse-voxels", "4000",
                          "--sampling.fine-voxels",    "10000"};

class CliTest : public ::testing::Test {
 protected:
  RunResult run(const Words& arguments, RunSettings settings = {}) const {
    settings.folder = folder_.path();
    return run_program(arguments, settings);
  }

  /// The command must exit with `code`, say all of `parts` on stderr and nothing on stdout, and leave the folder as it
  /// was.
  void expect_refusal(const Words& arguments, int code, const Words& parts, RunSettings settings = {}) const {
    std::string line = "tcm-icp";
    for (const auto& a : arguments) line += " " + a;
    const auto before = everything_in(folder_.path());
    const RunResult result = run(arguments, std::move(settings));
    EXPECT_EQ(result.exit_code, code) << line << "\nsignal " << result.signal << '\n' << result.err;
    EXPECT_EQ(result.out, "") << line;
    EXPECT_NE(result.err.find("tcm-icp: "), std::string::npos) << line;
    for (const auto& part : parts) {
      EXPECT_NE(result.err.find(part), std::string::npos) << line << "\ndoes not say '" << part << "':\n" << result.err;
    }
    EXPECT_EQ(everything_in(folder_.path()), before) << line;
  }

  const std::filesystem::path& folder() const { return folder_.path(); }
  TempFolder folder_;
};

}  // namespace tcm_icp::test
