// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>

namespace janus {

// Allocates for containers of tables that are looked up at random places: in huge pages, where the
// system has them to give, so that fewer lookups wait for a walk over page tables.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}  // NOLINT(google-explicit-constructor): as allocators are

  T* allocate(size_t n) {
    void* memory = ::operator new(n * sizeof(T), alignment(n));
#ifdef MADV_HUGEPAGE
    if (alignment(n) == std::align_val_t{kPage}) {
      madvise(memory, n * sizeof(T) / kPage * kPage, MADV_HUGEPAGE);  // a wish: it may fail
    }
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t n) { ::operator delete(memory, alignment(n)); }

  bool operator==(const HugePages&) const = default;

 private:
  static constexpr size_t kPage = 1 << 21;
  static std::align_val_t alignment(size_t n) {
    return std::align_val_t{n * sizeof(T) >= kPage ? kPage : alignof(T)};
  }
};

}  // namespace janus
