// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_seasons.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "geo/base/check.h"
#include "geo/mesh/covered.h"
#include "geo/time/period_parts.h"
#include "io/plan/material_assign.h"
#include "io/plan/seasons_of_plan.h"
#include "io/plan/weather_albedo.h"

namespace sunload {

namespace {

using Names = std::vector<std::string>;

/// What tells scenes of one period apart: seasons of the study, and how bright the weather says
/// that the ground is.
struct Moment {
  Names seasons;
  std::optional<int> albedo_step = {};  ///< where a material asks for it

  friend bool operator<(const Moment& a, const Moment& b) {
    return std::tie(a.seasons, a.albedo_step) < std::tie(b.seasons, b.albedo_step);
  }
};

constexpr std::size_t most_seasons = 16;  // each takes memory as a scene of its own

/// Seasons of the study that change a material.
std::vector<SeasonStudy> seasons_that_matter(const Study& study) {
  std::vector<SeasonStudy> matter;
  for (const SeasonStudy& season : study.seasons)
    if (std::any_of(study.scene.materials.begin(), study.scene.materials.end(), [&](const auto& m) {
          return std::any_of(m.seasons.begin(), m.seasons.end(),
                             [&](const auto& in) { return in.season == season.name; });
        }))
      matter.push_back(season);
  return matter;
}

Names in_force(const std::vector<SeasonStudy>& seasons, const CivilTime& time) {
  Names names;
  for (const SeasonStudy& season : seasons)
    if (is_in(season, time)) names.push_back(season.name);
  return names;
}

/// Of every interval, as numbers of `moments`, which are those that come.
std::vector<std::uint8_t> moments_of(const std::vector<SeasonStudy>& seasons, const Study& study,
                                     const LightSeries& light, std::vector<Moment>& moments) {
  const TimeZone zone(study.site.timezone);
  const bool by_albedo = has_material_of_weather(study);
  std::map<Moment, std::uint8_t> number_of;
  std::vector<std::uint8_t> of_interval;
  for (const LitInterval& interval : light.intervals) {
    const UnixTime middle = (interval.when.begin + interval.when.end) / 2;
    Moment moment{in_force(seasons, zone.civil_from_utc(middle))};
    if (by_albedo) moment.albedo_step = albedo_step(interval);
    const auto [place, is_new] =
        number_of.try_emplace(moment, static_cast<std::uint8_t>(moments.size()));
    if (is_new) moments.push_back(std::move(moment));
    if (moments.size() > most_seasons)
      throw InputError(
          seasons.empty() ? study.scene.where : seasons.front().where,
          fmt::format("more than {} seasons and overlaps of them{} lie in the period", most_seasons,
                      by_albedo ? ", with steps of the weather's albedo," : ""),
          "each is computed as a scene of its own", "write fewer");
    of_interval.push_back(place->second);
  }
  return of_interval;
}

/// Of the intervals of each moment, weighted by their light on level ground; the mean of their
/// reflected light is then what it would be with every day's own albedo, but for second bounces.
std::vector<double> mean_albedos(const LightSeries& light,
                                 const std::vector<std::uint8_t>& of_interval, std::size_t count) {
  constexpr double of_darkness = 1e-6;  // so that moments without light have a mean, too
  std::vector<double> weight(count, 0), mean(count, 0);
  for (std::size_t i = 0; i < of_interval.size(); ++i) {
    const LitInterval& interval = light.intervals[i];
    const double energy = (interval.mean.ghi + of_darkness) * interval.when.length_s();
    weight[of_interval[i]] += energy;
    mean[of_interval[i]] += energy * *interval.albedo;
  }
  for (std::size_t m = 0; m < count; ++m) mean[m] /= weight[m];
  return mean;
}

/// Dates of another year, of another half of it: nothing would say that they are without effect.
void warn_of_absent(const std::vector<SeasonStudy>& seasons, const std::vector<Moment>& moments,
                    std::vector<std::string>& warnings) {
  for (const SeasonStudy& season : seasons)
    if (std::none_of(moments.begin(), moments.end(), [&](const Moment& moment) {
          return std::ranges::find(moment.seasons, season.name) != moment.seasons.end();
        }))
      warnings.push_back(
          message(season.where, "season '" + season.name + "' holds in no interval of the period",
                  "its materials are never used", "dates without a year hold in every year"));
}

/// Totals by season are of the calendar, whatever the study calls a winter.
void warn_of_calendar_names(const Study& study, std::vector<std::string>& warnings) {
  const auto& totals = study.output.totals;
  if (!totals || std::ranges::find(*totals, PartKind::season) == totals->end()) return;
  for (const SeasonStudy& season : study.seasons)
    if (std::ranges::find(season_names, season.name) != season_names.end())
      warnings.push_back(
          message(season.where, "season '" + season.name + "' is called like one of the calendar",
                  "totals by season are of whole months, and --season chooses the study's own",
                  "give it another name"));
}

/// Numbers of the sets whose scenes are the same become one; the others move up.
void join_equal(std::vector<SceneSeason>& all, std::vector<std::uint8_t>& of_interval) {
  std::vector<SceneSeason> different;
  std::vector<std::uint8_t> number;
  for (SceneSeason& season : all) {
    const auto same = std::find_if(different.begin(), different.end(), [&](const auto& other) {
      return other.materials == season.materials && other.material == season.material;
    });
    number.push_back(static_cast<std::uint8_t>(same - different.begin()));
    if (same == different.end()) different.push_back(std::move(season));
  }
  all = std::move(different);
  for (std::uint8_t& season : of_interval) season = number[season];
}

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Patches are the same in all seasons, those of both sides, too.
void expect_same_patches(const Study& study, const Scene& scene, const Scene& other,
                         const std::string& season) {
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    if (scene.mesh.triangle_sides[t] == other.mesh.triangle_sides[t]) continue;
    throw InputError(study.scene.where,
                     "material '" + scene.material_of(t).name + "' has " +
                         (scene.mesh.triangle_sides[t] == Sides::two ? "two sides" : "one side") +
                         ", and '" + other.material_of(t).name + "', which it is in season '" +
                         season + "', not",
                     "patches are the same in all seasons",
                     "write `sides` for both of them under scene.materials");
  }
}

void widen(Box& box, const Vec3& point) {
  box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y),
             std::min(box.low.z, point.z)};
  box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y),
              std::max(box.high.z, point.z)};
}

bool holds(const Box& box, const Vec3& point) {
  const Vec3 above = point - box.low, below = box.high - point;
  return std::min({above.x, above.y, above.z, below.x, below.y, below.z}) >= -contact_m;
}

/// Surfaces of one object that let light pass in some seasons and stop it in others, as written.
struct Changing {
  std::size_t object = 0;
  bool covers = false;  ///< with the materials as written
  Box box;
};

/// In the order of their boxes along x.
std::vector<Changing> changing_objects(const Mesh& mesh, const std::vector<std::uint8_t>& changes,
                                       const Scene& written) {
  std::map<std::pair<std::size_t, bool>, Changing> by_object;
  for (std::size_t t = 0; t < changes.size(); ++t) {
    if (changes[t] == 0) continue;
    const std::size_t object = mesh.triangle_object[t].index();
    const bool covers = written.material_of(t).transmittance == 0;
    Changing& one = by_object[{object, covers}];
    one.object = object;
    one.covers = covers;
    for (int k = 0; k < 3; ++k) widen(one.box, mesh.corner(t, k));
  }
  std::vector<Changing> objects;
  objects.reserve(by_object.size());
  for (const auto& [key, one] : by_object) objects.push_back(one);
  std::sort(objects.begin(), objects.end(),
            [](const Changing& a, const Changing& b) { return a.box.low.x < b.box.low.x; });
  return objects;
}

/// Whether something of another object lies where changing surfaces cover it, or would: within
/// their box, and covered where they are opaque as written, or not where they are not.
bool any_is_covered(const Mesh& mesh, const std::vector<Changing>& objects) {
  double widest = 0;
  for (const Changing& one : objects) widest = std::max(widest, one.box.high.x - one.box.low.x);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const double x = mesh.corner(t, 0).x, first_x = x - widest - contact_m;
    auto one = std::lower_bound(objects.begin(), objects.end(), first_x,
                                [](const Changing& a, double low) { return a.box.low.x < low; });
    for (; one != objects.end() && one->box.low.x <= x + contact_m; ++one)
      if (one->object != mesh.triangle_object[t].index() && one->covers == mesh.is_covered(t) &&
          holds(one->box, mesh.corner(t, 0)) && holds(one->box, mesh.corner(t, 1)) &&
          holds(one->box, mesh.corner(t, 2)))
        return true;
  }
  return false;
}

/// What opaque surfaces cover was cut out with the materials as written.
void warn_of_uncovered(const std::vector<SceneSeason>& all, BuiltScene& built) {
  const Scene& written = built.scene;
  std::vector<std::uint8_t> changes(written.mesh.triangle_count(), 0);
  std::string names;
  for (const SceneSeason& season : all) {
    bool any = false;
    for (std::size_t t = 0; t < changes.size(); ++t) {
      const Material& now = season.materials[season.material[t].index()];
      if ((written.material_of(t).transmittance > 0) == (now.transmittance > 0)) continue;
      changes[t] = 1;
      any = true;
    }
    if (any) names += (names.empty() ? "'" : ", '") + season.name + "'";
  }
  if (names.empty()) return;
  if (!any_is_covered(written.mesh, changing_objects(written.mesh, changes, written))) return;
  built.warnings.push_back(fmt::format(
      "{} triangles let light pass in season {} or out of it, not in both: what they cover is "
      "what it is with the materials as written",
      std::count(changes.begin(), changes.end(), 1), names));
}

/// "leafless, snow, albedo 0.31".
std::string in_words(const MaterialsWhen& when) {
  Names words = when.seasons;
  if (when.albedo) words.push_back(fmt::format("albedo {:.2f}", *when.albedo));
  return joined(words);
}

SceneSeason season_of(const Study& study, const MaterialsWhen& when, const BuiltScene& built) {
  Scene scene;
  scene.mesh = built.scene.mesh;
  scene.mesh.triangle_sides = built.sides_of_files;  // by which a file's lamps share their power
  std::vector<std::string> said_before;
  assign_materials(study, {built.crs, built.site.north_deg}, scene, said_before, when);
  take_dark_backs(built, scene.mesh);
  const std::string name = in_words(when);
  expect_same_patches(study, built.scene, scene, name);
  return {name, std::move(scene.materials), std::move(scene.material)};
}

}  // namespace

std::vector<SeasonStretch> SceneSeasons::stretches(std::size_t first, std::size_t count) const {
  std::vector<SeasonStretch> stretches;
  for (std::size_t i = first; i < first + count; ++i) {
    if (stretches.empty() || stretches.back().season != of(i)) stretches.push_back({of(i), i, 0});
    ++stretches.back().count;
  }
  return stretches;
}

SceneSeasons take_seasons(const Study& study, const LightSeries& light, BuiltScene& built) {
  SceneSeasons seasons;
  if (!light.times_are_synthetic) warn_of_calendar_names(study, built.warnings);
  const auto matter = seasons_that_matter(study);
  const bool by_albedo = has_material_of_weather(study);
  if ((matter.empty() && !by_albedo) || light.times_are_synthetic) return seasons;
  std::vector<Moment> moments;
  auto of_interval = moments_of(matter, study, light, moments);
  warn_of_absent(matter, moments, built.warnings);
  const auto albedos =
      by_albedo ? mean_albedos(light, of_interval, moments.size()) : std::vector<double>();
  for (std::size_t m = 0; m < moments.size(); ++m) {
    MaterialsWhen when{moments[m].seasons};
    if (by_albedo) when.albedo = albedos[m];
    seasons.all.push_back(season_of(study, when, built));
  }
  warn_of_uncovered(seasons.all, built);
  join_equal(seasons.all, of_interval);
  if (seasons.all.size() > 1) {
    seasons.of_interval = std::move(of_interval);
    return seasons;
  }
  for (SceneSeason& only : seasons.all) {
    built.scene.materials = std::move(only.materials);
    built.scene.material = std::move(only.material);
  }
  return {};
}

Scene scene_in(const Scene& scene, const SceneSeason& season) {
  Scene now = scene;
  now.materials = season.materials;
  now.material = season.material;
  return now;
}

std::string seasons_text(const SceneSeasons& seasons, const LightSeries& light) {
  const auto hours = season_hours(seasons, light);
  std::string text;
  for (std::size_t s = 0; s < hours.size(); ++s)
    text +=
        fmt::format("{}{} {:.6g} h", text.empty() ? "" : ", ", words_of(seasons.all[s]), hours[s]);
  return text;
}

}  // namespace sunload
