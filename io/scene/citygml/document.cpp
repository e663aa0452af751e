// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/document.h"

#include <algorithm>
#include <array>
#include <set>

#include "io/scene/base/words.h"

namespace sunload {

namespace {

/// What may be met in following links: a position takes 6 bytes at least, a geometry 20, and either
/// stands in few objects.
constexpr std::size_t steps_at_least = 1'000'000;
constexpr std::size_t steps_per_byte = 8;

/// Other kinds of XML that end in .xml or .gml, by the name of their first element.
std::string known_kind(std::string_view root) {
  struct Kind {
    std::string_view root, name;
  };
  constexpr std::array<Kind, 11> kinds{{{"kml", "KML"},
                                        {"osm", "OpenStreetMap"},
                                        {"gbXML", "gbXML"},
                                        {"COLLADA", "COLLADA"},
                                        {"X3D", "X3D"},
                                        {"svg", "SVG"},
                                        {"gpx", "GPX"},
                                        {"LandXML", "LandXML"},
                                        {"IndoorFeatures", "IndoorGML"},
                                        {"html", "a web page"},
                                        {"ExceptionReport", "an error of a web service"}}};
  const auto* const found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.root == root; });
  return found == kinds.end() ? std::string() : "it is " + std::string(found->name);
}

bool is_texture(std::string_view name) {
  return name == "ParameterizedTexture" || name == "GeoreferencedTexture";
}

}  // namespace

CityDocument::CityDocument(const std::string& path, NoteCounter& notes)
    : file_(path), notes_(notes), steps_left_(steps_at_least + steps_per_byte * file_.bytes()) {
  check_root();
  survey();
  index_targets();
}

void CityDocument::check_root() const {
  const XmlElement first = root();
  if (first.name() == "CityModel") return;
  // What services of the web answer: members of a collection.
  const bool is_collection = first.name() == "FeatureCollection";
  if (is_collection && first.has_value_with("/citygml/")) return;
  std::string why = known_kind(first.name());
  if (why.empty())
    why = is_collection ? "it is GML of another schema"
                        : "its first element is '" + shortened(first.name()) + "', not CityModel";
  file_.fail(first, "is no CityGML", why,
             is_collection ? "plan data are read from GeoJSON, GeoPackage and Shapefile"
                           : "convert it to CityGML, CityJSON, OBJ or glTF");
}

void CityDocument::survey() {
  std::set<std::string> srs_names;
  std::size_t textures = 0;
  for (auto at = root(); at; at = next_in_file(at, root())) {
    if (const auto href = at.attribute("href"); href.starts_with('#'))
      targets_.try_emplace(href.substr(1));
    if (const auto srs = at.attribute("srsName"); !srs.empty()) {
      if (srs_name_.empty()) {
        srs_name_ = srs;
        srs_element_ = at;
      }
      constexpr std::size_t enough = 10;  // to tell that there are several
      if (srs_names.size() < enough) srs_names.emplace(srs);
    }
    if (const auto name = at.name(); name == "X3DMaterial") {
      materials_.push_back(at);
    } else if (is_texture(name)) {
      ++textures;
    }
  }
  notes_.count("textures ignored", textures);
  if (srs_names.size() > 1)
    notes_.say("coordinate systems of several names: all positions are taken to be in '" +
               shortened(srs_name_) + "'");
}

void CityDocument::index_targets() {
  if (targets_.empty()) return;
  for (auto at = root(); at; at = next_in_file(at, root())) {
    const auto id = at.attribute("id");
    if (id.empty()) continue;
    const auto entry = targets_.find(id);
    if (entry != targets_.end() && !entry->second) entry->second = at;
  }
}

std::vector<XmlElement> CityDocument::values(XmlElement property) const {
  std::vector<XmlElement> found;
  const auto href = property.attribute("href");
  if (href.starts_with('#')) {
    const auto entry = targets_.find(href.substr(1));
    if (entry != targets_.end() && entry->second)
      found.push_back(entry->second);
    else
      notes_.count("links to what is not in the file");
  } else if (!href.empty()) {
    notes_.count("links to other files, not followed");
  }
  for (const auto child : property.children()) found.push_back(child);
  return found;
}

void CityDocument::spend(XmlElement at, std::size_t steps) const {
  if (steps > steps_left_)
    file_.fail(at, "is named again once too often",
               "the links of this file make too much of it for its size");
  steps_left_ -= steps;
}

XmlElement CityDocument::value(XmlElement property) const {
  const auto all = values(property);
  return all.empty() ? XmlElement() : all.front();
}

}  // namespace sunload
