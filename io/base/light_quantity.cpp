// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/light_quantity.h"

#include <array>
#include <cctype>
#include <utility>

namespace sunload {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Longer ones first where one is part of another.
constexpr std::array unit_pairs{Pair{"kWh m-4", "klx h m-2"}, Pair{"kWh m-2", "klx h"},
                                Pair{"kWh", "klm h"}, Pair{"W m-2", "lx"}, Pair{"W", "lm"}};
constexpr std::array name_pairs{Pair{"kwh_m4", "klx_h_m2"}, Pair{"kwh_m2", "klx_h"},
                                Pair{"kwh", "klm_h"}, Pair{"w_m2", "lx"}};
constexpr std::array word_pairs{
    Pair{"irradiance", "illuminance"}, Pair{"incident energy per area", "luminous exposure"},
    Pair{"outgoing diffuse energy per area", "outgoing diffuse light per area"},
    Pair{"power", "luminous flux"}};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Every `from` becomes `to`; whole words only where asked for: power_sun is no word "power".
enum class Match { anywhere, words };
void replace_all(std::string& text, Pair pair, Match match) {
  const auto [from, to] = pair;
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const auto end = at + from.size();
    const bool is_word =
        (at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]));
    if (match == Match::words && !is_word) {
      at = end;
      continue;
    }
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

}  // namespace

std::string dataset_name(std::string name, Quantity quantity) {
  if (quantity == Quantity::illuminance)
    replace_all(name, {"irradiance", "illuminance"}, Match::anywhere);
  return name;
}

std::string light_units(std::string_view units, Quantity quantity) {
  if (quantity == Quantity::illuminance)
    for (const auto& [energy, light] : unit_pairs)
      if (units == energy) return std::string(light);
  return std::string(units);
}

std::string unit_names(std::string names, Quantity quantity) {
  if (quantity == Quantity::illuminance)
    for (const auto& pair : name_pairs) replace_all(names, pair, Match::anywhere);
  return names;
}

std::string light_words(std::string words, Quantity quantity) {
  if (quantity == Quantity::illuminance)
    for (const auto& pair : word_pairs)
      replace_all(words, pair, pair.first == "irradiance" ? Match::anywhere : Match::words);
  return words;
}

}  // namespace sunload
