// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/energy_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "io/base/text.h"
#include "io/result/time.h"

namespace sunload {
namespace {

/// Relative to the light that comes in: columns of a block of suns are in single precision.
constexpr double rounding = 1e-7;

/// Time sum of one term of the ledger [kWh, klm h], of the rows that are there (a partial result
/// lacks some); 0 where the result lacks the term.
double ledger_kwh(const ResultReader& result, const std::string& term) {
  if (!result.has("power_" + term)) return 0;
  const auto power = result.doubles("power_" + term);
  const auto lengths = interval_lengths(result);
  double energy = 0;
  for (std::size_t i = 0; i < std::min(power.size(), lengths.size()); ++i)
    if (!std::isnan(power[i])) energy += power[i] * lengths[i];
  return energy / joules_per_kwh;
}

/// Realizations of so few lines hit bright surfaces or not: where none of them does, all look
/// alike, and their spread says nothing. From four lines on the error of a single run holds
/// (builtin `emission`, 24 seeds).
constexpr double fewest_lines = 4;

/// Once, not for each band.
std::string warning_of_few_lines(const ResultReader& result) {
  if (result.band()) return {};
  const double each =
      result.number_attribute("lines_per_patch") / result.number_attribute("realizations");
  if (!(each < fewest_lines)) return {};
  return info_line("", fmt::format("its error cannot be trusted with {:g} line{} per patch and "
                                   "realization: take {:g} or more",
                                   each, each == 1 ? "" : "s", fewest_lines));
}

/// What was estimated of the light that is not followed; nothing where that was left.
std::string estimated_line(const ResultReader& result, double in) {
  const double estimated = ledger_kwh(result, "estimated");
  if (estimated == 0) return {};
  return info_line(
      "", fmt::format("estimated {} ({:.2g} % of in): what surfaces receive of light that is "
                      "not followed, part of the {}",
                      number_text(estimated, 3), in == 0 ? 0 : estimated / in * 100,
                      dataset_name("irradiance", result.quantity())));
}

/// The ledger of what the reader shows; `label` names its first line.
std::string ledger_lines(const ResultReader& result, const std::string& label) {
  const Quantity quantity = result.quantity();
  double in = 0, out = 0;
  std::string in_words, out_words;
  for (const char* term : {"sun", "sky", "ground", "emitted"}) {
    const double energy = ledger_kwh(result, term);
    in += energy;
    if (energy != 0)
      in_words +=
          fmt::format("{}{} {}", in_words.empty() ? "" : " + ", term, number_text(energy, 5));
  }
  for (const char* term : {"absorbed", "transmitted", "escaped", "unshot"}) {
    const double energy = ledger_kwh(result, term);
    out += energy;
    // What is less is what the rounding of sums leaves of a difference.
    if (std::abs(energy) > rounding * in)
      out_words +=
          fmt::format("{}{} {}", out_words.empty() ? "" : " + ", term, number_text(energy, 5));
  }
  if (in == 0 && out == 0) return info_line(label.c_str(), "none");
  const double residual = ledger_kwh(result, "residual");
  // An attribute of the term: the dataset of errors may hold those of the instants.
  const double error_kwh =
      result.has("power_residual")
          ? result.number_attribute("power_residual", unit_names("time_sum_se_kwh", quantity))
          : std::nan("");
  const std::string error =
      std::isnan(error_kwh) ? std::string() : " ± " + number_text(error_kwh, 2);
  // Of the mean of bands.
  const double bias =
      result.band() ? std::nan("")
                    : result.number_attribute(unit_names("residual_reuse_bias_kwh", quantity));
  const std::string reuse = std::isnan(bias)
                                ? std::string()
                                : ", of which " + number_text(bias, 2) + " by reuse of lines";
  return info_line(label.c_str(), fmt::format("in {} = {}", number_text(in, 6), in_words)) +
         info_line("", fmt::format("out {} = {}", number_text(out, 6), out_words)) +
         info_line("", fmt::format("residual {}{} ({:.2g} % of in){}", number_text(residual, 3),
                                   error, in == 0 ? 0 : residual / in * 100, reuse)) +
         warning_of_few_lines(result) + estimated_line(result, in);
}

}  // namespace

std::string energy_text(const ResultReader& result) {
  if (!result.has("power_sun")) return {};
  std::string text = ledger_lines(
      result, result.quantity() == Quantity::illuminance ? "light, klm h" : "energy, kWh");
  if (result.bands() == Bands::broadband || result.band()) return text;
  for (std::size_t b = 0; b < band_count; ++b)
    text += ledger_lines(ResultReader(result.path(), b), std::string("  ") + band_names[b]);
  return text;
}

std::string info_line(const char* name, const std::string& text) {
  return text.empty() ? text : fmt::format("{:<13}{}\n", name, text);
}

}  // namespace sunload
