// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light by its energy or by what the eye makes of it: names and units of both.
#pragma once

#include <string>
#include <string_view>

namespace sunload {

/// `light.quantity`: power [W] or luminous flux [lm]. The method is the same; sources differ.
enum class Quantity { irradiance, illuminance };

/// Name of a dataset of irradiance in a result of that quantity: irradiance_sky →
/// illuminance_sky. Names that do not speak of irradiance stay.
std::string dataset_name(std::string name, Quantity quantity);
/// Units of power and energy in that quantity: W → lm, W m-2 → lx, kWh → klm h,
/// kWh m-2 → klx h. Others stay.
std::string light_units(std::string_view units, Quantity quantity);
/// Names of columns and attributes that end in their unit: base_kwh_m2 → base_klx_h,
/// time_sum_kwh → time_sum_klm_h.
std::string unit_names(std::string names, Quantity quantity);
/// What the datasets are, in words: "irradiance …" → "illuminance …".
std::string light_words(std::string words, Quantity quantity);

}  // namespace sunload
