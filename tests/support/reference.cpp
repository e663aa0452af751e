// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <stdexcept>

#include "tests/support/paths.h"

namespace sunload::test {

namespace {

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.push_back(cell);
      cell.clear();
    } else if (c != '\r') {
      cell += c;
    }
  }
  cells.push_back(cell);
  return cells;
}

std::ifstream open_reference(const std::string& name) {
  std::ifstream file(source_folder() + "/tests/reference/" + name);
  if (!file) throw std::runtime_error("cannot read tests/reference/" + name);
  return file;
}

}  // namespace

std::vector<Row> read_csv(const std::string& name) {
  auto file = open_reference(name);
  std::vector<std::string> header;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto cells = split_line(line);
    if (header.empty()) {
      header = cells;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < header.size() && i < cells.size(); ++i) row[header[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

nlohmann::json read_json(const std::string& name) {
  auto file = open_reference(name);
  return nlohmann::json::parse(file);
}

std::vector<nlohmann::json> reference_cases(const std::string& name, const std::string& prefix) {
  const auto file = read_json(name);
  std::vector<nlohmann::json> chosen;
  for (const auto& c : file.at("cases"))
    if (c.at("id").get<std::string>().starts_with(prefix)) chosen.push_back(c);
  EXPECT_FALSE(chosen.empty()) << "no case " << prefix << " in tests/reference/" << name;
  return chosen;
}

double number(const nlohmann::json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

Vec3 point(const nlohmann::json& value) {
  return {number(value[0]), number(value[1]), number(value[2])};
}

std::vector<Vec3> polygon(const nlohmann::json& points) {
  std::vector<Vec3> corners;
  for (const auto& value : points) corners.push_back(point(value));
  return corners;
}

void expect_reference(const std::string& what, double ours, double truth, double tolerance) {
  const std::string text =
      fmt::format("{}: value {:.10g}, truth {:.10g}, off by {:.3g}, limit {:.3g}", what, ours,
                  truth, ours - truth, tolerance);
  std::cout << text << "\n";
  EXPECT_NEAR(ours, truth, tolerance) << text;
}

}  // namespace sunload::test
