// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What work costs: the page about it has the program's own numbers.
#include "io/plan/work_estimate.h"
#include "io/plan/workload.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "io/plan/cost.h"
#include "io/plan/variant_mesh.h"
#include "tests/support/paths.h"
#include "tests/support/study_plan.h"

namespace sunload {
namespace {

using namespace cost;

std::string page_of(const std::string& name) {
  std::ifstream file(test::source_folder() + "/docs/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}
std::string scaling_page() { return page_of("scaling.md"); }

std::string micro_s(double seconds) { return fmt::format("{:.4g} µs", 1e6 * seconds); }
std::string nano_s(double seconds) { return fmt::format("{:.4g} ns", 1e9 * seconds); }

TEST(CostModel, PageHasTheTimesOfTheProgram) {
  const std::string page = scaling_page();
  for (const std::string& row :
       {fmt::format("| patches + 1 | {} + {} s |", micro_s(s_per_patch), s_to_start),
        fmt::format("| patches · {} · {} · ({} + suns of the pilot, {} at most) | {} |",
                    elements_per_leaf, points_per_element, other_directions, most_mesh_pilot_suns,
                    micro_s(s_per_direct_ray)),
        fmt::format("| {} + {} · log2(input triangles) |", micro_s(s_per_line),
                    micro_s(s_per_level)),
        fmt::format("| patches · suns · {} (share that faces the sun) | {} |", facing_share,
                    micro_s(s_per_lit_share)),
        fmt::format("| {} · patches · *lit* that shine · direct_samples · {} … 1 by their distance "
                    "(up to {}°) | {} |",
                    facing_share, rays_in_one_place, degrees_to_share_rays,
                    micro_s(s_per_circumsolar_ray)),
        fmt::format("| {0} · suns · direct_samples · (sensors, {1} of mirrors' patches, if these "
                    "are more than a tenth; {1} of all by a disk, {2} by screens) | {3} |",
                    facing_share, share_at_edges, share_behind_screens, micro_s(s_per_direct_ray)),
        fmt::format("| {} of patches · suns (street with glass) | {} |", mirrored_share,
                    micro_s(s_per_mirrored_share)),
        fmt::format("| {} of patches · suns · direct_samples | {} |", mirrored_share,
                    micro_s(s_per_mirror_ray)),
        fmt::format("| lines · bounces · lit | {} |", nano_s(s_per_link_sun)),
        fmt::format("| patches · lit | {} |", micro_s(s_per_patch_sun)),
        fmt::format("| lit | {} |", micro_s(s_per_sun)),
        fmt::format("| lines · bounces · batches | {} |", nano_s(s_per_link_batch)),
        fmt::format("| patches · batches · realizations | {} |",
                    micro_s(s_per_patch_batch_realization)),
        fmt::format("the light iteration's lines once more | {} |",
                    micro_s(s_per_patch_sun_realization)),
        fmt::format("where surfaces emit and light is gathered | {} |",
                    micro_s(s_per_guided_patch)),
        fmt::format("| samples | {} |", micro_s(s_per_sample)),
        fmt::format("| patches · intervals | {} |", micro_s(s_per_value)),
        fmt::format("| patches · intervals with light | {} |", micro_s(s_per_further_value)),
        fmt::format("bytes of sums in batches, as below | {} |", nano_s(s_per_byte_of_sums)),
        fmt::format("({} of the lines meet something", share_that_meets),
        fmt::format("lines cost {} times as", 1 + rays_by_guide)})
    EXPECT_NE(page.find(row), std::string::npos) << row;
}

TEST(CostModel, PageHasTheSizesOfTheProgram) {
  const std::string page = scaling_page() + page_of("batch-file.md");
  for (const std::string& row :
       {fmt::format("{} · intervals + {} MB + {} · lines + patches · ({} · kept · min(batch_suns, "
                    "intervals) + {} "
                    "· realizations + {})",
                    bytes_per_interval, program_bytes / 1e6, bytes_per_line, float_bytes,
                    arrays_of_realizations * double_bytes, bytes_per_patch),
        fmt::format("{} · patches · lit · 2 · (output.series, one more with `standard_error: "
                    "instants`)",
                    stored_bytes_per_value),
        fmt::format("patches · batches · ({} · parts · realizations + {})", float_bytes,
                    batch_bytes_per_patch),
        fmt::format("patches · ({} + {} · measures + {} · parts + {} · realizations)",
                    geometry_bytes_per_patch + result_bytes_per_patch, bytes_per_measure,
                    result_bytes_per_kind, double_bytes),
        fmt::format("{} · patches + {} · input triangles for each season after the first",
                    season_bytes_per_patch, season_bytes_per_triangle),
        fmt::format("{} kB + {} kB · batches + {} · intervals", bytes_per_result / 1e3,
                    bytes_per_batch / 1e3, stored_bytes_per_interval),
        fmt::format("{:.1f} at 16, {:.1f} at 256, {:.1f} at 1024 lines of a patch",
                    kept_bytes_per_line(16), kept_bytes_per_line(256), kept_bytes_per_line(1024)),
        fmt::format("(realizations + 1) · ({} · patches", kept_bytes_per_patch),
        fmt::format("{} · 4097 where surfaces send light on", kept_bytes_per_cell),
        fmt::format("{} · patches² by matrix", kept_bytes_per_factor),
        fmt::format("{} of what is sent on", kept_bytes_per_weighted_link),
        fmt::format("{} where a line meets gloss", kept_bytes_per_glimpse),
        fmt::format("{} where surfaces emit", kept_bytes_per_guided_line)})
    EXPECT_NE(page.find(row), std::string::npos) << row;
}

// Counts for an accuracy are chosen by the cost of a line on the street.
TEST(CostModel, LineOfTheStreetCostsWhatLinesThereDo) {
  const VariantPlan plan = test::plan_of(
      "format: sunload-study-1\nname: t\nscene: {builtin: {name: street}}\n"
      "period: {positions: [{azimuth_deg: 180, elevation_deg: 45}]}\n"
      "light: {source: fixed, dni_w_m2: 800, dhi_w_m2: 100}\n");
  const auto triangles = static_cast<double>(plan.built.scene.mesh.triangle_count());
  // The error of the fit.
  EXPECT_NEAR(s_per_line_ray(triangles) / s_per_line_of_street, 1, 0.13);
}

/// Of the study whose every surface is of this material.
double estimated_seconds(const std::string& material) {
  const VariantPlan plan = test::plan_of(
      "format: sunload-study-1\nname: t\n"
      "scene: {builtin: {name: street}, materials: {all: {" +
      material +
      "}}, assign: [{material: all}]}\n"
      "period: {positions: [{azimuth_deg: 180, elevation_deg: 45}]}\n"
      "light: {source: fixed, dni_w_m2: 800, dhi_w_m2: 100}\n");
  return estimate_work(plan, 100'000).seconds;
}

// Lines go on from whatever is smooth or has a lobe, as from mirrors.
TEST(CostModel, LinesGoOnFromPanesMetalsAndGlossAsFromMirrors) {
  const double wall = estimated_seconds("diffuse: 0.3"), mirror = estimated_seconds("mirror: 0.3");
  EXPECT_GT(mirror, 1.2 * wall);
  for (const char* material :
       {"refractive_index: 1.5", "refractive_index: 1.4, extinction_coefficient: 5",
        "normal_transmittance: 0.8", "glossy: 0.3, glossy_exponent: 10"})
    EXPECT_EQ(estimated_seconds(material), mirror) << material;
}

/// Of a street in a winter's and a summer's hour, whose plaster is another in winter.
WorkEstimate estimated_with(const std::string& plaster, const std::string& seasons) {
  const VariantPlan plan =
      test::plan_of("format: sunload-study-1\nname: t\n" + seasons +
                    "site: {latitude_deg: 50, longitude_deg: 14, timezone: UTC}\n"
                    "scene: {builtin: {name: street}, materials: {all: {" +
                    plaster +
                    "}, other: {mirror: 0.3}}, assign: [{material: all}]}\n"
                    "period: {days: [2026-01-21, 2026-06-21], from: \"12:00\", to: \"13:00\"}\n"
                    "light: {source: clear_sky}\n");
  return estimate_work(plan, 100'000);
}

// Each season is traced as a scene of its own, with its own mirrors.
TEST(CostModel, SeasonsCostTheirLines) {
  const auto always = estimated_with("diffuse: 0.3", ""),
             mirrors = estimated_with("mirror: 0.3", "");
  const auto both =
      estimated_with("diffuse: 0.3, seasons: {cold: other}", "seasons: {cold: [1]}\n");
  EXPECT_EQ(both.line_rays, 2 * always.line_rays);
  EXPECT_GT(both.memory_bytes - always.memory_bytes,
            season_bytes_per_patch * static_cast<double>(both.patches));
  // As many lines of either kind.
  const double of_lines = mirrors.seconds - always.seconds;
  EXPECT_GT(both.seconds, always.seconds + of_lines);
}

VariantPlan hours_of(const std::string& end) {
  return test::plan_of(
      "format: sunload-study-1\nname: t\n"
      "site: {latitude_deg: 57.7, longitude_deg: 11.97, timezone: Europe/Stockholm}\n"
      "period: {start: 2026-06-01, end: " +
      end +
      ", step_min: 60}\nlight: {source: clear_sky}\n"
      "scene: {builtin: {name: city}}\nmesh: {max_edge_m: 20, oracle: none}\n");
}

// The fewer parts of the sky the suns of a period pass, the fewer solutions serve it. On the street
// a June of hours looked at the bright sky about 64 suns, a year at that about 180, each of them 32
// for tests.
TEST(CostModel, FewSolutionsServeWeeksOfHours) {
  EXPECT_FALSE(is_year_of_few(hours_of("2026-06-10")));
  const VariantPlan weeks = hours_of("2026-07-15"), year = hours_of("2027-06-01");
  ASSERT_TRUE(is_year_of_few(weeks));
  ASSERT_TRUE(is_year_of_few(year));
  const double patches = 1e5;
  const auto looked_about = [&](const VariantPlan& plan) {
    const double samples = plan.study.solver.direct_samples;
    const WorkEstimate work = estimate_work(plan, static_cast<std::size_t>(patches));
    return static_cast<double>(work.direct_rays) / (patches * facing_share * samples);
  };
  EXPECT_NEAR(looked_about(weeks), 64, 20);
  EXPECT_NEAR(looked_about(year), 180, 60);
}

}  // namespace
}  // namespace sunload
