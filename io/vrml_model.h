/// The scene that a walk through a VRML file builds: placed shapes, objects, materials.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/scene_support.h"
#include "io/vrml_shapes.h"

namespace sunload {

/// x ↦ axes·x + origin, composed like functions: (a * b)(x) = a(b(x)).
struct Affine {
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< images of the axes
  Vec3 origin;

  Vec3 operator()(Vec3 p) const { return direction(p) + origin; }
  Vec3 direction(Vec3 v) const { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }
  double determinant() const { return dot(axes[0], cross(axes[1], axes[2])); }
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {{a.direction(b.axes[0]), a.direction(b.axes[1]), a.direction(b.axes[2])}, a(b.origin)};
  }
};

/// Colours of one Material node, as the file gives them.
struct VrmlMaterial {
  std::string name;
  std::array<double, 3> diffuse{}, specular{}, emissive{};
  double transparency = 0;
};

/// One place in the tree under a name; every instance of a node is a place of its own.
struct VrmlPlace {
  std::string name;                     ///< DEFs from the root, joined by '/'
  ObjectId object = ObjectId::none();  ///< once it has faces
};

/// Hands out `name`, or `name_2`, `name_3` … where it is taken.
class UniqueNames {
 public:
  std::string operator()(const std::string& name);

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> last_;
};

class VrmlModel {
 public:
  VrmlModel(const std::string& path, const SceneFileRules& rules);

  /// A place below `parent` (an index, −1 = the root) under the name of a DEF.
  int enter(int parent, const std::string& name);

  /// Material of a node's colours; the same node and index again is the same material.
  MaterialId material(const void* node, int index, const VrmlMaterial& colours);

  /// Adds a shape; `materials` has one entry, or one for every `face_material`.
  void add(const ShapeFaces& shape, const Affine& file_from_shape, int place,
           const std::vector<MaterialId>& materials);

  NoteCounter& notes() { return notes_; }
  PolygonModel finish();

 private:
  double strength(const std::array<double, 3>& colour) const;
  ObjectId object_of(int place);

  SceneFileRules rules_;
  SceneFromFile scene_from_file_;
  PolygonModel model_;
  NoteCounter notes_;
  std::string stem_;
  std::vector<VrmlPlace> places_;
  ObjectId nameless_;
  std::map<std::pair<const void*, int>, MaterialId> materials_;
  UniqueNames object_names_, material_names_;
  double largest_ = 0;
};

}  // namespace sunload
