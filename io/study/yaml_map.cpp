// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/yaml_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/key_names.h"

namespace sunload {

namespace {

using Kind = YamlNode::Kind;

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

}  // namespace

void YamlReading::problem(const Where& where, const std::string& what, const std::string& why,
                          const std::string& hint) {
  if (known_.insert(message(where, what, why, hint)).second) {
    found_.push_back({where, what, why, hint});
  }
}

void YamlReading::throw_if_any() const {
  Problems all = parser_problems;
  auto sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Found& a, const Found& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
  for (const auto& found : sorted) all.add(found.where, found.what, found.why, found.hint);
  all.throw_if_any();
}

void YamlReading::warn(const Where& where, const std::string& what, const std::string& why,
                       const std::string& hint) {
  const std::string text = message(where, what, why, hint);
  if (known_.insert(text).second) warnings.push_back(text);
}

bool YamlReading::is_later(const std::string& path, const std::string& value) const {
  return std::any_of(later_.begin(), later_.end(), [&](const LaterKey& later) {
    return later.path == path && (later.value.empty() || later.value == value);
  });
}

YamlMap::YamlMap(YamlTree node, Where where, std::string path, std::string pattern,
                 YamlReading& reading)
    : node_(std::move(node)),
      where_(std::move(where)),
      path_(std::move(path)),
      pattern_(std::move(pattern)),
      reading_(reading) {
  if (!node_) return;
  state_ = State::present;
  where_ = node_->where;
  if (node_->kind == Kind::map) return;
  reading_.problem(where_, (path_.empty() ? "this file" : path_) + " must be a map of keys",
                   std::string("it is ") + kind_name(node_->kind));
  state_ = State::no_map;
  node_ = nullptr;
}

void YamlMap::read_all(const YamlTree& tree, YamlReading& reading, const Reader& read) {
  YamlMap map(tree, {}, "", "", reading);
  read(map);
  map.finish();
}

YamlMap YamlMap::child(const YamlTree& node, const Where& where, const std::string& path_end,
                       const std::string& pattern_end) {
  return {node, where, path_ + path_end, pattern_ + pattern_end, reading_};
}

std::string YamlMap::path(const std::string& key) const { return join(path_, key); }
std::string YamlMap::pattern(const std::string& key) const { return join(pattern_, key); }

bool YamlMap::has(const std::string& key) const { return node_ && node_->find(key); }

Where YamlMap::where(const std::string& key) const {
  const YamlEntry* entry = node_ ? node_->find(key) : nullptr;
  return entry ? entry->value->where : where_;
}

Kind YamlMap::kind(const std::string& key) const {
  const YamlEntry* entry = node_ ? node_->find(key) : nullptr;
  return entry ? entry->value->kind : Kind::empty;
}

void YamlMap::problem(const std::string& key, const std::string& what, const std::string& why,
                      const std::string& hint) {
  reading_.problem(where(key), path(key) + ": " + what, why, hint);
}

void YamlMap::warn(const std::string& key, const std::string& what, const std::string& why) {
  reading_.warn(where(key), path(key) + ": " + what, why);
}

void YamlMap::refuse(const std::string& key, const std::string& what, const std::string& why,
                     const std::string& hint) {
  refused_.insert(key);
  problem(key, what, why, hint);
}

const YamlNode* YamlMap::ask(const std::string& key) {
  asked_.insert(key);
  reading_.keys.insert(pattern(key));
  const YamlEntry* entry = node_ ? node_->find(key) : nullptr;
  if (!entry) return nullptr;
  if (entry->value->kind != Kind::empty) return entry->value.get();
  reading_.problem(entry->where, path(key) + " has no value", "", "give it one or remove the key");
  return nullptr;
}

bool YamlMap::is_none(const std::string& key) {
  const bool is_there = has(key) && kind(key) == Kind::empty;
  if (is_there) asked_.insert(key);
  return is_there;
}

YamlTree YamlMap::tree(const std::string& key) {
  return ask(key) ? node_->find(key)->value : nullptr;
}

void YamlMap::require(const std::string& key, const std::string& why, const std::string& hint) {
  if (has(key) || !is_usable()) return;
  reading_.problem(where_, path(key) + " is missing", why, hint);
}

const YamlNode* YamlMap::ask_list(const std::string& key) {
  const YamlNode* node = ask(key);
  if (!node || node->kind == Kind::list) return node;
  problem(key, std::string("must be a list, not ") + kind_name(node->kind), "",
          node->kind == Kind::text ? "write [" + node->text + "]" : "");
  return nullptr;
}

void YamlMap::section(const std::string& key, const Reader& read) {
  const YamlTree node = tree(key);
  const std::string dot = path_.empty() ? "" : ".";
  YamlMap map = child(node, where(key), dot + key, dot + key);
  if (has(key) && !node) map.state_ = State::no_map;  // reported by `ask`
  read(map);
  map.finish();
}

namespace {

/// {text_key: text} in the place of the text.
YamlTree map_around(const YamlTree& text, const std::string& text_key) {
  YamlNode map;
  map.kind = Kind::map;
  map.where = text->where;
  map.entries.push_back({text_key, text->where, text});
  return std::make_shared<const YamlNode>(std::move(map));
}

}  // namespace

void YamlMap::each(const std::string& key, const Reader& read) { each_item(key, {}, read); }

void YamlMap::each_or_text(const std::string& key, const std::string& text_key,
                           const Reader& read) {
  each_item(key, text_key, read);
}

void YamlMap::each_item(const std::string& key, const std::string& text_key, const Reader& read) {
  const YamlNode* list = ask_list(key);
  const std::string dot = path_.empty() ? "" : ".";
  const auto read_item = [&](const YamlTree& item, std::size_t place) {
    YamlMap map =
        child(item, where(key), fmt::format("{}{}[{}]", dot, key, place + 1), dot + key + "[]");
    read(map);
    map.finish();
  };
  if (list && list->items.empty()) problem(key, "the list is empty");
  for (std::size_t i = 0; list && i < list->items.size(); ++i) {
    const YamlTree& item = list->items[i];
    const bool is_text = !text_key.empty() && item->kind == Kind::text;
    read_item(is_text ? map_around(item, text_key) : item, i);
  }
  if (reading_.purpose == YamlReading::Purpose::describe) read_item(nullptr, 0);
}

void YamlMap::named(const std::string& key,
                    const std::function<void(const std::string&, YamlMap&)>& read) {
  const YamlNode* maps = ask(key);
  const std::string dot = path_.empty() ? "" : ".";
  const auto read_item = [&](const YamlTree& item, const std::string& name) {
    YamlMap map = child(item, where(key), dot + key + "." + name, dot + key + ".*");
    read(name, map);
    map.finish();
  };
  if (maps && maps->kind != Kind::map) {
    problem(key, std::string("must be a map of names, not ") + kind_name(maps->kind));
    maps = nullptr;
  }
  for (std::size_t i = 0; maps && i < maps->entries.size(); ++i) {
    read_item(maps->entries[i].value, maps->entries[i].key);
  }
  if (reading_.purpose == YamlReading::Purpose::describe) read_item(nullptr, "*");
}

void YamlMap::keep_rest() {
  if (!node_) return;
  for (const auto& entry : node_->entries) asked_.insert(entry.key);
}

std::vector<std::string> YamlMap::other_keys() {
  std::vector<std::string> keys;
  reading_.keys.insert(pattern("*"));
  if (!node_) return keys;
  for (const auto& entry : node_->entries)
    if (!asked_.contains(entry.key)) keys.push_back(entry.key);
  return keys;
}

void YamlMap::finish() {
  if (!node_) return;
  for (const auto& entry : node_->entries) {
    if (asked_.contains(entry.key) || refused_.contains(entry.key)) continue;
    if (reading_.is_later(pattern(entry.key), "")) {
      reading_.problem(entry.where, path(entry.key) + " is not supported yet in this version", "",
                       "remove it");
      continue;
    }
    const std::string place = path_.empty() ? "" : " in " + path_;
    reading_.problem(entry.where, "unknown key '" + entry.key + "'" + place, "",
                     key_hint(entry.key, {asked_.begin(), asked_.end()}));
  }
}

}  // namespace sunload
