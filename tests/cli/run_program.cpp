#include "run_program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "io/temp_files.hpp"

namespace tcm_icp::test {
namespace fs = std::filesystem;
namespace {

constexpr int kCannotStart = 127;

void send_to(int descriptor, const fs::path& file) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(kCannotStart);
}

[[noreturn]] void become_program(std::vector<char*>& argv, const RunSettings& settings, const fs::path& out,
                                 const fs::path& err) {
  send_to(STDOUT_FILENO, settings.stdout_file.empty() ? out : settings.stdout_file);
  send_to(STDERR_FILENO, err);
  if (chdir(settings.folder.c_str()) != 0) _exit(kCannotStart);
  std::signal(SIGINT, SIG_DFL);  // a test run in the background of a shell is started with SIGINT ignored
  if (settings.max_file_bytes > 0) {
    const rlimit limit{settings.max_file_bytes, settings.max_file_bytes};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(kCannotStart);
  }
  execv(argv[0], argv.data());
  _exit(kCannotStart);
}

/// Waits until stderr has the text or the program has ended; nothing is left to interrupt then.
void interrupt_at(const std::string& text, pid_t child, const fs::path& err) {
  siginfo_t ended{};
  while (read_text(err).find(text) == std::string::npos) {
    ended.si_pid = 0;
    if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGINT);
}

}  // namespace

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

RunResult run_program(const Words& arguments, const RunSettings& settings) {
  Words words = Words{TCM_ICP_EXECUTABLE} + arguments;
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // Beside the folder it runs in: what it leaves there is counted.
  const std::string beside = settings.folder.string() + "-run";
  const fs::path out = beside + ".out", err = beside + ".err";

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child == 0) become_program(argv, settings, out, err);
  if (settings.kill_after_ms > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(settings.kill_after_ms));
    kill(child, SIGKILL);  // the child is not waited for yet, so that its number is nobody else's
  }
  if (!settings.interrupt_at.empty()) interrupt_at(settings.interrupt_at, child, err);
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child) throw std::runtime_error("the process is lost");

  RunResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.out = settings.stdout_file.empty() ? read_text(out) : "";
  result.err = read_text(err);
  result.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  fs::remove(out);
  fs::remove(err);
  if (result.exit_code == kCannotStart) throw std::runtime_error("tcm-icp cannot be started");
  return result;
}

fs::path town_file(const std::string& name) { return fs::path(TCM_ICP_TOWN) / name; }

Words town_scans(const std::vector<int>& numbers) {
  Words scans;
  for (const int number : numbers) scans.push_back(town_file("00" + std::to_string(number) + ".ply").string());
  return scans;
}

std::set<fs::path> everything_in(const fs::path& folder) {
  std::set<fs::path> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) all.insert(entry.path());
  return all;
}

}  // namespace tcm_icp::test
