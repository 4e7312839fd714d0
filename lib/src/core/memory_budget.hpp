#pragma once
// Keeps the process below a limit: what is not needed at once leaves memory before there is more.

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "core/paged_memory.hpp"
#include "tcm_icp/core/run_context.hpp"

namespace tcm_icp {

/// While one is alive, what in_budget() copied lies in a file without a name in the folder of TMPDIR, or /var/tmp,
/// whose pages leave the process where seven tenths of the limit are used. A thread looks after it every few
/// milliseconds, so that no code has to say what it needs and what not. Results are the same bits with and without.
class MemoryBudget {
 public:
  /// @param context  its memory_limit counts, 0 for none; outlives the budget
  explicit MemoryBudget(const RunContext& context);
  ~MemoryBudget();

  /// What to tell the user where the folder could not take all that it should; empty otherwise.
  std::string shortfall() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether there is a budget, and an eighth of it is used: time to put away what may leave memory. Some microseconds.
bool memory_is_short();

/// The value itself, or where memory is short, a copy whose large arrays may leave it.
template <typename T>
T in_budget(T&& value) {
  static_assert(!std::is_reference_v<T>, "what is copied is given up");
  if (!memory_is_short()) return std::move(value);
  const PagedScope scope;
  return T(std::as_const(value));
}

}  // namespace tcm_icp
