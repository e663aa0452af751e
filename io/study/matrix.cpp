// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>

namespace sunload {

namespace {

using Kind = YamlNode::Kind;
using Axis = std::vector<MatrixValue>;
using Path = std::vector<MatrixValue::Part>;

constexpr std::size_t most_variants = 3000;

/// `scene.edit[2].raise.storeys`; empty where it is none.
Path path_of(const std::string& text) {
  Path path;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('.', at), text.size());
    MatrixValue::Part part{text.substr(at, end - at), 0};
    if (const auto open = part.key.find('['); open != std::string::npos) {
      const char* const first = part.key.data() + open + 1;
      const char* const last = part.key.data() + part.key.size();
      const auto read = std::from_chars(first, last, part.place);
      if (read.ec != std::errc() || read.ptr + 1 != last || *read.ptr != ']' || part.place == 0)
        return {};
      part.key.resize(open);
    }
    if (part.key.empty()) return {};
    path.push_back(std::move(part));
    at = end + 1;
  }
  return path;
}

/// What can stand in a file's name.
std::string as_name(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_' && c != '-')
      c = '-';
  return text;
}

/// As many of the last keys as tell the axis from the others: `storeys`, `glass-mirror`.
std::vector<std::string> short_names(const std::vector<Path>& paths) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  for (const Path& path : paths) ++uses[path.back().key];
  for (const Path& path : paths) {
    std::string name = path.back().key;
    if (uses[name] > 1 && path.size() > 1) name = path[path.size() - 2].key + "-" + name;
    names.push_back(as_name(name));
  }
  return names;
}

void read_axis(const YamlEntry& entry, const Path& path, const std::string& name, Axis& axis,
               YamlReading& reading) {
  const std::string subject = "matrix." + entry.key;
  const YamlNode& values = *entry.value;
  if (values.kind == Kind::map) {
    for (const YamlEntry& each : values.entries)
      axis.push_back({path, each.value, each.value->where, as_name(each.key)});
  } else if (values.kind == Kind::list) {
    for (const YamlTree& each : values.items) {
      if (each->kind == Kind::text)
        axis.push_back({path, each, each->where, name + "-" + as_name(each->text)});
      else
        reading.problem(each->where, subject + ": a value of a list must be a single one",
                        "it becomes part of the variant's name",
                        "write a map of names and values: {none: [], one: [...]}");
    }
  } else {
    reading.problem(values.where, subject + ": must be a list of values, or a map of named ones");
    return;
  }
  if (axis.empty()) reading.problem(values.where, subject + ": has no values");
}

YamlTree put(const YamlTree& node, const MatrixValue& value, std::size_t depth,
             const std::string& path, const std::vector<std::string>& appended,
             YamlReading& reading) {
  if (depth == value.path.size())
    return value.value->kind != Kind::empty ? merge_yaml(node, value.value, appended, path)
                                            : value.value;
  const MatrixValue::Part& step = value.path[depth];
  const std::string& key = step.key;
  const std::size_t place = step.place;
  auto map = std::make_shared<YamlNode>();
  map->kind = Kind::map;
  map->where = value.where;
  if (node && node->kind == Kind::map) *map = *node;
  const auto mine = std::find_if(map->entries.begin(), map->entries.end(),
                                 [&](const YamlEntry& e) { return e.key == key; });
  const bool is_there = mine != map->entries.end();
  const std::string deeper = path.empty() ? key : path + "." + key;
  YamlTree child = is_there ? mine->value : nullptr;
  if (place > 0) {
    const std::size_t count = child && child->kind == Kind::list ? child->items.size() : 0;
    if (place > count) {
      reading.problem(value.where, fmt::format("matrix: {}[{}] is not there", deeper, place),
                      fmt::format("the list has {} item{}", count, count == 1 ? "" : "s"),
                      "places in lists count from 1");
      return node;
    }
    auto list = std::make_shared<YamlNode>(*child);
    list->items[place - 1] =
        put(list->items[place - 1], value, depth + 1, deeper, appended, reading);
    child = std::move(list);
  } else {
    child = put(child, value, depth + 1, deeper, appended, reading);
  }
  if (child->kind == Kind::empty) {
    if (is_there) map->entries.erase(mine);
  } else if (is_there) {
    *mine = {key, value.where, std::move(child)};
  } else {
    map->entries.push_back({key, value.where, std::move(child)});
  }
  return map;
}

}  // namespace

std::vector<Axis> read_matrix(YamlMap& root, std::size_t variants) {
  root.reading().keys.insert("matrix.*");
  const YamlTree matrix = root.tree("matrix");
  if (!matrix) return {};
  if (matrix->kind != Kind::map) {
    root.problem("matrix", "must be a map of keys and their values", "",
                 "write matrix: {solver.bounces: [1, 5]}");
    return {};
  }
  std::vector<Path> paths;
  std::vector<const YamlEntry*> entries;
  for (const YamlEntry& entry : matrix->entries) {
    if (Path path = path_of(entry.key); !path.empty()) {
      paths.push_back(std::move(path));
      entries.push_back(&entry);
    } else {
      root.reading().problem(entry.where, "matrix: '" + entry.key + "' is no key of a study",
                             "keys are joined by dots, places in lists count from 1",
                             "write for example scene.edit[1].raise.storeys");
    }
  }
  const auto names = short_names(paths);
  std::vector<Axis> axes;
  std::size_t count = variants;
  for (std::size_t a = 0; a < paths.size(); ++a) {
    Axis axis;
    read_axis(*entries[a], paths[a], names[a], axis, root.reading());
    if (axis.empty()) continue;
    count *= axis.size();
    if (count > most_variants) {
      root.problem("matrix", fmt::format("makes more than {} variants", most_variants),
                   "each of them is a run of its own", "leave values out, or divide the study");
      return {};
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

std::vector<std::vector<MatrixValue>> combinations(const std::vector<Axis>& axes) {
  std::vector<std::vector<MatrixValue>> all{{}};
  for (const Axis& axis : axes) {
    std::vector<std::vector<MatrixValue>> longer;
    for (const auto& begun : all)
      for (const MatrixValue& value : axis) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

YamlTree with_value(const YamlTree& tree, const MatrixValue& value,
                    const std::vector<std::string>& appended, YamlReading& reading) {
  return put(tree, value, 0, "", appended, reading);
}

}  // namespace sunload
