// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/result_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "geo/base/units.h"
#include "geo/time/period_parts.h"
#include "io/result/h5.h"
#include "io/result/reader.h"
#include "solver/light/tally.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// A dimension of netCDF-4 without a variable: a size, neither words nor values.
bool is_size_only(const h5::Dataset& data) { return !data.text("long_name"); }

/// A double holds every value of the types of a result without loss.
bool same_values(const h5::Dataset& a, const h5::Dataset& b) {
  if (a.shape() != b.shape() || a.is_text() != b.is_text()) return false;
  if (is_size_only(a) || is_size_only(b)) return is_size_only(a) && is_size_only(b);
  return a.is_text() ? a.strings() == b.strings() : same_bits(a.doubles(), b.doubles());
}

std::vector<double> lengths_of(const ResultReader& result) {
  const auto bounds = result.doubles("time_bounds");
  std::vector<double> lengths;
  for (std::size_t k = 0; k + 1 < bounds.size(); k += 2)
    lengths.push_back(bounds[k + 1] - bounds[k]);
  return lengths;
}

double time_sum_kwh(const ResultReader& result, const std::string& term) {
  const auto power = result.doubles("power_" + term);
  const auto lengths = lengths_of(result);
  return std::inner_product(power.begin(), power.end(), lengths.begin(), 0.0) / joules_per_kwh;
}

/// Standard error of the residual's time sum: a dataset, or where the datasets
/// hold errors per instant an attribute.
double residual_se_kwh(const std::string& path) {
  const auto numbers = h5::File::open(path).dataset("power_residual").numbers("time_sum_se_kwh");
  return numbers ? numbers->at(0) : std::nan("");
}

bool differ(double a, double b, double tolerance) { return !(std::abs(a - b) <= tolerance); }

/// Series are float: of sums over them the terms' rounding is left.
double rounding_of(double value) { return float_rounding * std::abs(value) + 1e-12; }

std::string series_problem(const ResultReader& result) {
  const auto lengths = lengths_of(result);
  const std::size_t patches = result.shape("patch_area").at(0);
  std::vector<double> load(patches, 0), largest(patches, 0);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const auto row = result.row("irradiance", k);
    for (std::size_t i = 0; i < patches; ++i) {
      load[i] += row[i] * lengths[k] / joules_per_kwh;
      largest[i] = std::max(largest[i], row[i]);
    }
  }
  const auto total = result.doubles("light_load"), maximum = result.doubles("irradiance_max");
  std::vector<double> parts(patches, 0);
  for (const char* part : part_names) {
    const std::string name = std::string("light_load_") + part;
    if (!result.has(name)) continue;
    const auto of_part = result.doubles(name);
    for (std::size_t i = 0; i < patches; ++i) parts[i] += of_part[i];
  }
  for (std::size_t i = 0; i < patches; ++i) {
    if (differ(load[i], total[i], rounding_of(total[i])))
      return fmt::format("patch {}: series · time = {}, light_load = {}", i, load[i], total[i]);
    if (differ(parts[i], total[i], rounding_of(total[i])))
      return fmt::format("patch {}: parts = {}, light_load = {}", i, parts[i], total[i]);
    if (largest[i] != maximum[i])
      return fmt::format("patch {}: largest of the series {}, irradiance_max {}", i, largest[i],
                         maximum[i]);
  }
  return {};
}

std::string sun_hours_problem(const ResultReader& result) {
  const auto lengths = lengths_of(result), elevation = result.doubles("sun_elevation");
  double daylight_h = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k)
    if (elevation[k] > 0) daylight_h += lengths[k] / seconds_per_hour;
  for (const double hours : result.doubles("sun_hours"))
    if (!(hours >= 0 && hours <= daylight_h + rounding_of(daylight_h)))
      return fmt::format("sun_hours {} of {} h of daylight", hours, daylight_h);
  return {};
}

std::string facades_problem(const ResultReader& result) {
  const auto area = result.doubles("patch_area"), load = result.doubles("light_load");
  const auto facade = result.integers("patch_facade");
  const auto facade_area = result.doubles("facade_area");
  if (facade_area.empty()) return {};
  std::vector<double> patch_area(facade_area.size(), 0), energy = patch_area;
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (facade[i] < 0) continue;
    patch_area[static_cast<std::size_t>(facade[i])] += area[i];
    energy[static_cast<std::size_t>(facade[i])] += area[i] * load[i];
  }
  const auto facade_load = result.doubles("facade_light_load");
  for (std::size_t f = 0; f < facade_area.size(); ++f) {
    if (differ(patch_area[f], facade_area[f], rounding_of(facade_area[f])))
      return fmt::format("facade {}: patches have {} m2, facade_area {}", f, patch_area[f],
                         facade_area[f]);
    if (differ(energy[f], facade_load[f] * facade_area[f], rounding_of(energy[f])))
      return fmt::format("facade {}: patches receive {} kWh, the facade {}", f, energy[f],
                         facade_load[f] * facade_area[f]);
  }
  return {};
}

/// What patches send diffusely is what they reflect and emit.
std::string sent_light_problem(const ResultReader& result) {
  if (!result.has("diffuse_reflectance")) return {};  // its materials change with the seasons
  const auto load = result.doubles("light_load"), sent = result.doubles("power_load"),
             reflectance = result.doubles("diffuse_reflectance");
  auto emitted = std::vector<double>(load.size(), 0);
  if (result.has("emitted_exitance")) emitted = result.doubles("emitted_exitance");
  const auto lengths = lengths_of(result);
  const double hours = std::accumulate(lengths.begin(), lengths.end(), 0.0) / joules_per_kwh;
  for (std::size_t i = 0; i < load.size(); ++i) {
    const double known = reflectance[i] * load[i] + emitted[i] * hours;
    if (differ(sent[i], known, rounding_of(known)))
      return fmt::format("patch {}: power_load {}, reflected and emitted {}", i, sent[i], known);
  }
  return {};
}

/// Parts of the period make up all of it.
std::string parts_problem(const ResultReader& result) {
  // Stored as floats, and with bands or mirrors summed from floats.
  constexpr double rounding = 1e-5;
  // Where few solutions serve, what they make up below 0 for a realization counts as 0, in the
  // whole and in each part by itself: less than they are off by.
  double of_few = 0;
  if (result.number_attribute("year_skies") > 0) {
    const auto hours = result.doubles("sun_hours");
    of_few = result.number_attribute("reduction_error_w_m2") / 1000 *
             *std::max_element(hours.begin(), hours.end());
  }
  for (const std::string kind : part_kind_names) {
    if (!result.has(kind)) continue;
    for (const std::string total :
         {"light_load", "light_load_direct", "sun_hours", "light_load_realization",
          "facade_light_load", "facade_light_load_realization", "sensor_light_load",
          "sensor_light_load_realization", "sensor_sun_hours"}) {
      if (!result.has(total)) continue;
      const std::string end = total.ends_with("_realization") ? "_realization" : "",
                        parts = total.substr(0, total.size() - end.size()) + "_by_" + kind + end;
      if (!result.has(parts)) return parts + " is missing";
      const auto whole = result.doubles(total), rows = result.doubles(parts);
      const double largest = *std::max_element(whole.begin(), whole.end());
      const double off = rounding * largest + (end.empty() ? 0 : of_few);
      for (std::size_t i = 0; i < whole.size(); ++i) {
        double sum = 0;
        for (std::size_t at = i; at < rows.size(); at += whole.size()) sum += rows[at];
        if (!(std::abs(sum - whole[i]) <= off))
          return fmt::format("{} adds up to {} at place {}, not to {}", parts, sum, i, whole[i]);
      }
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> different_data(const std::string& a, const std::string& b) {
  const auto first = h5::File::open(a), second = h5::File::open(b);
  auto names = first.names();
  for (const auto& name : second.names())
    if (!first.has(name)) names.push_back(name);
  std::vector<std::string> different;
  for (const auto& name : names)
    if (!first.has(name) || !second.has(name) ||
        !same_values(first.dataset(name), second.dataset(name)))
      different.push_back(name);
  return different;
}

Energy energy_of(const std::string& path) {
  const ResultReader result(path);
  Energy energy;
  for (const char* term : {"sun", "sky", "ground", "emitted"})
    energy.in += time_sum_kwh(result, term);
  for (const char* term : {"absorbed", "transmitted", "escaped", "unshot"})
    energy.out += time_sum_kwh(result, term);
  energy.residual = time_sum_kwh(result, "residual");
  energy.residual_se = residual_se_kwh(path);
  energy.reuse_bias = result.number_attribute("residual_reuse_bias_kwh");
  energy.realizations = result.shape("light_load_realization").at(0);
  return energy;
}

std::string ledger_problem(const std::string& path, double lost_share) {
  const Energy e = energy_of(path);
  const double lost = lost_share * time_sum_kwh(ResultReader(path), "absorbed");
  const double limit = accepted_t(e.realizations) * e.residual_se + rounding_of(e.in);
  if (differ(e.residual, e.in - e.out, rounding_of(e.in)))
    return fmt::format("residual {} is not in {} - out {}", e.residual, e.in, e.out);
  if (differ(e.residual + lost, e.reuse_bias, limit))
    return fmt::format("residual {} kWh of {} in, {} of it by reuse of lines, limit {}",
                       e.residual + lost, e.in, e.reuse_bias, limit);
  return {};
}

std::string sums_problem(const std::string& path) {
  const ResultReader result(path);
  for (const auto& problem :
       {series_problem(result), sun_hours_problem(result), facades_problem(result),
        parts_problem(result), sent_light_problem(result)})
    if (!problem.empty()) return path + ": " + problem;
  return {};
}

}  // namespace sunload::test
