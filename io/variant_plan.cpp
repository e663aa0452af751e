#include "io/variant_plan.h"

#include <algorithm>
#include <cstring>

#include "io/hash.h"
#include "solver/parallel.h"

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
  }
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
  return digest.hex().substr(0, 16);
}

// Costs of one core [s], and sizes [bytes], fitted by scripts/scaling.py to a
// street of 20 000 … 260 000 patches (AVX-512): docs/scaling.md.
constexpr double s_per_line = 3.6e-7;
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
constexpr double arrays_of_realizations = 3;  ///< doubles of a patch and realization
constexpr double stored_bytes_per_value = 2.5;
constexpr double batch_bytes_per_patch = 80, result_bytes_per_patch = 175;

}  // namespace

VariantPlan make_plan(const Study& study) {
  VariantPlan plan;
  plan.study = study;
  plan.isa = usable_isa(study.solver.isa);
  plan.built = build_scene(study);
  plan.light = light_series(study, plan.built.site);
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
          .direct_samples = s.direct_samples,
          .realizations = s.realizations,
          .mirror_depth = s.mirror_depth,
          .link_threshold = link_threshold(plan.study),
          .seed = s.seed,
          .isa = plan.isa,
          .errors = plan.study.output.standard_error == StandardErrors::instants ? Errors::instants
                                                                                 : Errors::totals};
}

AccuracyGoal accuracy_goal(const Study& study) {
  return {study.solver.accuracy->light_load_relative, study.solver.max_lines_per_patch};
}

std::string result_path(const std::string& folder, const Study& study) {
  return folder + "/" + study.name + "/" + study.variant + ".h5";
}

std::string work_folder(const std::string& folder, const VariantPlan& plan) {
  return folder + "/" + plan.study.name + "/.work/" + plan.study.variant + "-" + plan.content_hash;
}

std::string prepared_path(const std::string& folder, const VariantPlan& plan) {
  return work_folder(folder, plan) + "/prepared";
}

std::string batch_path(const std::string& folder, const VariantPlan& plan, std::size_t batch) {
  std::string number = std::to_string(batch);
  number.insert(0, number.size() < 6 ? 6 - number.size() : 0, '0');
  return work_folder(folder, plan) + "/" + number + ".batch";
}

WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches) {
  const SolverStudy& s = plan.study.solver;
  return estimate_work(plan, patches, {s.lines_per_patch, s.direct_samples, 0});
}

WorkEstimate estimate_work(const VariantPlan& plan, std::size_t patches,
                           const SampleCounts& counts) {
  const SolverStudy& s = plan.study.solver;
  const auto& materials = plan.built.scene.materials;
  const auto has = [&](auto property) {
    return std::any_of(materials.begin(), materials.end(), property);
  };
  const bool mirrors = has([](const Material& m) { return m.mirror > 0; });
  const bool lamps = has([](const Material& m) { return m.emission_w_m2 > 0; });
  // Total, direct, sky, reflected, and what the scene has besides.
  const double parts = 4.0 + (mirrors ? 1 : 0) + (lamps ? 1 : 0);
  const auto n = static_cast<double>(patches + plan.built.scene.sensors.size());
  const auto lit = static_cast<double>(lamps ? plan.intervals() : plan.light.lit_count());
  const auto batch = static_cast<double>(std::min(plan.batch_suns(), plan.intervals()));
  const auto batches = static_cast<double>(plan.batches());
  const double lines = n * counts.lines_per_patch, links = lines * s.bounces;
  const double of_realizations = double_bytes * s.realizations;

  WorkEstimate work;
  work.patches = patches;
  work.line_rays = static_cast<std::uint64_t>(lines);
  const double rays = n * facing_share * lit * counts.direct_samples;
  work.direct_rays = static_cast<std::uint64_t>(rays);
  work.memory_bytes = program_bytes + lines * bytes_per_line +
                      n * (batch * parts * float_bytes + arrays_of_realizations * of_realizations +
                           bytes_per_patch);
  work.disk_bytes = n * lit * stored_bytes_per_value *
                        (parts + static_cast<double>(plan.study.output.series.size())) +
                    n * batches * (of_realizations + batch_bytes_per_patch) +
                    n * (of_realizations + result_bytes_per_patch);
  work.seconds =
      (s_to_start + n * s_per_patch + lines * s_per_line + rays * s_per_direct_ray +
       (mirrors ? n * mirrored_share * lit * counts.direct_samples * s_per_mirror_ray : 0) +
       links * lit * s_per_link_sun + links * batches * s_per_link_batch +
       n * lit * s_per_patch_sun + n * static_cast<double>(plan.intervals()) * s_per_value) /
      thread_count();
  return work;
}

}  // namespace sunload
