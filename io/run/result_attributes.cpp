// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/result_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <utility>
#include <variant>

#include "io/base/version.h"
#include "io/batch/batch_tally.h"
#include "io/plan/content_hash.h"
#include "io/plan/selection.h"
#include "io/run/measure_merge.h"
#include "io/run/stored_series.h"
#include "io/study/words.h"
#include "solver/accuracy.h"

namespace sunload {

namespace {

/// Largest relative difference that the lines' reuse makes, as a share of the
/// scene's energy: (mean over realizations - pooled) / (R - 1) (docs/developer/method.md,
/// Gathering).
double reuse_bias(const Totals& totals, const ResultGeometry& geometry, std::size_t realizations) {
  const auto& pooled = totals[sum_name(Part::total)];
  const auto& rows = totals[batch_array::exposure];
  const std::size_t N = pooled.size();
  double of_pooled = 0, of_rows = 0;
  for (std::size_t i = 0; i < N; ++i) {
    of_pooled += geometry.patch_area[i] * pooled[i];
    for (std::size_t r = 0; r < realizations; ++r)
      of_rows += geometry.patch_area[i] * rows[r * N + i] / static_cast<double>(realizations);
  }
  if (of_pooled <= 0 || realizations < 2) return 0;
  return (of_rows - of_pooled) / of_pooled / static_cast<double>(realizations - 1);
}

/// The part of the pooled ledger's residual that the lines' reuse makes [kWh]:
/// a patch that sees more sky sends more, and by the same lines more of it is
/// seen to escape. It falls as 1/lines, so that realizations show R times of it.
double residual_reuse_bias_kwh(const Totals& totals, std::size_t realizations) {
  const auto& rows = totals[batch_array::ledger];
  double of_rows = 0;
  for (std::size_t r = 0; r < realizations; ++r)
    of_rows += rows[r * ledger_line_count + residual_line] / static_cast<double>(realizations);
  const double of_pooled = totals[batch_array::energy][1];
  return (of_rows - of_pooled) / static_cast<double>(realizations - 1) * kwh_per_joule;
}

/// Sensors of which more than half the lines meet backs see a body from within.
std::string buried_sensors(const Totals& totals, const ResultGeometry& geometry) {
  if (!totals.has(batch_array::sensor_backs)) return {};
  const auto& backs = totals[batch_array::sensor_backs];
  std::size_t count = 0, first = 0;
  for (std::size_t s = backs.size(); s-- > 0;)
    if (backs[s] > 0.5) {
      ++count;
      first = s;
    }
  if (count == 0) return {};
  const Vec3 at = geometry.sensor_position[first] + geometry.origin;
  return fmt::format(
      "{} of {} sensors see mostly backs of surfaces, from where no light comes, the first of them "
      "sensor {} at ({:.10g}, {:.10g}, {:.10g}); they lie within bodies or look into them",
      count, backs.size(), first, at.x, at.y, at.z);
}

/// Patches of buildings that neither sky nor anything lit sees, where there is a sky: faces within
/// houses that are not closed. Some are in every model.
std::string dark_faces(const Totals& totals, const ResultGeometry& geometry) {
  constexpr double worth_a_word = 0.02;  // of the area of all that is no ground
  const auto &load = totals[sum_name(Part::total)], &sky = totals[sum_name(Part::sky)];
  if (std::ranges::none_of(sky, [](double exposure) { return exposure > 0; })) return {};
  std::vector<double> of_object(geometry.object_name.size(), 0);
  double dark = 0, all = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (static_cast<Surface>(geometry.patch_surface[i]) == Surface::ground) continue;
    all += geometry.patch_area[i];
    if (load[i] > 0) continue;
    dark += geometry.patch_area[i];
    if (const auto object = geometry.patch_object[i]; object >= 0)
      of_object[static_cast<std::size_t>(object)] += geometry.patch_area[i];
  }
  if (dark <= worth_a_word * all) return {};
  const auto most = std::ranges::max_element(of_object) - of_object.begin();
  return fmt::format(
      "{:.3g} m2 of surfaces ({:.2g} % of all but ground) get no light at all, most of them of {}; "
      "they are faces within houses or look into houses that are not closed, and means, lists and "
      "measures count them; leave inner faces out of the model, or close the houses (scene.repair: "
      "all)",
      dark, 100 * dark / all, geometry.object_name[static_cast<std::size_t>(most)]);
}

/// Share of the leaf area that counts whose error is as small as the study asks for.
double accuracy_share(const Totals& totals, const ResultGeometry& geometry, double relative) {
  const auto& load = totals[sum_name(Part::total)];
  const auto se = errors_of(totals[batch_array::exposure], load.size());
  const double largest = load.empty() ? 0 : *std::max_element(load.begin(), load.end());
  double counts = 0, met = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (load[i] <= 0 || load[i] < share_that_counts * largest) continue;
    counts += geometry.patch_area[i];
    if (se[i] <= relative * load[i]) met += geometry.patch_area[i];
  }
  return counts > 0 ? met / counts : 1;
}

/// Attributes are added to these lists in the order of the functions below.
using Attributes = ResultAttributes;

/// Of what it is, and by what.
void add_names(Attributes& a, const VariantPlan& plan) {
  a.text.insert(a.text.end(), {{"source", std::string("sunload ") + version + " (" + commit + ")"},
                               {"study", plan.study.name},
                               {"variant", plan.study.variant}});
}

/// Which of the study's variants it is, from 1.
std::int64_t variant_number(const MergedResult& result) {
  const auto& variants = result.file.variants;
  const auto here = std::find_if(variants.begin(), variants.end(), [&](const Study& study) {
    return study.variant == result.plan.study.variant;
  });
  return here - variants.begin() + 1;
}

/// How it was computed.
void add_identity(Attributes& a, const MergedResult& result) {
  const VariantPlan& plan = result.plan;
  const Study& study = plan.study;
  const std::string command =
      "sunload run " + std::filesystem::path(result.file.path).filename().string();
  a.text.insert(a.text.end(),
                {{"title", "Light load: " + study.name + ", variant " + study.variant},
                 {"history", iso_utc(now()) + " " + command},
                 {"study_sha256", plan.content_hash},
                 {"pairing_id", plan.pairing_id},
                 {"isa", plan.isa},
                 {"transport", word_of(study.solver.transport)}});
  if (!result.left_out.empty())
    a.text.emplace_back("incomplete", fmt::format("{} of {} batches are missing",
                                                  result.left_out.size(), plan.batches()));
  const auto add_unless_empty = [&](const char* name, std::string text) {
    if (!text.empty()) a.text.emplace_back(name, std::move(text));
  };
  std::string names;
  for (const auto& measure : study.measures) names += (names.empty() ? "" : " ") + measure.name;
  add_unless_empty("measures", names);
  add_unless_empty("measures_sha256", measures_hash(study));
  add_unless_empty("series_left_out", fmt::format("{}", fmt::join(unwanted_series(study), " ")));
  if (study.solver.bands == Bands::rgb) {
    a.text.emplace_back("bands", "rgb");
    a.text.emplace_back("light_colour", study.light.colour == LightColour::white ? "white" : "sky");
  }
  a.integers = {{"variant_number", variant_number(result)},
                {"seed", static_cast<std::int64_t>(study.solver.seed)},
                {"realizations", study.solver.realizations},
                {"numerics_version", numerics_version}};
}

/// For which instants of an interval the sun is taken.
std::string sun_sampling(const VariantPlan& plan) {
  if (std::holds_alternative<InstantsPeriod>(plan.study.period.kind))
    return "sun at the given instant";
  if (std::holds_alternative<PositionsPeriod>(plan.study.period.kind))
    return "sun at the given position";
  if (plan.light.any_joined())
    return "short intervals solved together: suns at most 2 minutes apart straight, 20 minutes by "
           "mirrors, each with the direct light of its own intervals";
  std::size_t most = 1;
  for (const auto& interval : plan.light.intervals)
    most = std::max(most, interval.when.sun_samples.size());
  if (most == 1) return "sun at the middle of the sunlit part of the interval";
  const bool is_auto = !plan.study.solver.sun_samples_per_interval;
  return fmt::format(
      "{}{} suns per interval, each at the middle of an equal part of the interval's sunlit time",
      is_auto ? "auto: up to " : "", most);
}

/// Where and when the sun stands.
void add_place(Attributes& a, const VariantPlan& plan) {
  const BuiltScene& built = plan.built;
  a.text.insert(a.text.end(), {{"timezone", plan.study.site.timezone},
                               {"site_source", built.site_source},
                               {"sun_sampling", sun_sampling(plan)}});
  if (!built.crs.empty()) a.text.emplace_back("crs", built.crs);
  if (built.crs_unit_m != 1) a.numbers.emplace_back("crs_unit_m", built.crs_unit_m);
  a.numbers.insert(a.numbers.end(), {{"latitude_deg", built.site.latitude_deg},
                                     {"longitude_deg", built.site.longitude_deg},
                                     {"elevation_m", built.site.elevation_m},
                                     {"north_deg", built.site.north_deg}});
}

/// Surfaces that are no patches, since they are inside of bodies, against others or below land.
void add_covered(Attributes& a, const VariantPlan& plan) {
  std::string text;
  const auto& covered_m2 = plan.built.report.covered_m2;
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    if (covered_m2[s] > 0)
      text +=
          fmt::format("{}{} {:.6g} m2", text.empty() ? "" : ", ", surface_names[s], covered_m2[s]);
  if (!text.empty()) a.text.emplace_back("covered", text);
}

/// Rays and seconds.
void add_work(Attributes& a, const MergedResult& result) {
  const WorkDone work = work_from(result.totals[batch_array::work]);
  const bool shoots = result.plan.study.solver.transport == Transport::shoot;
  for (const WorkKind& kind : work_kinds) {
    if (kind.told == WorkKind::Told::never) continue;
    if (kind.told == WorkKind::Told::when_shooting && !shoots) continue;
    if (kind.unit == WorkKind::Unit::seconds)
      a.numbers.emplace_back(kind.name, work[kind.work]);
    else
      a.integers.emplace_back(kind.name, static_cast<std::int64_t>(work[kind.work]));
  }
}

/// How far the numbers can be trusted: counts, biases, the accuracy asked for and reached.
void add_accuracy(Attributes& a, const MergedResult& result) {
  const Totals& totals = result.totals;
  const Study& study = result.plan.study;
  const auto R = static_cast<std::size_t>(study.solver.realizations);
  const auto& counts = totals[batch_array::counts];
  a.integers.insert(a.integers.end(),
                    {{"lines_per_patch", std::llround(counts[0])},
                     {"direct_samples", static_cast<std::int64_t>(counts[1])},
                     {"bounces", static_cast<std::int64_t>(totals[batch_array::bounces][0])}});
  // Few solutions are scaled to the sums of realizations, and differ from these by nothing.
  if (!totals.has(batch_array::reduction))
    a.numbers.emplace_back("reuse_bias_share", reuse_bias(totals, result.geometry, R));
  a.numbers.emplace_back(unit_names("residual_reuse_bias_kwh", study.light.quantity),
                         residual_reuse_bias_kwh(totals, R));
  if (totals.has(batch_array::reduction)) {
    const auto& reduction = totals[batch_array::reduction];
    a.integers.insert(a.integers.end(), {{"year_skies", static_cast<std::int64_t>(reduction[0])},
                                         {"year_suns", static_cast<std::int64_t>(reduction[1])}});
    a.numbers.emplace_back(unit_names("reduction_error_w_m2", study.light.quantity), reduction[2]);
    a.numbers.emplace_back("reduction_error_share",
                           reduction[3] > 0 ? reduction[2] / reduction[3] : 0);
  }
  if (!study.solver.accuracy) return;
  if (const auto relative = study.solver.accuracy->light_load_relative) {
    a.numbers.emplace_back("accuracy_light_load_relative", *relative);
    a.numbers.emplace_back("accuracy_area_share",
                           accuracy_share(totals, result.geometry, *relative));
  }
  if (const auto relative = study.solver.accuracy->irradiance_relative)
    a.numbers.emplace_back("accuracy_irradiance_relative", *relative);
  if (totals.has(batch_array::kept_area)) {
    const auto& area = totals[batch_array::kept_area];
    a.numbers.emplace_back("accuracy_irradiance_share", area[0] > 0 ? area[1] / area[0] : 1);
  }
  if (counts.size() > 2) a.numbers.emplace_back("samples_per_patch", counts[2]);
}

/// What the weather file says of itself, and all warnings.
void add_notes(Attributes& a, const MergedResult& result) {
  const auto add = [&](const char* name, std::initializer_list<std::vector<std::string>> lists) {
    std::string text;
    for (const auto& list : lists)
      for (const auto& line : list) text += line + "\n";
    if (!text.empty()) a.text.emplace_back(name, text);
  };
  add("weather", {result.plan.light.weather});
  add("warnings", {result.file.warnings, result.plan.built.warnings, result.plan.light.notes,
                   result_warnings(result.totals, result.geometry)});
}

}  // namespace

std::vector<std::string> result_warnings(const Totals& totals, const ResultGeometry& geometry) {
  // Light lost at backs is worth a warning above this share (docs/developer/design.md, Study).
  constexpr double tolerable = 1e-3;
  std::vector<std::string> warnings;
  const auto& energy = totals[batch_array::energy];
  const double share = energy[0] > 0 ? energy[2] / energy[0] : 0;
  if (share > tolerable)
    warnings.push_back(fmt::format(
        "{:.2g} % of the energy is lost at backs of one-sided surfaces; turn or close these "
        "surfaces, or make them two-sided (sides: two)",
        100 * share));
  for (std::size_t k = 0; k < geometry.selection_name.size(); ++k)
    if (geometry.selection_area[k] == 0)
      warnings.push_back(empty_selection_warning(geometry.selection_name[k]));
  if (auto buried = buried_sensors(totals, geometry); !buried.empty())
    warnings.push_back(std::move(buried));
  if (auto dark = dark_faces(totals, geometry); !dark.empty()) warnings.push_back(std::move(dark));
  return warnings;
}

ResultAttributes result_attributes(const MergedResult& result) {
  ResultAttributes attributes = scene_attributes(result.plan);
  for (const auto add : {add_identity, add_work, add_accuracy, add_notes}) add(attributes, result);
  return attributes;
}

ResultAttributes scene_attributes(const VariantPlan& plan) {
  ResultAttributes attributes;
  for (const auto add : {add_names, add_place, add_covered}) add(attributes, plan);
  return attributes;
}

}  // namespace sunload
