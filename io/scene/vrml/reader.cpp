// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vrml/reader.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoGetMatrixAction.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/misc/SoProto.h>
#include <Inventor/nodes/SoNodes.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>

#include "io/scene/vrml/faces.h"
#include "io/scene/vrml/model.h"
#include "io/scene/vrml/nodes.h"
#include "io/scene/vrml/text.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;
using coin::affine;
using coin::as;
using coin::plain;
using coin::text_of;
using coin::vec;

/// Of nodes, where files are inlined many times: seconds.
constexpr std::size_t most_visits = 10'000'000;

std::array<double, 3> colour(const SbColor& c) { return {c[0], c[1], c[2]}; }

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
         affine(orientation) * scaled(vec(node.scale.getValue())) * affine(orientation.inverse()) *
         moved(-center);
}

/// What Inventor's property nodes set for the shapes that follow them.
struct State {
  Affine file_from_here;
  SoMaterial* material = nullptr;
  SoMaterialBinding::Binding binding = SoMaterialBinding::OVERALL;
  VrmlFaces::Hints hints;
};

/// Walks through Coin's nodes and adds their faces.
class VrmlWalk {
 public:
  VrmlWalk(const std::string& path, const SceneFileRules& rules)
      : path_(path),
        model_(path, rules),
        files_(model_.notes()),
        faces_(model_.notes(), files_, [this](const SoNode& node) { return place_of(node); }) {}

  PolygonModel run() {
    State state;
    inline_file(path_, state, -1);
    PolygonModel model = model_.finish();
    model.files = files_.paths();
    return model;
  }

 private:
  Where place_of(const SoNode& node) const {
    const auto& text = here().text;
    const std::string name = node_name_.empty() ? text_of(node.getName()) : node_name_;
    const auto where = name.empty() ? std::nullopt : place_of_def(text, name);
    return where ? *where : Where{text.path};
  }

  /// As long as it lives, what is read counts as of a file. `is_home`: of the one that wrote the
  /// PROTO at hand; otherwise it is inlined.
  class Within {
   public:
    Within(VrmlWalk& walk, const VrmlFiles::File& file, bool is_home) : walk_(walk) {
      walk_.files_stack_.push_back({&file, is_home});
      walk_.model_.set_file(file.text.path);
    }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;
    ~Within() {
      walk_.files_stack_.pop_back();
      if (!walk_.files_stack_.empty()) walk_.model_.set_file(walk_.here().text.path);
    }

   private:
    VrmlWalk& walk_;
  };
  const VrmlFiles::File& here() const { return *files_stack_.back().file; }
  /// Of nodes whose PROTO another file has written.
  void enter_home(const SoNode* node, std::optional<Within>& home) {
    const auto* file = files_.home_of(node);
    if (file != nullptr && file != &here()) home.emplace(*this, *file, true);
  }

  void inline_file(const std::string& path, State& state, int place) {
    const std::string asker =
        files_stack_.empty() ? std::string() : "Inline of " + here().text.path;
    const auto& file = files_.read(path, asker);
    model_.set_file_bytes(files_.bytes());
    const bool is_within_itself =
        std::any_of(files_stack_.begin(), files_stack_.end(),
                    [&](const Level& level) { return level.file == &file; });
    if (is_within_itself || files_stack_.size() >= deepest_inline)
      throw InputError({here().text.path}, "inlines itself",
                       "Inline of " + path + " leads back to it");
    const Within inlined(*this, file, false);
    State inner;
    inner.file_from_here = state.file_from_here;
    visit(file.root, inner, place, 0);
  }

  /// Beside the file that it stands in; of a PROTO that is this one's, or, where a field has
  /// brought it, whose node it is (ISO/IEC 14772-1, 4.5.2). Empty where there is no such file.
  std::string file_of(const std::string& url) const {
    for (auto level = files_stack_.rbegin(); level != files_stack_.rend(); ++level) {
      auto path = VrmlFiles::beside(level->file->text.path, url);
      std::error_code no_matter;
      if (fs::is_regular_file(path, no_matter)) return path;
      if (!level->is_home) break;
    }
    return {};
  }

  /// The first url that is a file; further urls are copies of it elsewhere.
  void inline_url(const std::vector<std::string>& urls, State& state, int place) {
    for (const auto& url : urls)
      if (const auto path = file_of(url); !path.empty()) return inline_file(path, state, place);
    if (!urls.empty())
      model_.notes().say("inlined file '" + urls.front() + "' is not there, which " +
                         fs::path(here().text.path).filename().string() + " wants");
  }

  void visit(SoNode* node, State& state, int place, std::size_t depth) {
    std::optional<Within> home;
    enter_home(node, home);
    node = plain(node);
    if (node == nullptr) return;
    if (++visits_ > most_visits || depth > 4 * deepest_vrml) {
      throw InputError({path_}, "has too many nodes", "with every USE in its place");
    }
    const auto name = text_of(node->getName());
    const std::string outer_name = node_name_;
    if (!name.empty()) node_name_ = name;
    const bool is_geometry = node->isOfType(SoVRMLGeometry::getClassTypeId());
    const bool names_object =
        !name.empty() && !is_geometry && (node->getChildren() != nullptr || is_shape(node));
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
    urls.reserve(static_cast<std::size_t>(field.getNum()));
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
      state.hints.coordinates = coordinates;
    } else if (auto* hints = as<SoShapeHints>(node)) {
      state.hints.is_solid = hints->shapeType.getValue() == SoShapeHints::SOLID;
      state.hints.is_clockwise = hints->vertexOrdering.getValue() == SoShapeHints::CLOCKWISE;
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
    std::optional<Within> of_appearance, of_material;
    enter_home(node.appearance.getValue(), of_appearance);
    if (appearance != nullptr) enter_home(appearance->material.getValue(), of_material);
    if (const auto shape = faces_.of_vrml97(geometry))
      model_.add(*shape, state.file_from_here, place, {vrml97_material(material)});
  }

  MaterialId vrml97_material(SoVRMLMaterial* node) {
    if (node == nullptr) return MaterialId::none();
    return model_.material(node, 0,
                           {text_of(node->getName()), colour(node->diffuseColor.getValue()),
                            colour(node->specularColor.getValue()),
                            colour(node->emissiveColor.getValue()), node->transparency.getValue()});
  }

  void add_inventor(SoNode* node, const State& state, int place) {
    auto shape = faces_.of_inventor(node, state.hints);
    if (!shape || shape->faces.empty()) return;
    if (state.binding == SoMaterialBinding::PER_FACE_INDEXED) take_material_indices(*node, *shape);
    model_.add(*shape, state.file_from_here, place, inventor_materials(*shape, state));
  }

  /// Of faces that say themselves which of the materials is theirs.
  static void take_material_indices(SoNode& node, ShapeFaces& shape) {
    auto* set = as<SoIndexedShape>(&node);
    if (set == nullptr) return;
    const SoMFInt32& indices = set->materialIndex;
    for (auto& material : shape.face_material)
      if (material < indices.getNum() && indices[material] >= 0) material = indices[material];
  }

  std::vector<MaterialId> inventor_materials(ShapeFaces& shape, const State& state) {
    auto* node = state.material;
    if (node == nullptr) return {MaterialId::none()};
    const bool per_face = (state.binding == SoMaterialBinding::PER_FACE ||
                           state.binding == SoMaterialBinding::PER_FACE_INDEXED) &&
                          shape.face_material.size() == shape.faces.size();
    if (!per_face) {
      if (state.binding != SoMaterialBinding::OVERALL && node->diffuseColor.getNum() > 1)
        model_.notes().count("shapes have several materials, of which the first is taken");
      shape.face_material.clear();
    }
    std::vector<MaterialId> materials;
    const int count = per_face ? std::max(1, node->diffuseColor.getNum()) : 1;
    materials.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) materials.push_back(inventor_material(*node, i));
    return materials;
  }

  MaterialId inventor_material(SoMaterial& node, int index) {
    const auto entry = [&](const SoMFColor& field) -> std::array<double, 3> {
      if (field.getNum() == 0) return {};
      return colour(field[std::min(index, field.getNum() - 1)]);
    };
    const int transparencies = node.transparency.getNum();
    const double transparency =
        transparencies > 0 ? node.transparency[std::min(index, transparencies - 1)] : 0;
    return model_.material(&node, index,
                           {text_of(node.getName()), entry(node.diffuseColor),
                            entry(node.specularColor), entry(node.emissiveColor), transparency});
  }

  std::string path_;
  VrmlModel model_;
  VrmlFiles files_;
  VrmlFaces faces_;
  struct Level {
    const VrmlFiles::File* file;
    bool is_home;
  };
  std::vector<Level> files_stack_;
  std::string node_name_;
  std::size_t visits_ = 0;
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
