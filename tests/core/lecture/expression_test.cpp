// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light path expressions: what can be typed, and the automaton against a regular expression engine.
#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "janus/path/automaton.h"
#include "janus/util/error.h"
#include "support/scene_kit.h"

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
  for (const char* text :
       {"LE", "LDE", "LS+DE", "LS^+DE", "LDD+E", "L(D|S)*E", "L(D|S)E", "L (D|S) (D|S)^+ E",
        "LD?S*E", "L.*E", "L<TS>+DE", "L<SR'Mirror'>D'Wall'E", "L'Lamp.001''Glass'E", "L{Key}.*E",
        "BSE", "O.E", "(LD|LS)E", "L(D(G|S))*E", "LRTE", "L((D))+E"}) {
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

// An expression and the same for std::regex.
struct Both {
  std::string expression, regex;
};

class RandomExpressions {
 public:
  explicit RandomExpressions(uint32_t seed) : random_(seed) {}

  Both path() {
    const Both middle = below(5) == 0 ? Both{} : alternatives(3);
    return {"L" + middle.expression + "E", middle.regex};
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
  Both alternatives(int depth) {
    Both sum = sequence(depth);
    const bool several = below(3) == 0;
    if (several) {
      const Both other = sequence(depth);
      sum = {sum.expression + "|" + other.expression, sum.regex + "|" + other.regex};
    }
    return {"(" + sum.expression + ")", "(" + sum.regex + ")"};
  }
  Both sequence(int depth) {
    Both sum;
    for (int i = 1 + below(3); i > 0; --i) {
      const Both next = depth > 0 && below(3) == 0 ? alternatives(depth - 1) : symbol();
      const char* operators[] = {"", "", "+", "*", "?"};
      const std::string op = operators[below(5)];
      sum = {sum.expression + next.expression + op, sum.regex + next.regex + op};
    }
    return sum;
  }
  Both symbol() {
    const Both symbols[] = {{"D", "[dD]"},    {"G", "[gG]"},   {"S", "[sS]"},  {"R", "[dgs]"},
                            {"T", "[DGS]"},   {".", "[a-zA-Z]"}, {"<ST>", "S"}, {"<RD>", "d"}};
    return symbols[below(8)];
  }

  std::mt19937 random_;
};

// Wherever a path is cut in two, the automaton says of it what the regular expression says.
TEST(LectureExpressions, AutomatonMatchesRegularExpressions) {
  const auto scene =
      open_box().light("lamp", area_light({0, 0, 0.9f}, {0, 0, -1}, 0.5f, 10)).build();
  RandomExpressions random(7);
  int matched = 0;
  for (int set = 0; set < 100; ++set) {
    std::vector<Expression> expressions;
    std::vector<std::regex> regexes;
    for (int i = 0; i < 2; ++i) {
      const Both both = random.path();
      SCOPED_TRACE(both.expression);
      expressions.push_back(parse_expression(both.expression));
      regexes.emplace_back(both.regex);
    }
    const PathAutomaton automaton(expressions, *scene);
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
      for (size_t e = 0; e < regexes.size(); ++e) {
        const bool expected = std::regex_match(events, regexes[e]);
        matched += expected ? 1 : 0;
        ASSERT_EQ((automaton.completed(light, camera) >> e & 1) != 0, expected)
            << "set " << set << ", expression " << e << ", path " << events << " cut at " << cut;
      }
    }
  }
  EXPECT_GT(matched, 1000);
}

TEST(LectureExpressions, KnowNamesAndGroups) {
  SceneKit kit = room();
  LightDesc key = area_light({0, 0, 0.9f}, {0, 0, -1}, 0.5f, 10);
  key.light_group = "Key";
  kit.light("lamp", key).light("point", point_light({0, -0.5f, 0.5f}, 5)).world(Rgb(0.1f));
  const auto scene = kit.build();
  size_t box = 0, block = 0;
  for (size_t i = 0; i < scene->instances.size(); ++i) {
    box = scene->instances[i].name == "box" ? i : box;
    block = scene->instances[i].name == "block" ? i : block;
  }
  std::map<std::string, size_t> lights;
  for (size_t i = 0; i < scene->lights.size(); ++i) {
    lights[scene->lights[i]->name] = i;
  }
  ASSERT_EQ(lights.size(), 3u);
  std::vector<Expression> expressions;
  for (const char* text : {"L'lamp'.*E", "L{Key}.*E", "BD*E", "O.*E", "LD'box'D'block'E",
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

TEST(LectureExpressions, AreRefusedWhereTheyExplode) {
  const auto scene = open_box().light("lamp", point_light({0, 0, 0}, 1)).build();
  // Whether the n-th event from the end is diffuse: 2^n states.
  std::string text = "L.*D" + std::string(14, '.') + "E";
  const std::vector<Expression> expressions{parse_expression(text)};
  EXPECT_THROW(PathAutomaton(expressions, *scene), Error);
}

}  // namespace
}  // namespace janus::test
