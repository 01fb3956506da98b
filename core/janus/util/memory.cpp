// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/util/memory.h"

#ifdef __unix__
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <new>

namespace janus {

namespace {

// What a container may have, by the second and the first version of Linux' control groups.
constexpr const char* kGroupLimits[] = {"/sys/fs/cgroup/memory.max",
                                        "/sys/fs/cgroup/memory/memory.limit_in_bytes"};

}  // namespace

size_t physical_memory() {
#if defined(__unix__) && defined(_SC_PHYS_PAGES)
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) {
    return 0;
  }
  uint64_t most = static_cast<uint64_t>(pages) * static_cast<uint64_t>(page);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    most = std::min<uint64_t>(most, limit.rlim_cur);
  }
  for (const char* path : kGroupLimits) {
    uint64_t bytes = 0;  // the word "max" is no number
    if (std::ifstream(path) >> bytes && bytes > 0) {
      most = std::min(most, bytes);
    }
  }
  return static_cast<size_t>(most);
#else
  return 0;
#endif
}

bool has_memory(size_t bytes) {
#ifdef __unix__
  // Not by way of the heap: that touches a page, and a sanitizer's heap marks every byte, which
  // costs some 50 ms for each probe of a commit.
  void* probe = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return probe != MAP_FAILED && munmap(probe, bytes) == 0;
#else
  void* probe = ::operator new(bytes, std::nothrow);
  ::operator delete(probe);
  return probe != nullptr;
#endif
}

void require_memory(size_t bytes) {
  if (!has_memory(bytes)) {
    throw std::bad_alloc();
  }
}

}  // namespace janus
