// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "io/base/byte_text.h"
#include "io/export/format.h"

namespace sunload {
namespace {

// VTK File Formats: the second line has at most 256 characters with its end.
constexpr std::size_t longest_title = 255;

/// Numbers of a legacy file are big-endian, whatever the machine.
template <class Number>
void append_big(std::string& text, Number number) {
  append_bytes<std::endian::big>(text, number);
}

/// A string of a binary array: its length in 1, 2 or 4 bytes, told by the two highest bits
/// (vtkDataWriter), and its bytes.
void append_string(std::string& text, const std::string& string) {
  constexpr std::size_t short_end = std::size_t{1} << 6, middle_end = std::size_t{1} << 14;
  const auto length = static_cast<std::uint32_t>(string.size());
  if (string.size() < short_end)
    append_big(text, static_cast<std::uint8_t>(0xC0u | length));
  else if (string.size() < middle_end)
    append_big(text, static_cast<std::uint16_t>(0x8000u | length));
  else
    append_big(text, 0x40000000u | length);
  text += string;
}

std::string array_head(const std::string& name, std::size_t components, std::size_t count,
                       const char* type) {
  return fmt::format("{} {} {} {}\n", name, components, count, type);
}

template <class Number>
std::string array_text(const std::string& name, std::size_t components,
                       const std::vector<Number>& numbers, const char* type) {
  std::string text = array_head(name, components, numbers.size() / components, type);
  for (const auto number : numbers) append_big(text, number);
  return text + "\n";
}

std::string names_text(const std::string& name, const std::vector<std::string>& names) {
  std::string text = array_head(name, 1, names.size(), "string");
  for (const auto& entry : names) append_string(text, entry);
  return text + "\n";
}

std::string one_line(std::string title) {
  std::replace_if(
      title.begin(), title.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (title.size() <= longest_title) return title;
  // Not through the middle of a character of UTF-8.
  std::size_t end = longest_title;
  while (end > 0 && (static_cast<unsigned char>(title[end]) & 0xC0u) == 0x80u) --end;
  return title.substr(0, end);
}

std::string points_text(const ResultPatches& patches) {
  std::string text = fmt::format("POINTS {} double\n", patches.vertices.size());
  for (const auto& p : patches.vertices)
    for (const double coordinate : {p.x, p.y, p.z}) append_big(text, coordinate);
  return text + "\n";
}

std::string triangles_text(const ResultPatches& patches) {
  const std::size_t count = patches.corners.size();
  std::string text = fmt::format("POLYGONS {} {}\n", count, 4 * count);
  for (const auto& corners : patches.corners) {
    append_big(text, std::int32_t{3});
    for (const auto corner : corners) append_big(text, corner);
  }
  return text + "\n";
}

/// Tables that the numbers of the cells point into, and where the scene is.
std::string field_text(const ResultReader& result, const ResultPatches& patches) {
  std::string text = "FIELD FieldData 4\n";
  text += array_text<double>("origin", 3, {patches.origin.x, patches.origin.y, patches.origin.z},
                             "double");
  for (const char* name : {"object_name", "facade_name", "material_name"})
    text += names_text(name, result.strings(name));
  return text;
}

}  // namespace

void export_vtk(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  const ResultPatches patches(result);
  const auto shown = export_quantity(result, rules);
  std::vector<std::string> arrays;
  for (const char* name :
       {"patch_object", "patch_facade", "patch_material", "patch_surface", "patch_side"})
    arrays.push_back(array_text(name, 1, result.integers(name), "int"));
  for (const auto& name : patch_datasets(result, PatchDatasets::totals))
    arrays.push_back(array_text(name, 1, result.doubles(name), "double"));
  if (shown.is_series || shown.is_derived)
    arrays.push_back(array_text(shown.dataset, 1, shown.values, "double"));

  auto& out = target.stream;
  out << "# vtk DataFile Version 3.0\n"
      << one_line(export_caption(result, shown)) << "\nBINARY\nDATASET POLYDATA\n"
      << field_text(result, patches) << points_text(patches) << triangles_text(patches)
      << fmt::format("CELL_DATA {}\nFIELD FieldData {}\n", patches.corners.size(), arrays.size());
  for (const auto& array : arrays) out << array;
}

}  // namespace sunload
