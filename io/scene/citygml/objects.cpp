// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/objects.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "io/scene/base/words.h"
#include "io/scene/citygml/geometry.h"

namespace sunload {

namespace {

using Names = std::unordered_set<std::string_view>;

constexpr int deepest_feature = 40;  // features inside of features

/// Where CityGML has another name than CityJSON.
std::string_view of_cityjson(std::string_view feature) {
  static const std::unordered_map<std::string_view, std::string_view> names{
      {"WindowSurface", "Window"},
      {"DoorSurface", "Door"},
      {"Marking", "TransportationMarking"},
      {"HoleSurface", "TransportationHole"},
      {"Square", "TransportSquare"},
      {"Track", "Road"},
      {"TransportationComplex", "Road"},
      {"GenericOccupiedSpace", "GenericCityObject"},
      {"GenericUnoccupiedSpace", "GenericCityObject"},
      {"GenericLogicalSpace", "GenericCityObject"},
      {"Room", "BuildingRoom"},
      {"Storey", "BuildingStorey"},
      {"HollowSpace", "TunnelHollowSpace"}};
  const auto found = names.find(feature);
  return found == names.end() ? feature : found->second;
}

/// Properties whose features are no part of the object.
bool leads_elsewhere(std::string_view property) {
  static const Names names{"appearance",    "address",          "externalReference", "relatedTo",
                           "generalizesTo", "genericAttribute", "metaDataProperty",  "parent",
                           "dynamizer",     "predecessor",      "successor",         "relatesTo"};
  return names.contains(property);
}

/// Spaces above traffic, which hold no matter; their boundaries do.
bool is_open_space(std::string_view feature) {
  return feature == "TrafficSpace" || feature == "AuxiliaryTrafficSpace" ||
         feature == "ClearanceSpace" || feature == "Hole";
}

bool holds_boundaries(std::string_view property) {
  return property == "boundedBy" || property == "boundary" || property == "opening" ||
         property == "fillingSurface" || property == "filling";
}

/// The features that properties of reliefs, groups and wholes hold are objects of their own.
bool is_object(std::string_view type) {
  return is_city_object_type(type) || type.ends_with("Relief");
}

bool is_of_upper_case(std::string_view name) {
  return !name.empty() && std::isupper(static_cast<unsigned char>(name.front())) != 0;
}

/// Level of a property such as lod2Solid or tin; nothing where it holds no geometry.
std::optional<Lod> level_of(XmlElement property, XmlElement feature, const std::string& type) {
  const auto name = property.name();
  constexpr std::string_view mark = "lod";
  if (name.size() > mark.size() && name.starts_with(mark) &&
      std::isdigit(static_cast<unsigned char>(name[mark.size()])) != 0)
    return lod_of(name.substr(mark.size(), 1));
  if (name == "tin") return lod_of(feature.child("lod").text());
  if (name == "geometry" && type == "CityObjectGroup") return Lod{};
  return std::nullopt;
}

bool is_inside(XmlElement feature) {
  const auto name = feature.name();
  return is_interior(of_cityjson(name)) ||
         (name.starts_with("Int") && name.ends_with("Installation")) ||
         feature.child("relationToConstruction").text() == "inside";  // CityGML 3
}

/// Databases write a year far away where there is no end.
bool has_ended(XmlElement feature) {
  constexpr std::string_view never = "9999";
  for (const char* name : {"terminationDate", "validTo"}) {
    const auto end = feature.child(name);
    if (end && !end.text().empty() && !end.text().starts_with(never)) return true;
  }
  return false;
}

class ObjectReader {
 public:
  ObjectReader(const CityDocument& document, const LodWish& wish, NoteCounter& notes)
      : document_(document), wish_(wish), notes_(notes) {}

  CityObject read(XmlElement feature, int depth) {
    CityObject object;
    object.element = feature;
    object.type = of_cityjson(feature.name());
    object.is_part = object.type.ends_with("Part");
    walk(feature, object, {}, Walk{depth, false, false});
    leave_out_rooms(object);
    choose(object);
    unstack_reliefs(object);
    unstack_parts(object);
    unstack_group(object);
    return object;
  }

 private:
  void leave_out_rooms(CityObject& object) {
    if (!has_rooms_inside(object.geometries,
                          [](const auto& one) -> const SemanticSurface& { return one.surface; }))
      return;
    const auto left_out = std::erase_if(
        object.geometries, [](const auto& one) { return one.surface.of_room != OfRoom::no; });
    for (std::size_t i = 0; i < left_out; ++i) notes_.count(surfaces_of_rooms_left_out);
  }

  struct Walk {
    int depth = 0;
    bool is_boundary = false, is_open_space = false;
  };

  void walk(XmlElement feature, CityObject& object, SemanticSurface surface, Walk walk) {
    if (walk.depth > deepest_feature)
      document_.file().fail(feature, "features nest too deep", "do its links form a circle?");
    for (const auto property : feature.children()) {
      const auto name = property.name();
      document_.spend(property, 1);
      if (const auto lod = level_of(property, feature, object.type)) {
        if (!walk.is_open_space) add_geometry(property, *lod, surface, walk.is_boundary, object);
      } else if (name == "groupMember") {
        has_members_.insert(object.element.address());
        for (const auto child : property.children()) add_child(child, object, walk.depth);
      } else if (!leads_elsewhere(name)) {
        // Links lead to boundary surfaces of others, and to nothing else that belongs here.
        if (!property.attribute("href").empty() && !holds_boundaries(name)) continue;
        for (const auto value : document_.values(property))
          walk_value(value, property, object, surface, walk);
      }
    }
  }

  void walk_value(XmlElement value, XmlElement property, CityObject& object,
                  SemanticSurface surface, Walk walk) {
    const auto name = of_cityjson(value.name());
    const bool is_feature = is_of_upper_case(name) && !has_surfaces(name) && !is_thin(name) &&
                            name != "Envelope" && name != "Null";
    if (!is_feature) return;
    Walk inside{walk.depth + 1, walk.is_boundary, is_open_space(name)};
    if (const auto known = semantic_surface(name); known.is_known) {
      inside.is_boundary = true;
      this->walk(value, object, known, inside);
    } else if (is_left_out(value, notes_)) {
      return;
    } else if (is_object(name)) {
      add_child(value, object, walk.depth);
    } else {
      if (holds_boundaries(property.name()) && name.ends_with("Surface")) {
        notes_.count("semantic surfaces of unknown type: kind of surface by slope");
        inside.is_boundary = true;
        surface = {};
      }
      this->walk(value, object, surface, inside);
    }
  }

  void add_child(XmlElement feature, CityObject& object, int depth) {
    if (is_left_out(feature, notes_)) return;
    CityObject child = read(feature, depth + 1);
    object.children.push_back(std::move(child));
  }

  void add_geometry(XmlElement property, Lod lod, SemanticSurface surface, bool is_of_boundary,
                    CityObject& object) {
    for (const auto geometry : document_.values(property)) {
      const auto name = geometry.name();
      if (name == "ImplicitGeometry" ? !has_shape(geometry) : !has_surfaces(name)) {
        if (is_thin(name)) notes_.count("geometries of points or lines ignored");
        continue;
      }
      object.geometries.push_back(
          {geometry, lod, surface, is_of_boundary, property.name() == "lod0RoofEdge"});
    }
  }

  /// Whether an implicit geometry has one of GML.
  bool has_shape(XmlElement implicit) {
    for (const auto property : implicit.children())
      if (property.name() == "relativeGMLGeometry" || property.name() == "relativeGeometry") {
        const auto shape = document_.value(property);
        if (shape && has_surfaces(shape.name())) return true;
      }
    notes_.count("implicit geometries of library files (libraryObject) left out");
    return false;
  }

  void choose(CityObject& object) {
    auto& all = object.geometries;
    if (all.empty()) return;
    const auto rank_of = [&](const CityGeometry& one) { return wish_.rank(one.lod); };
    object.rank = rank_of(all.front());
    for (const auto& one : all) object.rank = std::max(object.rank, rank_of(one));
    notes_.count("geometries of other levels of detail left out",
                 std::erase_if(all, [&](const auto& one) { return rank_of(one) != object.rank; }));
    const auto is_edge = [](const CityGeometry& one) { return one.is_roof_edge; };
    if (!std::all_of(all.begin(), all.end(), is_edge))
      notes_.count("edges of roofs (lod0RoofEdge) beside footprints left out",
                   std::erase_if(all, is_edge));
    if (!wish_.is_met_by(object.rank))
      notes_.count("objects without LoD " + wish_.text() + ": the nearest one read");
  }

  void unstack_parts(CityObject& whole) {
    if (whole.geometries.empty()) return;
    std::vector<LodRank> ranks;
    for (const auto& part : whole.children)
      if (part.is_part && !part.geometries.empty()) ranks.push_back(part.rank);
    if (ranks.empty()) return;
    const auto read = unstacked(whole.rank, ranks, notes_);
    if (read == WholeOrParts::parts) whole.geometries.clear();
    if (read == WholeOrParts::whole)
      for (auto& part : whole.children)
        if (part.is_part) part.geometries.clear();
  }

  /// Components of a relief lie on each other, but for those that an extent bounds.
  void unstack_reliefs(CityObject& whole) {
    if (whole.type != "ReliefFeature" || whole.children.empty()) return;
    LodRank best{};
    bool has_any = false;
    for (const auto& part : whole.children) {
      if (part.geometries.empty()) continue;
      best = has_any ? std::max(best, part.rank) : part.rank;
      has_any = true;
    }
    for (auto& part : whole.children) {
      if (part.geometries.empty() || part.rank == best || part.element.child("extent")) continue;
      notes_.count("reliefs of other levels of detail left out");
      part.geometries.clear();
    }
  }

  /// The geometry of a group is a generalisation of its members.
  void unstack_group(CityObject& group) {
    if (group.type != "CityObjectGroup" || !has_members_.contains(group.element.address())) return;
    notes_.count("geometries of groups left out: they repeat their members",
                 group.geometries.size());
    group.geometries.clear();
  }

  const CityDocument& document_;
  const LodWish& wish_;
  NoteCounter& notes_;
  std::unordered_set<const void*> has_members_;  ///< groups
};

}  // namespace

CityObject city_object(XmlElement feature, const CityDocument& document, const LodWish& wish,
                       NoteCounter& notes) {
  return ObjectReader(document, wish, notes).read(feature, 0);
}

bool is_left_out(XmlElement feature, NoteCounter& notes) {
  const auto name = feature.name();
  if (is_inside(feature)) {
    notes.count("interior objects (" + shortened(name) + ") left out");
    return true;
  }
  if (has_ended(feature)) {
    notes.count("objects that have an end (terminationDate, validTo) left out");
    return true;
  }
  return false;
}

}  // namespace sunload
