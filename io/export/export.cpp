// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/export.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <iostream>

#include "geo/base/check.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"
#include "io/export/format.h"

namespace sunload {
namespace {

enum class Content : std::uint8_t { text, bytes, reference };
enum class Colours : std::uint8_t { none, of_patches, of_corners };
enum class Parts : std::uint8_t { whole, named };  ///< whether it can hold some of the scene alone

struct ExportFormat {
  std::string_view word;
  ExportWriter write;
  Content content;  ///< reference: names the result by its path from the file
  Colours colours;  ///< finest that the format has
  Parts parts = Parts::whole;
};

constexpr std::array formats{
    ExportFormat{"csv", export_csv, Content::text, Colours::none, Parts::named},
    ExportFormat{"vtk", export_vtk, Content::bytes, Colours::none},
    ExportFormat{"xdmf", export_xdmf, Content::reference, Colours::none},
    ExportFormat{"glb", export_glb, Content::bytes, Colours::of_corners},
    ExportFormat{"vrml", export_vrml, Content::text, Colours::of_corners},
    ExportFormat{"ply", export_ply, Content::bytes, Colours::of_patches},
    ExportFormat{"cityjson", export_cityjson, Content::text, Colours::none},
    ExportFormat{"gpkg", export_geopackage, Content::bytes, Colours::none, Parts::named},
    ExportFormat{"energyplus", export_energyplus, Content::text, Colours::none, Parts::named},
};

const ExportFormat& chosen_format(const std::string& word) {
  for (const auto& format : formats)
    if (format.word == word) return format;
  throw InputError({}, "--to " + word, "no such format",
                   fmt::format("write one of: {}", fmt::join(export_formats(), ", ")));
}

/// Options that the format would not heed are refused, not dropped.
void expect_heeded(const ExportFormat& format, const ExportRules& rules, const std::string& path) {
  Problems problems;
  const std::string to = "--to " + std::string(format.word);
  if (format.colours == Colours::none && (rules.palette || rules.largest))
    problems.add({}, to + " has no colours", "--colour and --max are for colours",
                 "leave them out, or export to glb, vrml or ply");
  if (format.colours != Colours::of_corners && (rules.interpolate || rules.crease_angle_deg))
    problems.add({}, to + " has one value per patch",
                 "--interpolate and --crease-angle are for colours of corners",
                 "leave them out, or export to glb or vrml");
  if (rules.crease_angle_deg && !rules.interpolate)
    problems.add({}, "--crease-angle without --interpolate",
                 "patches of one colour have no creases", "add --interpolate");
  if (rules.crease_angle_deg && !(*rules.crease_angle_deg >= 0 && *rules.crease_angle_deg <= 180))
    problems.add({}, fmt::format("--crease-angle {}", *rules.crease_angle_deg),
                 "must lie in [0, 180] degrees", "20 joins the facets of round towers");
  if (rules.light_map && format.write != export_glb)
    problems.add({}, "--lightmap with " + to, "it has no texture", "use --to glb");
  if (!rules.model.empty() && format.write != export_cityjson)
    problems.add({}, "--model with " + to, "only city models get values back", "use --to cityjson");
  if (!rules.of.empty() && format.write != export_csv)
    problems.add({}, "--of with " + to, "it chooses the rows of a table", "use --to csv");
  if (!rules.parts.empty() && format.parts != Parts::named)
    problems.add({}, "--facade, --object and --sensor with " + to, "it holds the whole scene",
                 "leave them out, or export to csv or gpkg");
  if (format.content != Content::text && path.empty())
    problems.add({}, to + " needs a file", "it is not written to the standard output",
                 "add -o FILE." + std::string(format.word));
  problems.throw_if_any();
}

/// What is derived has patches, and neither times nor sums of what a result holds.
void expect_fit_for_derived(const ResultReader& result, const ExportFormat& format,
                            const ExportRules& rules) {
  if (!result.is_derived()) return;
  const std::string what = result.is_comparison() ? "a comparison" : "a map of a place";
  if (format.write == export_xdmf || format.write == export_energyplus)
    throw InputError({result.path()}, "--to " + std::string(format.word) + " of " + what,
                     "it has no series", "export to csv, gpkg, vtk, glb, vrml, ply or cityjson");
  if (!(rules.of.empty() || rules.of == "patch") || rules.quantity == "series")
    throw InputError({result.path()}, "a table of groups of " + what,
                     result.is_comparison() ? "sunload compare --csv writes it"
                                            : "sunload explain --csv writes that of objects",
                     "leave out --of, or take the results");
}

/// A part of the period chooses totals, and rows of series.
void expect_part_heeded(const ResultReader& result, const ExportFormat& format,
                        const ExportRules& rules) {
  if (!result.chosen().any()) return;
  const std::string option = "--" + result.chosen().words();
  if (!rules.time.empty())
    throw InputError({}, "--time with " + option,
                     "one is an instant, the other a part of the period", "leave out one");
  if (format.write == export_xdmf || format.write == export_energyplus)
    throw InputError({}, "--to " + std::string(format.word) + " with " + option,
                     "it holds the whole series", "leave it out");
}

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> words;
  words.reserve(formats.size() + 1);
  for (const auto& format : formats) words.emplace_back(format.word);
  words.emplace_back(form_factors_word);
  return words;
}

void export_result(const ResultReader& result, const ExportRules& rules, const std::string& path) {
  const auto& format = chosen_format(rules.format);
  expect_heeded(format, rules, path);
  expect_fit_for_derived(result, format, rules);
  expect_part_heeded(result, format, rules);
  if (path.empty()) return format.write(result, rules, {std::cout, path});
  FileAside file(path);
  errno = 0;
  std::ofstream stream(file.aside(), std::ios::binary);
  if (!stream) throw_cannot_write(path, errno);
  format.write(result, rules, {stream, path});
  stream.close();
  if (!stream) throw_cannot_write(path, errno);
  file.publish();
}

}  // namespace sunload
