#include "console.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace tcm_icp::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void on_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);  // the second one ends the program
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // Whoever started us with a signal ignored (nohup) wants it ignored.
    if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

Console::Console(bool quiet, bool verbose)
    : quiet_(quiet),
      verbose_(verbose),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Console::~Console() { finish(); }

void Console::finish() {
  if (!line_.empty()) std::cerr << "\r\x1b[K" << std::flush;
  line_.clear();
}

Continue Console::progress(const Progress& progress) {
  if (interrupted != 0) return Continue::kStop;
  if (quiet_) return Continue::kYes;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << std::setw(6) << elapsed.count() << " s  " << progress.stage;
  if (terminal_) {
    if (progress.total > 0) {
      constexpr std::size_t kWidth = 24;
      const std::size_t filled = std::min(kWidth, kWidth * progress.done / progress.total);
      text << " [" << std::string(filled, '#') << std::string(kWidth - filled, ' ') << "] " << progress.done << '/'
           << progress.total;
    }
    line_ = text.str();
    std::cerr << '\r' << line_ << "\x1b[K" << std::flush;
  } else if (stage_ != progress.stage) {
    stage_ = progress.stage;
    std::cerr << text.str() << '\n';
  }
  return Continue::kYes;
}

void Console::log(LogLevel level, std::string_view message) {
  if (level == LogLevel::kDebug && !verbose_) return;
  if (level != LogLevel::kWarning && quiet_) return;
  finish();
  std::cerr << (level == LogLevel::kWarning ? "warning: " : "") << message << '\n';
}

}  // namespace tcm_icp::app
