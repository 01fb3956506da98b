// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace janus {

// Of the machine, or what this process may have of it, bytes; 0 where the system does not say.
size_t physical_memory();

// Would the system give so many bytes now? Where it promises what it does not have, the answer says
// little.
bool has_memory(size_t bytes);
// Throws std::bad_alloc if not.
void require_memory(size_t bytes);

}  // namespace janus
