// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/srs_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "io/base/file_text.h"

namespace sunload {

namespace {

/// Systems of AdV, the German surveys, without their heights. Reference: AdV, GeoInfoDok 7.1,
/// Basisschema, list of coordinate reference systems.
std::string of_german_surveys(std::string_view name) {
  struct Known {
    std::string_view name, crs;
  };
  constexpr std::array<Known, 10> all{{{"etrs89_utm31", "EPSG:25831"},
                                       {"etrs89_utm32", "EPSG:25832"},
                                       {"etrs89_utm33", "EPSG:25833"},
                                       {"etrs89_ze-n_utm32", "EPSG:4647"},
                                       {"etrs89_ze-n_utm33", "EPSG:5650"},
                                       {"de_dhdn_3gk2", "EPSG:31466"},
                                       {"de_dhdn_3gk3", "EPSG:31467"},
                                       {"de_dhdn_3gk4", "EPSG:31468"},
                                       {"de_dhdn_3gk5", "EPSG:31469"},
                                       {"etrs89_lat-lon", "EPSG:4258"}}};
  name = name.substr(0, name.find('*'));
  const auto* const found =
      std::find_if(all.begin(), all.end(), [&](const Known& each) { return each.name == name; });
  return found == all.end() ? std::string() : std::string(found->crs);
}

/// The first code behind the word EPSG; empty: there is none.
std::string epsg_code(std::string_view lower_case_name) {
  constexpr std::size_t shortest_code = 4;  // versions of the database are shorter
  const auto mark = lower_case_name.find("epsg");
  if (mark == lower_case_name.npos) return {};
  std::string digits;
  for (const char c : lower_case_name.substr(mark)) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      digits += c;
    } else if (digits.size() >= shortest_code) {
      break;
    } else {
      digits.clear();
    }
  }
  return digits.size() >= shortest_code ? digits : std::string();
}

}  // namespace

SrsName read_srs_name(const std::string& name) {
  const std::string lower = lower_case(name);
  constexpr std::string_view of_adv = "urn:adv:crs:";
  if (lower.starts_with(of_adv)) {
    const auto crs = of_german_surveys(std::string_view(lower).substr(of_adv.size()));
    return {crs.empty() ? name : crs, crs == "EPSG:4258"};
  }
  const bool is_definition = lower.starts_with("urn:") || lower.find("/def/crs") != lower.npos;
  if (is_definition) return {name, true};
  const auto code = epsg_code(lower);
  return {code.empty() ? name : "EPSG:" + code, false};
}

}  // namespace sunload
