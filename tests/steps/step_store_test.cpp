// A result is there whole or not at all, under the name of all that it depends on.

#include "tcm_icp/steps/step_store.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "io/temp_files.hpp"
#include "steps/do_once.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::test {
namespace {

namespace fs = std::filesystem;

class StepStoreTest : public ::testing::Test {
 protected:
  std::vector<fs::path> files_in(const std::string& part) const {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "work" / part)) {
      if (entry.is_regular_file()) out.push_back(entry.path());
    }
    return out;
  }
  StepStore open() {
    return StepStore(folder_.path() / "work", [this](std::string_view text) { said_ += std::string(text) + "\n"; });
  }
  std::size_t num_logged() const {
    std::string all;
    for (const auto& file : files_in("log")) all += read_text(file);
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
  }

  TempFolder folder_;
  std::string said_;
};

TEST_F(StepStoreTest, FindsWhatWasSavedByTheSameKeyAlone) {
  const StepKey key = step_key("fits", 0.1, 2), other = step_key("fits", 0.1, 3);
  open().save(key, "some bytes", 0.5);
  const StepStore again = open();
  EXPECT_EQ(again.find(key), "some bytes");
  EXPECT_EQ(again.find(other), std::nullopt);
  EXPECT_EQ(again.find({"samples", key.digest}), std::nullopt);
  EXPECT_EQ(again.counts().at("fits").num_found, 1U);
  EXPECT_EQ(said_, "");
}

TEST_F(StepStoreTest, KeysDifferInEveryBitOfWhatTheyDependOn) {
  const StepKey key = step_key("fits", 0.1, std::string("a"));
  EXPECT_EQ(key.digest.size(), 64U);
  EXPECT_EQ(step_key("fits", 0.1, std::string("a")).digest, key.digest);
  EXPECT_NE(step_key("fits", std::nextafter(0.1, 1), std::string("a")).digest, key.digest);
  EXPECT_NE(step_key("fits", 0.1, std::string("b")).digest, key.digest);
  EXPECT_NE(step_key("slides", 0.1, std::string("a")).digest, key.digest);
}

TEST_F(StepStoreTest, LeavesNothingUnfinishedAndLogsEachStep) {
  const StepStore store = open();
  for (int i = 0; i < 5; ++i) store.save(step_key("fits", i), std::string(100, 'x'), 0.1);
  EXPECT_TRUE(files_in("unfinished").empty());
  EXPECT_EQ(files_in("steps").size(), 5U);
  EXPECT_EQ(num_logged(), 5U);
}

TEST_F(StepStoreTest, DoesADamagedStepAgainAndSaysSo) {
  const StepKey key = step_key("fits", 1);
  const auto make = [] { return Points{{1, 2, 3}}; };
  {
    const StepStore store = open();
    do_once<Points>(store, key, make);
  }
  const fs::path file = files_in("steps").front();
  const std::string whole = read_text(file);
  std::vector<std::string> damaged{"", whole.substr(0, 10), whole.substr(0, whole.size() - 1), whole + "x"};
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    damaged.push_back(whole);
    damaged.back()[at] ^= 1;
  }
  for (const std::string& content : damaged) {
    std::ofstream(file, std::ios::binary) << content;
    said_.clear();
    const StepStore store = open();
    EXPECT_EQ(do_once<Points>(store, key, make), make());
    EXPECT_NE(said_.find(file.string() + ": is damaged; this step is done again"), std::string::npos);
    EXPECT_EQ(read_text(file), whole);
  }
}

TEST_F(StepStoreTest, DoesAStepAgainThatIsNoSuchRecord) {
  const StepKey key = step_key("fits", 1);
  open().save(key, "whole, but three bytes too few for a double", 0);
  const StepStore store = open();
  EXPECT_EQ(do_once<double>(store, key, [] { return 7.0; }), 7.0);
  EXPECT_NE(said_.find("damaged"), std::string::npos);
  EXPECT_EQ(do_once<double>(store, key, [] { return 8.0; }), 7.0);
}

TEST_F(StepStoreTest, KeepsNothingOfAStepThatThrows) {
  const StepStore store = open();
  const StepKey key = step_key("fits", 1);
  EXPECT_THROW(do_once<double>(store, key, []() -> double { throw InvalidInput("no"); }), InvalidInput);
  EXPECT_EQ(store.find(key), std::nullopt);
  EXPECT_TRUE(files_in("steps").empty());
}

TEST_F(StepStoreTest, MaySaveOneKeyFromManyThreads) {
  const StepStore store = open();
  const StepKey key = step_key("fits", 1);
  const std::string content(300'000, 'y');
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 20; ++k) {
        store.save(key, content, 0);
        EXPECT_EQ(store.find(key), content);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(files_in("steps").size(), 1U);
  EXPECT_EQ(said_, "");
}

TEST_F(StepStoreTest, RemovesWhatProcessesThatAreGoneLeftUnfinished) {
  open();
  char host[256] = {};
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  const std::string prefix = "work/unfinished/" + std::string(host);
  const pid_t gone = 0x3ffffff0;  // beyond the kernel's largest
  const auto old = [&](const fs::path& path) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(1));
    return path;
  };
  const fs::path abandoned = old(folder_.write(prefix + "-" + std::to_string(gone) + "-0", "half"));
  const fs::path young = folder_.write(prefix + "-" + std::to_string(gone) + "-1", "half");
  const fs::path own = old(folder_.write(prefix + "-" + std::to_string(getpid()) + "-2", "half"));
  const fs::path of_another_host = old(folder_.write("work/unfinished/elsewhere-1-0", "half"));
  open();
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(young));
  EXPECT_TRUE(fs::exists(own));
  EXPECT_TRUE(fs::exists(of_another_host));
}

TEST_F(StepStoreTest, NamesTheFolderThatCannotBeMade) {
  folder_.write("work", "a file");
  const std::string message = error_of<OutputError>([&] { open(); });
  EXPECT_NE(message.find("work"), std::string::npos);
  EXPECT_NE(message.find("check the free space and the rights"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp::test
