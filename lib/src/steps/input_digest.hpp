#pragma once
// Check sums of input files, remembered as long as the files look untouched.

#include <filesystem>
#include <string>

#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// SHA-256 of a file's bytes. Kept in the work folder's inputs/ with the file's size and time of change; while both are
/// the same, the file is not read again. @throws InputError, OutputError
std::string input_digest(const StepStore& store, const std::filesystem::path& file);

}  // namespace tcm_icp
