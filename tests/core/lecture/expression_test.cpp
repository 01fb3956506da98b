// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light path expressions: what can be typed, and the automaton against a matcher of its own.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>
#include <random>
#include <set>

#include "janus/path/match.h"
#include "janus/util/error.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

std::string complaint(const std::string& text) {
  try {
    parse_expression(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LectureExpressions, AreReadAsTheyAreTaught) {
  for (const char* text : {"LE",
                           "LDE",
                           "LS+DE",
                           "LS^+DE",
                           "LDD+E",
                           "L(D|S)*E",
                           "L(D|S)E",
                           "L (D|S) (D|S)^+ E",
                           "LD?S*E",
                           "L.*E",
                           "L<TS>+DE",
                           "L<SR'Mirror'>D'Wall'E",
                           "L'Lamp.001''Glass'E",
                           "L{Key}.*E",
                           "BSE",
                           "O.E",
                           "(LD|LS)E",
                           "L(D(G|S))*E",
                           "LRTE",
                           "L((D))+E"}) {
    EXPECT_EQ(complaint(text), "") << text;
  }
}

TEST(LectureExpressions, SayWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "empty"},
      {"  ", "empty"},
      {"DE", "begins with L"},
      {"D*E", "begins with L"},
      {"L?DE", "begins with L"},
      {"LD", "ends with E"},
      {"LDE?", "ends with E"},
      {"EDL", "from the light to the eye"},
      {"LDLE", "only at the beginning"},
      {"L+DE", "only at the beginning"},
      {"LEDE", "only at the end"},
      {"LXE", "character 2: 'X' is no symbol"},
      {"LdE", "'d' is no symbol"},
      {"L(DE", "closing parenthesis"},
      {"LD)E", "character 3: there is no parenthesis"},
      {"L()E", "a symbol is missing"},
      {"L(D|)E", "a symbol is missing"},
      {"|LE", "a symbol is missing"},
      {"L*", "ends with E"},
      {"+LE", "'+' is no symbol"},
      {"LD^E", "after ^"},
      {"L'Lamp", "closing '"},
      {"L{}E", "name is missing"},
      {"L<DS>E", "at once"},
      {"L<D", "closing >"},
      {"L<X>E", "between < and >"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_NE(complaint(text).find(message), std::string::npos)
        << text << ": \"" << complaint(text) << "\"";
  }
  EXPECT_NE(complaint("L" + std::string(100, '(') + "D").find("parentheses"), std::string::npos);
  EXPECT_NE(complaint("L" + std::string(100, 'D') + "E").find("64"), std::string::npos);
}

// Events as letters: capitals are transmissions.
constexpr char kEvents[] = "dDgGsS";

// An expression that knows by itself, without an automaton, what it matches.
class Pattern {
 public:
  using Ends = std::set<size_t>;  // where a match may end
  using Match = std::function<Ends(const std::string& events, size_t begin)>;

  Pattern() : Pattern("", [](const std::string&, size_t begin) { return Ends{begin}; }) {}

  static Pattern symbol(const std::string& text, const std::string& letters) {
    return {text, [letters](const std::string& events, size_t begin) {
              const bool good =
                  begin < events.size() && letters.find(events[begin]) != std::string::npos;
              return good ? Ends{begin + 1} : Ends{};
            }};
  }
  Pattern then(const Pattern& next) const {
    return {text + next.text, [one = match, two = next.match](const std::string& e, size_t begin) {
              Ends ends;
              for (const size_t middle : one(e, begin)) {
                ends.merge(two(e, middle));
              }
              return ends;
            }};
  }
  Pattern either(const Pattern& other) const {
    return {text + "|" + other.text,
            [one = match, two = other.match](const std::string& e, size_t begin) {
              Ends ends = one(e, begin);
              ends.merge(two(e, begin));
              return ends;
            }};
  }
  // `how`: one of + * ?
  Pattern repeated(char how) const {
    return {text + how, [one = match, how](const std::string& e, size_t begin) {
              Ends ends, more{begin};
              while (!more.empty()) {  // what is new since the last round
                Ends next;
                for (const size_t from : more) {
                  next.merge(one(e, from));
                }
                std::erase_if(next, [&](size_t end) { return ends.contains(end); });
                ends.insert(next.begin(), next.end());
                more = how == '?' ? Ends{} : next;
              }
              if (how != '+') {
                ends.insert(begin);
              }
              return ends;
            }};
  }
  Pattern in_parentheses() const { return {"(" + text + ")", match}; }

  bool matches(const std::string& events) const { return match(events, 0).contains(events.size()); }

  std::string text;
  Match match;

 private:
  Pattern(std::string t, Match m) : text(std::move(t)), match(std::move(m)) {}
};

class RandomExpressions {
 public:
  explicit RandomExpressions(uint32_t seed) : random_(seed) {}

  Pattern path() {  // without L and E
    return below(8) == 0 ? Pattern() : alternatives(2);
  }
  std::string events() {
    std::string text;
    for (int i = below(7); i > 0; --i) {
      text += kEvents[below(6)];
    }
    return text;
  }
  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }

 private:
  Pattern alternatives(int depth) {
    Pattern sum = sequence(depth);
    if (below(3) == 0) {
      sum = sum.either(sequence(depth));
    }
    return sum.in_parentheses();
  }
  Pattern sequence(int depth) {
    Pattern sum;
    for (int i = 1 + below(3); i > 0; --i) {
      Pattern next = depth > 0 && below(3) == 0 ? alternatives(depth - 1) : symbol();
      const int how = below(5);
      sum = sum.then(how < 3 ? next.repeated("+*?"[how]) : next);
    }
    return sum;
  }
  Pattern symbol() {
    const Pattern symbols[] = {Pattern::symbol("D", "dD"),   Pattern::symbol("G", "gG"),
                               Pattern::symbol("S", "sS"),   Pattern::symbol("R", "dgs"),
                               Pattern::symbol("T", "DGS"),  Pattern::symbol(".", kEvents),
                               Pattern::symbol("<ST>", "S"), Pattern::symbol("<RD>", "d")};
    return symbols[below(8)];
  }

  std::mt19937 random_;
};

// Wherever a path is cut in two, the automaton says of it what the expression says of the whole.
TEST(LectureExpressions, AutomatonMatchesFromBothEnds) {
  const auto scene =
      open_box().light("lamp", area_light({0, 0, 0.9f}, {0, 0, -1}, 0.5f, 10)).build();
  RandomExpressions random(7);
  int matched = 0, refused = 0;
  for (int set = 0; set < 100; ++set) {
    std::vector<Expression> expressions;
    std::vector<Pattern> patterns;
    for (int i = 0; i < 2; ++i) {
      patterns.push_back(random.path());
      expressions.push_back(parse_expression("L" + patterns.back().text + "E"));
    }
    std::optional<PathAutomaton> built;
    try {
      built.emplace(expressions, *scene);
    } catch (const Error&) {
      ++refused;
      continue;
    }
    const PathAutomaton& automaton = *built;
    for (int path = 0; path < 100; ++path) {
      const std::string events = random.events();
      const auto cut = static_cast<size_t>(random.below(static_cast<int>(events.size()) + 1));
      const auto event = [&](size_t i) {
        return static_cast<int>(std::string_view(kEvents).find(events[i]));
      };
      auto light = automaton.from_light(0), camera = automaton.from_camera();
      for (size_t i = 0; i < cut; ++i) {
        light = automaton.forward(light, event(i), 0);
      }
      for (size_t i = events.size(); i > cut; --i) {
        camera = automaton.reverse(camera, event(i - 1), 0);
      }
      for (size_t e = 0; e < patterns.size(); ++e) {
        const bool expected = patterns[e].matches(events);
        matched += expected ? 1 : 0;
        ASSERT_EQ((automaton.completed(light, camera) >> e & 1) != 0, expected)
            << patterns[e].text << ", path " << events << " cut at " << cut;
      }
    }
  }
  EXPECT_GT(matched, 1000);
  EXPECT_LT(refused, 10);
}

TEST(LectureExpressions, KnowNamesAndGroups) {
  SceneKit kit = room();
  LightDesc key = area_light({0, 0, 0.9f}, {0, 0, -1}, 0.5f, 10);
  key.light_group = "Key";
  kit.light("lamp", key).light("point", point_light({0, -0.5f, 0.5f}, 5)).world(Rgb(0.1f));
  const auto scene = kit.build();
  size_t box = 0, block = 0;
  for (size_t i = 0; i < scene->instances.size(); ++i) {
    box = scene->instances[i].names->name == "box" ? i : box;
    block = scene->instances[i].names->name == "block" ? i : block;
  }
  std::map<std::string, size_t> lights;
  for (size_t i = 0; i < scene->lights.size(); ++i) {
    lights[scene->lights[i]->name] = i;
  }
  ASSERT_EQ(lights.size(), 3u);
  std::vector<Expression> expressions;
  for (const char* text : {"L'la\\mp'.*E", "L{Key}.*E", "BD*E", "O.*E", "LD'box'D'block'E",
                           "L.'box'*E", "L'nobody'D'nothing'E"}) {
    expressions.push_back(parse_expression(text));
  }
  const PathAutomaton automaton(expressions, *scene);
  const auto of = [&](const std::string& light, const std::vector<size_t>& objects) {
    auto state = automaton.from_light(lights.at(light));
    for (const size_t object : objects) {
      state = automaton.forward(state, scatter_event(Scattering::Diffuse, false),
                                static_cast<uint32_t>(object));
    }
    return automaton.completed(state, automaton.from_camera());
  };
  EXPECT_EQ(of("lamp", {}), 0b0101011u);
  EXPECT_EQ(of("point", {}), 0b0101000u);
  EXPECT_EQ(of("World", {}), 0b0100100u);
  EXPECT_EQ(of("point", {box, block}), 0b0011000u);
  EXPECT_EQ(of("point", {block, box}), 0b0001000u);
  EXPECT_EQ(of("World", {box, box}), 0b0100100u);
  EXPECT_EQ(automaton.unknown_names(), (std::vector<std::string>{"nobody", "nothing"}));
}

// Four vertices of two kinds, all of whose words are told apart: sixteen states, for which there is
// no room. What is left of them is right on average.
TEST(LectureExpressions, DroppedStatesAreMadeUpFor) {
  BsdfEval half;
  half.f = Rgb(1.0f);
  half.diffuse = Rgb(0.5f, 0.25f, 0.75f);
  const UnreadVertex vertex{0, ScatterShares::joined(half, false)};
  const auto next = [](PathAutomaton::State state, int event, uint32_t) {
    const bool diffuse = event == scatter_event(Scattering::Diffuse, false);
    return static_cast<PathAutomaton::State>(2 * state + (diffuse ? 1 : 0));
  };
  std::map<PathAutomaton::State, std::array<Mean, 3>> shares;
  size_t most = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    Sampler sampler(3, Stream::Pilot, i, 0);
    sampler.start_block(0);
    PathTrace trace(1);
    for (int k = 0; k < 4; ++k) {
      trace.go_on(vertex, vertex.shares, k, next, sampler);
      most = std::max(most, trace.states().size());
    }
    for (PathAutomaton::State word = 16; word < 32; ++word) {
      Rgb share(0.0f);
      for (const WeightedState& s : trace.states()) {
        share += s.state == word ? s.share : Rgb(0.0f);
      }
      for (int c = 0; c < 3; ++c) {
        shares[word][c].add(share[c]);
      }
    }
  }
  EXPECT_EQ(most, 6u);
  for (const auto& [word, means] : shares) {
    for (int c = 0; c < 3; ++c) {
      double expected = 1.0;
      for (int k = 0; k < 4; ++k) {
        expected *= (word >> k & 1) != 0 ? half.diffuse[c] : 1.0 - half.diffuse[c];
      }
      EXPECT_LT(std::abs(z_score(means[c], expected)), 4.8) << word << ", channel " << c;
      EXPECT_LT(means[c].error(), 0.1 * expected);
    }
  }
}

TEST(LectureExpressions, AreRefusedWhereTheyExplode) {
  const auto scene = open_box().light("lamp", point_light({0, 0, 0}, 1)).build();
  // Whether the n-th event from the end is diffuse: 2^n states.
  std::string text = "L.*D" + std::string(14, '.') + "E";
  const std::vector<Expression> expressions{parse_expression(text)};
  EXPECT_THROW(PathAutomaton(expressions, *scene), Error);
}

}  // namespace
}  // namespace janus::test
