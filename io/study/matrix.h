// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Section `matrix` of a study: variants for all combinations of values of some keys.
#pragma once

#include <string>
#include <vector>

#include "io/study/yaml_map.h"

namespace sunload {

/// One value of one key. `path` has the key's parts, each with its place in a list (from 1; 0:
/// none).
struct MatrixValue {
  /// A step of the path: a key, and a place where its value is a list.
  struct Part {
    std::string key;
    std::size_t place = 0;
  };
  std::vector<Part> path;
  YamlTree value;  ///< an empty one removes the key, as in variants
  Where where;
  std::string label;  ///< part of the variant's name: `mirror-0.5`, or the study's own word
};

/// The values of every key, in the order of the file, for so many variants that the study writes;
/// problems are reported.
std::vector<std::vector<MatrixValue>> read_matrix(YamlMap& root, std::size_t variants);

/// Every combination, the last key varying fastest; a single empty one without keys.
std::vector<std::vector<MatrixValue>> combinations(
    const std::vector<std::vector<MatrixValue>>& axes);

/// The tree with the value in its place, merged as a variant's own keys are. Reports places that a
/// list does not have.
YamlTree with_value(const YamlTree& tree, const MatrixValue& value,
                    const std::vector<std::string>& appended, YamlReading& reading);

}  // namespace sunload
