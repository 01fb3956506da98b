// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/util/memory.h"

#ifdef __unix__
#include <unistd.h>
#endif

namespace janus {

size_t physical_memory() {
#if defined(__unix__) && defined(_SC_PHYS_PAGES)
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<size_t>(pages) * static_cast<size_t>(page) : 0;
#else
  return 0;
#endif
}

}  // namespace janus
