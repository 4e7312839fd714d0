#include "tcm_icp/steps/step_store.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <mutex>
#include <sstream>
#include <system_error>
#include <utility>

#include "steps/step_key.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "tcm-icp step 1\n";
// What is larger took seconds to make: it goes to the disk before its name does. Of a small one that a power failure
// tore the check sum tells, and it is made again.
constexpr std::size_t kSynced = std::size_t{1} << 20U;

/// Stands before a result: its length, and a check sum that tells what a disk or a power failure did to it.
std::string header_of(std::string_view result) {
  const auto* const bytes = reinterpret_cast<const Bytef*>(result.data());
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, bytes, result.size()));
  RecordWriter record;
  record(std::uint64_t{result.size()}, sum);
  return std::string(kMagic) + record.bytes();
}

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "host";
  std::string text = name.data();
  for (char& c : text) {
    if (c == '/' || c == '-') c = '_';
  }
  return text;
}

const std::string& process_name() {
  static const std::string name = host_name() + "-" + std::to_string(getpid());
  return name;
}

std::string reason() { return std::generic_category().message(errno); }

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) close(number_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  bool is_open() const { return number_ >= 0; }
  bool write_all(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = write(number_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  bool sync() const { return fsync(number_) == 0; }
  bool finish() { return close(std::exchange(number_, -1)) == 0; }  // NFS reports a full disk here

 private:
  int number_;
};

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw OutputError(path, "cannot be written: " + why, "check the free space and the rights of the work folder");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, error.message());
}

// Unfinished files that a process of this machine left when it was killed. Where containers share a name, a process of
// another may look gone: its file is young.
constexpr auto kAbandoned = std::chrono::minutes(10);

void remove_abandoned(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const std::string host = host_name() + "-";
    if (!name.starts_with(host)) continue;
    pid_t pid = 0;
    const auto [end, error] = std::from_chars(name.data() + host.size(), name.data() + name.size(), pid);
    if (error != std::errc() || pid <= 0 || kill(pid, 0) == 0 || errno != ESRCH) continue;
    const auto written = fs::last_write_time(entry.path(), ignored);
    if (!ignored && fs::file_time_type::clock::now() - written > kAbandoned) fs::remove(entry.path(), ignored);
  }
}

std::optional<std::string> bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(std::max<std::streamoff>(0, in.tellg())), '\0');
  in.seekg(0);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return bytes;
}

std::string time_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace

void write_whole(const fs::path& path, std::string_view content, const fs::path& beside) {
  static std::atomic<std::uint64_t> next{0};
  const fs::path unfinished = beside / (process_name() + "-" + std::to_string(next++));
  FileDescriptor file(open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file.is_open()) refuse(unfinished, reason());
  const bool is_written = file.write_all(content) && (content.size() < kSynced || file.sync()) && file.finish();
  std::error_code error;
  if (is_written) {
    fs::rename(unfinished, path, error);
    if (!error) return;
  }
  const std::string why = error ? error.message() : reason();
  fs::remove(unfinished, error);
  refuse(path, why);
}

struct StepStore::Impl {
  fs::path folder;
  std::function<void(std::string_view)> warn;
  mutable std::mutex mutex;  // of all below, and of `warn`
  std::map<std::string, StepCount> counts;

  fs::path path_of(const StepKey& key) const {
    return folder / "steps" / key.kind / key.digest.substr(0, 2) / key.digest.substr(2);
  }
  fs::path unfinished() const { return folder / "unfinished"; }

  void log(const StepKey& key, std::size_t size, double seconds) const {
    std::ostringstream line;
    line << time_text() << '\t' << key.kind << '\t' << key.digest << '\t' << seconds << '\t' << size << '\n';
    const fs::path path = folder / "log" / (process_name() + ".tsv");
    const FileDescriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!file.is_open() || !file.write_all(line.str())) refuse(path, reason());
  }
};

StepStore::StepStore(fs::path folder, std::function<void(std::string_view)> warn) : impl_(new Impl) {
  impl_->folder = std::move(folder);
  impl_->warn = std::move(warn);
  for (const char* part : {"steps", "unfinished", "log"}) make_folder(impl_->folder / part);
  remove_abandoned(impl_->unfinished());
}
StepStore::~StepStore() = default;

const fs::path& StepStore::folder() const { return impl_->folder; }

std::map<std::string, StepCount> StepStore::counts() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->counts;
}

void StepStore::report_damage(const StepKey& key) const {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->warn) impl_->warn(impl_->path_of(key).string() + ": is damaged; this step is done again");
}

std::optional<std::string> StepStore::find(const StepKey& key) const {
  std::optional<std::string> bytes = bytes_of(impl_->path_of(key));
  if (!bytes) return std::nullopt;
  const std::size_t header = kMagic.size() + sizeof(std::uint64_t) + sizeof(std::uint32_t);
  const std::string_view all = *bytes;
  if (all.size() < header || all.substr(0, header) != header_of(all.substr(header))) {
    report_damage(key);
    return std::nullopt;
  }
  const std::lock_guard lock(impl_->mutex);
  ++impl_->counts[key.kind].num_found;
  return bytes->substr(header);
}

void StepStore::save(const StepKey& key, std::string_view result, double seconds) const {
  std::string bytes = header_of(result);
  bytes += result;
  const fs::path path = impl_->path_of(key);
  make_folder(path.parent_path());
  write_whole(path, bytes, impl_->unfinished());
  impl_->log(key, result.size(), seconds);
  const std::lock_guard lock(impl_->mutex);
  ++impl_->counts[key.kind].num_made;
}

}  // namespace tcm_icp
