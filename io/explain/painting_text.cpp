// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/base/json_text.h"
#include "io/base/text.h"
#include "io/explain/painting.h"

namespace sunload {

namespace {

constexpr std::size_t rows_shown = 15;  // of each kind, a screen; CSV and JSON have all
constexpr std::size_t texts = 3;        // keys before the numbers

std::vector<std::string> keys_of(const Painting& painting) {
  std::vector<std::string> keys{"row", "material", "object", "area_m2", "reflectance"};
  for (const char* key : {"change_kwh_m2", "se_kwh_m2", "per_100_m2_kwh_m2"})
    keys.push_back(unit_names(key, painting.quantity));
  return keys;
}

std::vector<double> numbers_of(const PaintedRow& row) {
  return {row.area_m2, row.reflectance, row.change, row.se, row.per_100_m2()};
}

std::string kind_name(const PaintedRow& row) {
  return row.kind == PaintedRow::Kind::material ? "material" : "surface";
}

std::string words_of(const PaintedRow& row) {
  return row.kind == PaintedRow::Kind::material ? row.material : row.object + ": " + row.material;
}

std::string table(const std::vector<PaintedRow>& rows, const std::string& title) {
  std::size_t width = title.size();
  const std::size_t shown = std::min(rows.size(), rows_shown);
  for (std::size_t k = 0; k < shown; ++k) width = std::max(width, words_of(rows[k]).size());
  std::string text = fmt::format("{:{}}  {:>10}  {:>11}  {:>10}  {:>9}  {:>10}\n", title, width,
                                 "area m²", "reflectance", "+0.1", "± se", "per 100 m²");
  for (std::size_t k = 0; k < shown; ++k) {
    const PaintedRow& row = rows[k];
    text += fmt::format("{:{}}  {:>10.1f}  {:>11.3f}  {:>10.4g}  {:>9}  {:>10.3g}\n", words_of(row),
                        width, row.area_m2, row.reflectance, row.change,
                        std::isnan(row.se) ? "" : fmt::format("{:.2g}", row.se), row.per_100_m2());
  }
  if (rows.size() > shown)
    text += fmt::format("{} more with less; --csv has all\n", rows.size() - shown);
  return text;
}

}  // namespace

std::string painting_text(const Painting& painting) {
  const std::string units = display_units(painting.units);
  std::string text = fmt::format("{} of {}, variant {} ({})", painting.place, painting.study,
                                 painting.variant, painting.extent);
  if (!painting.part.empty()) text += ", " + painting.part;
  text += fmt::format(": has {:.5g} {}, and more of it where diffuse reflectances rise by 0.1\n\n",
                      painting.load, units);
  for (const auto& [kind, title] : {std::pair(PaintedRow::Kind::material, "material, everywhere"),
                                    std::pair(PaintedRow::Kind::surface, "surface")}) {
    std::vector<PaintedRow> rows;
    std::copy_if(painting.rows.begin(), painting.rows.end(), std::back_inserter(rows),
                 [of = kind](const PaintedRow& row) { return row.kind == of; });
    text += table(rows, title) + (kind == PaintedRow::Kind::material ? "\n" : "");
  }
  return text;
}

std::string painting_csv(const Painting& painting) {
  std::string text = fmt::format("{}\n", fmt::join(keys_of(painting), ","));
  for (const auto& row : painting.rows) {
    text += kind_name(row) + "," + csv_text(row.material) + "," + csv_text(row.object);
    for (const double value : numbers_of(row)) text += "," + csv_number(value);
    text += "\n";
  }
  return text;
}

std::string painting_json(const Painting& painting) {
  using Json = nlohmann::ordered_json;
  const auto keys = keys_of(painting);
  Json rows = Json::array();
  for (const auto& row : painting.rows) {
    Json entry{
        {"row", kind_name(row)},
        {"material", row.material},
        {"object", row.kind == PaintedRow::Kind::surface ? Json(row.object) : Json(nullptr)}};
    const auto numbers = numbers_of(row);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      entry[keys[k + texts]] = json_number(numbers[k]);
    rows.push_back(std::move(entry));
  }
  const Json document = {{"study", painting.study},
                         {"variant", painting.variant},
                         {"place", painting.place},
                         {"part", painting.part.empty() ? Json(nullptr) : Json(painting.part)},
                         {"extent", painting.extent},
                         {"units", painting.units},
                         {"light_load", painting.load},
                         {"rows", rows}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sunload
