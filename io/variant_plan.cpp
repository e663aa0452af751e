#include "io/variant_plan.h"

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

// Speeds of one core, measured on a street of 60 000 patches (AVX-512): good
// within a factor of two on other machines.
constexpr double lines_per_second = 3.5e6;
constexpr double direct_rays_per_second = 4e7;
constexpr double links_per_second = 4e8;      ///< one link of one sun
constexpr double prepare_patches_per_second = 1e6;
constexpr double stored_values_per_second = 5e7;
/// Of 256 lines about this share lead to distinct targets after pooling.
constexpr double pooled_share = 0.6;
constexpr double facing_share = 0.5;  ///< patches that face a sun
constexpr double link_bytes = 8;
/// Smooth series deflate to about half.
constexpr double stored_share = 0.5;

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

SolverRules solver_rules(const VariantPlan& plan) {
  const SolverStudy& s = plan.study.solver;
  return {.bounces = s.bounces,
          .unshot = s.unshot,
          .lines_per_patch = s.lines_per_patch,
          .direct_samples = s.direct_samples,
          .realizations = s.realizations,
          .mirror_depth = s.mirror_depth,
          .seed = s.seed,
          .isa = plan.isa,
          .errors = plan.study.output.standard_error == StandardErrors::instants
                        ? Errors::instants
                        : Errors::totals};
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
  const auto n = static_cast<double>(patches);
  const auto lit = static_cast<double>(plan.light.lit_count());
  const auto batch = static_cast<double>(std::min(plan.batch_suns(), plan.intervals()));
  const double lines = n * s.lines_per_patch;
  const double parts = static_cast<double>(part_count);
  const double cores = thread_count();
  WorkEstimate work;
  work.patches = patches;
  work.line_rays = static_cast<std::uint64_t>(lines);
  const double rays = n * facing_share * lit * s.direct_samples;
  work.direct_rays = static_cast<std::uint64_t>(rays);
  work.memory_bytes = 1e8 + lines * link_bytes * (1 + pooled_share) +
                      n * (batch * parts * 4 + 8.0 * block_width * 4 +
                           8.0 * (3 * s.realizations + 12) + 200);
  work.disk_bytes = n * static_cast<double>(plan.intervals()) * 4 * stored_share *
                    (parts + static_cast<double>(plan.study.output.series.size()));
  const double series_links = lines * pooled_share * lit * s.bounces;
  const double total_links = lines * s.bounces * static_cast<double>(plan.batches()) * block_width / 4;
  work.seconds = (lines / lines_per_second + rays / direct_rays_per_second +
                  (series_links + total_links) / links_per_second +
                  n / prepare_patches_per_second +
                  n * static_cast<double>(plan.intervals()) * parts / stored_values_per_second) /
                 cores;
  return work;
}

}  // namespace sunload
