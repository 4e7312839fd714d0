#pragma once
// Times the stages of a run and reads the process's peak memory.

#include <chrono>
#include <string>
#include <vector>

#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// Largest resident size of this process so far [MB]; 0 where the system does not tell.
double peak_memory_mb();

class StageClock {
 public:
  explicit StageClock(std::vector<StageRecord>& stages) : stages_(stages) {}

  /// Ends the running stage, if there is one, and begins the next.
  void begin(std::string name);
  void end();

 private:
  std::vector<StageRecord>& stages_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace tcm_icp
