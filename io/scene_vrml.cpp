#include "io/scene_vrml.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGetMatrixAction.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/misc/SoProto.h>
#include <Inventor/misc/SoProtoInstance.h>
#include <Inventor/nodes/SoNodes.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "io/vrml_model.h"
#include "io/vrml_nodes.h"
#include "io/vrml_text.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_visits = 10'000'000;  ///< of nodes, where files are inlined many times: seconds
constexpr double extruded_at_least = 2e5;         ///< points of all Extrusions: seconds in Coin …
constexpr double extruded_per_byte = 0.3;         ///< … and of large files

Vec3 vec(const SbVec3f& v) { return {v[0], v[1], v[2]}; }
std::array<double, 3> colour(const SbColor& c) { return {c[0], c[1], c[2]}; }
std::string text_of(const SbName& name) { return name.getString(); }

/// Coin's matrices act on row vectors.
Affine affine(const SbMatrix& m) {
  const auto row = [&](int i) { return Vec3{m[i][0], m[i][1], m[i][2]}; };
  return {{row(0), row(1), row(2)}, row(3)};
}
Affine affine(const SbRotation& rotation) {
  SbMatrix m;
  rotation.getValue(m);
  return affine(m);
}
Affine moved(Vec3 by) { return {.origin = by}; }
Affine scaled(Vec3 by) { return {{Vec3{by.x, 0, 0}, Vec3{0, by.y, 0}, Vec3{0, 0, by.z}}, {}}; }

/// T·C·R·SR·S·SR⁻¹·C⁻¹ (ISO/IEC 14772-1, 6.52).
Affine affine(const SoVRMLTransform& node) {
  const Vec3 center = vec(node.center.getValue());
  const SbRotation orientation = node.scaleOrientation.getValue();
  return moved(vec(node.translation.getValue()) + center) * affine(node.rotation.getValue()) *
         affine(orientation) * scaled(vec(node.scale.getValue())) *
         affine(orientation.inverse()) * moved(-center);
}

/// PROTOs stand for the root of what they make.
SoNode* plain(SoNode* node) {
  while (node != nullptr && node->isOfType(SoProtoInstance::getClassTypeId()))
    node = static_cast<SoProtoInstance*>(node)->getRootNode();
  return node;
}

template <class Node>
Node* as(SoNode* node) {
  node = plain(node);
  return node != nullptr && node->isOfType(Node::getClassTypeId()) ? static_cast<Node*>(node)
                                                                   : nullptr;
}

/// What Inventor's property nodes set for the shapes that follow them.
struct State {
  Affine file_from_here;
  SoMaterial* material = nullptr;
  SoMaterialBinding::Binding binding = SoMaterialBinding::OVERALL;
  SoCoordinate3* coordinates = nullptr;
  bool is_solid = false, is_clockwise = false;
};

/// Walks through Coin's nodes and adds their faces.
class VrmlWalk {
 public:
  VrmlWalk(const std::string& path, const SceneFileRules& rules)
      : path_(path), model_(path, rules), files_(model_.notes()) {}

  PolygonModel run() {
    State state;
    inline_file(path_, state, -1);
    return model_.finish();
  }

 private:
  [[noreturn]] void refuse(const SoNode* node, const std::string& what,
                           const std::string& why) const {
    const auto& text = files_stack_.back()->text;
    const std::string name = node_name_.empty() ? text_of(node->getName()) : node_name_;
    auto where = name.empty() ? std::nullopt : place_of_def(text, name);
    throw InputError(where ? *where : Where{text.path}, what, why);
  }

  void inline_file(const std::string& path, State& state, int place) {
    const auto& file = files_.read(path);
    model_.set_file_bytes(files_.bytes());
    if (std::find(files_stack_.begin(), files_stack_.end(), &file) != files_stack_.end() ||
        files_stack_.size() >= deepest_inline) {
      throw InputError({files_stack_.back()->text.path}, "inlines itself",
                       "Inline of " + path + " leads back to it");
    }
    files_stack_.push_back(&file);
    State inner;
    inner.file_from_here = state.file_from_here;
    visit(file.root, inner, place, 0);
    files_stack_.pop_back();
  }

  /// The first url that is a file; further urls are copies of it elsewhere.
  void inline_url(const std::vector<std::string>& urls, State& state, int place) {
    for (const auto& url : urls) {
      const auto path = VrmlFiles::beside(files_stack_.back()->text.path, url);
      std::error_code no_matter;
      if (fs::is_regular_file(path, no_matter)) return inline_file(path, state, place);
    }
    if (!urls.empty()) model_.notes().say("inlined file '" + urls.front() + "' is not there");
  }

  void visit(SoNode* node, State& state, int place, std::size_t depth) {
    node = plain(node);
    if (node == nullptr) return;
    if (++visits_ > most_visits || depth > 4 * deepest_vrml) {
      throw InputError({path_}, "has too many nodes", "with every USE in its place");
    }
    const auto name = text_of(node->getName());
    const std::string outer_name = node_name_;
    if (!name.empty()) node_name_ = name;
    const bool is_geometry = node->isOfType(SoVRMLGeometry::getClassTypeId());
    const bool names_object = !name.empty() && !is_geometry &&
                              (node->getChildren() != nullptr || is_shape(node));
    const int here = names_object ? model_.enter(place, name) : place;
    visit_kind(node, state, here, depth);
    node_name_ = outer_name;
  }

  static bool is_shape(const SoNode* node) {
    return node->isOfType(SoShape::getClassTypeId()) ||
           node->isOfType(SoVRMLInline::getClassTypeId());
  }

  void visit_kind(SoNode* node, State& state, int place, std::size_t depth) {
    if (node->isOfType(SoProto::getClassTypeId())) return;
    if (auto* shape = as<SoVRMLShape>(node)) return add_vrml97(*shape, state, place);
    if (auto* link = as<SoVRMLInline>(node)) return inline_url(urls_of(link->url), state, place);
    if (auto* link = as<SoWWWInline>(node))
      return inline_url({link->name.getValue().getString()}, state, place);
    if (auto* lod = as<SoVRMLLOD>(node)) {
      if (lod->level.getNum() > 0) visit(lod->level[0], state, place, depth + 1);
      return;
    }
    if (auto* choice = as<SoVRMLSwitch>(node)) {
      const int which = choice->whichChoice.getValue();
      if (which >= 0 && which < choice->choice.getNum())
        visit(choice->choice[which], state, place, depth + 1);
      return;
    }
    if (auto* transform = as<SoVRMLTransform>(node)) {
      State inner = state;
      inner.file_from_here = state.file_from_here * affine(*transform);
      return visit_children(node, inner, place, depth);
    }
    if (node->isOfType(SoVRMLGeometry::getClassTypeId()) ||
        node->isOfType(SoVRMLAppearance::getClassTypeId())) {
      return model_.notes().count("geometries and appearances outside of a Shape left out");
    }
    visit_inventor(node, state, place, depth);
  }

  static std::vector<std::string> urls_of(const SoMFString& field) {
    std::vector<std::string> urls;
    for (int i = 0; i < field.getNum(); ++i) urls.emplace_back(field[i].getString());
    return urls;
  }

  void visit_children(SoNode* node, State& state, int place, std::size_t depth) {
    const auto* children = node->getChildren();
    for (int i = 0; children != nullptr && i < children->getLength(); ++i)
      visit((*children)[i], state, place, depth + 1);
  }

  void visit_inventor(SoNode* node, State& state, int place, std::size_t depth) {
    if (auto* choice = as<SoSwitch>(node)) {
      const int which = choice->whichChild.getValue();
      if (which == SO_SWITCH_ALL) return visit_children(node, state, place, depth);
      if (which >= 0 && which < choice->getNumChildren())
        visit(choice->getChild(which), state, place, depth + 1);
    } else if (node->isOfType(SoLOD::getClassTypeId()) ||
               node->isOfType(SoLevelOfDetail::getClassTypeId())) {
      auto* group = static_cast<SoGroup*>(node);
      State inner = state;
      if (group->getNumChildren() > 0) visit(group->getChild(0), inner, place, depth + 1);
    } else if (node->isOfType(SoTransformSeparator::getClassTypeId())) {
      State inner = state;
      visit_children(node, inner, place, depth);
      inner.file_from_here = state.file_from_here;
      state = inner;
    } else if (node->isOfType(SoSeparator::getClassTypeId())) {
      State inner = state;
      visit_children(node, inner, place, depth);
    } else if (node->getChildren() != nullptr) {
      visit_children(node, state, place, depth);
    } else if (node->isOfType(SoShape::getClassTypeId())) {
      add_inventor(node, state, place);
    } else {
      set_property(node, state);
    }
  }

  static void set_property(SoNode* node, State& state) {
    if (node->isOfType(SoTransformation::getClassTypeId())) {
      SoGetMatrixAction matrix{SbViewportRegion()};
      matrix.apply(node);
      state.file_from_here = state.file_from_here * affine(matrix.getMatrix());
    } else if (auto* material = as<SoMaterial>(node)) {
      state.material = material;
    } else if (auto* binding = as<SoMaterialBinding>(node)) {
      state.binding = static_cast<SoMaterialBinding::Binding>(binding->value.getValue());
    } else if (auto* coordinates = as<SoCoordinate3>(node)) {
      state.coordinates = coordinates;
    } else if (auto* hints = as<SoShapeHints>(node)) {
      state.is_solid = hints->shapeType.getValue() == SoShapeHints::SOLID;
      state.is_clockwise = hints->vertexOrdering.getValue() == SoShapeHints::CLOCKWISE;
    }
  }

  void add_vrml97(SoVRMLShape& node, const State& state, int place) {
    auto* geometry = plain(node.geometry.getValue());
    if (geometry == nullptr) return;
    if (place < 0 && !text_of(geometry->getName()).empty())
      place = model_.enter(place, text_of(geometry->getName()));
    auto* appearance = as<SoVRMLAppearance>(node.appearance.getValue());
    if (appearance == nullptr ? node.appearance.getValue() != nullptr
                              : appearance->material.getValue() != nullptr &&
                                    as<SoVRMLMaterial>(appearance->material.getValue()) == nullptr)
      model_.notes().count("nodes left out where an Appearance or a Material belongs");
    auto* material =
        appearance == nullptr ? nullptr : as<SoVRMLMaterial>(appearance->material.getValue());
    if (appearance != nullptr && appearance->texture.getValue() != nullptr)
      model_.notes().count("textures of shapes ignored");
    if (const auto shape = vrml97_faces(geometry))
      model_.add(*shape, state.file_from_here, place, {vrml97_material(material)});
  }

  MaterialId vrml97_material(SoVRMLMaterial* node) {
    if (node == nullptr) return MaterialId::none();
    return model_.material(node, 0,
                           {text_of(node->getName()), colour(node->diffuseColor.getValue()),
                            colour(node->specularColor.getValue()),
                            colour(node->emissiveColor.getValue()),
                            node->transparency.getValue()});
  }

  std::optional<ShapeFaces> vrml97_faces(SoNode* node) {
    if (auto* box = as<SoVRMLBox>(node)) return vrml_box(vec(box->size.getValue()));
    if (auto* sphere = as<SoVRMLSphere>(node)) return vrml_sphere(sphere->radius.getValue());
    if (auto* cone = as<SoVRMLCone>(node)) {
      return vrml_cone(cone->bottomRadius.getValue(), cone->height.getValue(),
                       {cone->side.getValue() != 0, cone->bottom.getValue() != 0});
    }
    if (auto* c = as<SoVRMLCylinder>(node)) {
      return vrml_cylinder(c->radius.getValue(), c->height.getValue(),
                           {c->side.getValue() != 0, c->bottom.getValue() != 0,
                            c->top.getValue() != 0});
    }
    if (auto* set = as<SoVRMLIndexedFaceSet>(node)) return face_set(*set);
    if (auto* grid = as<SoVRMLElevationGrid>(node)) return elevation_grid(*grid);
    if (auto* extrusion = as<SoVRMLExtrusion>(node)) {
      extruded_ += static_cast<double>(extrusion->crossSection.getNum()) * extrusion->spine.getNum();
      if (extruded_ > extruded_at_least + extruded_per_byte * static_cast<double>(files_.bytes()))
        refuse(node, "Extrusions have too many points", "too many for the size of the file");
      auto shape = triangles_of(extrusion);
      shape.is_two_sided = extrusion->solid.getValue() == 0;
      return shape;
    }
    model_.notes().count(std::string(node->getTypeId().getName().getString()) +
                         " shapes left out: they have no surface");
    return std::nullopt;
  }

  static void turn_faces(ShapeFaces& shape) {
    for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
  }

  ShapeFaces face_set(SoVRMLIndexedFaceSet& node) {
    auto* coordinates = as<SoVRMLCoordinate>(node.coord.getValue());
    ShapeFaces shape;
    add_faces(node, node.coordIndex, coordinates == nullptr ? 0 : coordinates->point.getNum(),
              shape);
    if (coordinates != nullptr) take_points(coordinates->point, shape);
    if (node.color.getValue() != nullptr) model_.notes().count("colours per face or vertex ignored");
    if (node.ccw.getValue() == 0) turn_faces(shape);
    shape.is_two_sided = node.solid.getValue() == 0;
    return shape;
  }

  /// The points of the faces; few of a table that many shapes share, where they use few.
  static void take_points(const SoMFVec3f& field, ShapeFaces& shape) {
    std::size_t corners = 0;
    for (const auto& face : shape.faces) corners += face.size();
    if (corners >= static_cast<std::size_t>(field.getNum())) {
      for (int i = 0; i < field.getNum(); ++i) shape.points.push_back(vec(field[i]));
      return;
    }
    std::unordered_map<std::int32_t, std::int32_t> place;
    for (auto& face : shape.faces) {
      for (auto& corner : face) {
        const auto [entry, is_new] =
            place.try_emplace(corner, static_cast<std::int32_t>(shape.points.size()));
        if (is_new) shape.points.push_back(vec(field[corner]));
        corner = entry->second;
      }
    }
  }

  /// Faces by lists of indices, each closed by −1, into a table of `count` points.
  void add_faces(const SoNode& node, const SoMFInt32& indices, std::int32_t count,
                 ShapeFaces& shape) {
    std::vector<std::int32_t> face;
    std::int32_t number = 0;
    const auto finish = [&] {
      if (face.size() >= 3) {
        shape.faces.push_back(face);
        shape.face_material.push_back(number);
      } else if (!face.empty()) {
        model_.notes().count("faces of fewer than 3 corners left out");
      }
      ++number;
      face.clear();
    };
    for (int i = 0; i < indices.getNum(); ++i) {
      const std::int32_t index = indices[i];
      if (index == -1) {
        finish();
      } else if (index < 0 || index >= count) {
        refuse(&node, fmt::format("coordIndex {} is out of range", index),
               fmt::format("{} points are there, counted from 0", count));
      } else {
        face.push_back(index);
      }
    }
    finish();
  }

  ShapeFaces elevation_grid(SoVRMLElevationGrid& node) {
    const std::int32_t nx = node.xDimension.getValue(), nz = node.zDimension.getValue();
    if (nx < 0 || nz < 0 || static_cast<std::int64_t>(nx) * nz != node.height.getNum()) {
      refuse(&node, "ElevationGrid has another number of heights",
             fmt::format("{} × {} points, {} heights", nx, nz, node.height.getNum()));
    }
    std::vector<double> heights;
    for (int i = 0; i < node.height.getNum(); ++i) heights.push_back(node.height[i]);
    auto shape = vrml_elevation_grid(
        heights, {nx, nz, node.xSpacing.getValue(), node.zSpacing.getValue()});
    if (node.ccw.getValue() == 0) turn_faces(shape);
    shape.is_two_sided = node.solid.getValue() == 0;
    return shape;
  }

  /// Triangles as Coin makes them, in the frame of the shape.
  static ShapeFaces triangles_of(SoNode* node) {
    ShapeFaces shape;
    SoCallbackAction action;
    action.addTriangleCallback(
        SoShape::getClassTypeId(),
        [](void* data, SoCallbackAction* from, const SoPrimitiveVertex* a,
           const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
          auto& faces = *static_cast<ShapeFaces*>(data);
          const auto first = static_cast<std::int32_t>(faces.points.size());
          const Affine here = affine(from->getModelMatrix());
          for (const auto* v : {a, b, c}) faces.points.push_back(here(vec(v->getPoint())));
          faces.faces.push_back({first, first + 1, first + 2});
        },
        &shape);
    action.apply(node);
    return shape;
  }

  void add_inventor(SoNode* node, const State& state, int place) {
    auto shape = inventor_faces(node, state);
    if (!shape || shape->faces.empty()) return;
    model_.add(*shape, state.file_from_here, place, inventor_materials(*shape, state));
  }

  std::optional<ShapeFaces> inventor_faces(SoNode* node, const State& state) {
    if (auto* cube = as<SoCube>(node))
      return vrml_box({cube->width.getValue(), cube->height.getValue(), cube->depth.getValue()});
    if (auto* sphere = as<SoSphere>(node)) return vrml_sphere(sphere->radius.getValue());
    if (auto* cone = as<SoCone>(node)) {
      return vrml_cone(cone->bottomRadius.getValue(), cone->height.getValue(),
                       {cone->hasPart(SoCone::SIDES) != 0, cone->hasPart(SoCone::BOTTOM) != 0});
    }
    if (auto* c = as<SoCylinder>(node)) {
      return vrml_cylinder(c->radius.getValue(), c->height.getValue(),
                           {c->hasPart(SoCylinder::SIDES) != 0,
                            c->hasPart(SoCylinder::BOTTOM) != 0,
                            c->hasPart(SoCylinder::TOP) != 0});
    }
    ShapeFaces shape;
    if (auto* set = as<SoVertexShape>(node)) {
      const auto* coordinates = coordinates_of(*set, state);
      const std::int32_t count = coordinates == nullptr ? 0 : coordinates->getNum();
      add_vertex_shape(node, count, shape);
      if (coordinates != nullptr) take_points(*coordinates, shape);
    }
    if (shape.faces.empty()) {
      model_.notes().count(std::string(node->getTypeId().getName().getString()) +
                           " shapes left out: no faces are read of them");
    }
    if (state.is_clockwise) turn_faces(shape);
    shape.is_two_sided = !state.is_solid;
    return shape;
  }

  /// Open Inventor's sets of faces, strips and meshes. They are not left to Coin, which does not
  /// ask whether the points are there.
  void add_vertex_shape(SoNode* node, std::int32_t count, ShapeFaces& shape) {
    if (auto* set = as<SoIndexedFaceSet>(node)) {
      add_faces(*node, set->coordIndex, count, shape);
    } else if (auto* strips = as<SoIndexedTriangleStripSet>(node)) {
      add_faces(*node, strips->coordIndex, count, shape);
      cut_strips(shape);
    } else if (auto* faces = as<SoFaceSet>(node)) {
      add_rows(*node, faces->numVertices, faces->startIndex.getValue(), count, shape);
    } else if (auto* strip_set = as<SoTriangleStripSet>(node)) {
      add_rows(*node, strip_set->numVertices, strip_set->startIndex.getValue(), count, shape);
      cut_strips(shape);
    } else if (auto* mesh = as<SoQuadMesh>(node)) {
      add_mesh(*mesh, count, shape);
    }
  }

  /// Faces by their numbers of corners, which lie one after another; −1: all that are left.
  void add_rows(const SoNode& node, const SoMFInt32& lengths, std::int32_t first,
                std::int32_t count, ShapeFaces& shape) {
    for (int row = 0; row < lengths.getNum(); ++row) {
      const std::int32_t length = lengths[row] == -1 ? count - first : lengths[row];
      if (first < 0 || first > count || length < 0 || length > count - first) {
        refuse(&node, fmt::format("a face of {} corners has no points", lengths[row]),
               fmt::format("{} points are there, it begins with the one of number {}", count, first));
      }
      if (length >= 3) {
        auto& face = shape.faces.emplace_back();
        for (std::int32_t k = 0; k < length; ++k) face.push_back(first + k);
      } else {
        model_.notes().count("faces of fewer than 3 corners left out");
      }
      first += length;
    }
  }

  void add_mesh(const SoQuadMesh& node, std::int32_t count, ShapeFaces& shape) {
    const std::int32_t first = node.startIndex.getValue();
    const std::int32_t columns = node.verticesPerRow.getValue();
    const std::int32_t rows = node.verticesPerColumn.getValue();
    if (first < 0 || first > count || columns < 1 || rows < 1 ||
        static_cast<std::int64_t>(columns) * rows > count - first) {
      refuse(&node, fmt::format("a mesh of {} × {} points has no points", columns, rows),
             fmt::format("{} points are there, it begins with the one of number {}", count, first));
    }
    for (std::int32_t r = 0; r + 1 < rows; ++r) {
      for (std::int32_t c = 0; c + 1 < columns; ++c) {
        const std::int32_t a = first + r * columns + c, b = a + columns;
        shape.faces.push_back({a, b, b + 1});
        shape.faces.push_back({a, b + 1, a + 1});
      }
    }
  }

  /// Faces that are strips become triangles; every other one runs the other way around.
  static void cut_strips(ShapeFaces& shape) {
    std::vector<std::vector<std::int32_t>> triangles;
    for (const auto& strip : shape.faces) {
      for (std::size_t i = 0; i + 2 < strip.size(); ++i)
        triangles.push_back({strip[i], strip[i + 1 + i % 2], strip[i + 2 - i % 2]});
    }
    shape.faces = std::move(triangles);
    shape.face_material.clear();
  }

  static const SoMFVec3f* coordinates_of(SoVertexShape& set, const State& state) {
    auto* own = as<SoVertexProperty>(set.vertexProperty.getValue());
    if (own != nullptr && own->vertex.getNum() > 0) return &own->vertex;
    return state.coordinates == nullptr ? nullptr : &state.coordinates->point;
  }

  std::vector<MaterialId> inventor_materials(ShapeFaces& shape, const State& state) {
    auto* node = state.material;
    if (node == nullptr) return {MaterialId::none()};
    const bool per_face = state.binding == SoMaterialBinding::PER_FACE &&
                          shape.face_material.size() == shape.faces.size();
    if (!per_face) {
      if (state.binding != SoMaterialBinding::OVERALL && node->diffuseColor.getNum() > 1)
        model_.notes().count("shapes have several materials, of which the first is taken");
      shape.face_material.clear();
    }
    std::vector<MaterialId> materials;
    const int count = per_face ? std::max(1, node->diffuseColor.getNum()) : 1;
    for (int i = 0; i < count; ++i) materials.push_back(inventor_material(*node, i));
    return materials;
  }

  MaterialId inventor_material(SoMaterial& node, int index) {
    const auto entry = [&](const SoMFColor& field) -> std::array<double, 3> {
      if (field.getNum() == 0) return {};
      return colour(field[std::min(index, field.getNum() - 1)]);
    };
    const double transparency = node.transparency.getNum() > 0 ? node.transparency[0] : 0;
    return model_.material(&node, index,
                           {text_of(node.getName()), entry(node.diffuseColor),
                            entry(node.specularColor), entry(node.emissiveColor), transparency});
  }

  std::string path_;
  VrmlModel model_;
  VrmlFiles files_;
  std::vector<const VrmlFiles::File*> files_stack_;
  std::string node_name_;
  std::size_t visits_ = 0;
  double extruded_ = 0;
};

/// Coin's tables are one for all.
std::mutex& coin_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

PolygonModel read_scene_vrml(const std::string& path, const SceneFileRules& rules) {
  const std::lock_guard lock(coin_mutex());
  return VrmlWalk(path, rules).run();
}

}  // namespace sunload
