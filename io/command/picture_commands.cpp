// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <tuple>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/command/commands.h"
#include "io/command/common_options.h"
#include "io/command/sub_commands.h"
#include "io/export/export.h"

namespace sunload {
namespace {

using ColoursAndPalette = std::pair<PictureColours, Palette>;

struct RenderGiven {
  RenderOptions options;
  std::optional<ColoursAndPalette> colours;
};

struct ExportGiven {
  NamedResult result;  ///< of form factors also a study
  ExportRules rules;
  FormFactorOptions factors;
  std::string output;  ///< empty: standard output
};

int draw(const RenderGiven& given) {
  RenderOptions options = given.options;
  options.has_colours = given.colours.has_value();
  if (given.colours) std::tie(options.rules.colours, options.rules.palette) = *given.colours;
  return render(options);
}

/// What chooses light says nothing of form factors.
bool chooses_light(const ExportGiven& given) {
  const ExportRules& rules = given.rules;
  return !rules.quantity.empty() || !rules.time.empty() || given.result.period.any() ||
         !given.result.band.empty() || rules.palette || rules.largest || rules.interpolate ||
         rules.crease_angle_deg || rules.light_map;
}

int form_factors(const ExportGiven& given) {
  if (chooses_light(given) || !given.rules.parts.empty() || !given.rules.model.empty())
    throw InputError({}, "--to form-factors takes --of, --variant and --study-folder alone",
                     "they are geometry, of the whole scene", "leave out the other options");
  FormFactorOptions options = given.factors;
  options.input = given.result.path;
  options.of = given.rules.of;
  options.output = given.output;
  return export_form_factors(options);
}

int export_as(const ExportGiven& given) {
  if (given.rules.format == form_factors_word) return form_factors(given);
  if (!given.factors.variant.empty() || !given.factors.study_folder.empty())
    throw InputError({}, "--variant and --study-folder with --to " + given.rules.format,
                     "they are of form factors", "leave them out");
  export_result(*opened(given.result, Opens::derived_too), given.rules, given.output);
  return exit_code::done;
}

void add_largest(const Command& command, std::optional<double>& largest) {
  command.option("--max", largest, "value of the last colour").positive();
}

void add_interpolation(const Command& command, bool& interpolate, const std::string& what,
                       std::optional<double>& crease_angle_deg) {
  command.flag("--interpolate", interpolate, what);
  command
      .option("--crease-angle", crease_angle_deg,
              "patches that turn by more are not interpolated [degrees, default 20]")
      .within(0.0, 180.0);
}

void add_camera(const Command& command, RenderOptions& options) {
  RenderRules& rules = options.rules;
  command.choice("--camera", rules.view,
                 {{"overview", View::overview}, {"sun", View::sun}, {"top", View::top}}, "view");
  add_named(command, rules.parts, "picture of");
  command.option("--eye", rules.eye,
                 "camera at x,y,z [m], NAME+dx,dy,dz [m from the foot of an object or facade], "
                 "before a facade NAME, or on top of an object NAME");
  command.option("--look", rules.look, "what is looked at: x,y,z, NAME, NAME+dx,dy,dz");
  command.choice("--projection", rules.projection,
                 {{"perspective", Projection::perspective}, {"parallel", Projection::parallel}},
                 "of overview and eye point (default: perspective; top and sun are parallel)");
  command.option("--size", options.size, "WIDTHxHEIGHT in pixels").with_default_told();
}

void add_colours(const Command& command, RenderGiven& given) {
  RenderRules& rules = given.options.rules;
  add_largest(command, rules.largest);
  command.choice("--colour", given.colours,
                 {{"false", {{PictureColours::of_values, Palette::false_colour}}},
                  {"grey", {{PictureColours::of_values, Palette::grey}}},
                  {"hue", {{PictureColours::of_values, Palette::hue}}},
                  {"rgb", {{PictureColours::of_bands, Palette::false_colour}}},
                  {"surface", {{PictureColours::of_surfaces, Palette::false_colour}}},
                  {"material", {{PictureColours::of_materials, Palette::false_colour}}}},
                 "colours (rgb: the bands themselves, default quantity power_load; surface, "
                 "material: the scene without light, default surface of a study)");
  command.choice("--scale", rules.scale,
                 {{"linear", ColourScale::linear}, {"log", ColourScale::logarithmic}},
                 "of the colours (log: three powers of ten below the last one)");
}

void add_appearance(const Command& command, RenderRules& rules) {
  command
      .option("--same-scale", rules.same_scale,
              "results that the scale is to do for, too, so that pictures can be compared")
      .read();
  command.choice("--sky", rules.sky,
                 {{"plain", SkyBackground::plain},
                  {"first", SkyBackground::first},
                  {"second", SkyBackground::second}},
                 "sky behind (default: plain for totals, second for series)");
  command.flag("--mesh", rules.mesh, MeshLines::patches, "draw the patches' edges");
  add_interpolation(command, rules.interpolate, "colours run between corners",
                    rules.crease_angle_deg);
}

/// What is exported: of which result, as what, to which file.
void add_conversion(const Command& command, ExportGiven& given) {
  command
      .option("RESULT", given.result.path,
              "result file (.h5), comparison file or map of a place; form-factors: or a study "
              "(.yaml)")
      .read()
      .required()
      .single();
  const std::vector<std::string> formats = export_formats();
  command.option("--to", given.rules.format, fmt::format("format: {}", fmt::join(formats, ", ")))
      .required()
      .completed_by(formats);
  command
      .option("-o,--output", given.output,
              "file to write (csv, vrml, cityjson, energyplus, form-factors as CSV: default "
              "standard output)")
      .written();
  command
      .option("--model", given.rules.model,
              "cityjson: the study's own model, whose surfaces and objects get the values as "
              "attributes")
      .read();
}

void add_rows(const Command& command, ExportRules& rules) {
  command
      .option("--of", rules.of,
              "csv: a row for every patch (default), facade, object, orientation, selection or "
              "sensor; form-factors: between patches (default), facades, objects or kinds of "
              "surface")
      .completed_by({"patch", "facade", "object", "orientation", "selection", "sensor", "surface"});
  add_named(command, rules.parts, "csv, gpkg: only", "csv, gpkg, energyplus: only");
  command.option("--sensor", rules.parts.sensors, "csv, gpkg: only the sensor of that number")
      .repeatable();
}

void add_light(const Command& command, ExportRules& rules) {
  command.option("--quantity", rules.quantity,
                 "dataset per patch, or radiance (default: light_load; csv and xdmf: all); "
                 "csv: series, or with --of any series");
  command.option("--time", rules.time,
                 "instant of a series, e.g. 2026-06-21T12:00 (default: the brightest)");
  command.choice("--colour", rules.palette,
                 {{"false", Palette::false_colour}, {"grey", Palette::grey}, {"hue", Palette::hue}},
                 "colours");
  add_largest(command, rules.largest);
}

}  // namespace

void add_render(CommandLine& line) {
  const auto given = std::make_shared<RenderGiven>();
  RenderOptions& options = given->options;
  const Command command = line.command("render", "picture of a result in false colour, with legend",
                                       [given] { return draw(*given); });
  command
      .option("RESULT", options.result.path,
              "result file (.h5), comparison file, map of a place, or a study (.yaml), whose "
              "scene is drawn without light")
      .read()
      .required()
      .single();
  command.option("-o,--output", options.picture, "picture to write (.png)").written().required();
  command.option("--quantity", options.rules.quantity,
                 "dataset to draw (default: light_load; animated: irradiance), or radiance "
                 "(luminance): of diffuse light, at --time or in the mean");
  command.option("--time", options.rules.time, "instant of a series, e.g. 2026-06-21T12:00");
  add_camera(command, options);
  add_colours(command, *given);
  command.option("--variant", options.variant, "of a study (default: its first)");
  add_band(command, options.result.band);
  add_period(command, options.result.period);
  add_appearance(command, options.rules);
  command.flag("--animate", options.animate,
               "a picture for every sun position, NAME-0001.png ..., and NAME.png with all (APNG)");
  command.examples(
      "sunload render results/street/glazed.h5 -o glazed.png\n"
      "sunload render results/street/glazed.h5 -o top.png --camera top --mesh\n"
      "sunload render street.yaml -o scene.png --colour material");
}

void add_view(CommandLine& line) {
  struct Given {
    ViewOptions options;
    std::string band;
  };
  const auto given = std::make_shared<Given>();
  ViewOptions& options = given->options;
  const Command command = line.command(
      "view", "one self-contained page: walk through the scene, any time, two results", [given] {
        given->options.rules.band = chosen_band(given->band);
        return view(given->options);
      });
  command
      .option("RESULT", options.inputs,
              "one result file (.h5), or two to compare; or a study (.yaml), whose scene is "
              "shown without light")
      .read()
      .required();
  command.option("-o,--output", options.page, "page to write (.html)").written().required();
  command.option("--variant", options.variants,
                 "of a study: its variants to show, at most two (default: the first two)");
  command
      .option("--step", options.rules.step,
              "hold every N-th interval only (default: as many as 60 MB hold)")
      .within(1, 1'000'000);
  add_band(command, given->band);
  add_period(command, options.rules.period);
  command.examples(
      "sunload view results/street/baseline.h5 results/street/glazed.h5 -o street.html\n"
      "sunload view street.yaml -o scene.html");
}

void add_export(CommandLine& line) {
  const auto given = std::make_shared<ExportGiven>();
  ExportRules& rules = given->rules;
  const Command command = line.command("export", "a result in the format of another program",
                                       [given] { return export_as(*given); });
  add_conversion(command, *given);
  add_rows(command, rules);
  add_light(command, rules);
  add_band(command, given->result.band);
  add_period(command, given->result.period);
  add_interpolation(command, rules.interpolate, "colours of corners, not of patches (glb, vrml)",
                    rules.crease_angle_deg);
  command.flag("--lightmap", rules.light_map,
               "colours in a texture, a block of texels for each patch (glb)");
  command.option("--variant", given->factors.variant,
                 "form-factors: of a study (default: its first)");
  command.option("--study-folder", given->factors.study_folder,
                 "form-factors of a result: folder of its study file (default: the working "
                 "directory)");
  command.examples(
      "sunload export results/street/glazed.h5 --to csv --of facade -o facades.csv\n"
      "sunload export results/street/glazed.h5 --to glb -o glazed.glb\n"
      "sunload export street.yaml --to form-factors --of object -o factors.h5");
}

}  // namespace sunload
