#pragma once
// How much memory there is, and how much of it a run takes where nobody says.

#include <cstddef>

namespace tcm_icp {

/// [bytes] of the machine, or of the process's control group where that is less; 0 where the system does not tell.
std::size_t available_memory();

/// [bytes] half of available_memory(), and 2 GiB at most; of more than 25 scans 256 MiB and 2 MiB a scan: what leaves
/// and comes back is 2 to 4 % of the time (docs/decisions/0020-memory.md).
std::size_t default_memory_limit(std::size_t num_scans);

/// [bytes] of this process that are in memory now; 0 where the system does not tell.
std::size_t resident_memory();

}  // namespace tcm_icp
