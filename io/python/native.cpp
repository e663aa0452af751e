// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The module `_native` of the Python package: arrays of NumPy to and from `solve_arrays`. The only
// file that knows pybind11. Who imports it is io/python/sunload/arrays.py, which has checked all
// that a user can get wrong.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <utility>

#include "geo/base/check.h"
#include "io/python/array_solver.h"

namespace py = pybind11;

namespace sunload {

namespace {

constexpr int exact = py::array::c_style | py::array::forcecast;
using Doubles = py::array_t<double, exact>;
using Integers = py::array_t<std::int32_t, exact>;

template <class T>
T value(const py::dict& map, const char* key) {
  return map[key].cast<T>();
}

Smooth smooth_of(const py::dict& material) {
  const auto kind = value<std::string>(material, "kind");
  if (kind == "panes")
    return Panes{.refractive_index = value<double>(material, "refractive_index"),
                 .thickness_m = value<double>(material, "thickness_m"),
                 .absorption_per_m = value<double>(material, "absorption_per_m"),
                 .count = value<int>(material, "panes")};
  if (kind == "metal")
    return Metal{.refractive_index = value<double>(material, "refractive_index"),
                 .extinction_coefficient = value<double>(material, "extinction_coefficient")};
  if (kind == "clear glass")
    return ClearGlass{.normal_transmittance = value<double>(material, "normal_transmittance")};
  return ConstantShares{};
}

Material material_of(const py::dict& material) {
  return {.name = value<std::string>(material, "name"),
          .diffuse = value<double>(material, "diffuse"),
          .mirror = value<double>(material, "mirror"),
          .emission_w_m2 = value<double>(material, "emission_w_m2"),
          .smooth = smooth_of(material),
          .glossy = value<double>(material, "glossy"),
          .glossy_exponent = value<double>(material, "glossy_exponent"),
          .transmittance = value<double>(material, "transmittance")};
}

/// vertices [V, 3], triangles [T, 3], triangle_material [T], materials.
ArrayScene scene_of(const py::dict& arrays) {
  ArrayScene scene;
  const auto vertices = value<Doubles>(arrays, "vertices");
  for (py::ssize_t v = 0; v < vertices.shape(0); ++v)
    scene.vertices.push_back({vertices.at(v, 0), vertices.at(v, 1), vertices.at(v, 2)});
  const auto triangles = value<Integers>(arrays, "triangles");
  for (py::ssize_t t = 0; t < triangles.shape(0); ++t)
    scene.triangles.push_back({triangles.at(t, 0), triangles.at(t, 1), triangles.at(t, 2)});
  const auto material = value<Integers>(arrays, "triangle_material");
  scene.material.assign(material.data(), material.data() + material.size());
  for (const auto& item : value<py::list>(arrays, "materials")) {
    const auto written = item.cast<py::dict>();
    scene.materials.push_back(material_of(written));
    scene.sides.push_back(value<std::string>(written, "sides") == "two" ? Sides::two : Sides::one);
  }
  return scene;
}

SkyModel model_of(const std::string& word) {
  if (word == "uniform") return SkyModel::uniform;
  if (word == "cie_overcast") return SkyModel::cie_overcast;
  if (word == "cie_clear") return SkyModel::cie_clear;
  if (word == "cie_general") return SkyModel::cie_general;
  if (word == "preetham") return SkyModel::preetham;
  SUNLOAD_EXPECT(word == "perez", "a sky's model");
  return SkyModel::perez;
}

/// None for the cells of the solver's own grid.
std::optional<Subdivision> subdivision_of(py::ssize_t patches) {
  for (const auto subdivision :
       {Subdivision::tregenza, Subdivision::reinhart_mf2, Subdivision::reinhart_mf4})
    if (sky_patches(subdivision).size() == static_cast<std::size_t>(patches)) return subdivision;
  return {};
}

/// azimuth_deg, elevation_deg, dni, dhi, hours [K]; direction [K, 3] or None; radiance [K, n] or
/// None; sky, sky_type, turbidity, extraterrestrial_w_m2, far_ground_albedo.
ArrayLight light_of(const py::dict& arrays) {
  ArrayLight light;
  const auto azimuth = value<Doubles>(arrays, "azimuth_deg");
  const auto elevation = value<Doubles>(arrays, "elevation_deg");
  const auto dni = value<Doubles>(arrays, "dni"), dhi = value<Doubles>(arrays, "dhi");
  const auto hours = value<Doubles>(arrays, "hours");
  for (py::ssize_t k = 0; k < azimuth.shape(0); ++k)
    light.suns.push_back({.direction = enu_direction({azimuth.at(k), elevation.at(k)}),
                          .elevation_deg = elevation.at(k),
                          .dni = dni.at(k),
                          .dhi = dhi.at(k),
                          .hours = hours.at(k)});
  if (!arrays["direction"].is_none()) {
    const auto direction = value<Doubles>(arrays, "direction");
    for (std::size_t k = 0; k < light.suns.size(); ++k) {
      const auto row = static_cast<py::ssize_t>(k);
      light.suns[k].direction = {direction.at(row, 0), direction.at(row, 1), direction.at(row, 2)};
    }
  }
  light.sky = {.model = model_of(value<std::string>(arrays, "sky")),
               .extraterrestrial_normal = value<double>(arrays, "extraterrestrial_w_m2"),
               .cie_type = value<int>(arrays, "sky_type"),
               .turbidity = value<double>(arrays, "turbidity")};
  light.far_ground_albedo = value<double>(arrays, "far_ground_albedo");
  if (arrays["radiance"].is_none()) return light;
  const auto radiance = value<Doubles>(arrays, "radiance");
  light.radiance.assign(radiance.data(), radiance.data() + radiance.size());
  light.subdivision = subdivision_of(radiance.shape(1));
  return light;
}

ArrayRules rules_of(const py::dict& rules) {
  ArrayRules all;
  constexpr double link_threshold = 0.5;  // as of a study's mesh
  all.max_edge_m = value<double>(rules, "max_edge_m");
  all.threads = value<int>(rules, "threads");
  all.solver.bounces = value<int>(rules, "bounces");
  all.solver.lines_per_patch = value<int>(rules, "lines");
  all.solver.direct_samples = value<int>(rules, "samples");
  all.solver.realizations = value<int>(rules, "realizations");
  all.solver.link_threshold = link_threshold;
  all.solver.seed = value<std::uint64_t>(rules, "seed");
  all.solver.year = Year::automatic;
  if (value<std::string>(rules, "standard_error") == "instants")
    all.solver.errors = Errors::instants;
  return all;
}

/// Takes the values over, without a copy.
template <class Values>
py::array array_of(Values values, const std::vector<py::ssize_t>& shape) {
  auto kept = std::make_unique<Values>(std::move(values));
  const auto* data = kept->data();
  const py::capsule owner(kept.release(), [](void* p) { delete static_cast<Values*>(p); });
  return py::array_t<typename Values::value_type>(shape, data, owner);
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Vec3 p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}

void put_patches(const ArrayResult& result, py::dict& arrays) {
  const Hierarchy& mesh = *result.mesh;
  const auto N = static_cast<py::ssize_t>(mesh.patch_count());
  std::vector<Vec3> position = mesh.vertices(), normal, centroid;
  for (Vec3& p : position) p += result.origin;
  std::vector<std::int32_t> corners, triangle;
  std::vector<std::int8_t> side;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches()[i];
    corners.insert(corners.end(), patch.vertices.begin(), patch.vertices.end());
    triangle.push_back(patch.triangle);
    side.push_back(static_cast<std::int8_t>(patch.side));
    normal.push_back(mesh.normal(i));
    centroid.push_back(mesh.centroid(i) + result.origin);
  }
  const auto vertices = static_cast<py::ssize_t>(position.size());
  arrays["vertex_position"] = array_of(flat(position), {vertices, 3});
  arrays["patch_vertices"] = array_of(std::move(corners), {N, 3});
  arrays["patch_area"] = array_of(std::vector<double>(mesh.area()), {N});
  arrays["patch_centroid"] = array_of(flat(centroid), {N, 3});
  arrays["patch_normal"] = array_of(flat(normal), {N, 3});
  arrays["patch_input_triangle"] = array_of(std::move(triangle), {N});
  arrays["patch_side"] = array_of(std::move(side), {N});
}

/// By the names of result files, numbers being attributes; what the scene cannot have is left out.
py::dict arrays_of(ArrayResult result, std::size_t suns) {
  py::dict arrays;
  put_patches(result, arrays);
  const auto K = static_cast<py::ssize_t>(suns);
  const auto N = static_cast<py::ssize_t>(result.mesh->patch_count());
  const auto put = [&](const std::string& name, auto& values,
                       const std::vector<py::ssize_t>& shape) {
    if (!values.empty()) arrays[name.c_str()] = array_of(std::move(values), shape);
  };
  for (std::size_t p = 0; p < part_count; ++p) {
    const bool is_total = static_cast<Part>(p) == Part::total;
    const std::string part = is_total ? std::string() : std::string("_") + part_names[p];
    put("irradiance" + part, result.irradiance[p], {K, N});
    put("light_load" + part, result.light_load.mean[p], {N});
    put("light_load" + part + "_se", result.light_load.standard_error[p], {N});
  }
  put("irradiance_se", result.irradiance_se, {K, N});
  put("sun_hours", result.sun_hours, {N});
  if (const auto& reduction = result.reduction) {
    arrays["year_skies"] = reduction->skies;
    arrays["year_suns"] = reduction->suns;
    arrays["reduction_error_w_m2"] = reduction->error_w_m2;
  }
  return arrays;
}

/// Runs `work` on a thread of its own, while this one lets other Python threads run and looks for
/// signals: Ctrl-C sets `stop`, and its exception is raised once the work has ended.
template <class Work>
auto beside_python(std::atomic<bool>& stop, const Work& work) {
  auto done = std::async(std::launch::async, work);
  constexpr std::chrono::milliseconds patience{50};
  std::optional<py::error_already_set> raised;
  for (bool is_ready = false; !is_ready;) {
    {
      const py::gil_scoped_release others_run;
      is_ready = done.wait_for(patience) == std::future_status::ready;
    }
    if (!raised && PyErr_CheckSignals() != 0) {
      raised.emplace();
      stop = true;
    }
  }
  if (raised) throw py::error_already_set(*raised);
  return done.get();
}

py::dict solve_numpy(const py::dict& scene, const py::dict& light, const py::dict& rules) {
  const ArrayScene array_scene = scene_of(scene);
  const ArrayLight array_light = light_of(light);
  const ArrayRules array_rules = rules_of(rules);
  std::atomic<bool> stop = false;
  return arrays_of(beside_python(stop,
                                 [&] {
                                   return solve_arrays(array_scene, array_light, array_rules,
                                                       [&] { return stop.load(); });
                                 }),
                   array_light.suns.size());
}

}  // namespace

}  // namespace sunload

PYBIND11_MODULE(_native, module) {
  py::register_exception_translator([](std::exception_ptr problem) {
    try {
      std::rethrow_exception(std::move(problem));
    } catch (const sunload::InputError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  module.attr("version") = SUNLOAD_VERSION;
  module.def("solve", &sunload::solve_numpy, "See sunload.solve.");
}
