// Files are known by their bytes; one that looks untouched is not read again.

#include "steps/input_digest.hpp"

#include <gtest/gtest.h>

#include "io/sha256.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::test {
namespace {

namespace fs = std::filesystem;

TEST(InputDigest, IsThatOfTheBytesWhateverTheName) {
  const TempFolder folder;
  const StepStore store(folder.path() / "work");
  const fs::path a = folder.write("a.xyz", "1 2 3\n"), b = folder.write("b.xyz", "1 2 3\n");
  EXPECT_EQ(input_digest(store, a), sha256_of_file(a));
  EXPECT_EQ(input_digest(store, a), input_digest(store, b));
  folder.write("b.xyz", "1 2 4\n");
  EXPECT_NE(input_digest(store, a), input_digest(store, b));
}

TEST(InputDigest, IsRememberedUntilSizeOrTimeChange) {
  const TempFolder folder;
  const StepStore store(folder.path() / "work");
  const fs::path file = folder.write("a.xyz", "1 2 3\n");
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(file, long_ago);
  const std::string first = input_digest(store, file);
  folder.write("a.xyz", "1 2 4\n");
  fs::last_write_time(file, long_ago);  // looks untouched: what shows that it is not read
  EXPECT_EQ(input_digest(store, file), first);
  fs::last_write_time(file, long_ago + std::chrono::seconds(1));
  EXPECT_EQ(input_digest(store, file), sha256_of_file(file));
  EXPECT_NE(input_digest(store, file), first);
}

TEST(InputDigest, IsNotRememberedOfAFileThatWasJustWritten) {
  const TempFolder folder;
  const StepStore store(folder.path() / "work");
  const fs::path file = folder.write("a.xyz", "1 2 3\n");
  const auto now = fs::last_write_time(file);
  const std::string first = input_digest(store, file);
  folder.write("a.xyz", "1 2 4\n");
  fs::last_write_time(file, now);
  EXPECT_NE(input_digest(store, file), first);
}

TEST(InputDigest, NamesAFileThatIsMissing) {
  const TempFolder folder;
  const StepStore store(folder.path() / "work");
  EXPECT_NE(error_of<InputError>([&] { input_digest(store, folder.path() / "none.xyz"); }).find("none.xyz"),
            std::string::npos);
}

}  // namespace
}  // namespace tcm_icp::test
