#include "core/memory_budget.hpp"

#include <malloc.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "tcm_icp/core/memory_limit.hpp"

namespace tcm_icp {
namespace {

constexpr std::chrono::milliseconds kPause{2};
constexpr std::size_t kPutAwayShare = 8;  // from an eighth of the limit on: the rest is for what must stay, and work
// What comes back until the thread is awake again is more than a tenth of a small limit.
constexpr double kReleaseShare = 0.7;
constexpr double kLeastReleasedShare = 0.1;  // less is not worth touching all of it again

// Of the budget that is alive; where there are several, of the one made last. Memory is the process's.
std::atomic<std::size_t> limit_bytes{0};

std::filesystem::path folder_for_pages() {
  const char* const named = std::getenv("TMPDIR");
  if (named != nullptr && *named != '\0') return named;
  return "/var/tmp";  // on a disk, where /tmp may be memory
}

// Whether there was no room for something that was to lie in the file.
std::atomic<bool> no_room{false};

}  // namespace

struct MemoryBudget::Impl {
  const RunContext& context;
  std::mutex mutex{};
  std::condition_variable ended{};
  bool is_over = false;
  std::thread watch{};

  void run() {
    const std::size_t limit = context.memory_limit;
    std::unique_lock lock(mutex);
    const auto share = [&](double of) { return static_cast<std::size_t>(of * static_cast<double>(limit)); };
    std::size_t after_release = 0;  // what was in memory then cannot leave it
    while (!ended.wait_for(lock, kPause, [&] { return is_over; })) {
      if (paged_bytes() == 0) continue;
      const std::size_t resident = resident_memory();
      if (resident < share(kReleaseShare) || resident < after_release + share(kLeastReleasedShare)) continue;
      release_paged_memory();
      malloc_trim(0);
      after_release = resident_memory();
    }
  }
};

MemoryBudget::MemoryBudget(const RunContext& context) : impl_(new Impl{context}) {
  if (context.memory_limit == 0) return;
  limit_bytes = context.memory_limit;
  impl_->watch = std::thread([this] { impl_->run(); });
}

MemoryBudget::~MemoryBudget() {
  if (!impl_->watch.joinable()) return;
  limit_bytes = 0;
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->is_over = true;
  }
  impl_->ended.notify_all();
  impl_->watch.join();
}

std::string MemoryBudget::shortfall() const {
  if (!no_room.exchange(false)) return "";
  return folder_for_pages().string() + " has no room for what does not fit into the " +
         std::to_string(impl_->context.memory_limit >> 20) +
         " MiB of memory that the run may take: it took more; set TMPDIR to a folder with more room, or --memory";
}

bool memory_is_short() {
  const std::size_t limit = limit_bytes;
  if (limit == 0 || resident_memory() <= limit / kPutAwayShare) return false;
  if (open_paged_memory(folder_for_pages())) return true;
  no_room = true;
  return false;
}

}  // namespace tcm_icp
