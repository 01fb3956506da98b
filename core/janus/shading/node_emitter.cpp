// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/node_emitter.h"

#include "janus/shading/graph_compiler.h"
#include "janus/shading/point_reads.h"

namespace janus {

Value NodeEmitter::input(std::string_view identifier, int at) {
  return compiler_.input(reader_, identifier, at == 0 ? at_ : static_cast<uint16_t>(at));
}

Value NodeEmitter::generated() { return compiler_.generated(at_); }

// As in Cycles, one that varies does not count; then it is what the socket said without its link.
float NodeEmitter::filter_width() {
  float width = 0.1f;
  if (!is_constant(input("Filter Width"), &width)) {
    const float kept = number("filter_width");
    width = kept > 0.0f ? kept : 0.1f;
  }
  return width;
}

std::optional<uint16_t> NodeEmitter::shifted_points() {
  return compiler_.shifted_points(filter_width());
}

bool NodeEmitter::is_constant(Value value, float* x) const {
  const vec3* found = compiler_.as_constant(value);
  if (found && x) {
    *x = found->x;
  }
  return found != nullptr;
}

bool NodeEmitter::is_constant(Value value, vec3 x) const {
  const vec3* found = compiler_.as_constant(value);
  return found && *found == x;
}

SeenTree NodeEmitter::seen() const { return compiler_.seen(); }

Value NodeEmitter::constant(float x) { return compiler_.constant(vec3(x), SocketType::Float); }
Value NodeEmitter::constant(vec3 x) { return compiler_.constant(x, SocketType::Vector); }
Value NodeEmitter::convert(Value value, SocketType type) { return compiler_.convert(value, type); }

Value NodeEmitter::emit(const Operation& operation, std::initializer_list<Value> operands,
                        uint32_t data) {
  return compiler_.emit(operation, operands, data, at_);
}

void NodeEmitter::use_edges() { compiler_.use_edges(); }

uint32_t NodeEmitter::attribute(const std::string& key) { return compiler_.attribute(key); }
uint32_t NodeEmitter::table(std::vector<float> values) {
  return compiler_.table(std::move(values));
}
uint32_t NodeEmitter::texture(Texture texture) { return compiler_.texture(std::move(texture)); }

void NodeEmitter::sun(Value direction, SunDisc disc) {
  // Elsewhere, or turned, it is not where it is.
  if (seen().of == SeenTree::Of::World && direction.index == emit(kPosition, {}).index) {
    compiler_.sun(disc);
  }
}

const ImageDesc* NodeEmitter::image(const std::string& key) const { return compiler_.image(key); }

void NodeEmitter::output(std::string_view identifier, Value value) {
  compiler_.output(reader_.node(), at_, identifier, value);
}

bool NodeEmitter::output_linked(std::string_view identifier) const {
  return compiler_.linked(reader_.node(), identifier);
}

}  // namespace janus
