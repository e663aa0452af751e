// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The words by which studies name choices: readers take them, and the canonical text has them.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "io/study/study.h"

namespace sunload {

/// As a study writes it: `interval`, `60 min`, `day`, `month`.
inline std::string word_of(const SeriesStepStudy& step) {
  switch (step.unit) {
    case SeriesStepStudy::Unit::interval:
      return "interval";
    case SeriesStepStudy::Unit::minutes:
      return std::to_string(step.minutes) + " min";
    case SeriesStepStudy::Unit::day:
      return "day";
    case SeriesStepStudy::Unit::month:
      break;
  }
  return "month";
}

template <class E>
using Words = std::vector<std::pair<std::string, E>>;

inline Words<Stamp> words_of(Stamp) {
  return {{"start", Stamp::start}, {"middle", Stamp::middle}, {"end", Stamp::end}};
}
inline Words<Missing> words_of(Missing) {
  return {
      {"refuse", Missing::refuse}, {"interpolate", Missing::interpolate}, {"zero", Missing::zero}};
}
inline Words<Decomposition> words_of(Decomposition) {
  return {{"erbs", Decomposition::erbs}, {"disc", Decomposition::disc}};
}
inline Words<Refraction> words_of(Refraction) {
  return {{"none", Refraction::none}, {"spa", Refraction::spa}, {"bennett", Refraction::bennett}};
}
inline Words<Ut1> words_of(Ut1) { return {{"table", Ut1::table}, {"zero", Ut1::zero}}; }
inline Words<SunDisk> words_of(SunDisk) {
  return {{"point", SunDisk::point}, {"finite", SunDisk::finite}};
}
inline Words<LightSource> words_of(LightSource) {
  return {{"clear_sky", LightSource::clear_sky},
          {"weather", LightSource::weather},
          {"fixed", LightSource::fixed}};
}
inline Words<ClearSkyModel> words_of(ClearSkyModel) {
  return {{"ineichen", ClearSkyModel::ineichen},
          {"bird", ClearSkyModel::bird},
          {"haurwitz", ClearSkyModel::haurwitz}};
}
inline Words<SkyModel> words_of(SkyModel) {
  return {{"uniform", SkyModel::uniform},     {"cie_overcast", SkyModel::cie_overcast},
          {"cie_clear", SkyModel::cie_clear}, {"cie_general", SkyModel::cie_general},
          {"perez", SkyModel::perez},         {"preetham", SkyModel::preetham}};
}
inline Words<SkyScale> words_of(SkyScale) {
  return {{"diffuse", SkyScale::diffuse}, {"absolute", SkyScale::absolute}};
}
inline Words<Quantity> words_of(Quantity) {
  return {{"irradiance", Quantity::irradiance}, {"illuminance", Quantity::illuminance}};
}
inline Words<LightColour> words_of(LightColour) {
  return {{"sky", LightColour::sky}, {"white", LightColour::white}};
}
inline Words<Year> words_of(Year) {
  return {{"auto", Year::automatic}, {"modes", Year::modes}, {"each", Year::each}};
}
inline Words<ShortIntervals> words_of(ShortIntervals) {
  return {{"auto", ShortIntervals::automatic},
          {"each", ShortIntervals::each},
          {"together", ShortIntervals::together}};
}
inline Words<Unfollowed> words_of(Unfollowed) {
  return {{"estimate", Unfollowed::estimate}, {"leave", Unfollowed::leave}};
}
inline Words<Jacobi> words_of(Jacobi) {
  return {{"incremental", Jacobi::incremental}, {"regular", Jacobi::regular}};
}
inline Words<Transport> words_of(Transport) {
  return {
      {"gather", Transport::gather}, {"shoot", Transport::shoot}, {"matrix", Transport::matrix}};
}
inline Words<Bands> words_of(Bands) {
  return {{"broadband", Bands::broadband}, {"rgb", Bands::rgb}};
}
inline Words<StandardErrors> words_of(StandardErrors) {
  return {{"none", StandardErrors::none},
          {"totals", StandardErrors::totals},
          {"instants", StandardErrors::instants}};
}
inline Words<Sides> words_of(Sides) { return {{"one", Sides::one}, {"two", Sides::two}}; }
inline Words<VrmlColour> words_of(VrmlColour) {
  return {{"mean", VrmlColour::mean}, {"norm", VrmlColour::norm}};
}
inline Words<VrmlExcess> words_of(VrmlExcess) {
  return {{"refuse", VrmlExcess::refuse}, {"scale", VrmlExcess::scale}};
}
inline Words<GroundSurface> words_of(GroundSurface) {
  return {{"feet", GroundSurface::feet}, {"level", GroundSurface::level}};
}
inline Words<Repair> words_of(Repair) {
  return {{"none", Repair::none}, {"safe", Repair::safe}, {"all", Repair::all}};
}
inline Words<Orientation> words_of(Orientation) {
  return {{"outward", Orientation::outward}, {"keep", Orientation::keep}};
}
inline Words<Oracle> words_of(Oracle) {
  return {{"default", Oracle::light_load}, {"historic", Oracle::historic}, {"none", Oracle::none}};
}
inline Words<TVertices> words_of(TVertices) {
  return {{"remove", TVertices::remove}, {"keep", TVertices::keep}};
}

/// The word for a value.
template <class E>
std::string word_of(E value) {
  const Words<E> words = words_of(value);
  const auto found = std::find_if(words.begin(), words.end(),
                                  [&](const auto& word) { return word.second == value; });
  SUNLOAD_EXPECT(found != words.end(), "a word for every choice of a study");
  return found->first;
}

}  // namespace sunload
