// SPDX-License-Identifier: GPL-3.0-or-later
//
// Operations: what instructions do. Each is a plain function of floats and vectors, wrapped here
// into a kernel that knows where its operands are and a signature that the compiler checks:
//
//   e.emit(pure<[](float a, float b) { return a + b; }>, {a, b})
//
// A function may take `const Context&` first; then it can read the point, and `data`.
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include "janus/shading/node_types.h"
#include "janus/shading/program.h"

namespace janus {

struct Context {
  const ShadingPoint& point;
  const Program& program;
  uint32_t data;
};

inline constexpr int kMaxOperands = 12;

struct Operation {
  Kernel kernel;
  SocketType result;
  int count;  // of operands
  std::array<SocketType, kMaxOperands> operands;
  bool reads_point;  // its result is no function of the operands and `data` alone
  Dependence dependence;
  // Asks for the memory that the kernel will wait for; it writes nothing. Null: there is none.
  Kernel prefetch = nullptr;
  bool by_path = false;  // it depends on the path that leads to the point
};

namespace detail {

template <class T>
constexpr SocketType kSocket = std::is_same_v<T, float> ? SocketType::Float : SocketType::Vector;

template <class T>
T read(const float* r) {
  if constexpr (std::is_same_v<T, float>) {
    return *r;
  } else {
    return vec3(r[0], r[1], r[2]);
  }
}
inline void write(float* r, float x) { *r = x; }
inline void write(float* r, vec3 x) { r[0] = x.x, r[1] = x.y, r[2] = x.z; }

template <auto F, class Signature>
struct Make;

template <auto F, class R, class... A>
struct Make<F, R (*)(A...)> {
  template <size_t... I>
  static void run(RunState& f, const Instruction& i, std::index_sequence<I...>) {
    [[maybe_unused]] const uint16_t* in = f.program.operands.data() + i.operands;
    write(f.registers + i.out, F(read<A>(f.registers + in[I])...));
  }
  static void kernel(RunState& f, const Instruction& i) {
    run(f, i, std::index_sequence_for<A...>());
  }
  static constexpr Operation operation(bool reads_point, Dependence dependence) {
    static_assert(sizeof...(A) <= kMaxOperands);
    return {&kernel, kSocket<R>, sizeof...(A), {kSocket<A>...}, reads_point, dependence};
  }
};

template <auto F, class R, class... A>
struct Make<F, R (*)(const Context&, A...)> {
  template <size_t... I>
  static void run(RunState& f, const Instruction& i, std::index_sequence<I...>) {
    [[maybe_unused]] const uint16_t* in = f.program.operands.data() + i.operands;
    const Context context{f.points[i.at], f.program, i.data};
    write(f.registers + i.out, F(context, read<A>(f.registers + in[I])...));
  }
  static void kernel(RunState& f, const Instruction& i) {
    run(f, i, std::index_sequence_for<A...>());
  }
  static constexpr Operation operation(bool reads_point, Dependence dependence) {
    static_assert(sizeof...(A) <= kMaxOperands);
    return {&kernel, kSocket<R>, sizeof...(A), {kSocket<A>...}, reads_point, dependence};
  }
};

template <auto F>
using MakeOf = Make<F, decltype(+F)>;

}  // namespace detail

// A function of its operands (and of `data`): folded where they are constants.
template <auto F>
inline constexpr Operation pure = detail::MakeOf<F>::operation(false, Dependence::None);
// Of the point too, but not of the side or direction from which it is looked at, nor of its shading
// normal.
template <auto F>
inline constexpr Operation at_point = detail::MakeOf<F>::operation(true, Dependence::None);
template <auto F>
inline constexpr Operation by_side = detail::MakeOf<F>::operation(true, Dependence::Side);
template <auto F>
inline constexpr Operation by_view = detail::MakeOf<F>::operation(true, Dependence::View);
// Of the path between the camera and the point (ShadingPoint::path).
template <auto F>
inline constexpr Operation by_path = [] {
  Operation operation = detail::MakeOf<F>::operation(true, Dependence::None);
  operation.by_path = true;
  return operation;
}();

}  // namespace janus
