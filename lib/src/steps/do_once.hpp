#pragma once
// A step that is done where nobody has done it before.

#include <chrono>
#include <optional>
#include <utility>

#include "steps/step_key.hpp"
#include "steps/step_record.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// A result that is in the store; nothing where there is none or it cannot be read.
template <typename Result>
std::optional<Result> find_step(const StepStore& store, const StepKey& key) {
  const std::optional<std::string> bytes = store.find(key);
  if (!bytes) return std::nullopt;
  try {
    std::optional<Result> result(std::in_place);
    RecordReader record(*bytes);
    record(*result);
    record.finish();
    return result;
  } catch (const BrokenRecord&) {
    store.report_damage(key);
    return std::nullopt;
  }
}

template <typename Result>
void save_step(const StepStore& store, const StepKey& key, const Result& result, double seconds) {
  RecordWriter record;
  record(result);
  store.save(key, record.bytes(), seconds);
}

/// The result in the store, else that of make(), which is kept. @throws OutputError, and what make() throws
template <typename Result, typename Make>
Result do_once(const StepStore& store, const StepKey& key, Make make) {
  if (std::optional<Result> known = find_step<Result>(store, key)) return std::move(*known);
  const auto start = std::chrono::steady_clock::now();
  Result result = make();
  save_step(store, key, result, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return result;
}

}  // namespace tcm_icp
