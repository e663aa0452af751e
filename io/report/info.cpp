// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "geo/base/units.h"
#include "io/base/light_quantity.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/plan/time_words.h"
#include "io/report/measures.h"
#include "io/result/energy_text.h"
#include "io/result/mesh_error.h"
#include "io/result/own_seasons.h"
#include "io/result/part_of_period.h"
#include "io/result/patch_groups.h"
#include "io/result/time.h"

namespace sunload {
namespace {

// Patches below this share of the largest load say nothing of the accuracy:
// their relative error is large and their light does not matter (docs/developer/design.md, Study).
constexpr double share_that_counts = 0.01;
constexpr double median = 0.5;
constexpr double upper_quantile = 0.95;
constexpr std::size_t facades_shown = 3;

std::string heading(const ResultReader& result) {
  const auto study = result.text_attribute("study");
  return fmt::format("{}, variant {}\n", study.empty() ? result.text_attribute("title") : study,
                     result.text_attribute("variant"));
}

/// "snow 312 h, leafless 1200 h": of the study's own, which may overlap.
std::string own_seasons_in_words(const ResultReader& result) {
  const OwnSeasons own = own_seasons(result);
  const auto lengths = interval_lengths(result), shares = result.chosen_shares();
  std::string text;
  for (std::size_t s = 0; s < own.names.size(); ++s) {
    double hours = 0;
    for (std::size_t k = 0; k < own.flags.size(); ++k)
      if ((own.flags[k] >> s & 1) != 0) hours += shares[k] * lengths[k] / seconds_per_hour;
    text += fmt::format("{}{} {:.5g} h", text.empty() ? "" : ", ", own.names[s], hours);
  }
  return text;
}

std::string period(const ResultReader& result) {
  const auto lengths = interval_lengths(result), shares = result.chosen_shares();
  std::vector<std::size_t> chosen;
  double hours = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    if (shares[k] > 0) chosen.push_back(k);
    hours += shares[k] * lengths[k] / seconds_per_hour;
  }
  if (chosen.empty()) return info_line("period", "no intervals");
  const std::string step = series_step(result);
  auto text = info_line("period", fmt::format("{} {}{}, {:.5g} h in all", chosen.size(),
                                              step.empty() ? "interval" : "step",
                                              chosen.size() == 1 ? "" : "s", hours));
  if (has_no_dates(result)) return text + info_line("", "sun positions without a date");
  text += info_line("  days", period_in_words(result));
  if (const std::string seasons = own_seasons_in_words(result); !seasons.empty())
    text += info_line("  seasons", seasons);
  if (!step.empty())
    return text + info_line("  steps", "series are means over steps: " + step +
                                           "; largest values are those of intervals");
  text += info_line("  first", interval_in_words(result, chosen.front()));
  if (chosen.size() > 1) text += info_line("  last", interval_in_words(result, chosen.back()));
  return text;
}

/// Where north is, and a shadow that anybody can check with a stick.
std::string orientation(const ResultReader& result) {
  const double north = result.number_attribute("north_deg");
  const double latitude = result.number_attribute("latitude_deg");
  if (std::isnan(north)) return {};
  std::string text = info_line("north", north_words(north));
  Site site;
  site.latitude_deg = latitude;
  site.longitude_deg = result.number_attribute("longitude_deg");
  site.elevation_m = result.number_attribute("elevation_m");
  const bool has_place = std::isfinite(site.latitude_deg + site.longitude_deg + site.elevation_m);
  if (!has_place || has_no_dates(result)) return text;
  return text +
         info_line("pole test", pole_words(site, result.doubles("time"), result_zone(result)));
}

std::string size(const ResultReader& result, const PatchGroups& groups) {
  return info_line(
      "scene", fmt::format("{} patches, {:.1f} m², {} objects, {} facades", groups.patch_count(),
                           groups.groups().front().area_m2, result.strings("object_name").size(),
                           result.strings("facade_name").size()));
}

/// The goals of the study and what came of them.
std::string asked_for(const ResultReader& result) {
  std::string text;
  const auto add = [&](const char* goal_name, const char* share_name, const char* when) {
    const double goal = result.number_attribute(goal_name);
    if (std::isnan(goal)) return;
    const double share = result.number_attribute(share_name);
    text += info_line(
        "", fmt::format("asked for: below {:.3g} %{} on 95 % of the area", 100 * goal, when) +
                (std::isnan(share) ? std::string()
                                   : fmt::format("; reached on {:.3g} %", 100 * share)));
  };
  add("accuracy_light_load_relative", "accuracy_area_share", "");
  add("accuracy_irradiance_relative", "accuracy_irradiance_share", " at every instant");
  return text;
}

/// Of a year from few solutions.
std::string reduction(const ResultReader& result) {
  const double skies = result.number_attribute("year_skies");
  if (std::isnan(skies)) return {};
  const Quantity quantity = result.quantity();
  return info_line(
      "", fmt::format("sky and reflected light of all intervals from {:.0f} skies and {:.0f} suns, "
                      "off by {:.2g} {} (root mean square), {:.0f} % of the standard error that an "
                      "interval's have",
                      skies, result.number_attribute("year_suns"),
                      result.number_attribute(unit_names("reduction_error_w_m2", quantity)),
                      quantity == Quantity::illuminance ? "lx" : "W/m²",
                      100 * result.number_attribute("reduction_error_share")));
}

std::string accuracy(const ResultReader& result, const std::vector<double>& load) {
  const auto realizations =
      result.has("light_load_realization") ? result.shape("light_load_realization").front() : 0;
  if (!result.has("light_load_se") || realizations < 2)
    return info_line("accuracy", "not known: the result has no standard errors");
  const auto se = result.doubles("light_load_se");
  const double largest = *std::max_element(load.begin(), load.end());
  if (largest <= 0) return info_line("accuracy", "no patch receives light");
  const auto areas = result.doubles("patch_area");
  std::vector<double> relative, area;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (load[i] <= 0 || load[i] < share_that_counts * largest) continue;
    relative.push_back(se[i] / load[i] * 100);
    area.push_back(areas[i]);
  }
  return info_line(
             "accuracy",
             fmt::format("standard error of a patch's light load: {:.2g} % (median by area), below "
                         "{:.2g} % on 95 %; {} realizations",
                         weighted_quantile(relative, area, median),
                         weighted_quantile(relative, area, upper_quantile), realizations)) +
         reduction(result) + asked_for(result);
}

/// Least, mean and largest value of a quantity over the patches, and all their ratios.
std::string analysis(const std::string& name, const std::vector<double>& values,
                     const PatchGroups& groups) {
  if (values.empty()) return {};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double mean = groups.means(values.data()).front();
  const auto ratio = [](double a, double b) {
    return b == 0 ? std::string("-") : fmt::format("{:.3f}", a / b);
  };
  return fmt::format("  {:<24}{:>10} {:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9}\n", name,
                     number_text(*least, 4), number_text(mean, 4), number_text(*largest, 4),
                     ratio(*least, mean), ratio(*least, *largest), ratio(mean, *least),
                     ratio(*largest, *least), ratio(*largest, mean));
}

std::string lighting_analysis(const ResultReader& result, const PatchGroups& groups,
                              const std::vector<double>& load) {
  std::string text =
      fmt::format("{:<26}{:>10} {:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "lighting analysis",
                  "min", "mean", "max", "min/mean", "min/max", "mean/min", "max/min", "max/mean");
  const std::string series = dataset_name("irradiance", result.quantity());
  const auto with_units = [&](const std::string& name, const std::string& dataset) {
    return name + ", " + display_units(result.units(dataset));
  };
  text += analysis(with_units("light load", "light_load"), load, groups);
  if (result.has(series) && result.shape(series).front() > 0) {
    const auto brightest = brightest_interval(result);
    text += analysis(with_units(series, series) + " (1)", result.row(series, brightest), groups);
    if (result.has("sun_hours"))
      text += analysis("sun hours, h", result.doubles("sun_hours"), groups);
    text += "  (1) brightest row: " + row_in_words(result, brightest) + "\n";
  } else if (result.has("sun_hours")) {
    text += analysis("sun hours, h", result.doubles("sun_hours"), groups);
  }
  return text;
}

/// How many sensors, what falls on them, and how well it is known.
std::string sensors(const ResultReader& result) {
  if (!result.has("sensor_light_load")) return {};
  const auto load = result.doubles("sensor_light_load");
  const auto [least, largest] = std::minmax_element(load.begin(), load.end());
  const double mean =
      std::accumulate(load.begin(), load.end(), 0.0) / static_cast<double>(load.size());
  auto text = info_line("sensors", fmt::format("{}: light load {} … {} {}, mean {}", load.size(),
                                               number_text(*least, 4), number_text(*largest, 4),
                                               display_units(result.units("sensor_light_load")),
                                               number_text(mean, 4)));
  if (!result.has("sensor_light_load_se")) return text;
  const auto se = result.doubles("sensor_light_load_se");
  std::vector<double> relative, weight;
  for (std::size_t s = 0; s < load.size(); ++s) {
    if (load[s] <= 0 || load[s] < share_that_counts * *largest) continue;
    relative.push_back(se[s] / load[s] * 100);
    weight.push_back(1);
  }
  if (relative.empty()) return text;
  return text +
         info_line("", fmt::format("standard error {:.2g} % (median), below {:.2g} % for 95 %",
                                   weighted_quantile(relative, weight, median),
                                   weighted_quantile(relative, weight, upper_quantile)));
}

/// Mean over all patches of every part of the period that has totals of its own.
std::string parts_of_period(const ResultReader& result, const PatchGroups& groups) {
  constexpr std::size_t most_parts = 31;
  if (result.chosen().any()) return {};
  std::string text;
  for (const std::string kind : part_kind_names) {
    const std::string load = "light_load_by_" + kind, of_realizations = load + "_realization",
                      sun = "sun_hours_by_" + kind;
    if (!result.has(load) || result.shape(load).front() > most_parts) continue;
    const std::size_t patches = groups.patch_count();
    text += fmt::format("{:<18}{:>10}{:>14}{:>12}\n", "by " + kind, "time, h",
                        "load, " + display_units(result.units(load)), "sun, h");
    const auto labels = part_labels(result, kind);
    const auto hours = result.doubles(kind + "_duration");
    for (std::size_t part = 0; part < labels.size(); ++part) {
      std::vector<double> means;
      if (result.has(of_realizations)) {
        const auto rows = result.rows(of_realizations, part, 1);
        for (std::size_t first = 0; first + patches <= rows.size(); first += patches)
          means.push_back(groups.means(rows.data() + first).front());
      }
      const double se = sample_mean(means).se;
      text +=
          fmt::format("  {:<16}{:>10}{:>14}{:>12}{}\n", labels[part], number_text(hours[part], 4),
                      number_text(groups.means(result.row(load, part).data()).front(), 4),
                      number_text(groups.means(result.row(sun, part).data()).front(), 4),
                      std::isnan(se) ? std::string() : "  load ± " + number_text(se, 2));
    }
  }
  return text;
}

std::string facades(const ResultReader& result, const PatchGroups& groups,
                    const std::vector<double>& load) {
  const auto mean = groups.means(load.data());
  const auto realizations = group_realizations(result, groups);
  std::vector<std::size_t> order;
  for (std::size_t g = 0; g < groups.groups().size(); ++g)
    if (groups.groups()[g].kind == "facade") order.push_back(g);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return mean[a] > mean[b]; });
  const auto words = [&](std::size_t g) {
    const double se = sample_mean(realizations[g]).se;
    return groups.groups()[g].name + " " + number_text(mean[g], 4) +
           (std::isnan(se) ? std::string() : " ± " + number_text(se, 2));
  };
  std::string best, worst;
  const std::size_t shown = std::min(facades_shown, order.size());
  for (std::size_t k = 0; k < shown; ++k) {
    best += (k ? ", " : "") + words(order[k]);
    worst += (k ? ", " : "") + words(order[order.size() - 1 - k]);
  }
  if (shown == 0) return {};
  return info_line("facades", "mean light load ± standard error, " +
                                  display_units(result.units("light_load"))) +
         info_line("  most", best) + info_line("  least", worst);
}

std::string mesh_error(const ResultReader& result, const PatchGroups& groups,
                       const std::vector<double>& load) {
  if (!result.has("light_load_reflected")) return {};
  const auto reflected = result.doubles("light_load_reflected");
  const auto mean = groups.means(load.data()), error = mesh_errors(groups.means(reflected.data()));
  std::vector<double> percent;
  for (std::size_t g = 0; g < groups.groups().size(); ++g)
    if (groups.groups()[g].kind == "facade" && mean[g] > 0)
      percent.push_back(100 * error[g] / mean[g]);
  if (percent.empty()) return {};
  const std::vector<double> once(percent.size(), 1);
  return info_line(
      "mesh",
      fmt::format("reflected light is one value per patch, on the default mesh right within {:g} % "
                  "of it: {:.2g} % of a facade's load (median), below {:.2g} % on 95 %",
                  100 * mesh_error_of_reflected, weighted_quantile(percent, once, median),
                  weighted_quantile(percent, once, upper_quantile)));
}

/// What the light load tells, and what falls on sensors; of a part of the period that no merged
/// batch has light of, that there is none.
std::string light(const ResultReader& result, const PatchGroups& groups) {
  const auto load = result.doubles("light_load");
  if (!load.empty() &&
      std::all_of(load.begin(), load.end(), [](double x) { return std::isnan(x); }))
    return info_line("light load", "not known: no batch that was merged has light of " +
                                       (result.chosen().any() ? result.chosen().words()
                                                              : std::string("the period")));
  return accuracy(result, load) + mesh_error(result, groups, load) +
         lighting_analysis(result, groups, load) + parts_of_period(result, groups) +
         facades(result, groups, load) + sensors(result);
}

std::string runtime(const ResultReader& result) {
  std::string words;
  for (const char* stage :
       {"lines", "direct", "mirror", "solve", "realizations", "shoot", "sensors"}) {
    const double seconds = result.number_attribute(fmt::format("runtime_{}_s", stage));
    if (!std::isnan(seconds))
      words += fmt::format("{}{} {:.3g} s", words.empty() ? "" : ", ", stage, seconds);
  }
  return info_line("run time", words);
}

std::string band_words(const ResultReader& result) {
  if (result.bands() == Bands::broadband) return {};
  return result.band() ? fmt::format("{} of red, green, blue", band_names[*result.band()])
                       : "red, green, blue; shown is their mean, or one with --band";
}

}  // namespace

std::string info_text(const ResultReader& result) {
  const PatchGroups groups(result);
  std::string text = heading(result);
  text += period(result);
  text += orientation(result);
  text += size(result, groups);
  text += info_line("covered", result.text_attribute("covered"));
  text += info_line("bands", band_words(result));
  text += light(result, groups);
  text += result.chosen().any()
              ? info_line("energy", "of the whole period: without " + result.chosen().words())
              : energy_text(result);
  if (const auto measures = measures_line(result); !measures.empty()) {
    std::istringstream lines(measures);
    const char* word = "measures";
    for (std::string line; std::getline(lines, line); word = "") text += info_line(word, line);
  }
  text += runtime(result);
  text += info_line("made by", result.text_attribute("source"));
  return text;
}

}  // namespace sunload
