// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/expression.h"

#include <algorithm>

#include "janus/util/error.h"

namespace janus {

namespace {

constexpr size_t kMostSymbols = 64;
constexpr int kMostNested = 32;

// The events of a letter; 0: it is no letter of an event.
ScatterMask events_of(char letter) {
  switch (letter) {
    case 'D':
      return scatter_bit(Scattering::Diffuse);
    case 'G':
      return scatter_bit(Scattering::Glossy);
    case 'S':
      return scatter_bit(Scattering::Specular);
    case 'R':
      return kReflections;
    case 'T':
      return kTransmissions;
    case '.':
      return kAllScattering;
    default:
      return 0;
  }
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Expression parse() {
    if (at_end()) {
      throw Error("the expression is empty; caustics, for example, are LS+DE");
    }
    const Part whole = alternatives();
    if (!at_end()) {
      fail("there is no parenthesis that this one closes");
    }
    expression_.first = whole.first;
    check(whole);
    return std::move(expression_);
  }

 private:
  // A part of the expression: the symbols that it may begin and end with, and may it be nothing?
  struct Part {
    bool empty = true;
    std::vector<int> first, last;
  };

  [[noreturn]] void fail(const std::string& message) const {
    throw Error("at character " + std::to_string(std::min(at_, text_.size()) + 1) + ": " + message);
  }

  // Skips what means nothing.
  bool at_end() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) {
      ++at_;
    }
    return at_ == text_.size();
  }
  bool next_is(char c) { return !at_end() && text_[at_] == c; }
  bool take(char c) { return next_is(c) && ++at_; }

  Part alternatives() {
    if (++nested_ > kMostNested) {
      fail("too many parentheses in each other");
    }
    Part sum = sequence();
    while (take('|')) {
      const Part other = sequence();
      sum.empty = sum.empty || other.empty;
      append(sum.first, other.first);
      append(sum.last, other.last);
    }
    --nested_;
    return sum;
  }

  Part sequence() {
    if (at_end() || next_is('|') || next_is(')')) {
      fail("a symbol is missing");
    }
    Part sum;
    while (!at_end() && !next_is('|') && !next_is(')')) {
      const Part next = repeated();
      connect(sum.last, next.first);
      if (sum.empty) {
        append(sum.first, next.first);
      }
      sum.last = next.empty ? joined(sum.last, next.last) : next.last;
      sum.empty = sum.empty && next.empty;
    }
    return sum;
  }

  Part repeated() {
    Part part = take('(') ? parenthesis() : symbol();
    for (;;) {
      const bool raised = take('^');
      if (take('*')) {
        connect(part.last, part.first);
        part.empty = true;
      } else if (take('+')) {
        connect(part.last, part.first);
      } else if (take('?')) {
        part.empty = true;
      } else if (raised) {
        fail("after ^ comes +, * or ?");
      } else {
        return part;
      }
    }
  }

  Part parenthesis() {
    Part part = alternatives();
    if (!take(')')) {
      fail("a closing parenthesis is missing");
    }
    return part;
  }

  Part symbol() {
    VertexPattern pattern;
    const char c = text_[at_];
    if (c == '<') {
      ++at_;
      pattern = several();
    } else if (c == '\'') {
      pattern.name = quoted('\'');
    } else if (c == 'L' || c == 'B' || c == 'O') {
      ++at_;
      pattern.kind = VertexPattern::Kind::Light;
      pattern.background = c != 'O';
      pattern.objects = c != 'B';
      pattern.name = next_is('\'') ? quoted('\'') : "";
      pattern.group = next_is('{') ? quoted('}') : "";
    } else if (c == 'E') {
      ++at_;
      pattern.kind = VertexPattern::Kind::Eye;
    } else if (const ScatterMask events = events_of(c)) {
      ++at_;
      pattern.events = events;
      pattern.name = next_is('\'') ? quoted('\'') : "";
    } else {
      std::string message = "' is no symbol; there are L, E, D, G, S, R, T and .";
      message.insert(message.begin(), {'\'', c});
      fail(message);
    }
    if (expression_.symbols.size() == kMostSymbols) {
      fail("more than " + std::to_string(kMostSymbols) + " symbols");
    }
    const int index = static_cast<int>(expression_.symbols.size());
    expression_.symbols.push_back(std::move(pattern));
    expression_.follow.emplace_back();
    return {false, {index}, {index}};
  }

  // One event with several properties, after its <.
  VertexPattern several() {
    VertexPattern pattern;
    while (!take('>')) {
      if (at_end()) {
        fail("a closing > is missing");
      }
      if (next_is('\'')) {
        pattern.name = quoted('\'');
        continue;
      }
      const ScatterMask events = events_of(text_[at_]);
      if (!events) {
        fail("between < and > are D, G, S, R, T and the name of an object in quotes");
      }
      ++at_;
      pattern.events &= events;
    }
    if (!pattern.events) {
      fail("no event is all of that at once");
    }
    return pattern;
  }

  // A name, from its opening character to `end`. What follows a backslash is part of it.
  std::string quoted(char end) {
    std::string name;
    while (++at_ < text_.size() && text_[at_] != end) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        ++at_;
      }
      name += text_[at_];
    }
    if (at_ >= text_.size()) {
      fail(std::string("a closing ") + end + " is missing");
    }
    if (name.empty()) {
      fail("a name is missing");
    }
    ++at_;
    return name;
  }

  static void append(std::vector<int>& to, const std::vector<int>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }
  static std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
    append(a, b);
    return a;
  }
  void connect(const std::vector<int>& from, const std::vector<int>& to) {
    for (const int symbol : from) {
      std::vector<int>& follow = expression_.follow[symbol];
      for (const int next : to) {
        if (std::ranges::find(follow, next) == follow.end()) {
          follow.push_back(next);
        }
      }
    }
  }

  VertexPattern::Kind kind(int symbol) const { return expression_.symbols[symbol].kind; }

  // A path has a light at its beginning, the eye at its end, and neither in between.
  void check(const Part& whole) const {
    using Kind = VertexPattern::Kind;
    const auto is = [&](Kind wanted) { return [=, this](int i) { return kind(i) == wanted; }; };
    if (std::ranges::any_of(whole.first, is(Kind::Eye)) &&
        std::ranges::any_of(whole.last, is(Kind::Light))) {
      throw Error("expressions are read from the light to the eye: L comes first, E last");
    }
    if (!std::ranges::all_of(whole.first, is(Kind::Light))) {
      throw Error("an expression begins with L, the light");
    }
    if (!std::ranges::all_of(whole.last, is(Kind::Eye))) {
      throw Error("an expression ends with E, the eye");
    }
    for (size_t i = 0; i < expression_.symbols.size(); ++i) {
      const std::vector<int>& follow = expression_.follow[i];
      if (std::ranges::any_of(follow, is(Kind::Light))) {
        throw Error("L stands only at the beginning: paths have one light");
      }
      if (kind(static_cast<int>(i)) == Kind::Eye && !follow.empty()) {
        throw Error("E stands only at the end: paths end at the eye");
      }
    }
  }

  std::string_view text_;
  size_t at_ = 0;
  int nested_ = 0;
  Expression expression_;
};

}  // namespace

Expression parse_expression(std::string_view text) { return Parser(text).parse(); }

}  // namespace janus
