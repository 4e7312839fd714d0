// sample, plan, match, solve, write: refusals name what is missing (scripts/test_workflow.sh runs the steps).

#include "cli_test.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

class Steps : public CliTest {
 protected:
  Words work() const { return {"--work", "work"}; }
  int run_quietly(const Words& arguments) const {
    const RunResult result = run(arguments + Words{"--quiet"});
    EXPECT_EQ(result.err, "");
    return result.exit_code;
  }
};

TEST_F(Steps, HaveHelp) {
  for (const char* command : {"sample", "plan", "match", "solve", "write"}) {
    const RunResult help = run({command, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find(std::string("Usage: tcm-icp ") + command), std::string::npos);
    for (const char* option : {"--work", "--config", "--threads"}) {
      EXPECT_NE(help.out.find(option), std::string::npos) << command << ' ' << option;
    }
  }
}

TEST_F(Steps, RefuseWhatTheyCannotServe) {
  const Words scans = town_scans({0, 1});
  expect_refusal(Words{"sample"} + scans, 1, {"--work DIR is missing"});
  expect_refusal(Words{"sample"} + work(), 1, {"no scan is given"});
  expect_refusal(Words{"plan"} + work(), 1, {"no scan is given"});
  expect_refusal(Words{"match"} + work(), 1, {"--block K/N is missing"});
  for (const char* block : {"0/3", "4/3", "1", "1/", "/3", "a/b", "1/3x", "-1/3"}) {
    expect_refusal(Words{"match", std::string("--block=") + block} + work(), 1, {"--block", block, "K from 1 to N"});
  }
  expect_refusal(Words{"match", "--block", "1/1", "a.ply"} + work(), 1, {"a.ply", "in the plan"});
  expect_refusal(Words{"solve", "--out", "new"} + scans, 1, {"--work DIR is missing"});
  expect_refusal(Words{"solve"} + scans + work(), 1, {"--out DIR is missing"});
  expect_refusal(Words{"write"} + scans + work(), 1, {"--out DIR is missing"});
  expect_refusal(Words{"write", "--out", "none"} + scans + work(), 2, {"poses.json"});
  expect_refusal(Words{"sample", "--method", "icp"} + scans + work(), 1, {"--method"});
}

TEST_F(Steps, MatchWantsAPlanOfItsOptions) {
  const Words scans = town_scans({0, 1});
  const RunResult unplanned = run(Words{"match", "--block", "1/1"} + work());
  EXPECT_EQ(unplanned.exit_code, 2);
  EXPECT_NE(unplanned.err.find("plan.json: there is no plan; run 'tcm-icp plan' first"), std::string::npos);
  EXPECT_EQ(run_quietly(Words{"plan"} + scans + work() + kSmall), 0);
  const RunResult other = run(Words{"match", "--block", "1/1", "--seed", "7"} + work());
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("was made with other options"), std::string::npos);
  EXPECT_EQ(run_quietly(Words{"match", "--block", "1/1"} + work() + kSmall), 0);
  folder_.write("work/plan.json", "{}");
  const RunResult damaged = run(Words{"match", "--block", "1/1"} + work() + kSmall);
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_NE(damaged.err.find("is no plan"), std::string::npos);
}

TEST_F(Steps, WriteAScanAsRegisterDoes) {
  const Words scans = town_scans({0, 1, 2});
  EXPECT_EQ(run_quietly(Words{"register", "--each", "--out", "plain"} + scans + kSmall), 0);
  EXPECT_EQ(run_quietly(Words{"solve", "--out", "solved"} + scans + work() + kSmall), 0);
  EXPECT_FALSE(std::filesystem::exists(folder() / "solved/registered.ply"));
  EXPECT_TRUE(std::filesystem::exists(folder() / "solved/report.html"));
  EXPECT_EQ(run_quietly(Words{"write", "--out", "solved"} + town_scans({1}) + work() + kSmall), 0);
  for (const char* file : {"poses.json", "scans/001.ply"}) {
    EXPECT_TRUE(read_text(folder() / "plain" / file) == read_text(folder() / "solved" / file)) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "solved/scans/000.ply"));
  const RunResult unknown = run(Words{"write", "--out", "solved"} + town_scans({4}) + work() + kSmall);
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("no scan of the result is called so"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp::test
