// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// YAML text → plain tree with places; the only file that knows yaml-cpp.
///
/// Anchors, aliases and merge keys (`<<`) are resolved here. Duplicate keys,
/// tags, keys that are no words, and text that is not UTF-8 are problems of the
/// user. Trees are shared and never changed: an alias costs nothing until it is
/// read, and what it would expand to is limited.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "geo/base/check.h"

namespace sunload {

struct YamlNode;
using YamlTree = std::shared_ptr<const YamlNode>;

/// A key of a map with its value.
struct YamlEntry {
  std::string key;
  Where where;  ///< of the key
  YamlTree value;
};

/// A value of the file, and where it is written.
struct YamlNode {
  /// What the value is; empty: none, or `~`.
  enum class Kind { empty, text, list, map };
  /// Whether a text is in quotes; plain ones may be meant as numbers.
  enum class Style { plain, quoted };

  Kind kind = Kind::empty;
  Style style = Style::plain;
  std::string text;                ///< of `text`
  std::vector<YamlTree> items;     ///< of `list`
  std::vector<YamlEntry> entries;  ///< of `map`, keys unique, in the order of the file
  Where where;
  std::size_t size = 1;  ///< values in it, aliases expanded
  int depth = 1;         ///< levels in it, aliases expanded

  const YamlEntry* find(std::string_view key) const;
};

/// "a list" and the like, for messages.
const char* kind_name(YamlNode::Kind kind);

/// Reads one document. Adds what is wrong but leaves a tree to `problems`;
/// throws InputError for syntax errors, for an empty text, and for more than
/// `deepest_yaml` levels or `largest_yaml` values after expansion.
YamlTree parse_yaml(const std::string& file, const std::string& text, Problems& problems);

inline constexpr int deepest_yaml = 32;                 ///< studies need 6
inline constexpr std::size_t largest_yaml = 4'000'000;  ///< an instant for each minute of 7 years

/// `base` (null: nothing) with the values of `over`: maps merge, an empty value
/// removes the key, if there is one; lists whose path (keys joined by dots) is in
/// `appended` grow, all else is replaced. Values keep their places.
YamlTree merge_yaml(const YamlTree& base, const YamlTree& over,
                    const std::vector<std::string>& appended, const std::string& path = {});

}  // namespace sunload
