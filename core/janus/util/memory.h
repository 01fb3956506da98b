// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace janus {

// Of the machine, or what this process may have of it, bytes; 0 where the system does not say.
size_t physical_memory();

}  // namespace janus
