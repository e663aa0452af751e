// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/weather_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

/// What is more than this share of all GHI, or DNI, is no noise of instruments, nor of sunrise and
/// sunset.
constexpr double telling_share_of_all = 0.01;
constexpr auto* question_of_time = "are stamp and time zone of the weather right?";

const char* quantity_name(WeatherQuantity quantity) {
  if (quantity == &WeatherValues::dni) return "DNI";
  return quantity == &WeatherValues::dhi ? "DHI" : "GHI";
}

/// A note, or a warning that asks for what is likely wrong.
void add_contradiction(const WeatherDoubt& doubt, double ghi_wh_m2, const char* what,
                       const char* taken, const char* question, WeatherSayings& sayings) {
  if (doubt.records == 0) return;
  const std::string share = ghi_wh_m2 > 0
                                ? fmt::format("{:.3g} % of GHI", 100 * doubt.wh_m2 / ghi_wh_m2)
                                : std::string("GHI has nothing");
  const std::string text = fmt::format("{} records have {}: {:.4g} Wh/m2 ({}) {}", doubt.records,
                                       what, doubt.wh_m2, share, taken);
  if (doubt.wh_m2 > telling_share_of_all * ghi_wh_m2) {
    sayings.warnings.push_back(fmt::format("weather: {}; {}", text, question));
  } else {
    sayings.notes.push_back(text);
  }
}

/// Where to look for them.
std::string place_words(const BelowZero& values, const std::string& path) {
  return fmt::format("the lowest is {:g} W/m2, the first {}:{} ({})", values.lowest_w_m2, path,
                     values.line, values.first);
}

}  // namespace

std::string source_words(WeatherSource source, Decomposition decomposition) {
  switch (source) {
    case WeatherSource::dni_and_dhi:
      return "DNI and DHI as they are";
    case WeatherSource::ghi_and_dhi:
      return "DHI as it is, DNI = (GHI - DHI) / sin(elevation)";
    case WeatherSource::ghi_and_dni:
      return "DNI as it is, DHI = GHI - DNI sin(elevation)";
    case WeatherSource::ghi_alone:
      return decomposition == Decomposition::erbs
                 ? "GHI divided into DNI and DHI after Erbs, Klein & Duffie (1982)"
                 : "GHI divided into DNI and DHI by DISC, Maxwell (1987)";
    case WeatherSource::none:
      break;
  }
  return "nothing";
}

std::string completed_words(WeatherSource has, Decomposition decomposition) {
  switch (has) {
    case WeatherSource::dni_and_dhi:
      return "have no GHI: it is DNI sin(elevation) + DHI";
    case WeatherSource::ghi_and_dhi:
      return "have no DNI: it is (GHI - DHI) / sin(elevation)";
    case WeatherSource::ghi_and_dni:
      return "have no DHI: it is GHI - DNI sin(elevation)";
    case WeatherSource::ghi_alone:
      return "have GHI alone: " + source_words(has, decomposition);
    case WeatherSource::none:
      break;
  }
  return "have nothing";
}

std::string lacking_words(const std::vector<DatedWeather>& weather, WeatherSource source) {
  std::vector<std::string> words;
  for (const WeatherQuantity quantity : needed(source)) {
    const auto lacking = std::count_if(weather.begin(), weather.end(), [&](const DatedWeather& w) {
      return !(w.values.*quantity).has_value();
    });
    if (lacking > 0) words.push_back(fmt::format("{} {}", quantity_name(quantity), lacking));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string missing_words(const WeatherValues& values, WeatherSource source) {
  std::vector<std::string> names;
  for (const WeatherQuantity quantity : needed(source))
    if (!(values.*quantity).has_value()) names.push_back(quantity_name(quantity));
  return fmt::format("{} {}", fmt::join(names, " and "), names.size() == 1 ? "is" : "are");
}

std::string lacking_light_warning(const Closure& closure, const std::string& path) {
  constexpr double telling_share = 0.1;   // of GHI
  constexpr double instruments_w_m2 = 5;  // BSRN, for GHI
  constexpr double rounding = 1e-9;
  const double lacking = -closure.bias, all = closure.mean_ghi;
  if (!(lacking > std::max(telling_share * all, instruments_w_m2))) return {};
  constexpr auto* hint =
      "if DNI and DHI were not measured leave their columns out, or their values empty (EPW: "
      "9999), "
      "so that light.decomposition divides GHI; or choose another file";
  if (lacking >= (1 - rounding) * all)
    throw InputError({path},
                     fmt::format("DNI and DHI are 0 in all of {} sunlit records, where GHI is "
                                 "{:.4g} W/m2 in the mean",
                                 closure.intervals, all),
                     "light is made from DNI and DHI: there would be none", hint);
  return fmt::format(
      "weather: DNI sin(elevation) + DHI is {:.3g} % less than GHI over {} sunlit records ({:.4g} "
      "instead of {:.4g} W/m2 in the mean): light is made from DNI and DHI, sun and sky bring less "
      "than the ground is said to get; are values that were not measured written as 0? {}",
      100 * lacking / all, closure.intervals, all - lacking, all, hint);
}

WeatherSayings below_zero_words(const WeatherFile& file, Missing missing) {
  const BelowZero &offsets = file.offsets, &too_low = file.too_low;
  if (too_low.count > 0 && missing == Missing::refuse)
    throw InputError(
        {file.path, too_low.line, 0}, too_low.first + " is too low for an irradiance",
        fmt::format("offsets of instruments reach {:g} W/m2; lower values in the file: {}, the "
                    "lowest is {:g} W/m2",
                    lowest_offset_w_m2, too_low.count, too_low.lowest_w_m2),
        "correct them, or write light.missing: interpolate or zero, which fills them");
  WeatherSayings sayings;
  if (offsets.count > 0)
    sayings.warnings.push_back(fmt::format(
        "weather: {} values from {:g} up to 0 W/m2 are taken as 0, as offsets of instruments: {}",
        offsets.count, lowest_offset_w_m2, place_words(offsets, file.path)));
  if (too_low.count > 0)
    sayings.warnings.push_back(fmt::format(
        "weather: {} values below {:g} W/m2, which offsets of instruments do not reach, are taken "
        "as missing: {}",
        too_low.count, lowest_offset_w_m2, place_words(too_low, file.path)));
  return sayings;
}

WeatherSayings doubt_words(const WeatherDoubts& doubts, const std::string& path) {
  constexpr auto* of_columns = "are the columns of the weather right?";
  WeatherSayings sayings;
  add_contradiction(doubts.beam_by_difference, doubts.ghi_wh_m2,
                    "GHI - DHI above the sun's own beam outside of the atmosphere",
                    "too much for it are taken as diffuse light", question_of_time, sayings);
  add_contradiction(doubts.dhi_above_ghi, doubts.ghi_wh_m2, "DHI above GHI",
                    "more light than GHI has, DHI is kept", of_columns, sayings);
  add_contradiction(doubts.beam_above_ghi, doubts.ghi_wh_m2, "DNI sin(elevation) above GHI",
                    "more light than GHI has, DNI is kept", question_of_time, sayings);
  if (doubts.dni.records > 0)
    sayings.warnings.push_back(fmt::format(
        "weather: {} records have DNI above the sun's own outside of the atmosphere, first {}:{} "
        "with {:.0f} of at most {:.0f} W/m2; they are taken as they are",
        doubts.dni.records, path, doubts.dni.line, doubts.dni.is, doubts.dni.at_most));
  if (doubts.no_light.records > 0)
    sayings.warnings.push_back(fmt::format(
        "weather: {} records have no light at all with the sun above {:g} degrees, first {}:{}; "
        "they are taken as they are: are missing values written as 0 there, and {}",
        doubts.no_light.records, surely_light_deg, path, doubts.no_light.line, question_of_time));
  constexpr double most_in_kw = 1.5;  // the sun's own beam outside of the atmosphere has 1.4
  if (doubts.most_w_m2 > 0 && doubts.most_w_m2 <= most_in_kw)
    sayings.warnings.push_back(fmt::format(
        "weather: no value of {} records with the sun above {:g} degrees exceeds {:.3g} W/m2; they "
        "are taken as they are: are they in kW/m2?",
        doubts.high_suns, surely_light_deg, doubts.most_w_m2));
  return sayings;
}

WeatherSayings dark_beam_words(const WeatherLight& light,
                               const std::vector<DatedWeather>& weather) {
  if (light.dark_beams == 0) return {};
  double dni_wh_m2 = 0;
  for (const DatedWeather& record : weather)
    dni_wh_m2 += record.values.dni.value_or(0) * (record.end - record.begin) / seconds_per_hour;
  const std::string text = fmt::format(
      "{} records have DNI without sun above the horizon: {:.4g} Wh/m2 of direct light dropped, "
      "DHI kept",
      light.dark_beams, light.dropped_dni_wh_m2);
  WeatherSayings said;
  if (light.dropped_dni_wh_m2 <= telling_share_of_all * dni_wh_m2)
    said.notes.push_back(text);
  else
    said.warnings.push_back(fmt::format("weather: {} ({:.3g} % of all DNI); {}", text,
                                        100 * light.dropped_dni_wh_m2 / dni_wh_m2,
                                        question_of_time));
  return said;
}

}  // namespace sunload
