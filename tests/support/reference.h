// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Reference values of tests/reference, whose README.md says where they are from.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geo/base/vec.h"

namespace sunload::test {

/// One row of a CSV table by column name.
using Row = std::map<std::string, std::string>;

/// Rows of `tests/reference/<name>`; lines that begin with # are comments.
std::vector<Row> read_csv(const std::string& name);

/// A whole `tests/reference/<name>` JSON file.
nlohmann::json read_json(const std::string& name);

/// Its `cases` whose `id` begins with `prefix`; a failure where there are none.
std::vector<nlohmann::json> reference_cases(const std::string& name,
                                            const std::string& prefix = {});

/// A number that the JSON files give as number or as text with all its digits.
double number(const nlohmann::json& value);
double number(const Row& row, const std::string& column);
/// Expects that `ours` is a reference value but for its tolerance, and tells both on one line,
/// which scripts/validate reads.
void expect_reference(const std::string& what, double ours, double truth, double tolerance);
/// A list of three numbers, and one of points.
Vec3 point(const nlohmann::json& value);
std::vector<Vec3> polygon(const nlohmann::json& points);

}  // namespace sunload::test
