#include "solver/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "geo/check.h"
#include "solver/rng.h"

namespace sunload {

namespace {

using Corners = std::array<std::int32_t, 3>;

/// FNV-1a, stable over runs and machines.
std::uint64_t text_key(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// Corner opposite of the longest edge; of equal edges that with the smallest
/// vertex numbers, so that both triangles at an edge decide alike.
std::uint8_t apex_of_longest_edge(const std::vector<Vec3>& vertices, const Corners& c) {
  std::uint8_t apex = 0;
  double longest = -1;
  std::pair<std::int32_t, std::int32_t> longest_edge;
  for (std::uint8_t k = 0; k < 3; ++k) {
    const auto p = c[(k + 1u) % 3], q = c[(k + 2u) % 3];
    const std::pair<std::int32_t, std::int32_t> edge = std::minmax(p, q);
    const Vec3 d = vertices[static_cast<std::size_t>(edge.second)] -
                   vertices[static_cast<std::size_t>(edge.first)];
    const double length = dot(d, d);
    if (length > longest || (length == longest && edge < longest_edge)) {
      longest = length;
      longest_edge = edge;
      apex = k;
    }
  }
  return apex;
}

/// Weights at which a child begins: those of corners 0, 1, 2.
struct Weights {
  double w[3];
};

[[noreturn]] void refuse_size(const SplitRules& rules) {
  throw InputError({}, "more than " + std::to_string(rules.max_patches) + " patches",
                   "mesh.max_edge_m is too small for this scene", "use a larger one");
}

}  // namespace

std::size_t least_patch_count(const Scene& scene, const SplitRules& rules) {
  const double largest_leaf_m2 = std::max(std::sqrt(3.0) / 4 * rules.max_edge_m * rules.max_edge_m,
                                          2 * rules.min_area_m2);
  const Mesh& mesh = scene.mesh;
  double count = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.triangle_surface[t] == Surface::floor) continue;
    const double area_m2 = norm(mesh.area_vector2(t)) / 2;
    const double leaves = std::max(1.0, std::ceil(area_m2 / largest_leaf_m2));
    count += mesh.triangle_sides[t] == Sides::two ? 2 * leaves : leaves;
  }
  constexpr double beyond_any_machine = 1e15;
  return static_cast<std::size_t>(std::min(count, beyond_any_machine));
}

class Hierarchy::Builder {
 public:
  Builder(Hierarchy& h, const SplitRules& rules) : h_(h), rules_(rules) {}

  void add_tree(std::int32_t triangle, const Corners& corners, std::uint64_t tree_key) {
    const auto root = static_cast<std::int32_t>(h_.nodes_.size());
    h_.root_[static_cast<std::size_t>(triangle)] = root;
    h_.nodes_.emplace_back();
    split(root, triangle, corners, tree_key, 1);
  }

 private:
  void split(std::int32_t node, std::int32_t triangle, const Corners& c, std::uint64_t tree_key,
             std::uint64_t path) {
    const std::uint8_t apex = apex_of_longest_edge(h_.vertices_, c);
    if (!wants_split(c, apex)) return add_leaf(node, triangle, c, mixed(tree_key, path));
    const auto p = c[(apex + 1u) % 3], q = c[(apex + 2u) % 3], r = c[apex];
    const auto m = midpoint(p, q);
    const auto child = static_cast<std::int32_t>(h_.nodes_.size());
    h_.nodes_.resize(h_.nodes_.size() + 2);
    h_.nodes_[static_cast<std::size_t>(node)].first_child = child;
    h_.nodes_[static_cast<std::size_t>(node)].apex = apex;
    split(child, triangle, {p, m, r}, tree_key, 2 * path);
    split(child + 1, triangle, {m, q, r}, tree_key, 2 * path + 1);
  }

  bool wants_split(const Corners& c, std::uint8_t apex) const {
    const Vec3 a = at(c[(apex + 1u) % 3]), b = at(c[(apex + 2u) % 3]);
    if (norm(b - a) <= rules_.max_edge_m) return false;
    return norm(cross(b - a, at(c[apex]) - a)) / 2 >= 2 * rules_.min_area_m2;
  }

  Vec3 at(std::int32_t vertex) const { return h_.vertices_[static_cast<std::size_t>(vertex)]; }

  std::int32_t midpoint(std::int32_t p, std::int32_t q) {
    const auto [low, high] = std::minmax(p, q);
    const auto edge = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
    const auto [place, is_new] =
        midpoints_.try_emplace(edge, static_cast<std::int32_t>(h_.vertices_.size()));
    if (is_new) h_.vertices_.push_back((at(low) + at(high)) / 2);
    return place->second;
  }

  void add_leaf(std::int32_t node, std::int32_t triangle, const Corners& c, std::uint64_t key) {
    if (h_.patches_.size() >= rules_.max_patches) refuse_size(rules_);
    h_.nodes_[static_cast<std::size_t>(node)].first_patch =
        static_cast<std::int32_t>(h_.patches_.size());
    const double area = norm(cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]))) / 2;
    const bool both = h_.two_sided_[static_cast<std::size_t>(triangle)];
    for (std::uint8_t side = 0; side < (both ? 2 : 1); ++side) {
      h_.patches_.push_back({side == 0 ? c : Corners{c[0], c[2], c[1]}, triangle, side});
      h_.area_.push_back(area);
      h_.key_.push_back(mixed(key, side));
    }
  }

  Hierarchy& h_;
  const SplitRules& rules_;
  std::unordered_map<std::uint64_t, std::int32_t> midpoints_;
};

Hierarchy::Hierarchy(const Scene& scene, const SplitRules& rules)
    : root_(scene.mesh.triangle_count(), -1), two_sided_(scene.mesh.triangle_count()) {
  expect_valid(scene);
  if (least_patch_count(scene, rules) > rules.max_patches) refuse_size(rules);
  const Mesh& mesh = scene.mesh;
  vertices_ = mesh.vertices;
  Builder builder(*this, rules);
  std::vector<std::uint64_t> number_in_object(mesh.object_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto object = mesh.triangle_object[t].index();
    const std::uint64_t tree_key =
        mixed(text_key(mesh.object_names[object]), number_in_object[object]++);
    two_sided_[t] = mesh.triangle_sides[t] == Sides::two;
    if (mesh.triangle_surface[t] == Surface::floor) continue;
    builder.add_tree(static_cast<std::int32_t>(t), mesh.triangles[t], tree_key);
  }
}

Vec3 Hierarchy::normal(std::size_t patch) const {
  const Vec3 a = corner(patch, 0);
  return normalized(cross(corner(patch, 1) - a, corner(patch, 2) - a));
}

Vec3 Hierarchy::centroid(std::size_t patch) const {
  return (corner(patch, 0) + corner(patch, 1) + corner(patch, 2)) / 3;
}

std::int32_t Hierarchy::patch_at(std::int32_t triangle, double u, double v, bool front) const {
  const auto t = static_cast<std::size_t>(triangle);
  if (root_[t] < 0 || (!front && !two_sided_[t])) return -1;
  Weights x{{1 - u - v, u, v}};
  const Node* node = &nodes_[static_cast<std::size_t>(root_[t])];
  while (node->first_child >= 0) {
    const double p = x.w[(node->apex + 1) % 3], q = x.w[(node->apex + 2) % 3], r = x.w[node->apex];
    // Child 0 is (p, m, r), child 1 is (m, q, r), m the midpoint of pq.
    const bool second = q > p;
    x = second ? Weights{{2 * p, q - p, r}} : Weights{{p - q, 2 * q, r}};
    node = &nodes_[static_cast<std::size_t>(node->first_child + (second ? 1 : 0))];
  }
  return node->first_patch + (front ? 0 : 1);
}

}  // namespace sunload
