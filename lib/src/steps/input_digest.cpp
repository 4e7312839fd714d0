#include "steps/input_digest.hpp"

#include <sys/stat.h>

#include <ctime>
#include <fstream>
#include <sstream>

#include "io/sha256.hpp"
#include "steps/step_key.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

// A file that was changed just now may change again within the clock's resolution.
constexpr std::time_t kSettled_s = 3;

struct Look {
  std::string text;  ///< size and time of change
  bool is_settled = false;
};

Look look_of(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    throw InputError(file, "", "cannot be opened", "check the path and its permissions");
  }
  std::ostringstream text;
  text << status.st_size << ' ' << status.st_mtim.tv_sec << ' ' << status.st_mtim.tv_nsec;
  return {text.str(), std::time(nullptr) - status.st_mtim.tv_sec >= kSettled_s};
}

}  // namespace

std::string input_digest(const StepStore& store, const fs::path& file) {
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(file, ignored);
  const fs::path inputs = store.folder() / "inputs";
  const fs::path known = inputs / sha256_of((canonical.empty() ? file : canonical).string());
  const Look look = look_of(file);
  std::ifstream in(known);
  std::string looked, digest;
  if (std::getline(in, looked) && std::getline(in, digest) && looked == look.text && digest.size() == 64) return digest;
  digest = sha256_of_file(file);
  if (!look.is_settled || look_of(file).text != look.text) return digest;
  fs::create_directories(inputs, ignored);
  write_whole(known, look.text + "\n" + digest + "\n" + file.string() + "\n", store.folder() / "unfinished");
  return digest;
}

}  // namespace tcm_icp
