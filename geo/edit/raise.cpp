// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/edit/raise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geo/base/units.h"
#include "geo/edit/raised_outline.h"
#include "geo/mesh/slope.h"
#include "geo/mesh/surface_kind.h"

namespace sunload {

namespace {

/// A face that leans, with its plane and its plan.
struct Leaning {
  const LooseFace* face;
  Vec3 normal, through;
  double low, high;  ///< z

  double height_at(double x, double y) const {
    return through.z - (normal.x * (x - through.x) + normal.y * (y - through.y)) / normal.z;
  }
  bool covers(double x, double y) const { return holds_in_plan(face->rings, {x, y}, plan_point); }
};

std::vector<Leaning> leaning_of(const std::vector<LooseFace>& faces) {
  const double steepest = std::cos(radians(upright_slope_deg));
  std::vector<Leaning> leaning;
  for (const LooseFace& face : faces) {
    const Vec3 area = area_vector2(face);
    const double size = norm(area);
    const bool is_roof = face.facts.surface == Surface::roof;
    // Steep roofs are roofs where the file says so, but not upright faces of dormers.
    constexpr double nearly_upright = 0.02;  // a degree
    if (size == 0 || std::abs(area.z) / size < (is_roof ? nearly_upright : steepest)) continue;
    Leaning found{&face,
                  area / size,
                  {},
                  std::numeric_limits<double>::max(),
                  std::numeric_limits<double>::lowest()};
    for (const Vec3 v : face.rings.front()) {
      found.through += v / static_cast<double>(face.rings.front().size());
      found.low = std::min(found.low, v.z);
      found.high = std::max(found.high, v.z);
    }
    leaning.push_back(found);
  }
  return leaning;
}

/// Places inside of the face, seen from above: near its corners, and in its middle.
std::vector<Vec3> places_in(const Leaning& leaning) {
  std::vector<Vec3> places;
  const auto& ring = leaning.face->rings.front();
  const auto add = [&](Vec3 p) {
    if (leaning.covers(p.x, p.y)) places.push_back({p.x, p.y, leaning.height_at(p.x, p.y)});
  };
  add(leaning.through);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 before = ring[(i + ring.size() - 1) % ring.size()], here = ring[i],
               after = ring[(i + 1) % ring.size()];
    add((before + here + after) / 3);
    constexpr double inward = 0.05;  // of the way to the neighbours: past rims that stick out
    add(here * (1 - 2 * inward) + (before + after) * inward);
  }
  return places;
}

struct Column {
  double above = std::numeric_limits<double>::infinity();  ///< to the next face
  double below = std::numeric_limits<double>::infinity();
};
Column column_at(const std::vector<Leaning>& all, const Leaning& own, Vec3 place, double touching) {
  Column column;
  for (const Leaning& other : all) {
    if (&other == &own || !other.covers(place.x, place.y)) continue;
    const double gap = other.height_at(place.x, place.y) - place.z;
    if (gap > touching) column.above = std::min(column.above, gap);
    if (gap < -touching) column.below = std::min(column.below, -gap);
  }
  return column;
}

struct Levels {
  double foot = std::numeric_limits<double>::max(), top = std::numeric_limits<double>::lowest();
  double touching() const { return std::min(touching_m, touching_ratio * (top - foot)); }
};
Levels levels_of(const std::vector<LooseFace>& faces) {
  Levels levels;
  for (const auto& face : faces)
    for (const auto& ring : face.rings)
      for (const Vec3 v : ring) {
        levels.foot = std::min(levels.foot, v.z);
        levels.top = std::max(levels.top, v.z);
      }
  return levels;
}

std::vector<const Leaning*> roofs_of(const std::vector<Leaning>& leaning, const Levels& levels) {
  const double touching = levels.touching();
  std::vector<const Leaning*> roofs;
  for (const Leaning& each : leaning) {
    const Surface surface = each.face->facts.surface;
    const auto is_open_body = [&](Vec3 place) {
      const Column column = column_at(leaning, each, place, touching);
      return std::isinf(column.above) && column.below >= thinnest_body_m;
    };
    const bool may_be = surface == Surface::other && each.high > levels.foot + touching;
    const auto places = may_be ? places_in(each) : std::vector<Vec3>{};
    if (surface == Surface::roof || std::any_of(places.begin(), places.end(), is_open_body))
      roofs.push_back(&each);
  }
  return roofs;
}

/// Whether the face hangs under the rim of a roof, with nothing below.
bool is_soffit(const Leaning& face, const std::vector<Leaning>& leaning,
               const std::vector<const Leaning*>& roofs, const Levels& levels) {
  if (face.face->facts.surface != Surface::other || face.low <= levels.foot + levels.touching())
    return false;
  const auto places = places_in(face);
  return !places.empty() && std::all_of(places.begin(), places.end(), [&](Vec3 place) {
    const Column column = column_at(leaning, face, place, levels.touching());
    if (!std::isinf(column.below)) return false;
    return std::any_of(roofs.begin(), roofs.end(), [&](const Leaning* roof) {
      const double gap = roof->covers(place.x, place.y)
                             ? roof->height_at(place.x, place.y) - place.z
                             : std::numeric_limits<double>::infinity();
      return gap > 0 && gap < thinnest_body_m;
    });
  });
}

/// Whether a face has corners on both sides of the cut.
bool is_cut(const LooseFace& face, double cut) {
  bool above = false, below = false;
  for (const auto& ring : face.rings)
    for (const Vec3 v : ring) (v.z >= cut ? above : below) = true;
  return above && below;
}

/// Whether what is lifted stays above what is not.
bool has_room(const std::vector<LooseFace>& faces, const Levels& levels, double level_m,
              double by_m) {
  double highest_left = levels.foot, lowest_lifted = levels.top;
  for (const auto& face : faces)
    for (const auto& ring : face.rings)
      for (const Vec3 v : ring)
        if (v.z >= level_m)
          lowest_lifted = std::min(lowest_lifted, v.z);
        else
          highest_left = std::max(highest_left, v.z);
  return lowest_lifted + by_m > highest_left + levels.touching();
}

/// Every corner of the object that is so high.
void lift(PolygonModel& model, ObjectId object, double level_m, double by_m) {
  ChosenObjects chosen(model.object_names.size(), 0);
  chosen[object.index()] = 1;
  displace_objects(model, chosen, [&](Vec3 v) {
    return v.z >= level_m ? Vec3{v.x, v.y, v.z + by_m} : v;
  });
}

RaisedOutline outline_of(const std::vector<LooseFace>& faces, const std::vector<Leaning>& leaning,
                         const std::vector<const Leaning*>& roofs, double level_m, double by_m) {
  LiftedBody body{faces, std::vector<std::uint8_t>(faces.size()),
                  std::vector<std::uint8_t>(faces.size()), level_m, by_m};
  const auto place = [&](const Leaning& each) {
    return static_cast<std::size_t>(each.face - faces.data());
  };
  for (const Leaning& each : leaning) body.leans[place(each)] = 1;
  for (const Leaning* roof : roofs) body.is_roof[place(*roof)] = 1;
  return raised_outline(body);
}

/// What is known of an object's largest wall, for one more; of an object without any the object.
PolygonModel::Facts facts_of_walls(const std::vector<LooseFace>& faces,
                                   const std::vector<Leaning>& leaning) {
  PolygonModel::Facts facts{.object = faces.front().facts.object};
  double largest = 0;
  for (const LooseFace& face : faces) {
    const Surface surface = face.facts.surface;
    const bool leans = std::any_of(leaning.begin(), leaning.end(),
                                   [&](const Leaning& each) { return each.face == &face; });
    const double area = norm(area_vector2(face));
    if (leans || area <= largest || (surface != Surface::wall && surface != Surface::other))
      continue;
    largest = area;
    facts = face.facts;
  }
  facts.surface = Surface::wall;
  return facts;
}

void add_walls(PolygonModel& model, const std::vector<std::vector<Vec3>>& walls,
               const PolygonModel::Facts& facts) {
  for (const auto& wall : walls) {
    std::vector<std::int32_t> ring;
    for (const Vec3 v : wall) {
      ring.push_back(static_cast<std::int32_t>(model.vertices.size()));
      model.vertices.push_back(v);
    }
    model.add_polygon({ring}, facts);
  }
}

}  // namespace

std::optional<double> eaves_of(const std::vector<LooseFace>& faces) {
  const Levels levels = levels_of(faces);
  const auto leaning = leaning_of(faces);
  const auto roofs = roofs_of(leaning, levels);
  if (roofs.empty()) return {};
  double eaves = std::numeric_limits<double>::max();
  for (const Leaning* roof : roofs) eaves = std::min(eaves, roof->low);
  for (const Leaning& face : leaning)
    if (is_soffit(face, leaning, roofs, levels)) eaves = std::min(eaves, face.low);
  return eaves;
}

RaisedObject raise_object(PolygonModel& model, ObjectId object, double by_m,
                          std::optional<double> cut_m) {
  RaisedObject raised;
  const auto refuse = [&](const std::string& what, const std::string& why) {
    raised.refusal = what;
    raised.reason = why;
    return raised;
  };
  const auto faces = faces_of(model, object);
  const Levels levels = levels_of(faces);
  const auto leaning = leaning_of(faces);
  const auto roofs = roofs_of(leaning, levels);
  if (roofs.empty()) return refuse("has no roof", "nothing of it leans with a body below");
  const double touching = levels.touching();
  const double cut = cut_m ? *cut_m : *eaves_of(faces);
  raised.cut_m = cut;
  if (cut <= levels.foot + touching)
    return refuse("begins to rise at its foot", "there is no wall to be extended below its roofs");
  if (cut > levels.top) return refuse("ends below from_m", "nothing of it would be lifted");
  // Corners within the rounding of files are of one level.
  raised.level_m = cut - touching;
  for (const Leaning* roof : roofs)
    if (is_cut(*roof->face, raised.level_m))
      return refuse("has a roof that from_m cuts", "roofs are lifted whole");
  if (!has_room(faces, levels, raised.level_m, by_m))
    return refuse("is not high enough to be lowered so far where it is cut",
                  "what is lifted would come below what stays, such as windows there");
  for (const auto& face : faces)
    if (face.facts.surface == Surface::window && is_cut(face, raised.level_m)) ++raised.windows_cut;
  const RaisedOutline outline = outline_of(faces, leaning, roofs, raised.level_m, by_m);
  raised.outline_m = outline.length_m;
  raised.bare_m = outline.bare_m;
  lift(model, object, raised.level_m, by_m);
  raised.is_lifted = true;
  if (outline.walls.empty()) return raised;
  raised.added_m = outline.bare_m;
  add_walls(model, outline.walls, facts_of_walls(faces, leaning));
  return raised;
}

bool lift_with(PolygonModel& model, ObjectId object, const RaisedObject& body, double by_m) {
  const auto faces = faces_of(model, object);
  const Levels levels = levels_of(faces);
  if (levels.top < body.level_m) return false;
  // What stands there stands on it, whatever its file rounds.
  constexpr double standing_m = 0.3;
  if (levels.foot >= body.level_m - standing_m) {
    lift(model, object, levels.foot, by_m);
    return true;
  }
  const auto leaning = leaning_of(faces);
  const bool leans_there = std::any_of(leaning.begin(), leaning.end(), [&](const Leaning& each) {
    return is_cut(*each.face, body.level_m);
  });
  if (!leans_there && has_room(faces, levels, body.level_m, by_m)) {
    lift(model, object, body.level_m, by_m);
    return true;
  }
  if ((levels.foot + levels.top) / 2 < body.level_m) return false;
  lift(model, object, levels.foot, by_m);
  return true;
}

}  // namespace sunload
