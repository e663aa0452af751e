// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>

#include "io/export/format.h"

namespace sunload {
namespace {

/// A string of VRML97 (5.9): quotes and backslashes are escaped; line ends become blanks.
std::string vrml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + '"';
}

/// Colours in use, numbered as they first come.
class ColourTable {
 public:
  explicit ColourTable(Palette palette) : palette_(palette) { entry_.fill(-1); }

  int operator[](std::int32_t step) {
    auto& entry = entry_.at(static_cast<std::size_t>(step + 1));
    if (entry < 0) {
      entry = count_++;
      const Colour c = export_colour(palette_, step);
      text_ += fmt::format("      {:.4f} {:.4f} {:.4f},\n", c.red, c.green, c.blue);
    }
    return entry;
  }
  const std::string& text() const { return text_; }

 private:
  Palette palette_;
  std::array<int, export_palette_steps + 1> entry_{};  ///< the first is that of -1
  int count_ = 0;
  std::string text_;
};

std::string colour_indices(const ExportColours& colours, ColourTable& table) {
  std::string text;
  if (colours.corner_step.empty())
    for (const auto step : colours.patch_step) text += fmt::format("      {},\n", table[step]);
  for (const auto& steps : colours.corner_step) {
    const int a = table[steps[0]], b = table[steps[1]], c = table[steps[2]];
    text += fmt::format("      {}, {}, {}, -1,\n", a, b, c);
  }
  return text;
}

}  // namespace

void export_vrml(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  const ResultPatches patches(result);
  const auto colours = export_colours(result, rules, patches);
  ColourTable table(colours.palette);
  const std::string indices = colour_indices(colours, table);
  auto& out = target.stream;
  out << "#VRML V2.0 utf8\nWorldInfo {\n  title " << vrml_string(result.text_attribute("title"))
      << "\n  info [ " << vrml_string(export_caption(result, colours.shown)) << ",\n    "
      << vrml_string(fmt::format("colours from {} to {}", colours.least, colours.largest))
      << ",\n    "
      << vrml_string(fmt::format("metres, y up; relative to x, y, z (z up) {}, {}, {}",
                                 patches.origin.x, patches.origin.y, patches.origin.z))
      << " ]\n}\nShape {\n  geometry IndexedFaceSet {\n"
      << "    solid TRUE\n    colorPerVertex " << (colours.corner_step.empty() ? "FALSE" : "TRUE")
      << "\n    coord Coordinate { point [\n";
  // y is up: (x, y, z) → (x, z, −y), which turns no face.
  for (const auto& p : patches.vertices)
    out << fmt::format("      {} {} {},\n", p.x, p.z, 0.0 - p.y);
  out << "    ] }\n    coordIndex [\n";
  for (const auto& c : patches.corners)
    out << fmt::format("      {}, {}, {}, -1,\n", c[0], c[1], c[2]);
  out << "    ]\n    color Color { color [\n"
      << table.text() << "    ] }\n    colorIndex [\n"
      << indices << "    ]\n  }\n}\n";
}

}  // namespace sunload
