#pragma once
// Where large arrays lie: on the heap, or where memory is short, in a file that is mapped.

#include <cstddef>
#include <type_traits>

namespace tcm_icp {

/// Memory for an array, as operator new gives it; within a PagedScope large ones are pages of a mapped file.
/// @throws std::bad_alloc
void* allocate_array(std::size_t num_bytes);
/// Gives back what allocate_array() gave, in any scope and thread.
void free_array(void* array, std::size_t num_bytes) noexcept;

/// Lets containers lie in memory that the system can do without (paged_memory.hpp in the library); as std::allocator
/// otherwise. Any two are equal: containers can be moved, swapped and freed anywhere.
template <typename T>
struct PagedAllocator {
  using value_type = T;                    ///< what the container holds
  using is_always_equal = std::true_type;  ///< it has no state

  PagedAllocator() = default;
  /// For the container's own parts.
  template <typename U>
  PagedAllocator(const PagedAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): as containers ask

  /// Room for `count` values. @throws std::bad_alloc
  T* allocate(std::size_t count) {
    static_assert(alignof(T) <= alignof(std::max_align_t));
    if (count > static_cast<std::size_t>(-1) / sizeof(T))
      return static_cast<T*>(allocate_array(static_cast<std::size_t>(-1)));
    return static_cast<T*>(allocate_array(count * sizeof(T)));
  }
  /// Gives it back.
  void deallocate(T* array, std::size_t count) noexcept { free_array(array, count * sizeof(T)); }

  /// Always.
  friend bool operator==(const PagedAllocator&, const PagedAllocator&) noexcept { return true; }
};

}  // namespace tcm_icp
