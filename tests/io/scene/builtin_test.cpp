// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh_prepare.h"
#include "io/scene/cityjson/write.h"
#include "io/scene/file.h"
#include "io/scene/mesh_files/obj_write.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

constexpr double historic_street = 12424, historic_towers = 4500;  // as published
constexpr double count_tolerance = 0.02;

PreparedMesh prepared(const BuiltinRules& rules) { return prepare(builtin_scene(rules), {}); }

/// Directed edges of one object that have no single partner, by position of the polygons' rings.
std::size_t edges_without_partner(const PolygonModel& model) {
  std::map<std::tuple<int, int, int>, int> uses;
  for (std::size_t p = 0; p < model.polygon_count(); ++p)
    for (auto r = model.polygon_ring[p]; r < model.polygon_ring[p + 1]; ++r) {
      const auto begin = model.ring_begin[static_cast<std::size_t>(r)];
      const auto end = model.ring_begin[static_cast<std::size_t>(r) + 1];
      for (auto i = begin; i < end; ++i) {
        const auto next = i + 1 < end ? i + 1 : begin;
        ++uses[{model.facts[p].object.value, model.ring_vertex[static_cast<std::size_t>(i)],
                model.ring_vertex[static_cast<std::size_t>(next)]}];
      }
    }
  std::size_t bad = 0;
  for (const auto& [edge, count] : uses) {
    const auto& [object, a, b] = edge;
    const auto partner = uses.find({object, b, a});
    if (count != 1 || partner == uses.end()) ++bad;
  }
  return bad;
}

std::array<double, 2> flat(Vec3 p, int axis) {
  if (axis == 0) return {p.y, p.z};
  if (axis == 1) return {p.x, p.z};
  return {p.x, p.y};
}

/// True if the interiors of two triangles of one plane overlap: no edge separates them.
bool overlap_in_plane(const std::array<std::array<double, 2>, 3>& a,
                      const std::array<std::array<double, 2>, 3>& b) {
  constexpr double touch = 1e-7;  // m: below the joints, above rounding
  const auto separates = [&](const auto& s, const auto& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = s[i], q = s[(i + 1) % 3];
      const double size = std::hypot(q[0] - p[0], q[1] - p[1]);
      const std::array<double, 2> n{(q[1] - p[1]) / size, (p[0] - q[0]) / size};
      double low_s = 1e300, high_s = -1e300, low_t = 1e300, high_t = -1e300;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = n[0] * s[k][0] + n[1] * s[k][1], y = n[0] * t[k][0] + n[1] * t[k][1];
        low_s = std::min(low_s, x), high_s = std::max(high_s, x);
        low_t = std::min(low_t, y), high_t = std::max(high_t, y);
      }
      if (high_s <= low_t + touch || high_t <= low_s + touch) return true;
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

/// Pairs of triangles that lie on each other, whatever way they face.
std::size_t coplanar_overlaps(const Mesh& mesh) {
  std::map<std::array<long long, 4>, std::vector<std::size_t>> planes;
  constexpr double grid = 1e-4;  // of normals and of distances from the origin [m]
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    Vec3 n = normalized(mesh.area_vector2(t));
    if (n.x < -grid ||
        (std::abs(n.x) <= grid && (n.y < -grid || (std::abs(n.y) <= grid && n.z < 0))))
      n = -n;
    const auto cell = [&](double x) { return std::llround(x / grid); };
    planes[{cell(n.x), cell(n.y), cell(n.z), cell(dot(n, mesh.corner(t, 0)))}].push_back(t);
  }
  std::size_t count = 0;
  for (const auto& [key, triangles] : planes) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(key[static_cast<std::size_t>(k)]) >
          std::abs(key[static_cast<std::size_t>(axis)]))
        axis = k;
    const auto shape = [&](std::size_t t) {
      return std::array{flat(mesh.corner(t, 0), axis), flat(mesh.corner(t, 1), axis),
                        flat(mesh.corner(t, 2), axis)};
    };
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t j = i + 1; j < triangles.size(); ++j)
        count += overlap_in_plane(shape(triangles[i]), shape(triangles[j]));
  }
  return count;
}

struct Hit {
  std::size_t triangle;
  double distance;
};

/// Nearest hit, by trying all triangles (Möller, Trumbore 1997).
std::optional<Hit> first_hit(const Mesh& mesh, Vec3 from, Vec3 to) {
  std::optional<Hit> nearest;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = mesh.corner(t, 0), e1 = mesh.corner(t, 1) - a, e2 = mesh.corner(t, 2) - a;
    const Vec3 p = cross(to, e2);
    const double det = dot(e1, p);
    if (det == 0) continue;
    const Vec3 s = from - a, q = cross(s, e1);
    const double u = dot(s, p) / det, v = dot(to, q) / det, distance = dot(e2, q) / det;
    constexpr double start = 1e-6;  // m: not the triangle that the ray leaves
    if (u < 0 || v < 0 || u + v > 1 || distance < start) continue;
    if (!nearest || distance < nearest->distance) nearest = Hit{t, distance};
  }
  return nearest;
}

std::string object_of(const Mesh& mesh, std::size_t triangle) {
  return mesh.object_names[mesh.triangle_object[triangle].index()];
}

std::string material_of(const Mesh& mesh, std::size_t triangle) {
  return mesh.file_materials[mesh.triangle_material[triangle].index()].name;
}

Vec3 centroid(const Mesh& mesh, std::size_t t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
}

/// What every scene owes its users: nothing for preparation to repair.
void expect_clean(const PreparedMesh& p, const std::string& name) {
  const auto& r = p.report;
  EXPECT_EQ(r.polygons_untriangulated, 0u) << name;
  EXPECT_EQ(r.degenerates_dropped, 0u) << name;
  EXPECT_EQ(r.duplicates_dropped, 0u) << name;
  EXPECT_EQ(r.triangles_flipped, 0u) << name;
  EXPECT_EQ(r.nonmanifold_edges, 0u) << name;
  EXPECT_EQ(coplanar_overlaps(p.mesh), 0u) << name;
  for (const auto& warning : r.warnings) ADD_FAILURE() << name << ": " << warning;
}

TEST(SceneBuiltin, StreetIsTheHistoricOne) {
  for (const std::string house_3 : {"brick", "glazed"}) {
    const auto model = builtin_scene({"street", {{"house_3", house_3}}});
    const auto p = prepare(model, {});
    std::printf("street %s: %zu triangles, %zu bodies, %.0f m3, worst aspect %.0f\n",
                house_3.c_str(), p.mesh.triangle_count(), p.report.closed_bodies,
                p.report.volume_m3, p.report.worst_aspect);
    EXPECT_NEAR(static_cast<double>(p.mesh.triangle_count()), historic_street,
                count_tolerance * historic_street);
    EXPECT_EQ(edges_without_partner(model), 0u);
    EXPECT_EQ(p.report.open_sheets, 0u);
    EXPECT_EQ(p.report.open_edges, 0u);
    EXPECT_EQ(p.report.closed_bodies, model.object_names.size());
    EXPECT_GT(p.report.volume_m3, 0);
    expect_clean(p, "street " + house_3);
    const std::set<std::string> names(model.object_names.begin(), model.object_names.end());
    for (const char* name : {"house_1", "house_2", "house_3", "house_4", "pavement_north",
                             "pavement_south", "road", "kerb_north", "kerb_south"})
      EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_EQ(names.size(), model.object_names.size());
  }
}

TEST(SceneBuiltin, VariantsShareAllButHouse3) {
  const auto brick = builtin_scene({"street", {}});
  const auto glazed = builtin_scene({"street", {{"house_3", "glazed"}}});
  EXPECT_EQ(brick.object_names, glazed.object_names);
  const auto others = [](const PolygonModel& model) {
    std::vector<Vec3> corners;
    for (std::size_t p = 0; p < model.polygon_count(); ++p) {
      if (model.object_names[model.facts[p].object.index()] == "house_3") continue;
      const auto begin = model.ring_begin[static_cast<std::size_t>(model.polygon_ring[p])];
      const auto end = model.ring_begin[static_cast<std::size_t>(model.polygon_ring[p + 1])];
      for (auto i = begin; i < end; ++i)
        corners.push_back(model.vertices[static_cast<std::size_t>(
            model.ring_vertex[static_cast<std::size_t>(i)])]);
    }
    return corners;
  };
  EXPECT_EQ(others(brick), others(glazed));
}

/// Glass of house_3 in equinox sun at Plzeň, and what its mirror light meets [m²].
struct Glints {
  double panes = 0, lit = 0;
  std::map<std::string, double> met;
};
Glints glints(const Mesh& mesh, double hour_angle_deg) {
  const double latitude = radians(49.75), h = radians(hour_angle_deg);  // declination 0
  const Vec3 sun{-std::sin(h), -std::cos(h) * std::sin(latitude), std::cos(h) * std::cos(latitude)};
  Glints result;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 n = normalized(mesh.area_vector2(t));
    constexpr double towards_street = -0.9;
    if (object_of(mesh, t) != "house_3" || material_of(mesh, t) != "glass" || n.y > towards_street)
      continue;
    const double area = mesh.area_m2(t);
    result.panes += area;
    const Vec3 at = centroid(mesh, t);
    if (first_hit(mesh, at, sun)) continue;
    result.lit += area;
    if (const auto hit = first_hit(mesh, at, mirrored(sun, n)))
      result.met[object_of(mesh, hit->triangle)] += area;
  }
  return result;
}

TEST(SceneBuiltin, GlazedHouseMirrorsTheMorningSunOntoTheStreet) {
  const auto p = prepared({"street", {{"house_3", "glazed"}}});
  double panes = 0, lit = 0, pavement = 0, road = 0, opposite = 0;
  for (const double hour_angle_deg : {-75.0, -60.0, -45.0, -30.0, -15.0, 0.0}) {
    auto g = glints(p.mesh, hour_angle_deg);
    panes += g.panes, lit += g.lit;
    pavement += g.met["pavement_north"], road += g.met["road"], opposite += g.met["house_4"];
  }
  std::printf(
      "m2 of glass, six suns: %.0f, lit %.0f, mirrored to: pavement_north %.0f, road %.0f, "
      "house_4 %.0f\n",
      panes, lit, pavement, road, opposite);
  EXPECT_GT(2 * lit, panes) << "most panes are in the sun during the morning";
  EXPECT_GT(pavement, opposite) << "the pavement gains clearly, the house opposite slightly";
  EXPECT_GT(20 * pavement, lit);
}

TEST(SceneBuiltin, SkyscrapersAreFiveWithOneMirrorTower) {
  const auto model = builtin_scene({"skyscrapers", {}});
  const auto p = prepare(model, {});
  std::printf("skyscrapers: %zu triangles, %.0f m3\n", p.mesh.triangle_count(), p.report.volume_m3);
  EXPECT_NEAR(static_cast<double>(p.mesh.triangle_count()), historic_towers,
              count_tolerance * historic_towers);
  EXPECT_EQ(edges_without_partner(model), 0u);
  EXPECT_EQ(p.report.open_edges, 0u);
  expect_clean(p, "skyscrapers");
  std::set<std::string> with_mirror;
  std::array<Vec3, 6> middle{};
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    const auto name = object_of(p.mesh, t);
    if (p.mesh.file_materials[p.mesh.triangle_material[t].index()].mirror.value_or(0) > 0)
      with_mirror.insert(name);
    if (name.starts_with("tower_"))
      middle[static_cast<std::size_t>(name.back() - '0')] = centroid(p.mesh, t);
  }
  EXPECT_EQ(with_mirror, std::set<std::string>{"tower_1"});
  for (std::size_t k = 2; k <= 5; ++k)
    EXPECT_TRUE(middle[1].x < middle[k].x || middle[1].y < middle[k].y) << "tower_1 is front left";
}

TEST(SceneBuiltin, EverySceneIsCleanAndTagged) {
  for (const auto& name : builtin_scene_names()) {
    const auto model = builtin_scene({name, {}});
    const auto p = prepare(model, {});
    std::printf("%-20s %6zu triangles %3zu bodies %3zu sheets\n", name.c_str(),
                p.mesh.triangle_count(), p.report.closed_bodies, p.report.open_sheets);
    EXPECT_EQ(edges_without_partner(model), 0u) << name;
    EXPECT_EQ(p.report.open_sheets, 0u) << name;
    // Cubes that are sunk into their plane are the point of this scene.
    if (name != "geometric_accuracy") expect_clean(p, name);
    EXPECT_EQ(model.object_kinds.size(), model.object_names.size()) << name;
    EXPECT_FALSE(model.is_city_format);
    std::set<std::string> materials;
    for (const auto& material : model.materials) {
      EXPECT_TRUE(materials.insert(material.name).second) << name << ": " << material.name;
      EXPECT_LE(material.diffuse.value() + material.mirror.value(), 1) << name;
    }
  }
}

TEST(SceneBuiltin, RoomLooksInward) {
  const auto p = prepared({"room", {{"width", "6"}, {"depth", "3"}, {"height", "2.5"}}});
  const Vec3 eye = Vec3{0.5, 1.5, 1.2} - p.mesh.origin;
  for (int k = 0; k < 200; ++k) {  // directions on a spiral
    const double z = (2 * k + 1) / 200.0 - 1, angle = 2.4 * k, r = std::sqrt(1 - z * z);
    const Vec3 w{r * std::cos(angle), r * std::sin(angle), z};
    const auto hit = first_hit(p.mesh, eye, w);
    ASSERT_TRUE(hit) << "the room is closed";
    EXPECT_LT(dot(p.mesh.area_vector2(hit->triangle), w), 0);
    EXPECT_NE(p.mesh.triangle_surface[hit->triangle], Surface::floor);
  }
}

TEST(SceneBuiltin, EmissionPlaneIsItsOwnMirrorImage) {
  const auto p = prepared({"emission", {}});
  const auto key = [&](std::size_t t, double sign) {
    std::array<std::array<long long, 3>, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vec3 c = p.mesh.corner(t, k) + p.mesh.origin;
      corners[static_cast<std::size_t>(k)] = {std::llround(sign * c.x * 1e6),
                                              std::llround(c.y * 1e6), std::llround(c.z * 1e6)};
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::set<std::array<std::array<long long, 3>, 3>> left, right;
  std::size_t tiles = 0;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    if (material_of(p.mesh, t) == "emitter_tiled") ++tiles;
    if (p.mesh.triangle_surface[t] != Surface::ground) continue;
    left.insert(key(t, 1));
    right.insert(key(t, -1));
  }
  EXPECT_EQ(left, right);
  EXPECT_EQ(tiles, 200u);
}

/// Of a lamp only what sends light is meant, not its housing.
bool is_part(const Mesh& mesh, std::size_t t, const std::string& name) {
  return (name == "emitter" ? material_of(mesh, t) : object_of(mesh, t)) == name;
}

/// True if a point of one part's front sees a front point of the other.
bool sees(const Mesh& mesh, const std::string& from, const std::string& to) {
  constexpr int cuts = 3;  // sample points per edge of a triangle
  const auto points = [&](std::size_t t) {
    std::vector<Vec3> result;
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; i + j < cuts; ++j) {
        constexpr double inset = 0.02;
        const double a = inset + (1 - 3 * inset) * i / (cuts - 1);
        const double b = inset + (1 - 3 * inset) * j / (cuts - 1);
        result.push_back(mesh.corner(t, 0) + a * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
                         b * (mesh.corner(t, 2) - mesh.corner(t, 0)));
      }
    return result;
  };
  for (std::size_t s = 0; s < mesh.triangle_count(); ++s) {
    if (!is_part(mesh, s, from)) continue;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!is_part(mesh, t, to)) continue;
      for (const Vec3 x : points(s))
        for (const Vec3 y : points(t)) {
          const Vec3 w = y - x;
          if (dot(w, mesh.area_vector2(s)) <= 0 || dot(w, mesh.area_vector2(t)) >= 0) continue;
          const auto hit = first_hit(mesh, x, w);
          constexpr double nearly = 1 - 1e-9;
          if (!hit || hit->distance >= nearly) return true;
        }
    }
  }
  return false;
}

TEST(SceneBuiltin, ComplexPathsNeedThreeReflections) {
  const auto p = prepared({"complex_paths", {}});
  EXPECT_TRUE(sees(p.mesh, "emitter", "tray"));
  EXPECT_TRUE(sees(p.mesh, "tray", "wall"));
  EXPECT_TRUE(sees(p.mesh, "wall", "screen"));
  EXPECT_TRUE(sees(p.mesh, "screen", "cube"));
  for (const char* target : {"wall", "screen", "cube", "plane"})
    EXPECT_FALSE(sees(p.mesh, "emitter", target)) << target;
  EXPECT_FALSE(sees(p.mesh, "tray", "screen"));
  EXPECT_FALSE(sees(p.mesh, "tray", "cube"));
  EXPECT_FALSE(sees(p.mesh, "wall", "cube"));
}

TEST(SceneBuiltin, ParametersChangeTheScene) {
  EXPECT_EQ(builtin_parameters("street"), std::vector<std::string>{"house_3"});
  EXPECT_EQ(builtin_parameters("canyon"), (std::vector<std::string>{"height", "width", "length"}));
  EXPECT_TRUE(builtin_parameters("shadow").empty());
  const auto box = bounding_box(builtin_scene({"canyon", {{"height", "7.5"}}}).vertices);
  EXPECT_EQ(box.high.z, 7.5);
}

std::string builtin_refusal(const BuiltinRules& rules) {
  return test::refusal_of([&] { builtin_scene(rules); });
}

TEST(SceneBuiltin, CityHasTheTrianglesAskedFor) {
  const auto p = prepared({"city", {{"triangles", "4800"}}});
  EXPECT_EQ(p.mesh.triangle_count(), 4800u);
  EXPECT_EQ(p.report.closed_bodies, 200u) << "houses and their plots";
  expect_clean(p, "city");
  EXPECT_EQ(prepared({"city", {{"triangles", "100"}}}).mesh.triangle_count(), 96u);
  for (const char* wrong : {"47", "1e8", "100.5", "many"})
    EXPECT_NE(builtin_refusal({"city", {{"triangles", wrong}}}), "") << wrong;
}

TEST(SceneBuiltin, CityJsonReadsBackAsTheSameScene) {
  const test::WorkFolder folder;
  const auto path = folder / "city.city.json";
  for (const char* name : {"city", "canyon", "windows"}) {
    const auto model = builtin_scene({name, {}});
    write_cityjson(model, path);
    const auto again = prepare(read_scene_file(path, {}), {});
    const auto direct = prepare(model, {});
    EXPECT_EQ(again.mesh.triangle_count(), direct.mesh.triangle_count()) << name;
    EXPECT_EQ(again.report.closed_bodies, direct.report.closed_bodies) << name;
    // The file has micrometres: 1e-6 of a metre.
    EXPECT_NEAR(again.report.volume_m3, direct.report.volume_m3, 1e-6 * direct.report.volume_m3);
    for (const auto surface : {Surface::wall, Surface::roof, Surface::ground, Surface::floor}) {
      const auto s = static_cast<std::size_t>(surface);
      EXPECT_NEAR(again.report.area_m2[s], direct.report.area_m2[s],
                  1e-6 * direct.report.area_m2[s])
          << name << " " << surface_names[s];
    }
    std::set<std::string> materials;
    for (const auto& material : again.mesh.file_materials) materials.insert(material.name);
    for (const auto& material : model.materials) EXPECT_TRUE(materials.contains(material.name));
  }
  EXPECT_THROW(write_cityjson(builtin_scene({"room", {}}), folder / "missing/a.json"),
               MachineError);
}

TEST(SceneBuiltin, RefusesWithTheNearestName) {
  EXPECT_NE(builtin_refusal({"steet", {}}).find("'street'"), std::string::npos);
  EXPECT_NE(builtin_refusal({"street", {{"house3", "brick"}}}).find("'house_3'"),
            std::string::npos);
  EXPECT_NE(builtin_refusal({"street", {{"house_3", "glased"}}}).find("'glazed'"),
            std::string::npos);
  EXPECT_NE(builtin_refusal({"shadow", {{"height", "3"}}}), "");
  for (const char* wrong : {"0", "-1", "nan", "inf", "1e9", "3 m", ""})
    EXPECT_NE(builtin_refusal({"canyon", {{"height", wrong}}}), "") << wrong;
  EXPECT_NE(builtin_refusal({"box_on_plane", {{"plane", "5"}}}), "");
  const auto both = builtin_refusal({"canyon", {{"height", "x"}, {"hight", "3"}}});
  EXPECT_NE(both.find("'x'"), std::string::npos) << both;
  EXPECT_NE(both.find("'hight'"), std::string::npos) << both;
}

TEST(SceneBuiltin, ObjReadsBackAsTheSameScene) {
  const test::WorkFolder folder;
  const auto path = folder / "street.obj";
  const auto model = builtin_scene({"street", {{"house_3", "glazed"}}});
  write_obj(model, path);
  const auto again = prepare(read_scene_file(path, {}), {});
  const auto direct = prepare(model, {});
  EXPECT_EQ(again.mesh.triangle_count(), direct.mesh.triangle_count());
  EXPECT_EQ(again.mesh.object_names, direct.mesh.object_names);
  EXPECT_EQ(again.report.closed_bodies, direct.report.closed_bodies);
  // Sums of some 10 000 tetrahedra in another order of vertices: rounding only.
  EXPECT_NEAR(again.report.volume_m3, direct.report.volume_m3, 1e-9 * direct.report.volume_m3);
  for (const auto& material : again.mesh.file_materials)
    for (const auto& known : direct.mesh.file_materials)
      if (material.name == known.name) {
        // The reader takes the mean of three equal numbers: a rounding.
        EXPECT_DOUBLE_EQ(material.diffuse.value(), known.diffuse.value()) << material.name;
        EXPECT_DOUBLE_EQ(material.mirror.value_or(0), known.mirror.value_or(0)) << material.name;
      }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(files, 2u) << "nothing is left aside";
  EXPECT_THROW(write_obj(model, folder / "missing/a.obj"), MachineError);
}

TEST(SceneBuiltin, ObjIsWrittenWithoutWhatHasNoArea) {
  const test::WorkFolder folder;
  const auto path = folder / "square.obj";
  PolygonModel model;
  model.source = "square";
  model.object_names = {"square"};
  model.object_kinds = {""};
  model.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {1, 1e-8, 0}};
  const PolygonModel::Facts facts{.object = make_id<ObjectId>(0)};
  model.add_polygon({{0, 1, 2, 3}}, facts);
  EXPECT_TRUE(write_obj(model, path).empty());
  model.add_triangle(0, 1, 4, facts);  // a line
  model.add_triangle(0, 1, 1, facts);  // two corners
  model.add_triangle(0, 4, 5, facts);  // thin, but with area: stays
  const auto warnings = write_obj(model, path);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("polygons and triangles without area: 2;"), std::string::npos);
  EXPECT_EQ(read_scene_file(path, {}).polygon_count(), 3u);
  const auto refused = folder / "refused.obj";
  EXPECT_THROW(write_obj(model, refused, Repair::none), InputError);
  EXPECT_FALSE(std::filesystem::exists(refused)) << "nothing is written";
}

}  // namespace
}  // namespace sunload
