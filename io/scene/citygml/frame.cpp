// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "io/scene/base/words.h"
#include "io/scene/citygml/srs_name.h"

namespace sunload {

namespace {

/// What some objects of the file tell of all.
struct Sample {
  std::optional<Vec3> first;  ///< position, as it stands in the file
  /// Volume below faces, as if the first axis were east, and the sum of its shares' sizes.
  double volume = 0, size = 0;

  /// Whether faces look outward where the first axis is east; nothing where they do not tell.
  std::optional<bool> looks_outward() const {
    constexpr double clear_share = 0.1;
    if (!(std::abs(volume) > clear_share * size)) return std::nullopt;
    return volume > 0;
  }
};

/// A face seen from above.
struct PlanFace {
  double area = 0;  ///< positive: counter-clockwise
  double height = 0;
};

PlanFace plan_face(const std::vector<Vec3>& ring) {
  PlanFace face;
  const Vec3 at = ring.front();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 a = ring[k] - at, b = ring[(k + 1) % ring.size()] - at;
    face.area += (a.x * b.y - a.y * b.x) / 2;
    face.height += ring[k].z / static_cast<double>(ring.size());
  }
  return face;
}

/// The volume between the faces of an object and its lowest point: positive where roofs look up and
/// floors down, whether the object is closed or not (divergence theorem of (0, 0, z)).
void add_object(XmlElement object, CityCoordinates& coordinates, Sample& sample) {
  constexpr std::size_t enough = 2000;
  std::vector<PlanFace> faces;
  double lowest = HUGE_VAL;
  XmlElement next;
  for (auto at = object; at && faces.size() < enough; at = next) {
    const bool is_implicit = at.name() == "ImplicitGeometry";
    next = is_implicit ? next_behind(at, object) : next_in_file(at, object);
    if (is_implicit && !sample.first) {
      const auto point = at.child("referencePoint").child("Point");
      if (point) sample.first = coordinates.point(point);
    }
    if (at.name() != "LinearRing" && at.name() != "Ring") continue;
    const auto side = at.parent().name();
    if (side != "exterior" && side != "outerBoundaryIs") continue;
    if (!CityCoordinates::has_heights(at)) continue;  // refused where it is read
    const auto& ring = coordinates.ring(at);
    if (ring.empty()) continue;
    if (!sample.first) sample.first = ring.front();
    for (const auto& corner : ring) lowest = std::min(lowest, corner.z);
    faces.push_back(plan_face(ring));
  }
  for (const auto& face : faces) {
    const double volume = (face.height - lowest) * face.area;
    sample.volume += volume;
    sample.size += std::abs(volume);
  }
}

Sample sample_of(const CityDocument& document, CityCoordinates& coordinates) {
  constexpr int enough = 300;
  Sample sample;
  int objects = 0;
  for (const auto member : document.root().children()) {
    if (member.name() == "appearanceMember" || member.name() == "boundedBy") continue;
    for (const auto object : member.children()) {
      if (objects++ == enough) return sample;
      add_object(object, coordinates, sample);
    }
  }
  return sample;
}

Vec3 exchanged(Vec3 p) { return {p.y, p.x, p.z}; }

/// Whether the first number of positions is a northing or a latitude.
bool is_north_first(const MapAxes& axes, const SrsName& name, const Sample& sample,
                    NoteCounter& notes) {
  if (!sample.first) return false;
  const Vec3 p = *sample.first;
  const bool fits_exchanged = axes.is_in_use_at(p.y, p.x), fits = axes.is_in_use_at(p.x, p.y);
  if (!axes.is_north_first() && (fits || !fits_exchanged)) return false;
  bool north_first = name.has_official_axes;
  std::string because = "its form says so";
  if (fits != fits_exchanged) {
    north_first = fits_exchanged;
    because = "the other way round they lie outside of its area of use";
  } else if (const auto outward = sample.looks_outward()) {
    north_first = !*outward;
    because = "the other way round roofs would face down";
  }
  const char* order = axes.is_in_degrees()
                          ? (north_first ? "latitude, longitude" : "longitude, latitude")
                          : (north_first ? "northing, easting" : "easting, northing");
  notes.say("positions in '" + name.crs + "' are taken as " + order + ": " + because);
  return north_first;
}

}  // namespace

CityFrame::CityFrame(const CityDocument& document, CityCoordinates& coordinates,
                     const SceneFromFile& scene_from_file, const std::string& map_of_degrees,
                     NoteCounter& notes)
    : scene_from_file_(scene_from_file) {
  if (document.srs_name().empty()) return;
  if (document.srs_name().starts_with('#')) {
    notes.say("positions are in a coordinate system of the file's own: it tells no place");
    return;
  }
  const SrsName name = read_srs_name(document.srs_name());
  const MapAxes axes(name.crs);
  crs_ = axes.name();
  if (!axes.is_known()) return;  // the study may know better
  if (axes.is_geocentric())
    document.file().fail(
        document.srs_element(), "positions are in '" + shortened(document.srs_name()) + "'",
        "it is geocentric: up is nowhere z", "convert the model to a map projection such as UTM");
  const Sample sample = sample_of(document, coordinates);
  is_north_first_ = is_north_first(axes, name, sample, notes);
  if (!axes.is_in_degrees() || !sample.first) return;
  const Vec3 place = is_north_first_ ? exchanged(*sample.first) : *sample.first;
  crs_ = map_of_degrees.empty() ? utm_at(place.y, place.x) : map_of_degrees;
  map_from_degrees_ = std::make_unique<MapFromDegrees>(axes.name(), crs_);
  notes.say("degrees of the model are projected to " + crs_);
}

Vec3 CityFrame::operator()(Vec3 in_file) const {
  const Vec3 p = is_north_first_ ? exchanged(in_file) : in_file;
  return scene_from_file_(map_from_degrees_ ? (*map_from_degrees_)(p.x, p.y, p.z) : p);
}

}  // namespace sunload
