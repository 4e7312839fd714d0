#include "core/paged_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "tcm_icp/core/paged_allocator.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kAddresses = std::size_t{1} << 40;  // reserved, not used
constexpr std::size_t kFewestAddresses = std::size_t{1} << 34;
constexpr std::size_t kGrowth = std::size_t{1} << 27;  // by which the file grows

// One a process: memory is the process's.
struct PagedFile {
  std::mutex mutex;
  int descriptor = -1;
  std::atomic<char*> begin{nullptr};
  std::atomic<std::size_t> size{0};                    // of addresses
  std::atomic<std::size_t> end{0};                     // of what was ever given out
  std::map<std::size_t, std::vector<char*>> returned;  // what was given back, by size
  std::size_t grown = 0;                               // of the file that is mapped
  std::atomic<std::size_t> bytes{0};                   // in arrays
};

// Never destroyed: arrays may outlive it otherwise.
PagedFile& file() {
  static PagedFile* const the_file = new PagedFile;
  return *the_file;
}

thread_local bool in_scope = false;

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

// Whole pages: of few sizes, at most an eighth more than wanted, so that what is given back serves others.
std::size_t in_pages(std::size_t num_bytes) {
  const std::size_t pages = (num_bytes + page_size() - 1) / page_size();
  const auto digits = static_cast<unsigned>(std::bit_width(pages));
  const std::size_t step = digits > 4 ? std::size_t{1} << (digits - 4) : 1;
  return (pages + step - 1) / step * step * page_size();
}

int open_nameless(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor >= 0) return descriptor;
  std::string name = (folder / "tcm-icp-XXXXXX").string();  // not all file systems have files without names
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

// Room on the disk is taken first: a page that finds none when it is written would end the process.
bool grow(PagedFile& f) {
  if (f.grown + kGrowth > f.size) return false;
  const auto offset = static_cast<off_t>(f.grown);
  if (posix_fallocate(f.descriptor, offset, static_cast<off_t>(kGrowth)) != 0) return false;
  void* const at = f.begin + f.grown;
  if (mmap(at, kGrowth, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, f.descriptor, offset) == MAP_FAILED) {
    return false;
  }
  f.grown += kGrowth;
  return true;
}

// nullptr where there is no room.
void* allocate_pages(std::size_t num_bytes) {
  PagedFile& f = file();
  const std::lock_guard lock(f.mutex);
  if (f.descriptor < 0) return nullptr;
  if (auto& before = f.returned[num_bytes]; !before.empty()) {
    char* const array = before.back();
    before.pop_back();
    f.bytes += num_bytes;
    return array;
  }
  const std::size_t begin = f.end;
  while (f.grown - begin < num_bytes) {
    if (!grow(f)) return nullptr;
  }
  f.end = begin + num_bytes;
  f.bytes += num_bytes;
  return f.begin + begin;
}

bool is_paged(const void* array) {
  const char* const begin = file().begin.load(std::memory_order_relaxed);
  const auto offset = reinterpret_cast<std::uintptr_t>(array) - reinterpret_cast<std::uintptr_t>(begin);
  return begin != nullptr && offset < file().size.load(std::memory_order_relaxed);
}

}  // namespace

PagedScope::PagedScope() : before_(in_scope) { in_scope = true; }
PagedScope::~PagedScope() { in_scope = before_; }

bool open_paged_memory(const std::filesystem::path& folder) {
  PagedFile& f = file();
  const std::lock_guard lock(f.mutex);
  if (f.descriptor >= 0) return true;
  const int descriptor = open_nameless(folder);
  if (descriptor < 0) return false;
  for (std::size_t size = kAddresses; size >= kFewestAddresses && f.begin == nullptr; size /= 4) {
    void* const at = mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (at == MAP_FAILED) continue;
    f.size = size;
    f.begin = static_cast<char*>(at);
  }
  if (f.begin == nullptr || !(f.descriptor = descriptor, grow(f))) {
    f.descriptor = -1;
    ::close(descriptor);
    return false;
  }
  return true;
}

std::size_t paged_bytes() { return file().bytes; }

void release_paged_memory() noexcept {
  PagedFile& f = file();
  const std::size_t end = f.end;
  // Of a shared mapping nothing is lost: changed pages stay with the file.
  if (end > 0) madvise(f.begin, end, MADV_DONTNEED);
}

void* allocate_array(std::size_t num_bytes) {
  if (in_scope && num_bytes >= kSmallestPagedArray && num_bytes < kAddresses) {
    if (void* const pages = allocate_pages(in_pages(num_bytes))) return pages;
  }
  return ::operator new(num_bytes);
}

void free_array(void* array, std::size_t num_bytes) noexcept {
  if (!is_paged(array)) {
    ::operator delete(array);
    return;
  }
  const std::size_t size = in_pages(num_bytes);
  madvise(array, size, MADV_DONTNEED);
  PagedFile& f = file();
  const std::lock_guard lock(f.mutex);
  f.bytes -= size;
  f.returned[size].push_back(static_cast<char*>(array));
}

}  // namespace tcm_icp
