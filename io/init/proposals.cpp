// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/proposals.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace sunload {

namespace {

using Row = std::pair<std::string_view, std::string_view>;

// In this order: a window of oak is a window.
constexpr std::array<Row, 38> by_word{{
    {"glass", "double_glazing"},
    {"glaz", "double_glazing"},
    {"window", "double_glazing"},
    {"fenster", "double_glazing"},
    {"fenetre", "double_glazing"},
    {"brick", "brick"},
    {"ziegel", "brick"},
    {"concrete", "concrete"},
    {"beton", "concrete"},
    {"asphalt", "asphalt"},
    {"road", "asphalt"},
    {"street", "asphalt"},
    {"strasse", "asphalt"},
    {"grass", "grass"},
    {"lawn", "grass"},
    {"rasen", "grass"},
    {"leaf", "crown"},
    {"leaves", "crown"},
    {"foliage", "crown"},
    {"tree", "crown"},
    {"baum", "crown"},
    {"tile", "roof_tile"},
    {"roof", "roof_tile"},
    {"dach", "roof_tile"},
    {"slate", "slate"},
    {"plaster", "plaster"},
    {"stucco", "plaster"},
    {"putz", "plaster"},
    {"wood", "wood"},
    {"timber", "wood"},
    {"holz", "wood"},
    {"alumin", "aluminium"},
    {"steel", "steel"},
    {"water", "water"},
    {"stone", "stone"},
    {"paving", "paving"},
    {"gravel", "gravel"},
    {"wall", "plaster"},
}};

constexpr std::array<Row, 10> by_kind{{
    {"SolitaryVegetationObject", "crown"},
    {"PlantCover", "grass"},
    {"Road", "asphalt"},
    {"Railway", "gravel"},
    {"TransportSquare", "paving"},
    {"TransportationComplex", "asphalt"},
    {"WaterBody", "water"},
    {"Waterway", "water"},
    {"LandUse", "grass"},
    {"TINRelief", "grass"},
}};

}  // namespace

std::optional<std::string> proposed_for_name(std::string_view name) {
  std::string small(name);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const auto& [word, material] : by_word)
    if (small.find(word) != std::string::npos) return std::string(material);
  return {};
}

std::optional<std::string> proposed_for_kind(std::string_view kind) {
  const auto found = std::find_if(by_kind.begin(), by_kind.end(),
                                  [&](const Row& row) { return row.first == kind; });
  if (found == by_kind.end()) return {};
  return std::string(found->second);
}

std::string proposed_for_surface(Surface surface) {
  switch (surface) {
    case Surface::wall:
      return "plaster";
    case Surface::roof:
      return "roof_tile";
    case Surface::window:
      return "double_glazing";
    case Surface::ground:
    case Surface::floor:
      return "paving";
    case Surface::other:
      break;
  }
  return "concrete";
}

}  // namespace sunload
