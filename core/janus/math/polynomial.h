// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real polynomials in one variable, as coefficients in ascending order, and their roots.
#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace janus {

// The value and the derivative at x.
struct PolynomialValue {
  double value = 0.0, slope = 0.0;
};
inline PolynomialValue evaluate(std::span<const double> c, double x) {
  PolynomialValue result;
  for (size_t i = c.size(); i-- > 0;) {
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + c[i];
  }
  return result;
}

// Where the polynomial reaches `target` between `a` and `b`, at which it lies on both sides of it.
// Newton's steps, halves where they would leave the bracket or hardly narrow it.
inline double root_between(std::span<const double> c, double target, double a, double b) {
  const bool rising = evaluate(c, b).value >= evaluate(c, a).value;
  double x = 0.5 * (a + b);
  for (int i = 0; i < 200; ++i) {
    const PolynomialValue at = evaluate(c, x);
    const double off = at.value - target;
    if (off == 0.0) {
      break;
    }
    ((off < 0.0) == rising ? a : b) = x;
    double next = x - off / at.slope;
    if (!(next > a && next < b) || i % 8 == 7) {
      next = 0.5 * (a + b);
    }
    if (next == x || !(a < next && next < b)) {  // nothing lies in between any more
      break;
    }
    x = next;
  }
  return x;
}

// All x in [low, high] where the polynomial is 0, in ascending order; none if it is 0 everywhere.
// Where it touches 0 without a change of sign, rounding decides.
inline std::vector<double> roots(std::span<const double> c, double low, double high) {
  while (!c.empty() && c.back() == 0.0) {
    c = c.first(c.size() - 1);
  }
  std::vector<double> found;
  if (c.size() < 2) {
    return found;
  }
  // Between the places where its derivative is 0 it rises or falls.
  std::vector<double> derivative;
  for (size_t i = 1; i < c.size(); ++i) {
    derivative.push_back(static_cast<double>(i) * c[i]);
  }
  std::vector<double> stops = roots(derivative, low, high);
  stops.insert(stops.begin(), low);
  stops.push_back(high);
  for (size_t i = 0; i < stops.size(); ++i) {
    const double here = evaluate(c, stops[i]).value;
    if (here == 0.0) {
      if (found.empty() || found.back() != stops[i]) {
        found.push_back(stops[i]);
      }
    } else if (i + 1 < stops.size()) {
      const double next = evaluate(c, stops[i + 1]).value;
      if (next != 0.0 && (here < 0.0) != (next < 0.0)) {
        found.push_back(root_between(c, 0.0, stops[i], stops[i + 1]));
      }
    }
  }
  return found;
}

}  // namespace janus
