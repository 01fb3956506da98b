// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/strategies.h"

#include <charconv>
#include <optional>

#include "janus/util/error.h"

namespace janus {

namespace {

// A number, or -1 for *; nullopt: neither.
std::optional<int> number(std::string_view text) {
  if (text == "*") {
    return -1;
  }
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc() && end == text.data() + text.size() && value >= 0;
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace

Strategies Strategies::parse(std::string_view text) {
  constexpr std::string_view kSpaces = " \t();";
  constexpr int kMost = 1026;
  Strategies chosen;
  chosen.text_ = text;
  std::vector<Pattern> patterns;
  size_t at = text.find_first_not_of(kSpaces);
  while (at != std::string_view::npos) {
    const size_t end = std::min(text.find_first_of(kSpaces, at), text.size());
    const std::string word(text.substr(at, end - at));
    at = text.find_first_not_of(kSpaces, end);
    const size_t comma = word.find(',');
    const auto s = comma == std::string::npos ? std::nullopt : number(word.substr(0, comma));
    const auto t = comma == std::string::npos ? std::nullopt : number(word.substr(comma + 1));
    if (!s || !t || *s > kMost || *t > kMost) {
      throw Error("'" + word +
                  "' is no strategy: write s,t as numbers of vertices or *, such as 0,* or 2,3");
    }
    if (*t == 0) {
      throw Error("'" + word +
                  "': light paths that hit the lens (t=0) have an integrator of their own: Light "
                  "Tracing without next event estimation, with depth of field");
    }
    if (*s == 0 && *t == 1) {
      throw Error("'" + word + "' is a camera alone: paths have two vertices or more");
    }
    if (*s == 1 && *t == 1) {
      throw Error("'" + word +
                  "' is never used: light that goes straight to the camera is found by 0,2");
    }
    patterns.push_back({*s, *t});
  }
  if (!patterns.empty()) {
    chosen.patterns_ = std::move(patterns);
  }
  return chosen;
}

}  // namespace janus
