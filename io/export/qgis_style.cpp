// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/qgis_style.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace sunload {
namespace {

constexpr int classes = 10;
constexpr double far_beyond = std::numeric_limits<float>::max();

std::string colour_text(Colour colour) {
  const auto byte = [](double channel) { return std::lround(channel * 255); };  // of 8 bits
  return fmt::format("{},{},{},255", byte(colour.red), byte(colour.green), byte(colour.blue));
}

/// One way to draw the features of a class.
std::string symbol(int number, const std::string& colour, StyledAs as) {
  const auto options = [](std::initializer_list<std::pair<const char*, std::string>> list) {
    std::string text = "<Option type=\"Map\">";
    for (const auto& [name, value] : list)
      text += fmt::format(R"(<Option type="QString" name="{}" value="{}"/>)", name, value);
    return text + "</Option>";
  };
  const auto layer = [&](const char* type, const char* of, const std::string& values) {
    return fmt::format(R"(<symbol type="{}" name="{}" alpha="1" clip_to_extent="1">)"
                       R"(<layer class="{}" enabled="1" pass="0" locked="0">{}</layer></symbol>)",
                       type, number, of, values);
  };
  switch (as) {
    case StyledAs::areas:
      return layer("fill", "SimpleFill",
                   options({{"color", colour}, {"style", "solid"}, {"outline_style", "no"}}));
    case StyledAs::outlines:
      return layer("fill", "SimpleFill",
                   options({{"color", colour},
                            {"style", "solid"},
                            {"outline_color", colour},
                            {"outline_style", "solid"},
                            {"outline_width", "0.8"},
                            {"outline_width_unit", "MM"}}));
    case StyledAs::dots:
      break;
  }
  return layer("marker", "SimpleMarker",
               options({{"name", "circle"},
                        {"color", colour},
                        {"outline_style", "no"},
                        {"size", "2"},
                        {"size_unit", "MM"}}));
}

}  // namespace

std::string qgis_style(const std::string& column, StyleRange range, Palette palette, StyledAs as) {
  std::string ranges, symbols;
  for (int k = 0; k < classes; ++k) {
    const auto bound = [&](int c) {
      return range.least + (range.largest - range.least) * c / classes;
    };
    const double lower = bound(k), upper = bound(k + 1);
    const bool is_last = k + 1 == classes, has_more_below = k == 0 && range.least < 0;
    const std::string from = has_more_below ? std::string("… ") : fmt::format("{:.4g} … ", lower);
    ranges += fmt::format(
        R"(<range lower="{:.9g}" upper="{:.9g}" symbol="{}" label="{}" render="true"/>)",
        has_more_below ? -far_beyond : lower, is_last ? far_beyond : upper, k,
        is_last ? from : from + fmt::format("{:.4g}", upper));
    symbols += symbol(k, colour_text(map_colour(palette, (k + 0.5) / classes)), as);
  }
  return fmt::format(
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>"
      R"(<qgis version="3.22" styleCategories="Symbology">)"
      R"(<renderer-v2 type="graduatedSymbol" attr="{}" graduatedMethod="GraduatedColor" )"
      R"(symbollevels="0" enableorderby="0" forceraster="0">)"
      "<ranges>{}</ranges><symbols>{}</symbols></renderer-v2></qgis>",
      column, ranges, symbols);
}

}  // namespace sunload
