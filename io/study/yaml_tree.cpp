// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/yaml_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "io/base/names.h"

namespace sunload {

namespace {

using Kind = YamlNode::Kind;

Where place(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return {file};
  return {file, mark.line + 1, mark.column + 1};
}

std::shared_ptr<YamlNode> make_node(Kind kind, Where where) {
  auto node = std::make_shared<YamlNode>();
  node->kind = kind;
  node->where = std::move(where);
  return node;
}

/// Counts a child in; throws where the tree, aliases expanded, becomes too large or deep.
void count_child(YamlNode& parent, const YamlNode& child) {
  parent.size += child.size;
  parent.depth = std::max(parent.depth, child.depth + 1);
  if (parent.size > largest_yaml) {
    throw InputError(parent.where, "has too many values",
                     "more than " + std::to_string(largest_yaml) + ", aliases expanded");
  }
  if (parent.depth > deepest_yaml) {
    throw InputError(parent.where, "is nested too deeply",
                     "more than " + std::to_string(deepest_yaml) + " levels");
  }
}

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& file, Problems& problems) : file_(file), problems_(problems) {}
  YamlTree root() const { return root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    leaf(make_node(Kind::empty, place(file_, mark)), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    if (without_controls(value) != value)
      problems_.add(place(file_, mark), "a control character, '" + clean_name(value) + "'",
                    "texts of a study go to terminals and tables", "leave it out");
    auto node = make_node(Kind::text, place(file_, mark));
    node->text = value;
    node->style = tag == "?" ? YamlNode::Style::plain : YamlNode::Style::quoted;
    leaf(std::move(node), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    if (found == anchored_.end()) {
      throw InputError(place(file_, mark), "the anchor contains itself", "", "write the value out");
    }
    finished(found->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(Kind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  struct Open {
    std::shared_ptr<YamlNode> node;
    YAML::anchor_t anchor;
    YamlTree key;  ///< read, its value not yet
    std::unordered_set<std::string> keys;
    std::vector<YamlTree> merged;  ///< values of `<<`
  };

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    problems_.add(place(file_, mark), "the tag '" + tag + "' is not understood", "",
                  "leave it out");
  }

  void leaf(std::shared_ptr<YamlNode> node, YAML::anchor_t anchor) {
    if (anchor != 0) anchored_[anchor] = node;
    finished(std::move(node));
  }

  void begin(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    if (open_.size() >= static_cast<std::size_t>(deepest_yaml)) {
      throw InputError(place(file_, mark), "is nested too deeply",
                       "more than " + std::to_string(deepest_yaml) + " levels");
    }
    open_.push_back({make_node(kind, place(file_, mark)), anchor, nullptr, {}, {}});
  }

  void end() {
    Open done = std::move(open_.back());
    open_.pop_back();
    for (const auto& value : done.merged) merge_into(done, *value);
    leaf(done.node, done.anchor);
  }

  /// Keys of the map itself win over merged ones, earlier merged ones over later ones.
  void merge_into(Open& target, const YamlNode& value) {
    if (value.kind == Kind::list) {
      for (const auto& item : value.items) {
        if (item->kind == Kind::map)
          merge_into(target, *item);
        else
          refuse_merge(*item);
      }
      return;
    }
    if (value.kind != Kind::map) return refuse_merge(value);
    for (const auto& entry : value.entries) {
      if (target.keys.insert(entry.key).second) append(*target.node, entry);
    }
  }

  void refuse_merge(const YamlNode& value) {
    problems_.add(value.where, "'<<' merges maps", "", "give it an alias of a map");
  }

  void append(YamlNode& map, const YamlEntry& entry) {
    if (++entries_ > largest_yaml) throw InputError(map.where, "has too many keys");
    map.entries.push_back(entry);
    count_child(map, *entry.value);
  }

  void finished(YamlTree value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    Open& top = open_.back();
    if (top.node->kind == Kind::list) {
      count_child(*top.node, *value);
      top.node->items.push_back(std::move(value));
    } else if (!top.key) {
      top.key = std::move(value);
    } else {
      entry(top, std::exchange(top.key, nullptr), std::move(value));
    }
  }

  void entry(Open& map, const YamlTree& key, YamlTree value) {
    if (key->kind != Kind::text || key->text.empty()) {
      problems_.add(key->where, "this key is no word");
    } else if (key->text == "<<") {
      map.merged.push_back(std::move(value));
    } else if (!map.keys.insert(key->text).second) {
      const Where first = map.node->find(key->text)->where;
      problems_.add(key->where, "the key '" + key->text + "' is repeated",
                    "it is first written in line " + std::to_string(first.line),
                    "keep one of the two");
    } else {
      append(*map.node, {key->text, key->where, std::move(value)});
    }
  }

  std::string file_;
  Problems& problems_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlTree> anchored_;
  std::size_t entries_ = 0;
  YamlTree root_;
};

/// Length of the UTF-8 sequence at `at` (RFC 3629, table in section 4), 0 where there is none.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
  };
  const auto within = [&](std::size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const auto tail = [&](std::size_t i) { return within(i, 0x80, 0xBF); };
  const unsigned first = byte(0);
  if (first >= 0x01 && first <= 0x7F) return 1;
  if (within(0, 0xC2, 0xDF)) return tail(1) ? 2 : 0;
  if (within(0, 0xE0, 0xEF)) {
    const bool second = within(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && tail(2) ? 3 : 0;
  }
  if (within(0, 0xF0, 0xF4)) {
    const bool second = within(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && tail(2) && tail(3) ? 4 : 0;
  }
  return 0;
}

void require_utf8(const std::string& file, std::string_view text) {
  int line = 1, column = 1;
  for (std::size_t at = 0; at < text.size(); ++column) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) {
      throw InputError({file, line, column}, "this byte is no UTF-8 text", "",
                       "save the file as UTF-8");
    }
    if (text[at] == '\n') {
      ++line;
      column = 0;
    }
    at += length;
  }
}

/// Of text that is no YAML: a line that begins with a tab is mostly why, and the parser names
/// another place.
void refuse_tabs(const std::string& file, const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line[first] == '\t')
      throw InputError({file, number, static_cast<int>(first) + 1}, "a tab begins the line",
                       "YAML is indented by blanks alone", "write blanks in its place");
  }
}

}  // namespace

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::empty:
      return "nothing";
    case Kind::text:
      return "a single value";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map";
  }
  return "";
}

const YamlEntry* YamlNode::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const YamlEntry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

YamlTree parse_yaml(const std::string& file, const std::string& text, Problems& problems) {
  require_utf8(file, text);
  TreeBuilder builder(file, problems), second(file, problems);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    if (builder.root() && parser.HandleNextDocument(second)) {
      throw InputError(second.root() ? second.root()->where : Where{file},
                       "has more than one document", "", "remove the line '---' between them");
    }
  } catch (const YAML::Exception& error) {
    refuse_tabs(file, text);
    throw InputError(place(file, error.mark), "is no valid YAML", error.msg);
  }
  if (!builder.root() || builder.root()->kind == Kind::empty) {
    throw InputError({file, 1, 1}, "is empty");
  }
  return builder.root();
}

namespace {

/// A map without its keys that have no value, at any level: where nothing is, nothing is taken
/// away.
YamlTree without_empty_keys(const YamlTree& tree) {
  if (tree->kind != Kind::map) return tree;
  auto map = std::make_shared<YamlNode>(*tree);
  std::erase_if(map->entries,
                [](const YamlEntry& entry) { return entry.value->kind == Kind::empty; });
  for (YamlEntry& entry : map->entries) entry.value = without_empty_keys(entry.value);
  return map;
}

}  // namespace

YamlTree merge_yaml(const YamlTree& base, const YamlTree& over,
                    const std::vector<std::string>& appended, const std::string& path) {
  if (!base || base->kind != over->kind) return without_empty_keys(over);
  if (over->kind == Kind::list) {
    if (std::find(appended.begin(), appended.end(), path) == appended.end()) return over;
    auto list = std::make_shared<YamlNode>(*base);
    list->items.insert(list->items.end(), over->items.begin(), over->items.end());
    return list;
  }
  if (over->kind != Kind::map) return over;
  auto map = std::make_shared<YamlNode>(*base);
  if (!path.empty()) map->where = over->where;  // the outermost map stays where the file is
  for (const auto& entry : over->entries) {
    const auto mine = std::find_if(map->entries.begin(), map->entries.end(),
                                   [&](const YamlEntry& e) { return e.key == entry.key; });
    if (mine == map->entries.end()) {
      if (entry.value->kind != Kind::empty)
        map->entries.push_back({entry.key, entry.where, without_empty_keys(entry.value)});
    } else if (entry.value->kind == Kind::empty) {
      map->entries.erase(mine);
    } else {
      const std::string deeper = path.empty() ? entry.key : path + "." + entry.key;
      *mine = {entry.key, entry.where, merge_yaml(mine->value, entry.value, appended, deeper)};
    }
  }
  return map;
}

}  // namespace sunload
