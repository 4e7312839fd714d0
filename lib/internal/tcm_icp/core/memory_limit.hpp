#pragma once
// How much memory there is, and how much of it a run takes where nobody says.

#include <cstddef>

namespace tcm_icp {

/// [bytes] of the machine, or of the process's control group where that is less; 0 where the system does not tell.
std::size_t available_memory();

/// [bytes] half of available_memory(), and 2 GiB at most: sets of a thousand scans take hardly longer with it than with
/// all they could use.
std::size_t default_memory_limit();

/// [bytes] of this process that are in memory now; 0 where the system does not tell.
std::size_t resident_memory();

}  // namespace tcm_icp
