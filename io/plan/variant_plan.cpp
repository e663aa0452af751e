// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/variant_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/base/hash.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// Bytes to be hashed: numbers as they lie in memory, texts with their length.
class Digest {
 public:
  template <class Number>
  void add(const Number& number) {
    static_assert(std::is_trivially_copyable_v<Number>);
    const auto* bytes = reinterpret_cast<const char*>(&number);
    bytes_.append(bytes, sizeof(number));
  }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  std::string hex() const { return sha256(bytes_); }

 private:
  std::string bytes_;
};

void add_scene(Digest& digest, const Scene& scene) {
  const Mesh& mesh = scene.mesh;
  digest.add(mesh.origin);
  digest.add(mesh.vertices.size());
  for (const auto& v : mesh.vertices) digest.add(v);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    digest.add(mesh.triangles[t]);
    digest.add(mesh.triangle_object[t].value);
    digest.add(mesh.triangle_facade[t].value);
    digest.add(mesh.triangle_surface[t]);
    digest.add(mesh.triangle_sides[t]);
    digest.add(scene.material[t].value);
  }
  for (const auto& name : mesh.object_names) digest.add(name);
  for (const auto& f : mesh.facades) digest.add(f.name);
  for (const auto& m : scene.materials) {
    digest.add(m.name);
    digest.add(m.diffuse);
    digest.add(m.mirror);
    digest.add(m.emission_w_m2);
    for (const double property : {m.refractive_index, m.extinction_coefficient, m.thickness_m,
                                  m.absorption_per_m, m.glossy, m.glossy_exponent, m.transmittance})
      digest.add(property);
    digest.add(m.panes);
    if (m.normal_transmittance > 0) {
      digest.add(std::string("clear glass"));
      digest.add(m.normal_transmittance);
    }
    if (m.diffuse_in_band) digest.add(*m.diffuse_in_band);
  }
  const ParallelSources& sources = scene.parallel_sources;
  for (const auto& v : sources.mesh.vertices) digest.add(v);
  for (const auto& t : sources.mesh.triangles) digest.add(t);
  for (const double exitance : sources.exitance) digest.add(exitance);
  for (const auto& sensor : scene.sensors) {
    digest.add(sensor.position);
    digest.add(sensor.normal);
    digest.add(sensor.key);
  }
}

std::string times_text(const LightSeries& light) {
  Digest digest;
  for (const auto& i : light.intervals) {
    digest.add(i.when.begin);
    digest.add(i.when.end);
    digest.add(i.when.sun_time);
  }
  return digest.hex();
}

std::string content_hash(const VariantPlan& plan, const std::string& isa) {
  Digest digest;
  digest.add(numerics_version);
  digest.add(canonical_text(plan.study));
  digest.add(plan.study.output.standard_error == StandardErrors::instants);
  digest.add(isa);
  digest.add(times_text(plan.light));
  digest.add(plan.light.weather_sha256);
  digest.add(plan.built.site.latitude_deg);
  digest.add(plan.built.site.longitude_deg);
  digest.add(plan.built.site.elevation_m);
  digest.add(plan.built.site.north_deg);
  add_scene(digest, plan.built.scene);
  return digest.hex();
}

std::string pairing_id(const VariantPlan& plan) {
  const auto& s = plan.study.solver;
  Digest digest;
  digest.add(times_text(plan.light));
  digest.add(s.seed);
  for (const int n : {s.realizations, s.lines_per_patch, s.direct_samples}) digest.add(n);
  digest.add(s.transport);
  return digest.hex().substr(0, 16);
}

// Costs of one core [s], and sizes [bytes], fitted by scripts/scaling.py to a
// street of 20 000 … 260 000 patches (AVX-512): docs/scaling.md.
// Where surfaces emit, a line has a point on a bright surface beside it, three eighths of both go
// before, and three times an eighth is spent on what sees what (solver/gather/guide.cpp).
constexpr double rays_by_guide = 1 + 3 * 2 * 0.125 + 3 * 0.125;
// A line through 2^n triangles takes s_per_line + n · s_per_level: from a box on a plane to a city.
constexpr double s_per_line = 1.0e-7, s_per_level = 8.3e-9;
constexpr double share_that_meets = 0.6;  ///< of the lines; the others leave the scene
constexpr double s_per_direct_ray = 3.5e-8;
constexpr double s_per_mirror_ray = 1.3e-7;
constexpr double s_per_link_sun = 2.0e-10;    ///< one link of one sun and one bounce
constexpr double s_per_link_batch = 6.6e-10;  ///< one link of one batch's realizations
constexpr double s_per_patch_sun = 2.5e-7;
constexpr double s_per_value = 1.2e-8;  ///< one patch of one interval, stored
constexpr double s_per_patch = 2e-7;
constexpr double s_to_start = 0.1;
constexpr double facing_share = 0.62;    ///< of a sun's rays that need be cast
constexpr double mirrored_share = 0.11;  ///< of them again, where there are mirrors
constexpr double program_bytes = 3.6e7, bytes_per_line = 12.2, bytes_per_patch = 1400;
constexpr double double_bytes = 8, float_bytes = 4;
constexpr double s_per_sample = 6e-7;              ///< shot, with its deposit
constexpr double bytes_per_sample = 40;            ///< of one realization and iteration
constexpr double shooting_bytes_per_patch = 2700;  ///< columns in double
constexpr double columns_of_a_realization = 8;     ///< direct sun, in doubles
constexpr double arrays_of_realizations = 4;       ///< doubles of a patch and realization
constexpr double stored_bytes_per_value = 2.5;
constexpr double kept_bytes_per_line = 12.5;  ///< in the prepared file
constexpr double batch_bytes_per_patch = 80, result_bytes_per_patch = 175;

/// Lamps are given by their power, and watts of a lamp say nothing of its lumens.
void refuse_lamps_in_lux(const VariantPlan& plan) {
  if (plan.study.light.quantity == Quantity::irradiance || !has_lamps(plan)) return;
  throw InputError(plan.study.scene.where, "the scene has surfaces that emit light",
                   "their emission is in W/m2, and how much of it the eye sees is not known",
                   "set their emission_w_m2 to 0, or light.quantity to irradiance");
}

/// Samples of all shots: those of the first reflection, then (incremental) less by what is
/// absorbed, one at least of every patch. The light on a patch is taken as that on a sphere.
double estimated_samples(const VariantPlan& plan, double patches, double blocks,
                         int samples_per_patch) {
  const SolverStudy& s = plan.study.solver;
  const Scene& scene = plan.built.scene;
  double area = 0, reflecting = 0, emitted_w = 0, brightest_w_m2 = 0;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const Material& m = scene.materials[scene.material[t].index()];
    const double a = norm(scene.mesh.area_vector2(t)) / 2;
    area += a;
    reflecting += a * m.diffuse;
    emitted_w += a * m.emission_w_m2;
  }
  for (const auto& i : plan.light.intervals)
    brightest_w_m2 = std::max(brightest_w_m2, i.mean.dni / 4 + i.mean.dhi / 2);
  const double by_auto = patches * samples_per_patch, least = patches * s.realizations;
  const double raised = static_cast<double>(samples_per_patch) / s.lines_per_patch;
  const auto samples_of = [&](double power_w) {
    return s.power_per_sample_w ? raised * power_w / *s.power_per_sample_w : by_auto;
  };
  const double first = samples_of(reflecting * brightest_w_m2 + emitted_w);
  const double left = s.jacobi == Jacobi::regular ? 1 : reflecting / area;  // after a reflection
  double samples = 0, share = 1;
  for (int b = 0; b < s.bounces; ++b, share *= left) samples += std::max(least, first * share);
  return blocks * samples + (emitted_w > 0 ? samples_of(emitted_w) : 0);
}

}  // namespace

VariantPlan make_plan(const Study& study) {
  VariantPlan plan;
  plan.study = study;
  plan.isa = usable_isa(study.solver.isa);
  plan.built = build_scene(study);
  plan.light = light_series(study, plan.built.site);
  refuse_lamps_in_lux(plan);
  plan.content_hash = content_hash(plan, plan.isa);
  plan.pairing_id = pairing_id(plan);
  return plan;
}

std::string hash_with_isa(const VariantPlan& plan, const std::string& isa) {
  return content_hash(plan, isa);
}

SplitRules split_rules(const Study& study) {
  return {.max_edge_m = study.mesh.max_edge_m, .min_area_m2 = study.mesh.min_area_m2};
}

RefineRules refine_rules(const Study& study) {
  return {.oracle = study.mesh.oracle,
          .light_tolerance = study.mesh.light_tolerance,
          .light_threshold_m2 = study.mesh.light_threshold_m2,
          .form_factor_threshold = study.mesh.link_threshold,
          .t_vertices = study.mesh.t_vertices,
          .seed = study.solver.seed};
}

namespace {

/// The historic threshold F_eps is a form factor, the default one a number of lines.
double link_threshold(const Study& study) {
  const double threshold = study.mesh.link_threshold;
  return study.mesh.oracle == Oracle::historic ? threshold * study.solver.lines_per_patch
                                               : threshold;
}

}  // namespace

SolverRules solver_rules(const VariantPlan& plan) {
  const SolverStudy& s = plan.study.solver;
  return {.bounces = s.bounces,
          .unshot = s.unshot,
          .lines_per_patch = s.lines_per_patch,
          .lines_of_patch = {},
          .direct_samples = s.direct_samples,
          .realizations = s.realizations,
          .mirror_depth = s.mirror_depth,
          .link_threshold = link_threshold(plan.study),
          .seed = s.seed,
          .isa = plan.isa,
          .errors = plan.study.output.standard_error == StandardErrors::instants ? Errors::instants
                                                                                 : Errors::totals,
          .bands = s.bands,
          .transport = s.transport,
          .jacobi = s.jacobi,
          .power_per_sample_w = s.power_per_sample_w,
          .samples_per_patch = {},
          .by_source = false};
}

AccuracyGoal accuracy_goal(const Study& study) {
  const AccuracyStudy& accuracy = *study.solver.accuracy;
  return {accuracy.light_load_relative, study.solver.max_lines_per_patch,
          accuracy.irradiance_relative};
}

std::string goal_words(const AccuracyStudy& accuracy) {
  const auto load = accuracy.light_load_relative, irradiance = accuracy.irradiance_relative;
  std::string words = load ? fmt::format("{:.3g} %", 100 * *load) : "";
  if (load && irradiance) words += " and ";
  if (irradiance) words += fmt::format("{:.3g} % at every instant", 100 * *irradiance);
  return words;
}

bool has_lamps(const VariantPlan& plan) {
  const auto& materials = plan.built.scene.materials;
  return !plan.built.scene.parallel_sources.exitance.empty() ||
         std::any_of(materials.begin(), materials.end(),
                     [](const Material& m) { return m.emission_w_m2 > 0; });
}

std::size_t sun_count(const VariantPlan& plan, std::size_t batch) {
  const std::size_t begin = batch * plan.batch_suns();
  const std::size_t end = std::min(begin + plan.batch_suns(), plan.intervals());
  if (has_lamps(plan)) return end - begin;
  const auto at = [&](std::size_t k) {
    return plan.light.intervals.begin() + static_cast<std::ptrdiff_t>(k);
  };
  return static_cast<std::size_t>(std::count_if(
      at(begin), at(end), [](const LitInterval& i) { return i.mean.dni > 0 || i.mean.dhi > 0; }));
}

namespace {

/// Rays that a line is made of where mirrors send it on: of what it meets, as much as there is
/// mirror among the surfaces.
double rays_per_line(const Scene& scene, int mirror_depth) {
  double area = 0, mirrors = 0;
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const double of_triangle = norm(scene.mesh.area_vector2(t));
    area += of_triangle;
    if (scene.materials[scene.material[t].index()].mirror > 0) mirrors += of_triangle;
  }
  const double again = area > 0 ? share_that_meets * mirrors / area : 0;
  double rays = 1, of_depth = 1;
  for (int depth = 0; depth < mirror_depth; ++depth) rays += of_depth *= again;
  return rays;
}

/// Rays of the pilot that refines the mesh: for every element that it ever looks at, twice the
/// leaves, 16 points look along its suns and its other directions.
double refinement_rays(double patches, double lit) {
  constexpr double elements_per_leaf = 2, points = 16, most_suns = 32, other_directions = 16;
  return patches * elements_per_leaf * points * (std::min(lit, most_suns) + other_directions);
}

double line_seconds(const Scene& scene, int mirror_depth) {
  const auto triangles = static_cast<double>(std::max<std::size_t>(scene.mesh.triangle_count(), 1));
  return rays_per_line(scene, mirror_depth) * (s_per_line + s_per_level * std::log2(triangles));
}

}  // namespace

double pilot_memory_bytes(const VariantPlan& plan, std::size_t patches) {
  const bool of_instants = plan.study.solver.accuracy->irradiance_relative.has_value();
  const SolverRules rules = rules_of_pilot(solver_rules(plan), of_instants);
  const double R = rules.realizations, block = block_width * float_bytes;
  constexpr double sun_columns = 4;      // straight, circumsolar, by mirrors, all of them
  constexpr double spread_columns = 16;  // sums, squares, variances of three sources, in doubles
  double per_patch = rules.lines_per_patch * bytes_per_line + bytes_per_patch +
                     arrays_of_realizations * double_bytes * R;
  if (of_instants) per_patch += (sun_columns * R + spread_columns) * block;
  if (rules.transport == Transport::shoot)
    per_patch += shooting_bytes_per_patch + columns_of_a_realization * double_bytes * R;
  return program_bytes + static_cast<double>(patches) * per_patch;
}

WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches) {
  const SolverStudy& s = plan.study.solver;
  return estimate_work(plan, patches, {s.lines_per_patch, s.direct_samples, s.lines_per_patch});
}

WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches,
                           const SampleCounts& counts) {
  const SolverStudy& s = plan.study.solver;
  const auto& materials = plan.built.scene.materials;
  const auto has = [&](auto property) {
    return std::any_of(materials.begin(), materials.end(), property);
  };
  const bool mirrors = has([](const Material& m) { return sends_on(m); });
  const bool lamps = has_lamps(plan);
  const bool guided = s.transport == Transport::gather &&
                      has([](const Material& m) { return m.emission_w_m2 > 0; });
  // Total, direct, sky, reflected, and what the scene has besides.
  const double parts = 4.0 + (mirrors ? 1 : 0) + (lamps ? 1 : 0);
  const auto n = static_cast<double>(patches + plan.built.scene.sensors.size());
  const auto lit = static_cast<double>(lamps ? plan.intervals() : plan.light.lit_count());
  const auto batch = static_cast<double>(std::min(plan.batch_suns(), plan.intervals()));
  const auto batches = static_cast<double>(plan.batches());
  const double lines = n * counts.mean_lines(), links = lines * s.bounces;
  const double of_realizations = double_bytes * s.realizations;
  const bool is_rgb = s.bands == Bands::rgb;
  const double bands = is_rgb ? static_cast<double>(band_count) : 1;

  WorkEstimate work;
  work.patches = patches;
  work.line_rays = static_cast<std::uint64_t>(lines);
  const double rays = n * facing_share * lit * counts.direct_samples;
  work.direct_rays = static_cast<std::uint64_t>(rays);
  work.memory_bytes =
      program_bytes + lines * bytes_per_line +
      n * (bands * (batch * parts * float_bytes + arrays_of_realizations * of_realizations) +
           bytes_per_patch);
  // The sun's light of each realization, straight and circumsolar, and by mirrors.
  if (is_rgb)
    work.memory_bytes += n * s.realizations * block_width * float_bytes * (mirrors ? 3.0 : 2.0);
  if (s.transport == Transport::shoot) {
    const double blocks = batches * std::ceil(batch / static_cast<double>(block_width));
    work.samples =
        static_cast<std::uint64_t>(estimated_samples(plan, n, blocks, counts.samples_per_patch));
    const double per_shot = static_cast<double>(work.samples) / (blocks * std::max(1, s.bounces));
    work.memory_bytes +=
        n * (shooting_bytes_per_patch + of_realizations * columns_of_a_realization) +
        per_shot / s.realizations * bytes_per_sample;
  }
  work.disk_bytes = bands * n * lit * stored_bytes_per_value *
                        (parts + static_cast<double>(plan.study.output.series.size())) +
                    bands * n * batches * (of_realizations + batch_bytes_per_patch) +
                    bands * n * (of_realizations + result_bytes_per_patch) +
                    (plan.batches() > 1 ? lines * kept_bytes_per_line : 0);
  work.seconds =
      (s_to_start + n * s_per_patch +
       lines * (guided ? 1 + rays_by_guide : 1) * line_seconds(plan.built.scene, s.mirror_depth) +
       rays * s_per_direct_ray +
       (mirrors ? n * mirrored_share * lit * counts.direct_samples * s_per_mirror_ray : 0) +
       (s.transport == Transport::gather
            ? bands * (links * lit * s_per_link_sun + links * batches * s_per_link_batch)
            : static_cast<double>(work.samples) * s_per_sample) +
       (plan.study.mesh.oracle == Oracle::none ? 0 : refinement_rays(n, lit) * s_per_direct_ray) +
       bands *
           (n * lit * s_per_patch_sun + n * static_cast<double>(plan.intervals()) * s_per_value)) /
      thread_count();
  return work;
}

}  // namespace sunload
