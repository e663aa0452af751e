#include "io/variant_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/batch_file.h"
#include "io/batch_tally.h"
#include "io/machine.h"
#include "io/merge.h"
#include "io/mpi_world.h"
#include "io/prepared_file.h"
#include "solver/parallel.h"

namespace sunload {

namespace {

std::string rays_text(const char* what, std::uint64_t rays, double seconds) {
  if (rays == 0 || seconds <= 0) return {};
  return fmt::format("  {:<14} {:8.2f} s  {:9.3g} rays  {:7.1f} million rays/s\n", what, seconds,
                     static_cast<double>(rays), static_cast<double>(rays) / seconds / 1e6);
}

}  // namespace

VariantRun::VariantRun(const std::string& folder, const VariantPlan& plan,
                       std::shared_ptr<const Hierarchy> mesh, Progress& progress)
    : folder_(folder), plan_(plan), mesh_(std::move(mesh)), progress_(progress) {}

void VariantRun::compute(UnitQueue& units, MpiWorld* world) {
  make_writable_folder(work_folder(folder_, plan_));
  const bool others_work_too = units.share() < plan_.batches() || world != nullptr;
  std::size_t seen = 0;
  const std::size_t share = units.share();
  // Ranks meet where the first of them traces the lines, before any takes a batch.
  if (world && world->any(!batches_not_there(folder_, plan_).empty())) make_solver(true, world);
  for (auto batch = units.next(); batch; batch = units.next(), ++seen) {
    if (is_finished(*batch)) continue;
    if (!solver_) make_solver(others_work_too, world);
    progress_.set_batches(world ? *batch : seen, share);
    compute_batch(*batch);
  }
  if (solver_) report_work();
}

bool VariantRun::is_finished(std::size_t batch) {
  const auto check = check_batch(batch_path(folder_, plan_, batch), plan_.content_hash, batch);
  if (check.exists && !check.valid)
    progress_.say("warning: " + check.reason + "; it is computed again");
  return check.valid;
}

void VariantRun::make_solver(bool others_work_too, MpiWorld* world) {
  const auto build = [&](std::optional<Lines> ready) {
    solver_ = std::make_unique<LightSolver>(plan_.built.scene, mesh_, solver_rules(plan_),
                                            progress_, std::move(ready));
    open_share_ = open_shares(solver_->sky_grid(), plan_.built.site.horizon,
                              scene_from_enu(plan_.built.site));
  };
  if (!others_work_too) return build({});
  const std::string path = prepared_path(folder_, plan_);
  const auto trace_and_share = [&] {
    build(read_prepared(path, plan_.content_hash));
    if (solver_->work().line_rays > 0) write_prepared(path, plan_.content_hash, solver_->lines());
  };
  if (!world) return trace_and_share();
  if (world->is_first()) trace_and_share();
  world->wait_for_all();
  if (!world->is_first()) build(read_prepared(path, plan_.content_hash));
}

void VariantRun::compute_batch(std::size_t batch) {
  const std::size_t first = batch * plan_.batch_suns();
  const std::size_t count = std::min(plan_.batch_suns(), plan_.intervals() - first);
  std::vector<SunLight> light(count);
  parallel_for(count, [&](std::size_t k) {
    light[k] = sun_light(plan_.light.intervals[first + k], static_cast<std::uint32_t>(first + k),
                         plan_.study.light, solver_->sky_grid(), open_share_);
    light[k].disk_half_angle = disk_half_angle(
        plan_.study.sun.disk, plan_.light.intervals[first + k].when.sun.distance_au);
  });
  const BatchTally tally = solver_->solve(light, progress_);
  WorkDone work = solver_->work();
  work -= written_;
  BatchWriter writer({.content_hash = plan_.content_hash,
                      .variant = plan_.study.variant,
                      .isa = plan_.isa,
                      .batch = batch,
                      .first_interval = first,
                      .interval_count = count,
                      .chunk_intervals = plan_.batch_suns(),
                      .compression = plan_.study.output.compression});
  add_tally(writer, tally, *solver_, plan_.built.scene.mesh, work);
  // Another process that failed may have removed the folder, which was empty until now.
  make_writable_folder(work_folder(folder_, plan_));
  writer.write(batch_path(folder_, plan_, batch));
  written_ = solver_->work();
}

void VariantRun::report_work() const {
  constexpr double mib = 1024.0 * 1024;
  const WorkDone& w = solver_->work();
  std::string text = fmt::format("{}: {} patches\n", plan_.study.variant,
                                 solver_->hierarchy().patch_count());
  text += rays_text("lines", w.line_rays, w.lines_s);
  text += rays_text("direct sun", w.direct_rays, w.direct_s);
  text += rays_text("mirrored sun", w.mirror_rays, w.mirror_s);
  if (w.mirror_beams + w.mirror_shots > 0)
    text += fmt::format("  {:<14} {} beams by image directions, {} arrivals by shooting\n", "",
                        w.mirror_beams, w.mirror_shots);
  text += rays_text("sensors", w.sensor_rays, w.sensors_s);
  text += fmt::format("  {:<14} {:8.2f} s\n  {:<14} {:8.2f} s  peak memory {:.0f} MiB",
                      "sky and Jacobi", w.solve_s, "realizations", w.realizations_s,
                      peak_memory_bytes() / mib);
  progress_.say(text);
}

}  // namespace sunload
