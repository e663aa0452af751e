// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/base/json_text.h"
#include "io/base/text.h"
#include "io/report/info.h"

namespace sunload {
namespace {

constexpr std::size_t widest_name = 48;

/// Right-aligned cells below their head.
class TextColumn {
 public:
  explicit TextColumn(const TableColumn& column) : heads_{column.word, column.units} {
    for (const double value : column.values) cells_.push_back(cell_text(value, column.format));
    for (const auto* texts : {&heads_, &cells_})
      for (const auto& text : *texts) width_ = std::max(width_, fmt::formatted_size("{}", text));
  }
  std::string head(std::size_t line) const { return fmt::format("  {:>{}}", heads_[line], width_); }
  std::string row(std::size_t row) const { return fmt::format("  {:>{}}", cells_[row], width_); }
  bool is_empty() const {
    return std::all_of(cells_.begin(), cells_.end(), [](auto& text) { return text == "-"; });
  }

 private:
  std::vector<std::string> heads_, cells_;
  std::size_t width_ = 0;
};

const char* word_of(TableOf of) {
  constexpr std::array words{"facades", "objects", "orientations", "selections", "sensors"};
  return words[static_cast<std::size_t>(of)];
}

std::string variant_words(const ResultReader& result) {
  const auto study = result.text_attribute("study");
  return fmt::format("{}, variant {}", study.empty() ? result.text_attribute("title") : study,
                     result.text_attribute("variant"));
}

}  // namespace

std::string group_table_text(const ResultReader& result, const GroupTable& table) {
  std::vector<TextColumn> columns;
  for (const auto& column : table.columns)
    if (TextColumn text(column); !text.is_empty()) columns.push_back(std::move(text));
  std::size_t width = 4;
  for (const auto& name : table.names) width = std::max(width, std::min(name.size(), widest_name));
  std::string text =
      fmt::format("{}: {} {}\n", variant_words(result), table.names.size(), word_of(table.of));
  for (const std::size_t line : {0U, 1U}) {
    text += fmt::format("{:<{}}", line == 0 ? "name" : "", width);
    for (const auto& column : columns) text += column.head(line);
    text += "\n";
  }
  for (std::size_t row = 0; row < table.names.size(); ++row) {
    text += fmt::format("{:<{}}", table.names[row], width);
    for (const auto& column : columns) text += column.row(row);
    text += "\n";
  }
  return text + "±: standard error over realizations; largest: of any " +
         (table.of == TableOf::sensors ? "instant\n" : "patch at any instant\n");
}

std::string group_table_json(const ResultReader& result, const GroupTable& table) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (std::size_t row = 0; row < table.names.size(); ++row) {
    Json& object = rows.emplace_back(Json{{"name", table.names[row]}});
    for (const auto& column : table.columns) {
      const double value = column.values[row];
      object[column.key] = json_number(value);
    }
  }
  const Json document = {{"study", result.text_attribute("study")},
                         {"variant", result.text_attribute("variant")},
                         {"table", word_of(table.of)},
                         {"rows", rows}};
  // Names may be anything.
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sunload
