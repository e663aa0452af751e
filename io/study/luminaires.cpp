// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Luminaires of section `scene` of a study.
#include <optional>

#include "io/study/sections.h"

namespace sunload::study_sections {

namespace {

constexpr Range photometric_distances_m{0.01, 1e5};
// The narrowest searchlights have some 0.3 deg; of far less the solid angle drowns in rounding.
constexpr Range beams_deg{0.1, 360};
constexpr Range intensities_cd{0, 1e12, Range::Low::excluded};
constexpr Range fluxes_lm{0, 1e12, Range::Low::excluded};

/// That it is known how bright it is, once.
void check_strength(YamlMap& map) {
  const bool file = map.has("file");
  if (file) {
    for (const char* key : {"intensity_cd", "beam_deg"})
      if (map.has(key))
        map.problem(key, "stands beside file", "the file tells what is sent where",
                    "leave it out; flux_lm scales the file");
  } else if (map.has("intensity_cd") == map.has("flux_lm") && map.is_usable()) {
    map.reading().problem(map.where(),
                          map.has("flux_lm") ? "the luminaire has intensity_cd and flux_lm"
                                             : "the luminaire has no file, intensity_cd or flux_lm",
                          "one of them tells how bright it is");
  }
}

LuminaireStudy read_luminaire(YamlMap& map, const std::string& folder) {
  LuminaireStudy luminaire;
  luminaire.where = map.where();
  map.require("position_m", "a luminaire hangs somewhere");
  luminaire.position = read_vector(map, "position_m").value_or(Vec3{0, 0, 0});
  luminaire.to = read_vector(map, "to_m");
  luminaire.every_m = map.number("every_m", photometric_distances_m, 0);
  check_row(map, "luminaires");
  luminaire.towards = read_vector(map, "towards").value_or(luminaire.towards);
  if (norm(luminaire.towards) < shortest_normal)
    map.problem("towards", "has no length", "it tells where the luminaire looks");
  luminaire.turn_deg = map.number("turn_deg", {-360, 360}, luminaire.turn_deg);
  luminaire.file = read_path(map, "file", folder);
  luminaire.intensity_cd = map.number("intensity_cd", intensities_cd);
  luminaire.beam_deg = map.number("beam_deg", beams_deg, luminaire.beam_deg);
  luminaire.flux_lm = map.number("flux_lm", fluxes_lm);
  check_strength(map);
  return luminaire;
}

}  // namespace

std::vector<LuminaireStudy> read_luminaires(YamlMap& scene, const std::string& folder) {
  std::vector<LuminaireStudy> luminaires;
  scene.each("luminaires",
             [&](YamlMap& map) { luminaires.push_back(read_luminaire(map, folder)); });
  return luminaires;
}

}  // namespace sunload::study_sections
