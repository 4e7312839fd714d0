#pragma once
// What a step depends on, as the name under which its result is kept.

#include <string>

#include "steps/step_record.hpp"

namespace tcm_icp {

/// A kind of step and a check sum (SHA-256) over this program and all that the step's result depends on.
struct StepKey {
  std::string kind;    ///< a folder's name: "samples"
  std::string digest;  ///< 64 hexadecimal digits
};

/// SHA-256 of bytes.
std::string sha256_of(std::string_view bytes);

/// Version and commit of this program; where files had been changed since the commit, also the program's own bytes.
const std::string& program_identity();

/// The key of a step: each of `values` as RecordWriter takes it.
template <typename... Values>
StepKey step_key(const std::string& kind, const Values&... values) {
  RecordWriter record;
  record(program_identity(), kind, values...);
  return {kind, sha256_of(record.bytes())};
}

}  // namespace tcm_icp
