// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/named_files.h"

#include <filesystem>

#include "geo/base/check.h"
#include "io/study/yaml_tree.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;

void collect(const YamlTree& value, const fs::path& folder, std::vector<std::string>& files) {
  if (!value) return;
  std::error_code no_file;
  if (value->kind == YamlNode::Kind::text)
    if (const fs::path path = folder / value->text; fs::is_regular_file(path, no_file))
      files.push_back(path.string());
  for (const auto& item : value->items) collect(item, folder, files);
  for (const auto& entry : value->entries) collect(entry.value, folder, files);
}

}  // namespace

std::vector<std::string> named_files(const StudyFile& study) {
  std::vector<std::string> files{study.path};
  Problems told_before;
  collect(parse_yaml(study.path, study.yaml, told_before), fs::path(study.path).parent_path(),
          files);
  return files;
}

}  // namespace sunload
