#include "io/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "io/batch_file.h"
#include "io/batch_tally.h"
#include "io/machine.h"
#include "io/merge.h"
#include "io/result_file.h"
#include "io/variant_plan.h"
#include "solver/parallel.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

std::string folder_of(const StudyFile& file, const RunOptions& options) {
  return options.output.empty() ? file.variants.front().output.folder : options.output;
}

/// What is to be done with a variant whose result may be there already.
enum class Todo { compute, nothing };

Todo check_existing(const std::string& folder, const VariantPlan& plan, const RunOptions& options) {
  const std::string path = result_path(folder, plan.study);
  if (!fs::exists(path) || options.existing == Existing::overwrite) return Todo::compute;
  const std::string hash = ResultReader(path).text_attribute("study_sha256");
  if (hash != plan.content_hash)
    throw InputError({path}, "is the result of another state of the study",
                     "its content hash differs", "use --overwrite to replace it, or --output");
  if (options.existing == Existing::resume) return Todo::nothing;
  throw InputError({path}, "is there already, of this very study", "nothing is left to compute",
                   "use --resume to accept it, or --overwrite to compute it again");
}

/// Refuses work that cannot fit before it starts.
void check_limits(const std::string& folder, const WorkEstimate& work) {
  constexpr double gib = 1024.0 * 1024 * 1024;
  if (const double left = available_memory_bytes(); work.memory_bytes > left)
    throw MachineError(fmt::format(
        "too little memory: about {:.1f} GiB are needed for {} patches, {:.1f} GiB are available; "
        "use a larger mesh.max_edge_m, fewer lines_per_patch or a smaller batch_suns",
        work.memory_bytes / gib, work.patches, left / gib));
  if (const double left = free_disk_bytes(folder); work.disk_bytes > left)
    throw MachineError(fmt::format(
        "too little disk space for {}: about {:.1f} GiB are needed, {:.1f} GiB are free; "
        "choose another folder with --output, or fewer output.series",
        folder, work.disk_bytes / gib, left / gib));
}

std::string rays_text(const char* what, std::uint64_t rays, double seconds) {
  if (rays == 0 || seconds <= 0) return {};
  return fmt::format("  {:<14} {:8.2f} s  {:9.3g} rays  {:7.1f} million rays/s\n", what, seconds,
                     static_cast<double>(rays), static_cast<double>(rays) / seconds / 1e6);
}

void report_work(Progress& progress, const std::string& variant, const LightSolver& solver) {
  const WorkDone& w = solver.work();
  std::string text = fmt::format("{}: {} patches\n", variant, solver.hierarchy().patch_count());
  text += rays_text("lines", w.line_rays, w.lines_s);
  text += rays_text("direct sun", w.direct_rays, w.direct_s);
  text += rays_text("mirrored sun", w.mirror_rays, w.mirror_s);
  text += fmt::format("  {:<14} {:8.2f} s\n  {:<14} {:8.2f} s  peak memory {:.0f} MiB",
                      "sky and Jacobi", w.solve_s, "realizations", w.realizations_s,
                      peak_memory_bytes() / 1048576);
  progress.say(text);
}

/// Computes the batches of one variant that are missing.
class VariantRun {
 public:
  VariantRun(const std::string& folder, const VariantPlan& plan, Progress& progress)
      : folder_(folder), plan_(plan), progress_(progress) {}

  /// Computes and writes; returns the frozen mesh for the merge.
  const Hierarchy& compute() {
    const auto missing = missing_batches(folder_, plan_);
    for (const auto& reason : missing.reasons)
      progress_.say("warning: " + reason + "; it is computed again");
    if (missing.numbers.empty()) return geometry();
    if (missing.numbers.size() < plan_.batches())
      progress_.say(fmt::format("{}: {} of {} batches are there already", plan_.study.variant,
                                plan_.batches() - missing.numbers.size(), plan_.batches()));
    make_writable_folder(work_folder(folder_, plan_));
    solver_ = std::make_unique<LightSolver>(plan_.built.scene, split_rules(plan_.study),
                                            solver_rules(plan_), progress_);
    for (std::size_t n = 0; n < missing.numbers.size(); ++n) {
      progress_.set_batches(n, missing.numbers.size());
      compute_batch(missing.numbers[n]);
    }
    report_work(progress_, plan_.study.variant, *solver_);
    return solver_->hierarchy();
  }

 private:
  const Hierarchy& geometry() {
    if (!hierarchy_)
      hierarchy_ = std::make_unique<Hierarchy>(plan_.built.scene, split_rules(plan_.study));
    return *hierarchy_;
  }

  void compute_batch(std::size_t batch) {
    const std::size_t first = batch * plan_.batch_suns();
    const std::size_t count = std::min(plan_.batch_suns(), plan_.intervals() - first);
    std::vector<SunLight> light(count);
    parallel_for(count, [&](std::size_t k) {
      light[k] = sun_light(plan_.light.intervals[first + k], static_cast<std::uint32_t>(first + k),
                           plan_.study.light, solver_->sky_grid());
    });
    const BatchTally tally = solver_->solve(light, progress_);
    WorkDone work = solver_->work();
    work -= reported_;
    reported_ = solver_->work();
    BatchWriter writer({.content_hash = plan_.content_hash,
                        .variant = plan_.study.variant,
                        .isa = plan_.isa,
                        .batch = batch,
                        .first_interval = first,
                        .interval_count = count,
                        .chunk_intervals = plan_.batch_suns(),
                        .compression = plan_.study.output.compression});
    add_tally(writer, tally, *solver_, plan_.built.scene.mesh, work);
    writer.write(batch_path(folder_, plan_, batch));
  }

  const std::string& folder_;
  const VariantPlan& plan_;
  Progress& progress_;
  std::unique_ptr<LightSolver> solver_;
  std::unique_ptr<Hierarchy> hierarchy_;
  WorkDone reported_;
};

void print_warnings(Progress& progress, const VariantPlan& plan) {
  for (const auto& list : {plan.built.warnings, plan.light.notes})
    for (const auto& line : list) progress.say(plan.study.variant + ": warning: " + line);
}

void use_threads(const RunOptions& options) {
  set_thread_count(options.threads > 0 ? options.threads : permitted_processors());
}

}  // namespace

std::vector<Study> chosen_variants(const StudyFile& file, const RunOptions& options) {
  if (options.variants.empty()) return file.variants;
  std::vector<Study> chosen;
  Problems problems;
  for (const auto& name : options.variants) {
    const auto found = std::find_if(file.variants.begin(), file.variants.end(),
                                    [&](const Study& s) { return s.variant == name; });
    if (found != file.variants.end()) {
      chosen.push_back(*found);
      continue;
    }
    std::string names;
    for (const auto& v : file.variants) names += (names.empty() ? "" : ", ") + v.variant;
    problems.add({file.path}, "no variant '" + name + "'", {}, "the study has: " + names);
  }
  problems.throw_if_any();
  return chosen;
}

int run_study(const std::string& path, const RunOptions& options) {
  use_threads(options);
  const StudyFile file = read_study(path);
  const std::string folder = folder_of(file, options);
  Progress progress(options.progress, options.time_limit_min);
  for (const auto& warning : file.warnings) progress.say("warning: " + warning);
  // Every variant is checked before the first one is computed.
  std::vector<VariantPlan> plans;
  Problems problems;
  for (const auto& study : chosen_variants(file, options)) {
    try {
      VariantPlan plan = make_plan(study);
      if (check_existing(folder, plan, options) == Todo::nothing) {
        progress.say(study.variant + ": finished already, nothing to do");
        continue;
      }
      plans.push_back(std::move(plan));
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  make_writable_folder(folder + "/" + file.name);
  for (auto& plan : plans) {
    progress.begin_variant(plan.study.variant);
    print_warnings(progress, plan);
    const Hierarchy mesh(plan.built.scene, split_rules(plan.study));
    check_limits(folder, estimate_work(plan, mesh.patch_count()));
    VariantRun run(folder, plan, progress);
    const Hierarchy& hierarchy = run.compute();
    merge_variant(folder, plan, file, hierarchy);
    if (options.batches == Batches::remove) remove_batches(folder, plan);
    progress.say(plan.study.variant + ": wrote " + result_path(folder, plan.study));
  }
  return exit_code::done;
}

int merge_study(const std::string& path, const RunOptions& options) {
  use_threads(options);
  const StudyFile file = read_study(path);
  const std::string folder = folder_of(file, options);
  int code = exit_code::done;
  for (const auto& study : chosen_variants(file, options)) {
    const VariantPlan plan = make_plan(study);
    const std::string result = result_path(folder, plan.study);
    if (fs::exists(result) &&
        ResultReader(result).text_attribute("study_sha256") == plan.content_hash) {
      fmt::print(stderr, "{}: merged already, nothing to do\n", study.variant);
      continue;
    }
    const auto missing = missing_batches(folder, plan);
    for (const auto& reason : missing.reasons) fmt::print(stderr, "{}\n", reason);
    if (!missing.numbers.empty()) {
      fmt::print(stderr, "{}: {} of {} batches are missing:", study.variant,
                 missing.numbers.size(), plan.batches());
      for (const auto b : missing.numbers) fmt::print(stderr, " {}", b);
      fmt::print(stderr, "; run the study again with --resume\n");
      code = exit_code::unfinished;
      continue;
    }
    if (fs::exists(result) && options.existing != Existing::overwrite)
      throw InputError({result}, "is the result of another state of the study",
                       "its content hash differs", "use --overwrite to replace it");
    const Hierarchy hierarchy(plan.built.scene, split_rules(plan.study));
    merge_variant(folder, plan, file, hierarchy);
    if (options.batches == Batches::remove) remove_batches(folder, plan);
    fmt::print(stderr, "{}: wrote {}\n", study.variant, result);
  }
  return code;
}

}  // namespace sunload
