#include "pipeline/stage_clock.hpp"

#include <sys/resource.h>

#include <utility>

namespace tcm_icp {

double peak_memory_mb() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts kilobytes
}

void StageClock::begin(std::string name) {
  end();
  name_ = std::move(name);
  start_ = std::chrono::steady_clock::now();
}

void StageClock::end() {
  if (name_.empty()) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  stages_.push_back({name_, elapsed.count(), peak_memory_mb()});
  name_.clear();
}

}  // namespace tcm_icp
