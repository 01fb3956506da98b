// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/shape.h"

#include "janus/util/error.h"

namespace janus {

void check_attribute(const std::string& key, const AttributeDesc& attribute, size_t elements,
                     bool at_least) {
  const std::string path = "attributes[" + attribute.key + "]";
  if (attribute.channels < 1 || attribute.channels > 4) {
    throw SceneError(key, path, "must have 1 to 4 channels");
  }
  const size_t channels = static_cast<size_t>(attribute.channels);
  const size_t size = attribute.values.size() / channels;
  if (attribute.values.size() % channels != 0 || size < elements ||
      (!at_least && size != elements)) {
    throw SceneError(key, path,
                     "has " + std::to_string(size) + " elements, not " + std::to_string(elements));
  }
}

}  // namespace janus
