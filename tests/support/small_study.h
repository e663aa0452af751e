// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A study that takes a tenth of a second and has everything in it.
#pragma once

#include <string>

namespace sunload::test {

/// A square with a house whose south wall is a mirror, an awning that is lit
/// from both sides, and a lamp that shines down: 1 material each.
inline constexpr const char* square_obj =
    "o square\nusemtl paving\n"
    "v -15 -15 0\nv 15 -15 0\nv 15 15 0\nv -15 15 0\nf 1 2 3 4\n"
    "o house\nusemtl plaster\n"
    "v -4 3 0.01\nv 4 3 0.01\nv 4 9 0.01\nv -4 9 0.01\nv -4 3 7\nv 4 3 7\nv 4 9 7\nv -4 9 7\n"
    "f 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\nf 9 10 11 12\nf 8 7 6 5\n"
    "usemtl glass\nf 5 6 10 9\n"
    "o awning\nusemtl canvas\n"
    "v -8 -6 3\nv -3 -6 3\nv -3 -2 3\nv -8 -2 3\nf 13 14 15 16\n"
    "o lamp\nusemtl lamp\n"
    "v 6 -6 4\nv 6 -5 4\nv 7 -5 4\nv 7 -6 4\nf 17 18 19 20\n";

/// Faces of square_obj: `f 5 6 10 9` looks south.
/// 12 intervals of an equinox day in 6 batches.
inline std::string square_study(const std::string& standard_error = "totals",
                                const std::string& solver = "",
                                const std::string& max_edge_m = "1.5") {
  return "format: sunload-study-1\n"
         "name: square\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "period: {days: [2026-03-21], from: \"06:00\", to: \"18:00\", step_min: 60}\n"
         "light: {source: clear_sky}\n"
         "scene:\n"
         "  files: [square.obj]\n"
         "  materials:\n"
         "    paving: {diffuse: 0.3}\n"
         "    plaster: {diffuse: 0.6}\n"
         "    glass: {diffuse: 0.05, mirror: 0.85}\n"
         "    canvas: {diffuse: 0.5, sides: two}\n"
         "    lamp: {diffuse: 0.1, emission_w_m2: 200}\n"
         "mesh: {oracle: none, max_edge_m: " +
         max_edge_m +
         "}\n"
         "solver: {lines_per_patch: 64, direct_samples: 16, realizations: 16, batch_suns: 2" +
         solver +
         "}\n"
         "output: {folder: results, totals: [season, day, hour_of_day], standard_error: " +
         standard_error + "}\n";
}

/// The same day in 144 intervals, which few solutions can serve.
inline std::string square_in_five_minutes(const std::string& solver) {
  std::string text = square_study("totals", solver);
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("step_min: 60", "step_min: 5");
  replace("batch_suns: 2", "batch_suns: 24");
  return text;
}

/// The built-in street, coarse: 6 batches, most of a second.
inline std::string street_study(const std::string& standard_error = "totals",
                                const std::string& solver = "") {
  return "format: sunload-study-1\n"
         "name: street\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "period: {days: [2026-03-21], from: \"06:00\", to: \"18:00\", step_min: 60}\n"
         "light: {source: clear_sky}\n"
         "scene: {builtin: {name: street}}\n"
         "mesh: {oracle: none, max_edge_m: 4}\n"
         "measures:\n"
         "  exposure: {rule: en_17037, least_elevation_deg: 13, of: {facade: '*'}}\n"
         "  sky: {rule: bre_209_vsc, of: {object: 'house_1'}}\n"
         "  bright: {rule: light_hours, above_w_m2: 500}\n"
         "solver: {lines_per_patch: 64, direct_samples: 16, realizations: 16, batch_suns: 2" +
         solver +
         "}\n"
         "output: {folder: results, totals: [season, day, hour_of_day], standard_error: " +
         standard_error + "}\n";
}

}  // namespace sunload::test
