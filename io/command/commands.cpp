// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <set>

#include "geo/base/check.h"
#include "io/base/bands.h"
#include "io/base/exit_code.h"
#include "io/base/output_target.h"
#include "io/base/standard_streams.h"
#include "io/command/study_scenes.h"
#include "io/picture/picture.h"
#include "io/plan/scene_edit.h"
#include "io/plan/scene_models.h"
#include "io/report/compare.h"
#include "io/report/info.h"
#include "io/report/measures.h"
#include "io/result/lacking.h"
#include "io/result/patches_csv.h"
#include "io/run/options.h"
#include "io/run/work_folder.h"
#include "io/scene/builtin.h"
#include "io/scene/cityjson/write.h"
#include "io/scene/mesh_files/obj_write.h"
#include "io/study/material_table.h"
#include "io/study/named_files.h"

namespace sunload {
namespace {

/// The result of a study's variant.
std::string result_named(const CompareOptions& options, const StudyFile& study,
                         const std::string& variant) {
  RunOptions chosen;
  chosen.output = options.output;
  chosen.variants = {variant};
  return result_path(results_folder(study, chosen), chosen_variants(study, chosen).front());
}

/// With the files of a study's variants in place of their names.
CompareOptions with_files(CompareOptions options, const StudyFile& study) {
  auto& names = options.variants;
  if (names.size() == 1) names.insert(names.begin(), study.variants.front().variant);
  for (auto& name : names) name = result_named(options, study, name);
  options.base = names.front();
  names.erase(names.begin());
  return options;
}

/// Results know the study as it was.
void note_changes_of(const StudyFile& study, const ResultReader& result) {
  const auto text = result.strings("study_yaml");
  if (!text.empty() && text.front() != study.yaml)
    tell("note: " + study.path + " is not as it was when " + result.path() + " was computed");
}

void expect_one_variant(const CompareOptions& options) {
  if (options.variants.size() == 1) return;
  if (options.format != CompareOptions::Format::table)
    throw InputError({}, "--csv and --json take one variant", "their header has no column for it",
                     "call compare once per variant");
  if (!options.differences.empty())
    throw InputError({}, "--hdf5 takes one variant", "a file holds one comparison",
                     "call compare once per variant");
}

std::string text_of(const Comparison& comparison, CompareOptions::Format format) {
  switch (format) {
    case CompareOptions::Format::csv:
      return comparison_csv(comparison);
    case CompareOptions::Format::json:
      return comparison_json(comparison);
    case CompareOptions::Format::table:
      break;
  }
  return comparison_table(comparison);
}

/// The table that was asked for, or that the names are of.
InfoOptions::What table_asked_for(const InfoOptions& options) {
  using What = InfoOptions::What;
  if (options.what.size() > 1)
    throw InputError({},
                     "--patches, --facades, --objects, --orientations, --sensors and --measures "
                     "are one table each",
                     "two of them are asked for", "call info once for each");
  if (!options.what.empty()) return options.what.front();
  std::vector<What> of_names;
  if (!options.parts.facades.empty()) of_names.push_back(What::facades);
  if (!options.parts.objects.empty()) of_names.push_back(What::objects);
  if (!options.parts.selections.empty()) of_names.push_back(What::selections);
  if (!options.parts.sensors.empty()) of_names.push_back(What::sensors);
  if (of_names.size() > 1)
    throw InputError({}, "names of more than one kind", "there is a table for each kind",
                     "call info once for each, or list their --patches");
  return of_names.empty() ? What::screen : of_names.front();
}

InfoOptions::What asked_for(const InfoOptions& options) {
  using What = InfoOptions::What;
  const What what = table_asked_for(options);
  if (what == What::screen && options.format != InfoOptions::Format::text)
    throw InputError({}, "--csv and --json are of tables", "the screen is for people",
                     "add --facades, --objects, --orientations, --selections, --sensors, "
                     "--measures or --patches");
  if (what == What::patches && options.format == InfoOptions::Format::json)
    throw InputError({}, "--patches with --json", "it is CSV", "leave out --json");
  if (what == What::patches && !options.parts.sensors.empty())
    throw InputError({}, "--patches with --sensor", "sensors are no patches", "write --sensors");
  return what;
}

void print_table(const ResultReader& result, TableOf of, const InfoOptions& options) {
  const GroupTable table = group_table(result, of, options.parts);
  switch (options.format) {
    case InfoOptions::Format::csv:
      std::cout << group_table_csv(table);
      return;
    case InfoOptions::Format::json:
      std::cout << group_table_json(result, table);
      return;
    case InfoOptions::Format::text:
      break;
  }
  std::cout << group_table_text(result, table);
}

void print_measures(const ResultReader& result, const InfoOptions& options) {
  const auto rows = measure_table(result, options.parts);
  switch (options.format) {
    case InfoOptions::Format::csv:
      std::cout << measure_table_csv(result, rows);
      return;
    case InfoOptions::Format::json:
      std::cout << measure_table_json(result, rows);
      return;
    case InfoOptions::Format::text:
      break;
  }
  std::cout << measure_table_text(result, rows);
}

/// The scene of a study before any light: kinds of surface, or materials.
int render_study(RenderOptions options) {
  if (!options.has_colours) options.rules.colours = PictureColours::of_surfaces;
  const bool is_of_light = options.rules.colours == PictureColours::of_values ||
                           options.rules.colours == PictureColours::of_bands;
  if (is_of_light || options.animate || options.result.period.any() || !options.result.band.empty())
    throw InputError({options.result.path}, "a study has no light yet",
                     "its scene is drawn by kinds of surface or by materials",
                     "write --colour surface or --colour material, or run it and draw the result");
  const StudyFile file = read_study(options.result.path);
  RunOptions chosen;
  if (!options.variant.empty()) chosen.variants = {options.variant};
  const auto scenes = study_scenes(file, {chosen_variants(file, chosen).front()}, options.picture);
  render_png(ResultReader(scenes.front().path()), options.rules, options.picture);
  return exit_code::done;
}

void write_scene(const PolygonModel& model, const std::string& path, Repair repair = Repair::safe,
                 double crs_unit_m = 1) {
  if (path.ends_with(".obj")) return tell_warnings(write_obj(model, path, repair));
  if (path.ends_with(".json")) return write_cityjson(model, path, crs_unit_m);
  throw InputError({path}, "is of no format that scenes are written in", "",
                   "let its name end in .obj or .city.json");
}

/// Of the scene, and of what goes with it.
void expect_scene_not_read(const std::string& path, const std::vector<std::string>& inputs) {
  expect_not_read(path, inputs);
  if (path.ends_with(".obj")) expect_not_read(obj_library(path), inputs, path);
}

/// Of materials that the study or the table defines a model's file keeps the names.
void warn_of_names_alone(const SceneStudy& scene, const PolygonModel& model,
                         const std::string& path) {
  std::set<std::string> all, tabled;
  for (const FileMaterial& material : model.materials) {
    if (!material.is_reference) continue;
    all.insert(material.name);
    const bool is_of_study = std::ranges::any_of(
        scene.materials, [&](const MaterialStudy& of) { return of.name == material.name; });
    if (!is_of_study) tabled.insert(material.name + ": {}");
  }
  if (all.empty()) return;
  tell_warnings({message(
      {path},
      fmt::format("of {} it has the names alone, not what they reflect and let pass, nor two sides",
                  fmt::join(all, ", ")),
      "a study of the file takes them for grey and opaque",
      tabled.empty()
          ? std::string("write them into its scene.materials as in this study")
          : fmt::format("scene.materials: {{{}}} takes the table's{}", fmt::join(tabled, ", "),
                        tabled.size() < all.size() ? "; others as in this study" : ""))});
}

/// The model of a study's variant, with its steps done.
int write_edited(const BuiltinOptions& options) {
  if (!options.parameters.empty())
    throw InputError({}, "--set " + options.parameters.front(), "the study says what its scene is",
                     "change the study, or choose one of its variants with --variant");
  const StudyFile file = read_study(options.name);
  RunOptions chosen;
  if (!options.variant.empty()) chosen.variants = {options.variant};
  const Study study = chosen_variants(file, chosen).front();
  expect_scene_not_read(options.path, named_files(file));
  PolygonModel model = edited(read_models(study), study).model;
  expect_scene_not_read(options.path, model.files);
  if (!study.site.crs.empty()) model.crs = study.site.crs;
  tell_warnings(model.warnings);
  for (const auto& note : model.notes) tell("note: " + note);
  write_scene(model, options.path, study.scene.repair, crs_unit_m(study.scene, model.crs));
  warn_of_names_alone(study.scene, model, options.path);
  return exit_code::done;
}

}  // namespace

std::optional<std::size_t> chosen_band(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional(band_by_name(name));
}

std::unique_ptr<const ResultReader> opened(const NamedResult& named, Opens opens) {
  auto result = std::make_unique<ResultReader>(named.path, chosen_band(named.band), opens);
  result->choose(named.period);
  warn_of_lacking(*result);
  return result;
}

int print_info(const InfoOptions& options) {
  using What = InfoOptions::What;
  const What what = asked_for(options);
  const auto reader = opened(options.result);
  const ResultReader& result = *reader;
  switch (what) {
    case What::screen:
      std::cout << info_text(result);
      break;
    case What::patches:
      std::cout << patches_csv(result, options.parts);
      break;
    case What::measures:
      print_measures(result, options);
      break;
    case What::facades:
      print_table(result, TableOf::facades, options);
      break;
    case What::objects:
      print_table(result, TableOf::objects, options);
      break;
    case What::orientations:
      print_table(result, TableOf::orientations, options);
      break;
    case What::selections:
      print_table(result, TableOf::selections, options);
      break;
    case What::sensors:
      print_table(result, TableOf::sensors, options);
      break;
  }
  return exit_code::done;
}

int compare(const CompareOptions& asked) {
  const auto study = is_study(asked.base) ? std::optional(read_study(asked.base)) : std::nullopt;
  const CompareOptions options = study ? with_files(asked, *study) : asked;
  expect_one_variant(options);
  // Of a study only now the names of its results are known.
  std::vector<std::string> inputs = options.variants;
  inputs.push_back(options.base);
  expect_not_read(options.differences, inputs);
  const auto read_base = opened({options.base, options.band, options.period});
  const ResultReader& base = *read_base;
  for (const auto& path : options.variants) {
    const auto read_variant = opened({path, options.band, options.period});
    const ResultReader& variant = *read_variant;
    if (study) note_changes_of(*study, variant);
    Comparison comparison = compare_results(
        base, variant,
        {.dataset = options.quantity,
         .least_percent = options.least_percent,
         .storey_m = options.storey_m > 0 ? std::optional(options.storey_m) : std::nullopt});
    if (!options.differences.empty())
      write_comparison_hdf5(comparison, base, variant, options.differences);
    keep_named(comparison, options.parts, path);
    if (options.format != CompareOptions::Format::csv) {
      const Verdicts verdicts = verdicts_of_both(base, variant);
      comparison.measures = measure_changes(verdicts, options.parts);
      for (auto& note : notes_on_verdicts(verdicts)) comparison.notes.push_back(std::move(note));
    }
    // The table and JSON have them among what they tell.
    if (options.format == CompareOptions::Format::csv)
      for (const auto& note : comparison.notes) tell("note: " + note);
    std::cout << text_of(comparison, options.format);
    if (options.format == CompareOptions::Format::table)
      std::cout << measure_changes_text(comparison.measures);
  }
  return exit_code::done;
}

namespace {

/// `1600x1000`, and nothing before, between or behind.
bool read_size(const std::string& text, int& width, int& height) {
  const char* const end = text.data() + text.size();
  const auto across = std::from_chars(text.data(), end, width);
  if (across.ec != std::errc() || across.ptr == end || *across.ptr != 'x') return false;
  const auto down = std::from_chars(across.ptr + 1, end, height);
  return down.ec == std::errc() && down.ptr == end;
}

}  // namespace

int render(RenderOptions options) {
  RenderRules& rules = options.rules;
  if (!read_size(options.size, rules.width, rules.height))
    throw InputError({}, "--size " + options.size, "not a size", "write e.g. 1600x1000");
  expect_picture_name(options.picture);
  if (is_study(options.result.path)) return render_study(options);
  if (!options.variant.empty())
    throw InputError({}, "--variant without a study", "a result is of one variant",
                     "name the result of the variant, or the study");
  if (!rules.time.empty() && options.result.period.any())
    throw InputError({}, "--time with --" + options.result.period.words(),
                     "one is an instant, the other a part of the period", "leave out one");
  const auto result = opened(options.result, Opens::derived_too);
  options.animate ? render_animation(*result, rules, options.picture)
                  : render_png(*result, rules, options.picture);
  return exit_code::done;
}

int write_builtin(const BuiltinOptions& options) {
  const bool is_study = options.name.ends_with(".yaml") || options.name.ends_with(".yml");
  if (!is_study && !options.variant.empty())
    throw InputError({}, "--variant of a built-in scene", "variants are a study's",
                     "write --set parameter=value, or a study (.yaml)");
  if (is_study) return write_edited(options);
  BuiltinRules rules{options.name, {}};
  for (const auto& set : options.parameters) {
    const auto equals = set.find('=');
    if (equals == std::string::npos)
      throw InputError({}, "--set " + set, "no '='", "write --set parameter=value");
    rules.parameters[set.substr(0, equals)] = set.substr(equals + 1);
  }
  write_scene(builtin_scene(rules), options.path);
  return exit_code::done;
}

}  // namespace sunload
