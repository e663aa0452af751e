// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "io/base/file_aside.h"
#include "io/base/output_target.h"
#include "io/base/scene_colours.h"
#include "io/base/text.h"
#include "io/picture/animated_png.h"
#include "io/picture/overview.h"
#include "io/picture/render_bands.h"
#include "io/picture/render_frame.h"
#include "io/picture/render_refusals.h"
#include "io/picture/render_scene.h"
#include "io/picture/viewpoint.h"
#include "io/result/patches.h"
#include "io/result/shown_quantity.h"
#include "io/result/time.h"

namespace sunload {
namespace {

// A field of view as of a 50 mm lens on 35 mm film shows shapes undistorted;
// a street seen from within needs a wider one.
constexpr double overview_field_deg = 27, walker_field_deg = 60;
// Balconies and eaves of a facade are less deep than this; what stands farther in front hides it.
constexpr double facade_front_m = 2;
// Fast enough for motion, slow enough to read the hour.
constexpr int milliseconds_per_picture = 250;

Vec3 sun_at(const ResultReader& result, std::size_t interval) {
  const auto sun = result.row("sun_direction", interval);
  return {sun.at(0), sun.at(1), sun.at(2)};
}

std::string title(const ResultReader& result) {
  if (result.is_comparison())
    return fmt::format("{} — {} minus {}", result.text_attribute("study"),
                       result.text_attribute("variant"), result.text_attribute("base"));
  const auto study = result.text_attribute("study");
  if (result.is_place_map())
    return fmt::format("{} — {}: where the light of {} comes from", study,
                       result.text_attribute("variant"), result.text_attribute("place"));
  const auto lacking = result.lacking();
  return fmt::format("{} — {}{}", study.empty() ? result.text_attribute("title") : study,
                     result.text_attribute("variant"), lacking.empty() ? "" : ": " + lacking);
}

/// "; facade house_3/*, object tower".
std::string named_in_words(const NamedParts& parts) {
  std::string words;
  for (const auto& [kind, names] : {std::pair("facade", &parts.facades),
                                    {"object", &parts.objects},
                                    {"selection", &parts.selections}})
    for (const auto& name : *names)
      words += fmt::format("{} {} {}", words.empty() ? ";" : ",", kind, name);
  return words;
}

/// What --look names, where no eye says from where.
ScenePlace looked_at(const ResultReader& result, const std::string& look) {
  auto place = viewpoint(result, look, ViewpointOf::look).of;
  if (!place)
    throw InputError({}, "--look " + look + " without --eye", "a point can be seen from anywhere",
                     "add --eye, or look at an object or a facade by name");
  return *place;
}

/// Kinds of surface or materials: which each patch has, and which are there.
struct SceneKinds {
  std::vector<std::size_t> of_patch;
  std::vector<Colour> colours;     ///< of all kinds
  std::vector<KindEntry> entries;  ///< those with area, largest first
};

SceneKinds scene_kinds(const ResultReader& result, PictureColours by) {
  const bool by_surface = by == PictureColours::of_surfaces;
  std::vector<std::string> names =
      by_surface ? std::vector<std::string>{surface_names.begin(), surface_names.end()}
                 : result.strings("material_name");
  names.emplace_back("none");
  const auto entry = result.integers(by_surface ? "patch_surface" : "patch_material");
  const auto area = result.doubles("patch_area");
  SceneKinds kinds;
  std::vector<double> sums(names.size(), 0);
  const auto of_materials = by_surface ? std::vector<std::size_t>() : material_colours(names);
  for (std::size_t k = 0; k + 1 < names.size(); ++k)
    kinds.colours.push_back(by_surface ? surface_colour(k) : material_colour(of_materials[k]));
  kinds.colours.push_back(back_colour);
  for (std::size_t p = 0; p < entry.size(); ++p) {
    kinds.of_patch.push_back(entry[p] < 0 ? names.size() - 1 : static_cast<std::size_t>(entry[p]));
    sums[kinds.of_patch.back()] += area[p];
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (sums[k] > 0) kinds.entries.push_back({names[k], kinds.colours[k], sums[k]});
  std::stable_sort(kinds.entries.begin(), kinds.entries.end(),
                   [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
  return kinds;
}

/// Begins anew where no interval follows for longer than the sun needs for an hour line or two.
SunTrack sun_track(const ResultReader& result) {
  constexpr double longest_gap_s = 3 * seconds_per_hour;
  const auto azimuth = result.doubles("sun_azimuth"), elevation = result.doubles("sun_elevation"),
             time = result.doubles("time");
  SunTrack path;
  if (has_long_steps(result)) return path;
  for (std::size_t k = 0; k < azimuth.size(); ++k) {
    path.places.push_back({azimuth[k], elevation[k]});
    path.breaks.push_back(k > 0 && time[k] - time[k - 1] > longest_gap_s ? 1 : 0);
  }
  return path;
}

/// Of patches, 0 of those that a picture of these parts is not of.
std::vector<double> drawn_area(const ResultReader& result, const NamedParts& parts) {
  std::vector<double> all = result.doubles("patch_area");
  if (!parts.choose_patches()) return all;
  std::vector<double> drawn(all.size(), 0);
  for (const std::size_t i : chosen_patches(result, parts)) drawn[i] = all[i];
  return drawn;
}

/// A result being drawn: what all pictures of it share.
class Renderer {
 public:
  Renderer(const ResultReader& result, const RenderRules& rules)
      : result_(result),
        rules_(rules),
        scene_(result),
        caster_(scene_.mesh()),
        drawn_area_(drawn_area(result, rules.parts)),
        north_deg_(scene_north_deg(result)) {
    if (rules.parts.choose_patches()) place_ = scene_place(result, rules.parts);
    if (rules.eye.empty() && !rules.look.empty()) place_ = looked_at(result, rules.look);
    if (rules.interpolate) patches_ = std::make_unique<ResultPatches>(result);
  }

  /// End of the scale for values of this result and of those that are compared with it.
  double largest(const ShownQuantity& shown) const {
    double end = scale_end(rules_.largest, shown.sizes(), drawn_area_);
    for (const auto& path : rules_.same_scale) {
      ResultReader other(path, result_.band(),
                         result_.is_derived() ? Opens::derived_too : Opens::results);
      other.choose(result_.chosen());
      const auto theirs = shown_quantity(other, shown.dataset, rules_.time);
      if (theirs.units != shown.units)
        throw InputError({path}, shown.dataset + " is in " + theirs.units,
                         "the result drawn has it in " + shown.units);
      end = std::max(end, scale_end({}, theirs.sizes(), drawn_area(other, rules_.parts)));
    }
    return end;
  }
  const PatchScene& scene() const { return scene_; }

  /// The scene by kinds of surface or by materials, as it is without any light.
  std::unique_ptr<Picture> picture_of_kinds(std::size_t interval) {
    auto picture = std::make_unique<Picture>(rules_.width, rules_.height);
    const PictureArea area = scene_area(*picture);
    trace(interval, area);
    const SceneKinds kinds = scene_kinds(result_, rules_.colours);
    PatchColours colours;
    colours.values.assign(scene_.patch_count(), 0);
    colours.mesh = rules_.mesh;
    for (const auto kind : kinds.of_patch) colours.own.push_back(linear_light(kinds.colours[kind]));
    picture->paint(area.x, area.y, area.width, traced_->pixels(colours, {}));
    draw_title(*picture, title(result_),
               std::string(rules_.colours == PictureColours::of_surfaces ? "kinds of surface"
                                                                         : "materials") +
                   ", sun path of " + period_in_words(result_) + named_in_words(rules_.parts));
    draw_kinds(*picture, kinds.entries);
    draw_sun_path(*picture, sun_track(result_),
                  camera_->ground_direction(scene_direction({0, 0}, north_deg_)));
    return picture;
  }

  /// The whole picture with its frame.
  std::unique_ptr<Picture> picture(const ShownQuantity& shown, double largest) {
    auto picture = std::make_unique<Picture>(rules_.width, rules_.height);
    const PictureArea area = scene_area(*picture);
    // A camera that follows the sun sees something else each time.
    if (!traced_ || (rules_.view == View::sun && rules_.eye.empty())) trace(shown.interval, area);
    const Palette palette = shown.is_difference ? Palette::difference : rules_.palette;
    PatchColours colours{shown.values, largest, palette, rules_.mesh};
    colours.scale = rules_.scale;
    colours.least = rules_.scale == ColourScale::logarithmic ? least_of_decades(largest)
                                                             : shown.scale_begin(largest);
    if (result_.is_place_map())
      for (const double weight : result_.doubles("place_weight"))
        colours.marked.push_back(weight > 0 ? 1 : 0);
    const bool in_rgb = rules_.colours == PictureColours::of_bands;
    if (in_rgb) {
      auto bands =
          colours_of_bands(result_, shown.dataset, rules_.time, rules_.largest, drawn_area_);
      colours.own = std::move(bands.of_patches);
      largest = bands.white;
    }
    if (patches_)
      colours.corner_values = corner_values(*patches_, shown.values,
                                            rules_.crease_angle_deg.value_or(default_crease_deg));
    // Whoever looks down upon the scene sees no sky beside it.
    const bool has_sky = shown.is_series && !has_long_steps(result_) && !rules_.eye.empty();
    const auto kind = rules_.sky.value_or(has_sky ? SkyBackground::second : SkyBackground::plain);
    picture->paint(area.x, area.y, area.width,
                   traced_->pixels(colours, {kind, sun_behind(shown.interval)}));
    draw_title(
        *picture, title(result_) + (in_rgb ? "" : band_title(result_)),
        shown.name + (shown.when.empty() ? "" : ", " + shown.when) + named_in_words(rules_.parts) +
            seen_from_in_words(shown) +
            (in_rgb ? ", in colour, white: " + number_text(largest, 4) + " " + shown.units : "") +
            (result_.is_place_map() ? "; green: the place itself" : "") + no_value_in_words(shown) +
            nothing_in_words(shown));
    const auto marked_where = [&](const auto& is_beyond) {
      return std::any_of(shown.values.begin(), shown.values.end(), is_beyond)
                 ? Legend::Above::marked
                 : Legend::Above::nothing;
    };
    if (!in_rgb)
      draw_legend(
          *picture,
          {shown.units, largest, palette,
           marked_where([&](double value) { return value > largest; }), colours.least,
           marked_where([&](double value) { return value < colours.least; }), colours.scale});
    draw_north(*picture, camera_->ground_direction(scene_direction({0, 0}, north_deg_)));
    return picture;
  }

 private:
  /// From where, if not from the overview; of an interval's values the sun is told already.
  std::string seen_from_in_words(const ShownQuantity& shown) const {
    if (!rules_.eye.empty()) return "; seen from " + rules_.eye;
    if (rules_.view == View::sun && !shown.is_series)
      return "; seen from the " + row_in_words(result_, shown.interval);
    return "";
  }

  /// The scale has to end somewhere.
  static std::string nothing_in_words(const ShownQuantity& shown) {
    return std::all_of(shown.values.begin(), shown.values.end(),
                       [](double value) { return value == 0 || std::isnan(value); })
               ? "; 0 everywhere"
               : "";
  }

  /// What surfaces without a value are.
  std::string no_value_in_words(const ShownQuantity& shown) const {
    if (std::none_of(shown.values.begin(), shown.values.end(),
                     [](double value) { return std::isnan(value); }))
      return "";
    if (shown.is_difference) return "; grey: no counterpart";
    return fmt::format("; {}: not measured", rules_.palette == Palette::grey ? "blue" : "grey");
  }

  void trace(std::size_t interval, PictureArea area) {
    camera_ = std::make_unique<Camera>(camera(interval, area));
    traced_ = std::make_unique<TracedPicture>(scene_, caster_, *camera_, area.width, area.height,
                                              rules_.mesh);
    if (rules_.eye.empty() && !traced_->shows_anything())  // a room from outside
      traced_ = std::make_unique<TracedPicture>(scene_, caster_, *camera_, area.width, area.height,
                                                rules_.mesh, Backs::let_pass);
    expect_something_seen();
  }

  Camera camera(std::size_t interval, PictureArea area) const {
    if (!rules_.eye.empty()) return free_camera(area);
    if (!rules_.parts.facades.empty() && place_->normal)
      return Camera::parallel(place_->points, *place_->normal, {0, 0, 1}, area.width, area.height,
                              facade_front_m);
    switch (rules_.view) {
      case View::sun:
        return sun_camera(interval, area);
      case View::top:
        return Camera::parallel(focus_points(), {0, 0, 1}, scene_direction({0, 0}, north_deg_),
                                area.width, area.height);
      case View::overview:
        break;
    }
    const Vec3 from = view_direction();
    return rules_.projection == Projection::parallel
               ? Camera::parallel(focus_points(), from, {0, 0, 1}, area.width, area.height)
               : Camera::fitted(focus_points(), from, overview_field_deg, area.width, area.height);
  }

  /// Of facades that look several ways the side that most of them look to.
  Vec3 view_direction() const {
    const auto side = result_.is_place_map() ? side_of_mapped_place(result_)
                      : rules_.parts.facades.empty() || !place_
                          ? std::optional<Vec3>()
                          : side_of(place_->normal_sum, place_->area);
    if (!side) return overview_direction(result_, north_deg_);
    return enu_direction({horizontal(*side).azimuth_deg, overview_elevation_deg});
  }

  /// What the camera holds: what is asked for, or the buildings.
  std::vector<Vec3> focus_points() const { return place_ ? place_->points : scene_.focus_points(); }

  Camera free_camera(PictureArea area) const {
    const Viewpoint from = viewpoint(result_, rules_.eye, ViewpointOf::eye);
    if (rules_.look.empty() && !from.towards)
      throw InputError({}, "--eye " + rules_.eye + " without --look",
                       "only a facade says where one looks from it",
                       "add --look x,y,z or --look NAME");
    const Vec3 eye = from.at, look = rules_.look.empty()
                                         ? eye + *from.towards
                                         : viewpoint(result_, rules_.look, ViewpointOf::look).at;
    if (!(norm(eye - look) > 0))
      throw InputError({}, "--eye and --look are the same point",
                       "there is no direction to look in");
    return rules_.projection == Projection::parallel
               ? Camera::parallel(focus_points(), eye - look, {0, 0, 1}, area.width, area.height)
               : Camera::perspective(eye, look, walker_field_deg, area.width, area.height);
  }

  /// A picture without anything of the scene helps nobody.
  void expect_something_seen() const {
    const Box box = bounding_box(scene_.mesh().vertices);
    const Vec3 low = box.low + result_.origin(), high = box.high + result_.origin();
    if (!traced_->shows_anything())
      throw InputError(
          {}, "the picture would show nothing of the scene",
          fmt::format(
              "the scene lies in x {:.1f} … {:.1f}, y {:.1f} … {:.1f}, z {:.1f} … {:.1f} m, "
              "and the camera looks past it, or is inside of a body or below the ground",
              low.x, high.x, low.y, high.y, low.z, high.z),
          "look at something by name (--look NAME), or take another --eye");
    if (place_ && !traced_->shows(place_->patches))
      throw InputError(
          {}, "the picture would show nothing of what is asked for",
          fmt::format("other things hide it; it lies about x {:.1f}, y {:.1f}, z {:.1f} "
                      "m",
                      (place_->middle() + result_.origin()).x,
                      (place_->middle() + result_.origin()).y,
                      (place_->middle() + result_.origin()).z),
          "take --camera top, or an --eye near it (--eye NAME stands before a facade)");
  }

  /// What is derived is of no instant: the sky behind it is plain.
  Vec3 sun_behind(std::size_t interval) const {
    return result_.is_derived() ? Vec3{0, 0, 1} : sun_at(result_, interval);
  }

  Camera sun_camera(std::size_t interval, PictureArea area) const {
    const Vec3 sun = sun_at(result_, interval);
    if (sun.z <= 0)
      throw InputError({}, "the sun is below the horizon", interval_in_words(result_, interval),
                       "choose another --time");
    return Camera::parallel(focus_points(), sun, {0, 0, 1}, area.width, area.height);
  }

  const ResultReader& result_;
  const RenderRules& rules_;
  PatchScene scene_;
  RayCaster caster_;
  std::vector<double> drawn_area_;  ///< of patches
  double north_deg_;
  std::optional<ScenePlace> place_;  ///< what the picture is of, where somebody says so
  std::unique_ptr<ResultPatches> patches_;
  std::unique_ptr<Camera> camera_;
  std::unique_ptr<TracedPicture> traced_;
};

/// Rows that are chosen with the sun above the horizon at some time.
std::vector<std::size_t> sunny_intervals(const ResultReader& result) {
  const auto elevation = result.doubles("sun_elevation"), shares = result.chosen_shares();
  std::vector<std::size_t> sunny;
  for (std::size_t k = 0; k < elevation.size(); ++k)
    if (elevation[k] > 0 && shares[k] > 0) sunny.push_back(k);
  if (sunny.empty())
    throw InputError({result.path()}, "the sun is never up",
                     "no interval has the sun above the horizon");
  return sunny;
}

ShownQuantity shown_at(const ResultReader& result, const std::string& dataset,
                       std::size_t interval) {
  return shown_quantity(result, dataset, iso_utc(result.doubles("time").at(interval)));
}

}  // namespace

void render_png(const ResultReader& result, const RenderRules& rules, const std::string& path) {
  expect_sense(rules);
  expect_fit_for_steps(result, rules);
  if (is_of_kinds(rules.colours)) {
    if (result.is_derived())
      throw InputError({result.path()}, "--colour surface or material of what is derived",
                       "it is of light", "draw one of its results, or the study");
    expect_fit_for_kinds(rules);
    Renderer(result, rules)
        .picture_of_kinds(rules.time.empty() ? brightest_interval(result)
                                             : interval_at(result, rules.time))
        ->save(path);
    return;
  }
  expect_fit_for_derived(result, rules);
  // Parts of the period have no power load.
  const bool is_of_sent = rules.colours == PictureColours::of_bands && result.has("power_load");
  const std::string usual = is_of_sent ? "power_load" : usual_quantity(result);
  const auto shown =
      shown_quantity(result, rules.quantity.empty() ? usual : rules.quantity, rules.time);
  expect_time_matters(result, rules, shown);
  Renderer renderer(result, rules);
  renderer.picture(shown, renderer.largest(shown))->save(path);
}

void render_animation(const ResultReader& result, const RenderRules& rules,
                      const std::string& path) {
  expect_sense(rules);
  expect_fit_for_steps(result, rules);
  if (result.is_derived())
    throw InputError({result.path()}, "--animate of what is derived", "it is of no instant",
                     "draw one picture of it, or animate the results");
  if (!rules.time.empty())
    throw InputError({}, "--time with --animate", "it shows all times", "use --day");
  if (is_of_kinds(rules.colours))
    throw InputError({}, "--animate of surfaces or materials", "they do not change",
                     "leave it out");
  if (rules.colours == PictureColours::of_bands)
    throw InputError({}, "--colour rgb with --animate",
                     "each picture would have a white of its own",
                     "draw single pictures with --time and --max");
  const std::string dataset =
      rules.quantity.empty() ? dataset_name("irradiance", result.quantity()) : rules.quantity;
  const auto intervals = sunny_intervals(result);
  Renderer renderer(result, rules);
  double largest = 0;
  for (const auto k : intervals)
    largest = std::max(largest, renderer.largest(shown_at(result, dataset, k)));
  if (output_target(path).kind != OutputTarget::Kind::file)
    throw InputError({}, "--animate into " + path, "it writes a picture of every sun beside it",
                     "name a file");
  const std::filesystem::path whole(path);
  const std::string stem = (whole.parent_path() / whole.stem()).string();
  const auto frame_of = [&](std::size_t k) { return fmt::format("{}-{:04}.png", stem, k + 1); };
  std::vector<std::string> inputs = rules.same_scale;
  inputs.push_back(result.path());
  for (const auto k : intervals) expect_not_read(frame_of(k), inputs, path);
  AnimatedPng animation(path, intervals.size(), milliseconds_per_picture);
  for (const auto k : intervals) {
    const auto png = renderer.picture(shown_at(result, dataset, k), largest)->png();
    write_file(frame_of(k), png);
    animation.add(png);
  }
  animation.finish();
}

}  // namespace sunload
