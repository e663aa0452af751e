// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/base/byte_text.h"
#include "io/export/format.h"

namespace sunload {
namespace {

template <class Number>
void append_little(std::string& bytes, Number number) {
  append_bytes<std::endian::little>(bytes, number);
}

std::string comment(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return "comment " + text + "\n";
}

/// One number per face under its name.
struct Property {
  std::string name;
  std::vector<double> values;
};

std::vector<Property> face_properties(const ResultReader& result, const ShownQuantity& shown) {
  std::vector<Property> properties;
  for (const auto& name : patch_datasets(result, PatchDatasets::totals))
    properties.push_back({name, result.doubles(name)});
  if (shown.is_series || shown.is_derived) properties.push_back({shown.dataset, shown.values});
  return properties;
}

std::string head(const ResultReader& result, const ResultPatches& patches,
                 const ExportColours& colours, const std::vector<Property>& properties) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += comment(export_caption(result, colours.shown));
  text += comment(fmt::format("colours from {} to {}", colours.least, colours.largest));
  text += comment(fmt::format("metres, z up; relative to {} {} {}", patches.origin.x,
                              patches.origin.y, patches.origin.z));
  for (std::size_t k = 0; k < patches.object_names.size(); ++k)
    text += comment(fmt::format("object {} {}", k, patches.object_names[k]));
  text += fmt::format("element vertex {}\n", patches.vertices.size());
  for (const char axis : {'x', 'y', 'z'}) text += fmt::format("property double {}\n", axis);
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                      patches.corners.size());
  for (const char* channel : {"red", "green", "blue"})
    text += fmt::format("property uchar {}\n", channel);
  text += "property int object\n";
  for (const auto& property : properties) text += "property double " + property.name + "\n";
  return text + "end_header\n";
}

}  // namespace

void export_ply(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  const ResultPatches patches(result);
  const auto colours = export_colours(result, rules, patches);
  const auto properties = face_properties(result, colours.shown);
  std::string bytes = head(result, patches, colours, properties);
  for (const auto& p : patches.vertices)
    for (const double coordinate : {p.x, p.y, p.z}) append_little(bytes, coordinate);
  for (std::size_t i = 0; i < patches.corners.size(); ++i) {
    append_little(bytes, std::uint8_t{3});
    for (const auto corner : patches.corners[i]) append_little(bytes, corner);
    const Colour c = export_colour(colours.palette, colours.patch_step[i]);
    for (const double channel : {c.red, c.green, c.blue})
      append_little(bytes, static_cast<std::uint8_t>(std::lround(255 * channel)));
    append_little(bytes, patches.object[i]);
    for (const auto& property : properties) append_little(bytes, property.values[i]);
  }
  target.stream << bytes;
}

}  // namespace sunload
