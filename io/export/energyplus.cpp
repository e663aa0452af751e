// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "geo/time/time.h"
#include "io/base/light_quantity.h"
#include "io/base/standard_streams.h"
#include "io/base/text.h"
#include "io/export/format.h"
#include "io/result/time.h"

namespace sunload {
namespace {

constexpr int days_of_year = 365, days_of_leap_year = 366;
constexpr double same_instant_s = 1e-3;

bool is_same(double one, double other) { return std::abs(one - other) < same_instant_s; }

/// Begins of the intervals in local standard time [s since 1970], and their length.
struct ShadingYear {
  std::vector<double> begin;
  double step_s = 0;
};

/// EnergyPlus wants every step of a year, in local standard time, a whole number in an hour.
ShadingYear expected_year(const ResultReader& result) {
  if (const std::string step = series_step(result); !step.empty())
    throw InputError({result.path()}, "series are means over steps: " + step,
                     "sunlit fractions are those of the sun of each interval",
                     "run the study with output.series_step: interval");
  const InputError not_a_year(
      {result.path()}, "the intervals are not those of a year of EnergyPlus",
      "it needs all of 365 or 366 days from 1 January 00:00 local standard time, in equal steps "
      "of which a whole number fits into an hour",
      "run a study with period: {start: YYYY-01-01T00:00, end: …, step_min: 60}; where clocks are "
      "put forward on 1 January, with site.timezone as a fixed offset, e.g. \"+09:30\"");
  const auto bounds = result.doubles("time_bounds");
  const std::size_t count = bounds.size() / 2;
  if (count == 0) throw not_a_year;
  ShadingYear year;
  year.step_s = bounds[1] - bounds[0];
  const auto middle = calendar_from_utc(bounds[2 * (count / 2)]);
  const double offset_s = result_zone(result).standard_offset_s(middle.year);
  for (std::size_t k = 0; k < count; ++k) {
    if (!is_same(bounds[2 * k + 1] - bounds[2 * k], year.step_s) ||
        (k > 0 && !is_same(bounds[2 * k], bounds[2 * k - 1])))
      throw not_a_year;
    year.begin.push_back(std::round(bounds[2 * k] + offset_s));
  }
  const double days = static_cast<double>(count) * year.step_s / seconds_per_day;
  const double steps_per_hour = seconds_per_hour / year.step_s;
  const auto first = calendar_from_utc(year.begin.front());
  if ((!is_same(days, days_of_year) && !is_same(days, days_of_leap_year)) ||
      !is_same(steps_per_hour, std::round(steps_per_hour)) || day_of_year(first) != 1 ||
      first.hour != 0 || first.minute != 0)
    throw not_a_year;
  return year;
}

/// "01/01 24:00": the end of an interval, midnight as that of the day that ends.
std::string end_text(double begin, double step_s) {
  const auto day = calendar_from_utc(begin);
  const double since_midnight = begin - std::floor(begin / seconds_per_day) * seconds_per_day;
  const auto minutes = std::lround((since_midnight + step_s) / seconds_per_minute);
  return fmt::format("{:02}/{:02} {:02}:{:02}", day.month, day.day, minutes / 60, minutes % 60);
}

/// What the fractions are made of.
struct Direct {
  std::string dataset, normal_dataset;
  std::vector<double> normal, sun;  ///< direct normal irradiance, direction to the sun
};

Direct direct_light(const ResultReader& result) {
  Direct direct;
  direct.dataset = dataset_name("irradiance_direct", result.quantity());
  direct.normal_dataset =
      result.quantity() == Quantity::illuminance ? "direct_normal_illuminance" : "dni";
  if (!result.has(direct.dataset))
    throw InputError(
        {result.path()}, "no dataset " + direct.dataset,
        "sunlit fractions are the direct light's share of what an unshaded facade gets",
        "run the study with the series in parts, or export to csv");
  direct.normal = result.doubles(direct.normal_dataset);
  direct.sun = result.doubles("sun_direction");
  return direct;
}

/// Roof patches of one object in one plane are one surface.
struct RoofPlane {
  Vec3 normal, through;
  std::int32_t surface;

  bool holds(Vec3 of_normal, Vec3 at) const {
    constexpr double least_cosine = 0.9998, apart_m = 0.05;  // 1 degree
    return dot(normal, of_normal) >= least_cosine && std::abs(dot(at - through, normal)) <= apart_m;
  }
};

/// Facades in the order of the file, then roofs by their planes: "house_3/roof_1".
class ShadedSurfaces {
 public:
  explicit ShadedSurfaces(const ResultReader& result)
      : patches_(result),
        surface_(result.integers("patch_facade")),
        names_(result.strings("facade_name")),
        facade_count_(names_.size()) {
    add_roofs(result);
    if (names_.empty())
      throw InputError({result.path()}, "no facades and roofs", "the scene has no walls");
  }
  const std::vector<std::string>& names() const { return names_; }
  /// From which of them on they are roofs.
  std::size_t facade_count() const { return facade_count_; }

  /// Direct light received by what the sun would give without any shade: 1 is unshaded. 0 for a
  /// surface that looks away. The rim of the sun's disk can still meet it, which is cut off.
  std::vector<double> sunlit(const std::vector<double>& direct, double normal, Vec3 sun) const {
    std::vector<double> received(names_.size(), 0), unshaded(names_.size(), 0);
    for (std::size_t i = 0; i < surface_.size(); ++i) {
      if (surface_[i] < 0) continue;
      const auto f = static_cast<std::size_t>(surface_[i]);
      received[f] += patches_.area[i] * direct[i];
      unshaded[f] += patches_.area[i] * normal * std::max(0.0, dot(patches_.normal[i], sun));
    }
    for (std::size_t f = 0; f < received.size(); ++f)
      received[f] = unshaded[f] > 0 ? std::clamp(received[f] / unshaded[f], 0.0, 1.0) : 0;
    return received;
  }

 private:
  void add_roofs(const ResultReader& result) {
    const auto kind = result.integers("patch_surface"), side = result.integers("patch_side");
    const auto centroid = result.doubles("patch_centroid");
    std::map<std::int32_t, std::vector<RoofPlane>> of_object;
    for (std::size_t i = 0; i < surface_.size(); ++i) {
      if (static_cast<Surface>(kind[i]) != Surface::roof || side[i] != 0 || surface_[i] >= 0)
        continue;
      const Vec3 at{centroid[3 * i], centroid[3 * i + 1], centroid[3 * i + 2]};
      auto& planes = of_object[patches_.object[i]];
      auto plane = std::ranges::find_if(
          planes, [&](const RoofPlane& of) { return of.holds(patches_.normal[i], at); });
      if (plane == planes.end()) {
        const auto object = static_cast<std::size_t>(patches_.object[i]);
        plane = planes.insert(planes.end(),
                              {patches_.normal[i], at, static_cast<std::int32_t>(names_.size())});
        names_.push_back(
            fmt::format("{}/roof_{}", patches_.object_names.at(object), planes.size()));
      }
      surface_[i] = plane->surface;
    }
  }

  ResultPatches patches_;
  std::vector<std::int32_t> surface_;  ///< per patch, into `names_`; -1: none
  std::vector<std::string> names_;
  std::size_t facade_count_;
};

/// Those that are named, of facades alone; else all.
std::vector<std::size_t> chosen_surfaces(const ResultReader& result, const ExportRules& rules,
                                         const ShadedSurfaces& surfaces) {
  auto chosen = chosen_facades(result, rules.parts);
  if (rules.parts.facades.empty())
    for (std::size_t f = surfaces.facade_count(); f < surfaces.names().size(); ++f)
      chosen.push_back(f);
  return chosen;
}

}  // namespace

void export_energyplus(const ResultReader& result, const ExportRules& rules,
                       const ExportTarget& target) {
  if (!rules.quantity.empty() || !rules.time.empty())
    throw InputError({}, "--quantity and --time with --to energyplus",
                     "the file holds the sunlit fractions of all intervals", "leave them out");
  if (!rules.parts.objects.empty() || !rules.parts.selections.empty() ||
      !rules.parts.sensors.empty())
    throw InputError({}, "--object, --selection and --sensor with --to energyplus",
                     "the file holds facades and roofs", "write --facade");
  const ShadingYear year = expected_year(result);
  const Direct direct = direct_light(result);
  const ShadedSurfaces surfaces(result);
  auto& out = target.stream;
  out << "Surface Name";
  const auto chosen = chosen_surfaces(result, rules, surfaces);
  for (const auto f : chosen) out << "," << csv_text(surfaces.names()[f]);
  out << "\n";
  std::size_t unknown = 0;
  for (std::size_t k = 0; k < year.begin.size(); ++k) {
    const Vec3 sun{direct.sun[3 * k], direct.sun[3 * k + 1], direct.sun[3 * k + 2]};
    if (sun.z > 0 && !(direct.normal[k] > 0)) ++unknown;
    const auto row = result.row(direct.dataset, k);
    if (std::any_of(row.begin(), row.end(), [](double value) { return std::isnan(value); }))
      throw InputError(
          {result.path()}, "the series is not complete",
          "there is no value at the interval that ends " + end_text(year.begin[k], year.step_s),
          "finish the run");
    out << end_text(year.begin[k], year.step_s);
    const auto sunlit = surfaces.sunlit(row, direct.normal[k], sun);
    for (const auto f : chosen) out << fmt::format(",{:.6g}", sunlit[f]);
    out << "\n";
  }
  if (unknown > 0)
    tell(
        fmt::format("{}: {} intervals with the sun up have no direct light and the fraction 0; "
                    "light.source: clear_sky has them all",
                    target.path.empty() ? "energyplus" : target.path, unknown));
}

}  // namespace sunload
