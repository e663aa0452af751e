// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/study_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "geo/base/units.h"
#include "io/base/name_pattern.h"
#include "io/measure/rules.h"
#include "io/measure/sun_day.h"
#include "io/plan/planner.h"
#include "io/plan/selection.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

namespace {

std::vector<std::string> facade_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Facade& facade : mesh.facades) names.push_back(facade.name);
  return names;
}

/// Objects or facades that a measure is of, and that a scene does not have.
struct AbsentPlace {
  const MeasureParameters* of;
  std::string kind, pattern;
  std::vector<std::string> near;  ///< names that it has and that may be meant
};

std::vector<AbsentPlace> absent_places(const Study& study, const Mesh& mesh) {
  std::vector<AbsentPlace> absent;
  const auto objects = names_with_surfaces({mesh.object_names, mesh.object_kinds, mesh.families});
  const auto facades = facade_names(mesh);
  const auto look_for = [&](const std::string& pattern, const std::vector<std::string>& names,
                            const char* kind, const MeasureParameters& of) {
    const auto is_it = [&](const std::string& name) { return matches(pattern, name); };
    if (!pattern.empty() && std::none_of(names.begin(), names.end(), is_it))
      absent.push_back({&of, kind, pattern, near_names(pattern, names)});
  };
  for (const MeasureParameters& of : study.measures) {
    look_for(of.of.object, objects, "object", of);
    look_for(of.of.facade, facades, "facade", of);
  }
  return absent;
}

bool are_same(const AbsentPlace& a, const AbsentPlace& b) {
  return a.of->name == b.of->name && a.kind == b.kind && a.pattern == b.pattern;
}

/// Those that this variant, too, does not have; all of them where its scene cannot be made, which
/// is told where it is planned.
std::vector<AbsentPlace> still_absent(std::vector<AbsentPlace> absent, const Study& variant,
                                      Planner& planner) {
  try {
    const auto here = absent_places(variant, planner.scene_uncovered(variant).scene.mesh);
    std::erase_if(absent, [&](const AbsentPlace& place) {
      return std::none_of(here.begin(), here.end(),
                          [&](const AbsentPlace& other) { return are_same(place, other); });
    });
  } catch (const InputError&) {
    return absent;
  }
  return absent;
}

/// `quantity`: of the series.
MeasuredInterval measured(const LitInterval& lit, Quantity quantity) {
  MeasuredInterval interval{lit.when.begin, lit.when.end, 0, source_means(lit, quantity).dhi, {}};
  if (lit.when.sunlit_s <= 0) return interval;
  // Means are over the whole interval.
  interval.dni = lit.mean.dni * lit.when.length_s() / lit.when.sunlit_s;
  const auto& samples = lit.when.sun_samples;
  if (samples.empty()) interval.suns = {{lit.when.direction, lit.when.sunlit_s}};
  for (const Vec3& sun : samples)
    interval.suns.push_back({sun, lit.when.sunlit_s / static_cast<double>(samples.size())});
  std::erase_if(interval.suns, [](const SunStretch& sun) { return sun.direction.z <= 0; });
  return interval;
}

/// The rule's own day, in the year in which the period begins.
void fill_in_date(MeasureParameters& of, const MeasureRule& rule, const VariantPlan& plan) {
  if (of.date || !rule.day) return;
  const TimeZone zone(plan.built.site.timezone);
  const auto [month, day] = *rule.day;
  // Years of weather begin some hours before those of a zone that is behind the station's.
  const auto& intervals = plan.light.intervals;
  const bool is_of_weather = std::holds_alternative<WeatherPeriod>(plan.study.period.kind);
  const UnixTime when =
      std::min(intervals.front().when.begin + (is_of_weather ? seconds_per_day : 0),
               intervals.back().when.begin);
  of.date = {zone.civil_from_utc(when).year, month, day};
}

/// Whether faces are of what a measure names besides a selection; `facade`: of their side.
class MeasuredFaces {
 public:
  MeasuredFaces(const MeasureOf& of, const Mesh& mesh)
      : of_(of), mesh_(mesh), named_(objects_named(of.object, mesh)) {}

  bool hold(std::size_t t, FacadeId facade) const {
    if (!of_.facade.empty() &&
        (!facade.exists() || !matches(of_.facade, mesh_.facades[facade.index()].name)))
      return false;
    const auto surface = surface_names[static_cast<std::size_t>(mesh_.triangle_surface[t])];
    if (!of_.surface.empty() && of_.surface != surface) return false;
    return named_[mesh_.triangle_object[t].index()] != 0;
  }

 private:
  const MeasureOf& of_;
  const Mesh& mesh_;
  ChosenObjects named_;
};

std::vector<std::size_t> chosen_patches(const MeasureOf& of, const VariantPlan& plan,
                                        const Hierarchy& hierarchy) {
  const Mesh& mesh = plan.built.scene.mesh;
  ChosenParts selected(hierarchy.patch_count(), 1);
  for (const NamedSelection& selection : plan.study.selections)
    if (selection.name == of.selection)
      selected = selected_patches(selection, plan.built, hierarchy);
  const MeasuredFaces measured_faces(of, mesh);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i) {
    if (selected[i] == 0) continue;
    const Patch& patch = hierarchy.patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    const FacadeId facade = patch.side == 0 ? mesh.triangle_facade[t] : FacadeId::none();
    if (measured_faces.hold(t, facade)) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

void expect_measured_somewhere(const StudyFile& file, const std::vector<Study>& chosen,
                               Planner& planner) {
  for (const Study& study : chosen) {
    std::vector<AbsentPlace> absent;
    try {
      absent = absent_places(study, planner.scene_uncovered(study).scene.mesh);
    } catch (const InputError&) {
      continue;
    }
    // What it costs to look elsewhere is paid for slips and by variants that lack something.
    for (const auto* variants : {&chosen, &file.variants})
      for (const Study& other : *variants)
        if (!absent.empty()) absent = still_absent(std::move(absent), other, planner);
    Problems problems;
    for (const AbsentPlace& place : absent)
      problems.add(
          place.of->where,
          fmt::format("measure {}: no {} matches '{}'", place.of->name, place.kind, place.pattern),
          file.variants.size() > 1 ? "in any variant of the study" : "",
          place.near.empty() ? "" : fmt::format("did you mean {}?", fmt::join(place.near, ", ")));
    problems.throw_if_any();
  }
}

void warn_of_absent_places(const Study& study, const BuiltScene& built,
                           std::vector<std::string>& warnings) {
  for (const AbsentPlace& place : absent_places(study, built.scene.mesh))
    warnings.push_back(
        message(place.of->where,
                fmt::format("measure {}: no {} of variant {} matches '{}'", place.of->name,
                            place.kind, study.variant, place.pattern),
                "nothing is measured of it there"));
}

void warn_of_no_faces(const Study& study, const BuiltScene& built,
                      std::vector<std::string>& warnings) {
  const Mesh& mesh = built.scene.mesh;
  const auto absent = absent_places(study, mesh);
  for (const MeasureParameters& measure : study.measures) {
    const MeasureOf& of = measure.of;
    std::vector<std::string> words;
    for (const auto& [key, value] :
         {std::pair{"object", &of.object}, {"facade", &of.facade}, {"surface", &of.surface}})
      if (!value->empty()) words.push_back(fmt::format("{} '{}'", key, *value));
    if (words.empty() || std::any_of(absent.begin(), absent.end(), [&](const AbsentPlace& place) {
          return place.of == &measure;
        }))
      continue;
    const MeasuredFaces faces(of, mesh);
    bool is_any = false;
    for (std::size_t t = 0; t < mesh.triangle_count() && !is_any; ++t)
      is_any = mesh.bears_patches(t) && faces.hold(t, mesh.triangle_facade[t]);
    if (is_any) continue;
    warnings.push_back(
        message(measure.where,
                fmt::format("measure {}: no surface of variant {} is of {}", measure.name,
                            study.variant, fmt::join(words, " and ")),
                "nothing is measured but sensors",
                of.facade.empty() ? "" : "facades are of walls; leave one of the keys away"));
  }
}

void expect_measurable(const Study& study, const LightSeries& light) {
  // A year of weather files, leap days left out; the longest, with a closing row.
  constexpr double year_s = 365 * seconds_per_day, longest_s = 367 * seconds_per_day;
  const double length_s = std::accumulate(
      light.intervals.begin(), light.intervals.end(), 0.0,
      [](double sum, const LitInterval& interval) { return sum + interval.when.length_s(); });
  Problems problems;
  for (const MeasureParameters& of : study.measures) {
    using Spans = MeasureRule::Spans;
    const Spans spans = find_measure_rule(of.rule)->spans;
    if (spans != Spans::any_period && length_s < year_s)
      problems.add(of.where, "measure " + of.name + " needs a whole year",
                   "its values are those of a year", "write period: {year_of: weather}");
    // Shares of a year are those of several, too; sums are not.
    if (spans == Spans::whole_year && length_s > longest_s)
      problems.add(of.where, "measure " + of.name + " needs one year",
                   fmt::format("its values are those of a year, and the period has {:.5g} days",
                               length_s / seconds_per_day),
                   "write a period of one year, or a study of each");
  }
  problems.throw_if_any();
}

void warn_of_no_values(const Study& study, const LightSeries& light,
                       std::vector<std::string>& warnings) {
  const auto counts = [&](const LitInterval& lit) {
    return is_without_sun(measured(lit, study.light.quantity));
  };
  for (const MeasureParameters& of : study.measures)
    if (find_measure_rule(of.rule)->counts == MeasureRule::Counts::without_sun &&
        std::none_of(light.intervals.begin(), light.intervals.end(), counts))
      warnings.push_back(
          message(of.where, "measure " + of.name + " has no value",
                  "it is taken over intervals with light but without sun, and the period has none",
                  "write an overcast sky, light: {source: fixed, dni_w_m2: 0, dhi_w_m2: 200, sky: "
                  "cie_overcast}, or weather with cloudy hours"));
}

void warn_of_lamps(const Study& study, std::vector<std::string>& warnings) {
  for (const MeasureParameters& of : study.measures)
    if (find_measure_rule(of.rule)->counts == MeasureRule::Counts::without_sun &&
        of.words.at("light") != "sky")
      warnings.push_back(message(of.where, "measure " + of.name + " counts the light of lamps",
                                 "they are in the scene, and daylight is of the sky alone",
                                 "leave them away in a variant, or write light: sky"));
}

StudyMeasures::StudyMeasures(const VariantPlan& plan, const Hierarchy& hierarchy) {
  if (plan.study.measures.empty()) return;
  const Scene& scene = plan.built.scene;
  caster_ = std::make_unique<RayCaster>(scene.mesh, plan.isa);
  // Rules look at light of intervals as they are, also where these are solved together.
  for (const LitInterval& lit : plan.light.intervals) {
    if (!lit.joined) intervals_.push_back(measured(lit, plan.study.light.quantity));
    for (const LitInterval& part : lit.parts())
      intervals_.push_back(measured(part, plan.study.light.quantity));
  }
  for (const MeasureParameters& of : plan.study.measures) {
    StudyMeasure& m = all_.emplace_back(StudyMeasure{of, find_measure_rule(of.rule), {}, {}, {}});
    fill_in_date(m.parameters, *m.rule, plan);
    m.patches = chosen_patches(of.of, plan, hierarchy);
    m.scene = std::make_unique<MeasuredScene>(MeasuredScene{{},
                                                            m.patches.size(),
                                                            *caster_,
                                                            plan.built.site,
                                                            plan.study.sun.refraction,
                                                            plan.study.sun.ut1_utc,
                                                            intervals_});
    for (const std::size_t i : m.patches)
      m.scene->points.push_back({hierarchy.centroid(i), hierarchy.normal(i)});
    for (const Sensor& sensor : scene.sensors)
      m.scene->points.push_back({sensor.position, sensor.normal});
    m.measure = m.rule->start(m.parameters, *m.scene);
  }
}

namespace {

/// When the sun stands high enough in the open: "from 07:31 to 16:52 (13 deg and higher)".
std::string counted_sun_in_words(const MeasureParameters& of, const VariantPlan& plan) {
  const auto key = of.numbers.find("least_elevation_deg");
  const double least_deg = key == of.numbers.end() ? 0 : key->second;
  const Site& site = plan.built.site;
  const auto spans =
      sun_course(site, plan.study.sun.refraction, plan.study.sun.ut1_utc, *of.date, least_deg)
          .counted;
  if (spans.empty()) return fmt::format("it stays below {:g} deg, and nothing has any", least_deg);
  const TimeZone zone(site.timezone);
  const auto clock = [&](UnixTime t) {
    const CivilTime at = zone.civil_from_utc(t);
    return fmt::format("{:02}:{:02}", at.hour, at.minute);
  };
  return fmt::format("from {} to {} ({:g} deg and higher)", clock(spans.front().begin),
                     clock(spans.back().end), least_deg);
}

}  // namespace

std::vector<std::string> measures_in_words(const VariantPlan& plan, const Hierarchy& hierarchy) {
  std::vector<std::string> lines;
  const std::size_t sensors = plan.built.scene.sensors.size();
  for (MeasureParameters of : plan.study.measures) {
    const MeasureRule& rule = *find_measure_rule(of.rule);
    fill_in_date(of, rule, plan);
    std::string needs;
    switch (rule.needs) {
      case MeasureRule::Needs::geometry:
        needs = "the scene alone, in any light";
        break;
      case MeasureRule::Needs::sun_path:
        needs = fmt::format("the sun of {:04}-{:02}-{:02}, whatever the period: {}", of.date->year,
                            of.date->month, of.date->day, counted_sun_in_words(of, plan));
        break;
      case MeasureRule::Needs::intervals:
        needs = fmt::format("suns and weather of the period's {} intervals", plan.intervals());
        break;
      case MeasureRule::Needs::series:
        needs = "the series that the run computes";
        break;
    }
    lines.push_back(
        fmt::format("{}: {} of {} patches{}; needs {}", of.name, of.rule,
                    chosen_patches(of.of, plan, hierarchy).size(),
                    sensors > 0 ? fmt::format(" and {} sensor{}", sensors, sensors == 1 ? "" : "s")
                                : std::string(),
                    needs));
  }
  return lines;
}

}  // namespace sunload
