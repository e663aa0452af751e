// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_refusals.h"

#include <fmt/format.h>

#include <algorithm>

#include "geo/base/check.h"
#include "io/result/time.h"

namespace sunload {

namespace {

constexpr int least_pixels = 320, most_pixels = 16384;

}  // namespace

void expect_sense(const RenderRules& rules) {
  Problems problems;
  const auto [least, most] = std::minmax(rules.width, rules.height);
  if (least < least_pixels || most > most_pixels)
    problems.add({}, fmt::format("--size {}x{}", rules.width, rules.height),
                 fmt::format("width and height must lie in [{}, {}]", least_pixels, most_pixels));
  if (!rules.parts.sensors.empty())
    problems.add({}, "--sensor in a picture", "sensors are points", "name facades or objects");
  if (!rules.parts.facades.empty() && (!rules.eye.empty() || rules.view != View::overview))
    problems.add({}, "--facade with another camera", "it is a camera of its own",
                 "leave out --eye and --camera, or write --object");
  if (!rules.look.empty() && rules.eye.empty() && rules.parts.choose_patches())
    problems.add({}, "--look without --eye, with --facade or --object",
                 "both say what the picture is of", "leave out one");
  if (rules.projection == Projection::perspective && rules.eye.empty() &&
      rules.view != View::overview)
    problems.add({}, "--projection perspective with --camera top or sun", "they are parallel",
                 "leave it out, or write --camera overview or --eye");
  if (rules.projection && rules.eye.empty() && !rules.parts.facades.empty())
    problems.add({}, "--projection with --facade", "facades have a camera of their own",
                 "leave it out, or write --object");
  if (rules.crease_angle_deg && !rules.interpolate)
    problems.add({}, "--crease-angle without --interpolate",
                 "patches of one colour have no creases", "add --interpolate");
  if (rules.crease_angle_deg && !(*rules.crease_angle_deg >= 0 && *rules.crease_angle_deg <= 180))
    problems.add({}, fmt::format("--crease-angle {}", *rules.crease_angle_deg),
                 "must lie in [0, 180] degrees");
  if (rules.largest && !rules.same_scale.empty())
    problems.add({}, "--max with --same-scale", "both set the end of the scale", "leave out one");
  if (rules.colours == PictureColours::of_bands && (rules.interpolate || !rules.same_scale.empty()))
    problems.add({}, "--colour rgb with --interpolate or --same-scale",
                 "these are of values, not of bands", "leave them out; --max sets what is white");
  if (rules.scale == ColourScale::logarithmic && rules.colours != PictureColours::of_values)
    problems.add({}, "--scale log with --colour rgb, surface or material",
                 "it is of values by a palette", "leave out one");
  problems.throw_if_any();
}

void expect_fit_for_derived(const ResultReader& result, const RenderRules& rules) {
  if (!result.is_derived()) return;
  const std::string of = result.is_comparison() ? " of a comparison" : " of a map of a place";
  Problems problems;
  const auto refuse = [&](bool is_wrong, const std::string& what, const std::string& why,
                          const std::string& hint) {
    if (is_wrong) problems.add({result.path()}, what + of, why, hint);
  };
  refuse(rules.view == View::sun, "--camera sun", "it has no sun", "use overview or top");
  refuse(rules.sky.value_or(SkyBackground::plain) != SkyBackground::plain, "--sky", "it has no sun",
         "leave it out");
  refuse(!rules.time.empty(), "--time", "it is of the whole period", "leave it out");
  if (result.is_place_map()) {
    refuse(rules.colours == PictureColours::of_bands, "--colour rgb",
           "it has the mean of the bands", "leave it out");
    return problems.throw_if_any();
  }
  refuse(rules.scale == ColourScale::logarithmic, "--scale log", "differences are of either sign",
         "leave it out");
  refuse(rules.colours == PictureColours::of_bands || rules.palette != Palette::false_colour,
         "--colour", "differences have their own scale, from blue to red", "leave it out");
  problems.throw_if_any();
}

void expect_fit_for_steps(const ResultReader& result, const RenderRules& rules) {
  if (!has_long_steps(result)) return;
  Problems problems;
  const auto refuse = [&](bool is_wrong, const std::string& what, const std::string& hint) {
    if (is_wrong)
      problems.add({result.path()}, what + " of series of steps: " + series_step(result),
                   "no one sun stands for such a step", hint);
  };
  refuse(rules.view == View::sun, "--camera sun", "use overview or top");
  refuse(rules.sky.value_or(SkyBackground::plain) != SkyBackground::plain, "--sky", "leave it out");
  problems.throw_if_any();
}

void expect_time_matters(const ResultReader& result, const RenderRules& rules,
                         const ShownQuantity& shown) {
  const bool is_for_sky = rules.sky.value_or(SkyBackground::plain) != SkyBackground::plain;
  if (rules.time.empty() || shown.is_series || rules.view == View::sun || is_for_sky) return;
  throw InputError({}, "--time " + rules.time, shown.dataset + " is a total of the whole period",
                   leave_out_or_name_a_series(result));
}

bool is_of_kinds(PictureColours colours) {
  return colours == PictureColours::of_surfaces || colours == PictureColours::of_materials;
}

void expect_fit_for_kinds(const RenderRules& rules) {
  const bool is_about_light = !rules.quantity.empty() || rules.largest ||
                              !rules.same_scale.empty() || rules.interpolate ||
                              rules.sky.value_or(SkyBackground::plain) != SkyBackground::plain ||
                              (!rules.time.empty() && rules.view != View::sun);
  if (is_about_light)
    throw InputError({}, "--quantity, --time, --max, --same-scale, --interpolate or --sky",
                     "the picture is of surfaces or materials, without light",
                     "leave them out, or draw a result with --colour false");
}

}  // namespace sunload
