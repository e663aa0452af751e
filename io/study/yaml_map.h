// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Typed, ranged access to the maps of a YAML file, with places.
///
/// A reader asks for every key that it knows; what is left is an unknown key.
/// Nothing is thrown while reading: all problems of a file are collected, and a
/// value that is wrong reads as its default.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "io/study/yaml_tree.h"

namespace sunload {

/// Allowed values of a number; `excluded`: above `low`, not at it.
struct Range {
  /// Whether `low` itself is allowed.
  enum class Low { included, excluded };
  double low, high;
  Low low_end = Low::included;
  const char* hint = "";  ///< for values outside
};

/// A key (or, with `value`, one value of a known key) that a later version will read.
/// `*` stands for a name of the user, `[]` for a place in a list.
struct LaterKey {
  std::string path, value;
};

/// What one reading of a file finds out.
class YamlReading {
 public:
  /// `describe` reads absent lists and named entries as if they had one empty item, so that
  /// `keys` becomes the list of all keys.
  enum class Purpose { read, describe };
  explicit YamlReading(std::vector<LaterKey> later, Purpose wanted = Purpose::read)
      : purpose(wanted), later_(std::move(later)) {}

  /// Problems and warnings that are already known are left out: variants share their base.
  void problem(const Where& where, const std::string& what, const std::string& why = {},
               const std::string& hint = {});
  void warn(const Where& where, const std::string& what, const std::string& why = {},
            const std::string& hint = {});
  bool is_later(const std::string& path, const std::string& value) const;
  /// Throws InputError with what the parser found, then all else from top to bottom.
  void throw_if_any() const;

  const Purpose purpose;
  Problems parser_problems;  ///< of `parse_yaml`
  std::vector<std::string> warnings;
  std::set<std::string> keys;  ///< every path asked for, `scene.materials.*.diffuse`

 private:
  struct Found {
    Where where;
    std::string what, why, hint;
  };
  std::vector<LaterKey> later_;
  std::vector<Found> found_;
  std::set<std::string> known_;
};

/// A text and where it is written.
struct PlacedText {
  std::string text;
  Where where;
};

/// One map of the file while it is read; an absent one reads as empty.
class YamlMap {
 public:
  using Reader = std::function<void(YamlMap&)>;

  /// Reads the whole file: `read` gets the outermost map; unknown keys are reported after it.
  static void read_all(const YamlTree& tree, YamlReading& reading, const Reader& read);

  YamlReading& reading() { return reading_; }
  const Where& where() const { return where_; }
  /// Where the value of `key` is written, or the map where it is not.
  Where where(const std::string& key) const;
  /// `site.latitude_deg`: for messages.
  std::string path(const std::string& key) const;
  bool has(const std::string& key) const;
  /// Whether the file has the key without a value (`~`), where that says something: asking is
  /// enough to make the key a known one, and only then.
  bool is_none(const std::string& key);
  /// False where something else stands in place of the map (which is reported).
  bool is_usable() const { return state_ != State::no_map; }
  /// Kind of the value; `empty` where the key is absent.
  YamlNode::Kind kind(const std::string& key) const;
  /// The value as it is; asking for it is enough to make the key a known one.
  YamlTree tree(const std::string& key);

  std::optional<double> number(const std::string& key, const Range& range);
  double number(const std::string& key, const Range& range, double absent);
  /// Whole numbers from `low` to `high`.
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high,
                       std::int64_t absent);
  int integer(const std::string& key, int low, int high, int absent);
  /// Never empty.
  std::optional<std::string> text(const std::string& key);
  std::string text(const std::string& key, const std::string& absent);
  template <class E>
  E choice(const std::string& key, const std::vector<std::pair<std::string, E>>& names, E absent);
  /// The same, with the words of io/study/words.h.
  template <class E>
  E choice(const std::string& key, E absent) {
    return choice(key, words_of(absent), absent);
  }
  /// One of `names`.
  std::string word(const std::string& key, const std::vector<std::string>& names,
                   const std::string& absent);
  std::vector<double> numbers(const std::string& key, const Range& range);
  std::vector<PlacedText> texts(const std::string& key);

  /// The map under `key`; `read` is called with an empty one where it is absent.
  void section(const std::string& key, const Reader& read);
  /// Every map of a list of maps.
  void each(const std::string& key, const Reader& read);
  /// The same where a text may stand for a map of the one key `text_key`.
  void each_or_text(const std::string& key, const std::string& text_key, const Reader& read);
  /// Every map of a map of maps, with its name.
  void named(const std::string& key, const std::function<void(const std::string&, YamlMap&)>& read);
  /// All keys that were not asked for are known, and read elsewhere.
  void keep_rest();
  /// The keys that were not asked for so far, where a map has names of the user: ask for each.
  std::vector<std::string> other_keys();

  /// The key must be there.
  void require(const std::string& key, const std::string& why = {}, const std::string& hint = {});
  /// `path: what` at the value of `key`.
  void problem(const std::string& key, const std::string& what, const std::string& why = {},
               const std::string& hint = {});
  void warn(const std::string& key, const std::string& what, const std::string& why = {});
  /// As `problem`, for a key that may not stand here.
  void refuse(const std::string& key, const std::string& what, const std::string& why = {},
              const std::string& hint = {});

 private:
  YamlMap(YamlTree node, Where where, std::string path, std::string pattern, YamlReading& reading);
  YamlMap child(const YamlTree& node, const Where& where, const std::string& path_end,
                const std::string& pattern_end);
  std::string pattern(const std::string& key) const;
  void each_item(const std::string& key, const std::string& text_key, const Reader& read);
  /// The value of a key that the file has; null where absent or without value.
  const YamlNode* ask(const std::string& key);
  std::optional<double> to_number(const YamlNode& node, const std::string& key, const Range& range);
  std::optional<std::string> to_text(const YamlNode& node, const std::string& key);
  const YamlNode* ask_list(const std::string& key);
  std::optional<std::size_t> find_word(const std::string& key,
                                       const std::vector<std::string>& names);
  void finish();

  YamlTree node_;  ///< a map, or null
  Where where_;
  std::string path_, pattern_;
  YamlReading& reading_;
  std::set<std::string> asked_, refused_;
  enum class State { absent, present, no_map } state_ = State::absent;
};

template <class E>
E YamlMap::choice(const std::string& key, const std::vector<std::pair<std::string, E>>& names,
                  E absent) {
  std::vector<std::string> words;
  words.reserve(names.size());
  for (const auto& name : names) words.push_back(name.first);
  const auto found = find_word(key, words);
  return found ? names[*found].second : absent;
}

}  // namespace sunload
