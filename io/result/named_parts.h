// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a command's --facade, --object, --selection and --sensor choose of a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/result/reader.h"

namespace sunload {

/// Names or patterns (`house_3/*`); of sensors their numbers, from 0.
struct NamedParts {
  std::vector<std::string> facades, objects, sensors;
  std::vector<std::string> selections = {};

  bool choose_patches() const {
    return !facades.empty() || !objects.empty() || !selections.empty();
  }
  bool empty() const { return !choose_patches() && sensors.empty(); }
};

// Indices in the order of the file; all where nothing is named. They throw InputError for a name
// that the result does not have, and tell near ones.
std::vector<std::size_t> chosen_facades(const ResultReader& result, const NamedParts& parts);
std::vector<std::size_t> chosen_objects(const ResultReader& result, const NamedParts& parts);
std::vector<std::size_t> chosen_sensors(const ResultReader& result, const NamedParts& parts);
std::vector<std::size_t> chosen_selections(const ResultReader& result, const NamedParts& parts);
/// Patches of the facades and those of the objects and selections, both sides.
std::vector<std::size_t> chosen_patches(const ResultReader& result, const NamedParts& parts);

/// What to tell of two results whose scenes are turned against each other; empty: they are not.
std::string different_north_in_words(const ResultReader& base, const ResultReader& variant);

/// Names of the study's selections; none where it has none.
std::vector<std::string> selection_names(const ResultReader& result);
/// Per patch 0 where it is of the selection, else -1.
std::vector<std::int32_t> selection_entries(const ResultReader& result, std::size_t selection);
/// "0", "1" …: what sensors are called.
std::vector<std::string> sensor_names(const ResultReader& result);

}  // namespace sunload
