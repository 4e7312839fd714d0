#pragma once
// Memory in a file that is mapped: its pages can leave the process at any time, and come back when they are touched.

#include <cstddef>
#include <filesystem>

namespace tcm_icp {

/// Large arrays of PagedAllocator that this thread allocates while it lives lie in the file. What is to lie there is
/// copied in a scope; temporaries of a computation are better off on the heap.
class PagedScope {
 public:
  PagedScope();
  ~PagedScope();
  PagedScope(const PagedScope&) = delete;
  PagedScope& operator=(const PagedScope&) = delete;

 private:
  bool before_;
};

/// Opens the file, which has no name, in that folder; nothing where one is open. False where there can be none: then
/// all arrays lie on the heap.
bool open_paged_memory(const std::filesystem::path& folder);

/// Bytes of arrays in the file.
std::size_t paged_bytes();

/// Takes the file's pages out of this process; what is touched again comes back, mostly from the system's memory. Safe
/// beside threads that read or write them.
void release_paged_memory() noexcept;

/// Smaller arrays lie on the heap: each takes whole pages.
constexpr std::size_t kSmallestPagedArray = 16 * 1024;

}  // namespace tcm_icp
