// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/radiance.h"

#include <numeric>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/result/time.h"

namespace sunload {

namespace {

constexpr const char* reflectance = "diffuse_reflectance";
constexpr const char* emitted = "emitted_exitance";

/// rho E + M of one band, or of light without bands.
std::vector<double> exitance_of(const ResultReader& band, std::vector<double> irradiance) {
  if (!band.has(reflectance))
    throw InputError(
        {band.path()}, "does not say what its surfaces reflect",
        "an earlier version computed it, or materials change with the seasons",
        "take the mean of its whole period, without --time and parts, or run the study "
        "again with --overwrite");
  const auto rho = band.doubles(reflectance);
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] *= rho[i];
  if (!band.has(emitted)) return irradiance;
  const auto own = band.doubles(emitted);
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] += own[i];
  return irradiance;
}

/// Radiance of that exitance. What a band's light is reflected by is its own: the mean is of the
/// products.
template <class Exitance>
std::vector<double> radiance_of(const ResultReader& result, const Exitance& exitance) {
  std::vector<double> radiance;
  const auto add = [&](const ResultReader& band, double share) {
    const auto of_band = exitance(band);
    radiance.resize(of_band.size(), 0);
    for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] += share * of_band[i] / pi;
  };
  if (result.bands() == Bands::broadband || result.band()) {
    add(result, 1);
    return radiance;
  }
  for (std::size_t b = 0; b < band_count; ++b) {
    ResultReader band(result.path(), b);
    band.choose(result.chosen());
    add(band, 1 / static_cast<double>(band_count));
  }
  return radiance;
}

/// Length of what is chosen of the period [s].
double chosen_seconds(const ResultReader& result) {
  const auto lengths = interval_lengths(result), shares = result.chosen_shares();
  return std::inner_product(lengths.begin(), lengths.end(), shares.begin(), 0.0);
}

std::vector<double> mean_of_load(std::vector<double> load, double seconds) {
  for (double& value : load) value *= joules_per_kwh / seconds;
  return load;
}

}  // namespace

std::string radiance_name(Quantity quantity) {
  return quantity == Quantity::illuminance ? "luminance" : "radiance";
}

std::string radiance_units(Quantity quantity) {
  return quantity == Quantity::illuminance ? "cd m-2" : "W m-2 sr-1";
}

std::vector<double> radiance_at(const ResultReader& result, std::size_t interval) {
  const std::string series = dataset_name("irradiance", result.quantity());
  if (!result.has(series))
    throw InputError({result.path()}, radiance_name(result.quantity()) + " at a time",
                     "its series of all light is not stored",
                     "leave out --time, or run the study with output.series: [total]");
  return radiance_of(result, [&](const ResultReader& band) {
    return exitance_of(band, band.row(series, interval));
  });
}

std::vector<double> mean_radiance(const ResultReader& result) {
  const double seconds = chosen_seconds(result);
  // Of a part of the period nobody added up what patches send.
  if (result.has("power_load"))
    return radiance_of(result, [&](const ResultReader& band) {
      return mean_of_load(band.doubles("power_load"), seconds);
    });
  return radiance_of(result, [&](const ResultReader& band) {
    return exitance_of(band, mean_of_load(band.doubles("light_load"), seconds));
  });
}

}  // namespace sunload
