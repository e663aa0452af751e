// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Trees from YAML text, typed access, places and hints.
#include "io/study/yaml_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "io/base/key_names.h"

namespace sunload {
namespace {

using Strings = std::vector<std::string>;

/// All problems of a text that `read` reads.
Strings problems_of(const std::string& text, const YamlMap::Reader& read,
                    std::vector<LaterKey> later = {}) {
  try {
    YamlReading reading(std::move(later));
    const auto tree = parse_yaml("f.yaml", text, reading.parser_problems);
    YamlMap::read_all(tree, reading, read);
    reading.throw_if_any();
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

void keep_all(YamlMap& map) { map.keep_rest(); }

const Range share{0, 1};
void read_share(YamlMap& map) { map.number("share", share); }

// Names of a study are printed: none commands a terminal.
TEST(Yaml, RefusesControlCharacters) {
  const auto problems = problems_of("a: \"x\\e[31m\"\n\"b\\x07\": |\n  two\n  lines\n", keep_all);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].substr(0, 11), "f.yaml:1:4:") << problems[0];
  EXPECT_NE(problems[0].find("'x\\x1b[31m'"), std::string::npos) << problems[0];
  EXPECT_EQ(problems[1].substr(0, 11), "f.yaml:2:1:") << problems[1];
}

TEST(Yaml, GivesThePlaceOfSyntaxErrors) {
  const auto problems = problems_of("a: 1\nb: [1, 2\nc: 3\n", keep_all);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].substr(0, 9), "f.yaml:3:") << problems[0];
  EXPECT_NE(problems[0].find("is no valid YAML"), std::string::npos);
}

TEST(Yaml, NamesTheTabThatIndentsALine) {
  const auto problems = problems_of("a: 1\nb:\n  c: {d: 2}\n\te: 3\n", keep_all);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].substr(0, 11), "f.yaml:4:1:") << problems[0];
  EXPECT_NE(problems[0].find("a tab begins the line"), std::string::npos) << problems[0];
  EXPECT_TRUE(problems_of("a: [1,\n\t2]\n", keep_all).empty());  // within brackets it may
}

TEST(Yaml, RefusesWhatIsNoStudyText) {
  const auto first = [](const std::string& text) {
    const auto problems = problems_of(text, keep_all);
    return problems.empty() ? std::string("accepted") : problems[0];
  };
  EXPECT_EQ(first(""), "f.yaml:1:1: is empty");
  EXPECT_EQ(first("# only a comment\n"), "f.yaml:1:1: is empty");
  EXPECT_EQ(first("- 1\n"), "f.yaml:1:1: this file must be a map of keys (it is a list)");
  EXPECT_EQ(first("a: 1\n---\nb: 2\n"),
            "f.yaml:3:1: has more than one document; remove the line '---' between them");
  EXPECT_EQ(first("a: !!python/object 1\n").substr(0, 16), "f.yaml:1:4: the ");
  EXPECT_EQ(first("a: 1\nb\xFF: 2\n").substr(0, 12), "f.yaml:2:2: ");
  EXPECT_EQ(first(std::string("a: \0", 4)).substr(0, 12), "f.yaml:1:4: ");
  EXPECT_EQ(first("\xF4\x90\x80\x80: 1").substr(0, 12), "f.yaml:1:1: ");  // beyond U+10FFFF
  EXPECT_EQ(first("ä€😀: 1\n"), "accepted");
  EXPECT_EQ(first("? [a, b]\n: 1\n"), "f.yaml:1:3: this key is no word");
}

TEST(Yaml, RefusesRepeatedKeys) {
  EXPECT_EQ(problems_of("a: 1\nm: {b: 1, b: 2}\na: 2\n", keep_all),
            (Strings{"f.yaml:2:11: the key 'b' is repeated (it is first written in line 2); keep "
                     "one of the two",
                     "f.yaml:3:1: the key 'a' is repeated (it is first written in line 1); keep "
                     "one of the two"}));
}

TEST(Yaml, ResolvesAnchorsAndMergeKeys) {
  Problems problems;
  const auto tree = parse_yaml("f.yaml",
                               "base: &base {x: 1, y: 2}\nmore: &more {y: 5, z: 3}\n"
                               "one: {<<: *base, y: 7}\ntwo: {<<: [*base, *more]}\nthree: *more\n",
                               problems);
  EXPECT_TRUE(problems.empty());
  const auto value = [&](const char* map, const char* key) {
    return tree->find(map)->value->find(key)->value->text;
  };
  EXPECT_EQ(value("one", "x"), "1");
  EXPECT_EQ(value("one", "y"), "7");
  EXPECT_EQ(value("two", "y"), "2");
  EXPECT_EQ(value("two", "z"), "3");
  EXPECT_EQ(value("three", "z"), "3");
  EXPECT_EQ(problems_of("a: {<<: 3}\n", keep_all).size(), 1u);
}

TEST(Yaml, LimitsBombs) {
  std::string aliases = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    aliases += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) aliases += (k ? ", *a" : "*a") + std::to_string(i - 1);
    aliases += "]\n";
  }
  EXPECT_EQ(problems_of(aliases, keep_all).size(), 1u);
  for (const int depth : {40, 400, 100'000}) {
    const auto size = static_cast<std::size_t>(depth);
    EXPECT_EQ(problems_of("a: " + std::string(size, '['), keep_all).size(), 1u);
    EXPECT_EQ(problems_of("a: " + std::string(size, '[') + std::string(size, ']'), keep_all).size(),
              1u);
  }
  const auto self = problems_of("a: &a [*a]\n", keep_all);
  ASSERT_EQ(self.size(), 1u);
  EXPECT_NE(self[0].find("contains itself"), std::string::npos) << self[0];
}

// What is written with a unit is told in that of the key; 33 degrees south are -33.
TEST(Yaml, UnitsBesideNumbersAreTold) {
  const auto hint = [](const std::string& key, const std::string& text) {
    const auto problems = problems_of(key + ": " + text, [&](YamlMap& map) {
      map.number(key, {-1e9, 1e9}, 0);
    });
    const auto at = problems.empty() ? std::string::npos : problems[0].find("; ");
    return at == std::string::npos ? std::string() : problems[0].substr(at + 2);
  };
  const std::string degrees = " alone, it is in degrees", metres = " alone, it is in metres";
  EXPECT_EQ(hint("latitude_deg", "33.45S"), "write -33.45" + degrees);
  EXPECT_EQ(hint("latitude_deg", "S 33.45"), "write -33.45" + degrees);
  EXPECT_EQ(hint("longitude_deg", "70.66 W"), "write -70.66" + degrees);
  EXPECT_EQ(hint("longitude_deg", "14.5E"), "write 14.5" + degrees);
  EXPECT_EQ(hint("latitude_deg", "50 °"), "write 50" + degrees);
  for (const char* text : {"33d27m S", "north", "33 27 S"})
    EXPECT_EQ(hint("latitude_deg", text),
              std::string(text) == "north"
                  ? ""
                  : "write decimal degrees alone; south and west are below 0");
  EXPECT_EQ(hint("max_edge_m", "50cm"), "write 0.5" + metres);
  EXPECT_EQ(hint("max_edge_m", "2 m"), "write 2" + metres);
  EXPECT_EQ(hint("elevation_m", "1706 ft"), "write 519.9888" + metres);
  EXPECT_EQ(hint("elevation_m", "1706 furlongs"), "write a number" + metres);
  EXPECT_EQ(hint("step_min", "1h"), "write 60 alone, it is in minutes");
  EXPECT_EQ(hint("latitude_deg", "-33.4S"),
            "write decimal degrees alone; south and west are below 0");
  EXPECT_EQ(hint("latitude_deg", "50E"), "write decimal degrees alone; south and west are below 0");
  EXPECT_EQ(hint("area_percent", "50%"), "write 50 alone, it is in percent");
  EXPECT_EQ(hint("above_lx", "2klx"), "write 2000 alone, it is in lux");
  EXPECT_EQ(hint("zenith_luminance_cd_m2", "5 kcd/m2"), "write 5000 alone, it is in cd/m²");
  EXPECT_EQ(hint("absorption_per_m", "0.04/mm"), "write 40 alone, it is in 1/m");
  EXPECT_EQ(hint("lines_per_patch", "1k"), "");
}

TEST(Yaml, ReadsNumbersStrictly) {
  const auto one = [](const std::string& text) {
    const auto problems = problems_of("share: " + text, read_share);
    return problems.empty() ? std::string() : problems[0];
  };
  for (const char* right : {"0", "1", "0.5", "+0.5", "1e-3", ".5", "1."}) EXPECT_EQ(one(right), "");
  const std::string start = "f.yaml:1:8: share: ";
  EXPECT_EQ(one("1.01"), start + "1.01 is out of range (must be from 0 up to 1)");
  EXPECT_EQ(one("-1e-9"), start + "-1e-9 is out of range (must be from 0 up to 1)");
  EXPECT_EQ(one("\"0.5\""), start + "'0.5' is no number; leave out the quotes");
  EXPECT_EQ(one("0,5"), start + "'0,5' is no number; write 0.5");
  EXPECT_EQ(one("0.5 m"), start + "'0.5 m' is no number; write 0.5 alone");
  EXPECT_EQ(one("20 %"), start + "'20 %' is no number; write 0.2 alone");
  for (const char* wrong : {".nan", "nan", ".inf", "-.inf", "inf", "0x1", "1e999", "true", "1_0",
                            "--1", "0.1.2", "1e"}) {
    EXPECT_EQ(one(wrong), start + "'" + wrong + "' is no number");
  }
  EXPECT_EQ(one("[1]"), start + "must be a number, not a list");
  EXPECT_EQ(problems_of("share:\n", read_share),
            Strings{"f.yaml:1:1: share has no value; give it one or remove the key"});
}

TEST(Yaml, ReadsWholeNumbersExactly) {
  const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  const auto read = [&](const std::string& text) {
    std::int64_t value = -1;
    EXPECT_TRUE(problems_of("n: " + text, [&](YamlMap& map) {
                  value = map.integer("n", std::int64_t{0}, largest, std::int64_t{-1});
                }).empty());
    return value;
  };
  EXPECT_EQ(read("9223372036854775807"), largest);
  EXPECT_EQ(read("9007199254740993"), 9007199254740993);  // 2^53 + 1: no double
  EXPECT_EQ(read("1e3"), 1000);
  EXPECT_EQ(problems_of("n: 1.5", [](YamlMap& map) { map.integer("n", 0, 9, 0); }),
            Strings{"f.yaml:1:4: n: 1.5 is no whole number"});
  for (const std::string text : {"-1", "9223372036854775808", "99999999999999999999999", "1e300"})
    EXPECT_EQ(problems_of("n: " + text,
                          [&](YamlMap& map) {
                            map.integer("n", std::int64_t{0}, largest, std::int64_t{0});
                          }),
              Strings{"f.yaml:1:4: n: " + text +
                      " is out of range (must be from 0 up to 9223372036854775807)"});
}

TEST(Yaml, NamesUnknownKeysWithTheNearest) {
  const auto read = [](YamlMap& root) {
    root.section("materials", [](YamlMap& materials) {
      materials.section("brick", [](YamlMap& brick) {
        brick.number("diffuse", share);
        brick.number("mirror", share);
      });
    });
    root.section("site", [](YamlMap& site) {
      site.number("latitude_deg", {-90, 90});
      site.number("step_min", {0, 90});
    });
  };
  EXPECT_EQ(problems_of("materials:\n  brick: {difuse: 0.3, zzzzz: 1}\n"
                        "site: {latitude: 3, step_h: 2}\n",
                        read),
            (Strings{"f.yaml:2:11: unknown key 'difuse' in materials.brick; did you mean "
                     "'diffuse'?",
                     "f.yaml:2:24: unknown key 'zzzzz' in materials.brick; known here: diffuse, "
                     "mirror",
                     "f.yaml:3:8: unknown key 'latitude' in site; did you mean 'latitude_deg'? Its "
                     "unit is degrees",
                     "f.yaml:3:21: unknown key 'step_h' in site; did you mean 'step_min'? Its unit "
                     "is minutes"}));
}

TEST(Yaml, RefusesKeysOfLaterVersionsByName) {
  const auto problems =
      problems_of("bands: rgb\nkind: finite\nlist:\n  - {old: 1, extra: 2}\n",
                  [](YamlMap& map) {
                    map.word("kind", {"point"}, "point");
                    map.each("list", [](YamlMap& item) { item.number("old", share); });
                  },
                  {{"bands", ""}, {"kind", "finite"}, {"list[].extra", ""}});
  EXPECT_EQ(
      problems,
      (Strings{"f.yaml:1:1: bands is not supported yet in this version; remove it",
               "f.yaml:2:7: kind: 'finite' is not supported yet in this version (it reads "
               "point)",
               "f.yaml:4:14: list[1].extra is not supported yet in this version; remove it"}));
}

TEST(Yaml, MergesMapsAndAppendsOnlyWhereAsked) {
  Problems problems;
  const auto base = parse_yaml("f.yaml", "s: {a: 1, b: 2, l: [1], m: [1]}\nt: 1\n", problems);
  const auto over = parse_yaml("f.yaml", "s: {b: 3, l: [2], m: [2], a: ~, c: 4}\n", problems);
  const auto merged = merge_yaml(base, over, {"s.l"});
  const auto& s = *merged->find("s")->value;
  EXPECT_EQ(s.find("a"), nullptr);
  EXPECT_EQ(s.find("b")->value->text, "3");
  EXPECT_EQ(s.find("c")->value->text, "4");
  EXPECT_EQ(s.find("l")->value->items.size(), 2u);
  EXPECT_EQ(s.find("m")->value->items.size(), 1u);
  EXPECT_NE(merged->find("t"), nullptr);
  EXPECT_NE(base->find("s")->value->find("a"), nullptr);  // the base is as it was
}

TEST(Yaml, TakesNothingAwayWhereNothingIs) {
  Problems problems;
  const auto base = parse_yaml("f.yaml", "s: {a: 1}\n", problems);
  const auto over = parse_yaml("f.yaml", "s: {m: {x: ~, y: {z: ~, w: 1}}}\nt: {u: ~}\n", problems);
  const auto merged = merge_yaml(base, over, {});
  const auto& m = *merged->find("s")->value->find("m")->value;
  EXPECT_EQ(m.find("x"), nullptr);
  EXPECT_EQ(m.find("y")->value->find("z"), nullptr);
  EXPECT_EQ(m.find("y")->value->find("w")->value->text, "1");
  EXPECT_TRUE(merged->find("t")->value->entries.empty());
}

TEST(KeyNames, MeasuresEdits) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook's example
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
  EXPECT_EQ(edit_distance("ca", "abc"), 3);  // 2 if swapped letters could be edited again
  EXPECT_EQ(key_hint("Max-Edge_M", {"max_edge_m", "min_area_m2"}).substr(0, 25),
            "did you mean 'max_edge_m'");
}

// Damaged texts end in a tree or in an InputError, whatever is damaged.
TEST(Yaml, SurvivesDamage) {
  const std::string sound =
      "format: x\nsite: &s {a: 1.5, b: [1, 2, {c: d}]}\nlist:\n  - {<<: *s, e: \"f\"}\n"
      "  - >-\n    folded\n  - 'single'\n? k\n: v\n";
  std::mt19937 random(1);
  const std::string letters = "{}[]:,&*!?|>-'\"%@`#\n\t <a1";
  constexpr int runs = 20'000;
  for (int run = 0; run < runs; ++run) {
    std::string text = sound;
    for (unsigned hit = 0; hit <= random() % 4; ++hit) {
      const auto at = random() % text.size();
      const char letter = letters[random() % letters.size()];
      if (random() % 2)
        text[at] = letter;
      else if (random() % 2)
        text.insert(at, 1, letter);
      else
        text.erase(at, 1 + random() % 5);
      if (text.empty()) text = "a";
    }
    EXPECT_NO_THROW(problems_of(text, [](YamlMap& map) {
      map.text("format");
      map.section("site", [](YamlMap& site) { site.number("a", share); });
      map.each("list", [](YamlMap& item) { item.texts("b"); });
    })) << text;
  }
}

}  // namespace
}  // namespace sunload
