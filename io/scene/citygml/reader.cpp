// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/citygml/reader.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "io/scene/base/from_file.h"
#include "io/scene/base/placed_shape.h"
#include "io/scene/base/words.h"
#include "io/scene/citygml/appearance.h"
#include "io/scene/citygml/coordinates.h"
#include "io/scene/citygml/document.h"
#include "io/scene/citygml/frame.h"
#include "io/scene/citygml/geometry.h"
#include "io/scene/citygml/objects.h"

namespace sunload {

namespace {

class CityReader {
 public:
  CityReader(const std::string& path, const SceneFileRules& rules)
      : scene_from_file_(rules, 'z', path),
        wish_(rules.lod, path),
        document_(path, notes_),
        coordinates_(document_, notes_),
        frame_(document_, coordinates_, scene_from_file_, rules.map_of_degrees, notes_),
        appearance_(document_, model_, notes_),
        writer_(
            document_, coordinates_, [this](Vec3 p) { return frame_(p); }, model_, notes_),
        placer_(scene_from_file_, document_.file().bytes()) {
    model_.source = path;
    model_.is_city_format = true;
    model_.crs = frame_.crs();
  }

  PolygonModel read() {
    for (const auto member : document_.root().children()) {
      const auto name = member.name();
      if (name != "cityObjectMember" && name != "featureMember" && name != "featureMembers" &&
          name != "member")
        continue;
      for (const auto feature : member.children()) {
        if (is_left_out(feature, notes_)) continue;
        const auto object = city_object(feature, document_, wish_, notes_);
        if (!is_city_object_type(object.type) && object.type != "ReliefFeature")
          notes_.count("objects of unknown type '" + shortened(object.type) +
                       "' read like any other");
        read_object(object, std::nullopt);
      }
    }
    add_families();
    appearance_.transparent().count_used(model_, notes_);
    put_notes(notes_, model_);
    return std::move(model_);
  }

 private:
  /// Parts first: what they have of the whole's polygons is theirs. Returns the geometries met.
  MetGeometry read_object(const CityObject& object, std::optional<std::size_t> owner) {
    const std::size_t place = relatives_.size();
    relatives_.push_back({object.element, object.type, owner, ObjectId::none()});
    MetGeometry of_children;
    for (const auto& child : object.children) of_children.add_all_of(read_object(child, place));
    if (object.geometries.empty()) return of_children;
    const auto polygons_before = model_.polygon_count();
    const auto id = make_id<ObjectId>(model_.object_names.size());
    MetGeometry met = append_geometries(object, id, std::move(of_children));
    if (model_.polygon_count() > polygons_before) {
      relatives_[place].object = id;
      model_.object_names.push_back(unique_(name_of(object.element, object.type)));
      model_.object_kinds.push_back(object.type);
    }
    return met;
  }

  MetGeometry append_geometries(const CityObject& object, ObjectId id, MetGeometry met) {
    writer_.begin_object();
    std::unordered_set<std::uint64_t> of_boundaries;
    MetGeometry met_in_boundaries = std::move(met);
    for (const auto& one : object.geometries) {
      if (!one.is_of_boundary) continue;
      if (!one.surface.kind) {
        notes_.count("closure surfaces left out: light passes them",
                     collected(one, met_in_boundaries, nullptr).size());
        continue;
      }
      append(one, object, id, met_in_boundaries, nullptr, [&](std::uint64_t key) {
        of_boundaries.insert(key);
        return true;
      });
    }
    MetGeometry met_in_own;
    for (const auto& one : object.geometries) {
      if (one.is_of_boundary) continue;
      append(one, object, id, met_in_own, &met_in_boundaries, [&](std::uint64_t key) {
        if (!of_boundaries.contains(key)) return true;
        notes_.count("polygons that repeat those of boundary surfaces left out");
        return false;
      });
    }
    met_in_boundaries.add_all_of(std::move(met_in_own));
    return met_in_boundaries;
  }

  std::vector<CityPolygon> collected(const CityGeometry& one, MetGeometry& met,
                                     const MetGeometry* met_before) {
    std::vector<CityPolygon> polygons;
    collect_polygons(one.geometry, document_, appearance_, met, polygons, notes_);
    if (met_before != nullptr)
      std::erase_if(polygons, [&](const auto& each) { return met_before->has(each.element); });
    return polygons;
  }

  /// `keeps` decides by a polygon's key whether it stays.
  template <class Keeps>
  void append(const CityGeometry& one, const CityObject& object, ObjectId id, MetGeometry& met,
              const MetGeometry* met_before, Keeps keeps) {
    PolygonModel::Facts facts{.object = id, .surface = one.surface.kind.value_or(Surface::other)};
    const auto is_implicit = one.geometry.name() == "ImplicitGeometry";
    const auto shape = is_implicit ? shape_of(one.geometry) : one.geometry;
    if (!one.is_of_boundary && is_terrain(object.type) && !is_solid(shape.name()))
      facts.surface = Surface::ground;
    if (is_implicit) return place(one.geometry, shape, facts);
    for (const auto& polygon : collected(one, met, met_before)) {
      const auto key = writer_.add(polygon, facts);
      if (key != 0 && !keeps(key)) writer_.take_back();
    }
  }

  // ---- implicit geometries

  XmlElement shape_of(XmlElement implicit) const {
    for (const auto property : implicit.children())
      if (property.name() == "relativeGMLGeometry" || property.name() == "relativeGeometry")
        return document_.value(property);
    return {};
  }

  void place(XmlElement implicit, XmlElement shape, PolygonModel::Facts facts) {
    const auto placed = placer_.append(model_of(shape), affine_of_implicit(implicit),
                                       reference_of(implicit), facts, model_);
    if (placed == Placed::too_many_corners)
      document_.file().fail(implicit, "shows a geometry once too often",
                            "the implicit geometries of this file make too many polygons for its "
                            "size");
    if (placed == Placed::beyond_coordinates)
      document_.file().fail(implicit, "reaches beyond all coordinates on Earth");
  }

  /// The polygons of a shape in its own frame, read when it is first shown.
  const PolygonModel& model_of(XmlElement shape) {
    auto& made = shapes_[shape.address()];
    if (!made) {
      made = std::make_unique<PolygonModel>();
      MetGeometry met;
      PolygonWriter writer(
          document_, coordinates_, [](Vec3 p) { return p; }, *made, notes_);
      std::vector<CityPolygon> polygons;
      collect_polygons(shape, document_, appearance_, met, polygons, notes_);
      for (const auto& polygon : polygons) writer.add(polygon, {});
    }
    return *made;
  }

  Affine affine_of_implicit(XmlElement implicit) {
    const auto element = implicit.child("transformationMatrix");
    if (!element) return {};
    std::array<double, 16> matrix{};
    const auto& numbers = coordinates_.numbers(element);
    if (numbers.size() != matrix.size())
      document_.file().fail(
          element, "transformationMatrix has " + std::to_string(numbers.size()) + " numbers",
          "16 were expected, row by row");
    std::copy(numbers.begin(), numbers.end(), matrix.begin());
    const auto affine = affine_of(matrix);
    if (!affine)
      document_.file().fail(element, "has a transformationMatrix whose last row is not 0 0 0 1",
                            "it is to be listed row by row");
    return *affine;
  }

  /// Where an implicit geometry stands, in the scene.
  Vec3 reference_of(XmlElement implicit) {
    const auto property = implicit.child("referencePoint");
    const auto point = property ? document_.value(property) : XmlElement();
    if (!point) document_.file().fail(implicit, "has no referencePoint");
    const Vec3 reference = frame_(coordinates_.point(point));
    if (!is_usable(reference))
      document_.file().fail(point, "lies beyond all coordinates on Earth",
                            "no map projection reaches 1e9 m", "are srsName and unit_m right?");
    return reference;
  }

  std::string name_of(XmlElement element, const std::string& type) {
    const auto id = element.attribute("id");
    if (!id.empty()) return std::string(id);
    return type + "_" + std::to_string(++anonymous_[type]);
  }

  /// Those of which nothing is read get their names behind all others.
  void add_families() {
    auto& [of_object, bare] = model_.families;
    std::vector<Owner> as_owner;
    for (const Relative& each : relatives_) {
      if (each.object.exists()) {
        as_owner.push_back({.object = each.object});
        continue;
      }
      as_owner.push_back({.bare = make_id<BareId>(bare.size())});
      bare.push_back({unique_(name_of(each.element, each.type)), each.type});
    }
    for (std::size_t r = 0; r < relatives_.size(); ++r) {
      if (!relatives_[r].owner) continue;
      const Owner owner = as_owner[*relatives_[r].owner];
      of_object.resize(model_.object_names.size());
      (as_owner[r].bare.exists() ? bare[as_owner[r].bare.index()].owner
                                 : of_object[as_owner[r].object.index()]) = owner;
    }
  }

  /// An object of the file as it is read.
  struct Relative {
    XmlElement element;
    std::string type;
    std::optional<std::size_t> owner;  ///< of relatives_
    ObjectId object;
  };

  NoteCounter notes_;
  PolygonModel model_;
  SceneFromFile scene_from_file_;
  LodWish wish_;
  CityDocument document_;
  CityCoordinates coordinates_;
  CityFrame frame_;
  CityAppearance appearance_;
  PolygonWriter writer_;
  ShapePlacer placer_;
  UniqueNames unique_;
  std::map<std::string, int> anonymous_;
  std::vector<Relative> relatives_;
  std::unordered_map<const void*, std::unique_ptr<PolygonModel>> shapes_;
};

}  // namespace

PolygonModel read_scene_citygml(const std::string& path, const SceneFileRules& rules) {
  return CityReader(path, rules).read();
}

}  // namespace sunload
