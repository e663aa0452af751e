// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Positions as people write them, by GeographicLib.
#include <GeographicLib/DMS.hpp>
#include <GeographicLib/GeoCoords.hpp>
#include <cctype>
#include <cmath>
#include <string>

#include "geo/base/check.h"
#include "geo/base/pattern.h"
#include "geo/sun/site.h"

namespace sunload {

namespace {

const std::string forms =
    "write for example 49d44'51\"N 13d22'39\"E, 49.7475 13.3776, 33north 451234 5512345, or "
    "33UVR5123412345";

[[noreturn]] void refuse(const std::string& text, const std::string& why,
                         const std::string& hint = forms) {
  throw InputError({}, "'" + text + "' is no position on Earth", why, hint);
}

// Latitude bands of UTM from 80° south in steps of 8°, the last one of 12°.
const std::string bands = "CDEFGHJKLMNPQRSTUVWX";
constexpr double first_band_deg = -80, band_deg = 8;
// Places near the border of a band are written with either letter.
constexpr double band_margin_deg = 0.5;

/// A UTM position with its band, "33U 451234 5512345", as GeographicLib reads it: with its
/// hemisphere, "33north 451234 5512345". Other texts stay as they are.
struct Banded {
  std::string text;
  char band = 0;
};

Banded without_band(const std::string& text) {
  static const Pattern pattern(R"(\s*(\d{1,2})\s*([A-Za-z])[\s,]+(\S+)[\s,]+(\S+)\s*)");
  const auto found = pattern.whole(text);
  if (!found) return {text};
  const auto& part = *found;
  const char band =
      static_cast<char>(std::toupper(static_cast<unsigned char>(part[2].text.front())));
  if (band == 'S') {
    refuse(text, "S is the southern hemisphere to some, a band of the northern one to others",
           "write the zone as " + part[1].text + "south or " + part[1].text + "north");
  }
  if (bands.find(band) == bands.npos) refuse(text, std::string("UTM has no band ") + band);
  const bool is_north = band >= 'N';
  return {part[1].text + (is_north ? "north " : "south ") + part[3].text + " " + part[4].text,
          band == 'N' ? '\0' : band};  // the hemisphere as well, of which nothing more is known
}

void expect_in_band(const std::string& text, char band, double latitude_deg) {
  const double low_deg = first_band_deg + band_deg * static_cast<double>(bands.find(band));
  const double height_deg = band == bands.back() ? 1.5 * band_deg : band_deg;
  if (latitude_deg < low_deg - band_margin_deg ||
      latitude_deg > low_deg + height_deg + band_margin_deg) {
    refuse(text, "latitude " + std::to_string(latitude_deg) + " is not in the band " + band,
           "check the northing");
  }
}

// The middle of an MGRS square stands for it: a square of 1 km leaves 0.006° to the sun.
void expect_fine_square(const std::string& text) {
  constexpr std::size_t fewest_digits = 4;
  static const Pattern pattern(R"(\s*\d{0,2}[A-Za-z]{1,3}(\d*)\s*)");
  const auto part = pattern.whole(text);
  if (part && (*part)[1].text.size() < fewest_digits) {
    refuse(text, "a square of 10 km or more does not say where the sun stands",
           "write at least two digits each for east and north");
  }
}

}  // namespace

Site site_from_text(const std::string& text) {
  const Banded written = without_band(text);
  expect_fine_square(text);
  try {
    const GeographicLib::GeoCoords place(written.text);
    if (!std::isfinite(place.Latitude()) || !std::isfinite(place.Longitude())) {
      refuse(text, "it has no latitude and longitude");
    }
    if (written.band) expect_in_band(text, written.band, place.Latitude());
    return {.latitude_deg = place.Latitude(), .longitude_deg = place.Longitude()};
  } catch (const GeographicLib::GeographicErr& error) {
    refuse(text, error.what());
  }
}

std::string position_text(const Site& site) {
  // A tenth of a second of arc is 3 m.
  constexpr unsigned seconds_digits = 1;
  const auto angle = [](double deg, GeographicLib::DMS::flag flag) {
    return GeographicLib::DMS::Encode(deg, GeographicLib::DMS::SECOND, seconds_digits, flag);
  };
  return angle(site.latitude_deg, GeographicLib::DMS::LATITUDE) + " " +
         angle(site.longitude_deg, GeographicLib::DMS::LONGITUDE);
}

}  // namespace sunload
