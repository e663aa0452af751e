/// Glass of reference 07 in the light of the sun: what a pane transmits, reflects and keeps.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/units.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr double demanded_error = 0.005;  // of the truth, as a standard error

/// Shares of the sun's power per realization: a pane of 1 m² alone, the sun at that angle.
std::vector<double> share(const Solved& solved, Term term) {
  return solved.ledger([&](const Ledger& l) { return l[term] / l[Term::sun]; });
}

TEST(Glass, TransmitsReflectsAndKeepsTheReferencesShares) {
  if (shared_missing("reference")) return;
  const auto cases = reference_cases("07_cie171_bestest/cie171_style.json", "glass_fresnel");
  ASSERT_GE(cases.size(), 3u);
  for (const auto& c : cases) {
    const double angle = radians(number(c["angle_deg"]));
    const auto at = [&](double sun_angle) {
      Material glass{"pane"};
      glass.refractive_index = 1.526;
      glass.absorption_per_m = number(c["KL"]) / glass.thickness_m;
      SceneBuilder builder;
      builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, builder.material(glass));
      return solve(builder.scene(),
                   {one_second({std::sin(sun_angle), 0, std::cos(sun_angle)}, 800)}, test_rules());
    };
    // Planted fault: the sun 15° lower.
    const Solved solved = at(angle), lower = at(angle + radians(15));
    for (const auto& [name, term] :
         {std::pair{"T", Term::transmitted}, {"R", Term::escaped}, {"A", Term::absorbed}}) {
      const double truth = number(c[name]);
      const auto values = share(solved, term);
      const std::string id = c["id"].get<std::string>() + " " + name;
      const Verdict verdict = expect_mean(values, truth, float_rounding);
      std::cout << id << ": " << verdict.text << "\n";
      EXPECT_TRUE(verdict) << id << ": " << verdict.text;
      EXPECT_LE(verdict.standard_error, demanded_error * truth + 1e-15) << id;
      if (truth > float_rounding) {
        EXPECT_FALSE(expect_mean(share(lower, term), truth, float_rounding))
            << id << ": planted fault unnoticed";
      }
    }
  }
}

}  // namespace
}  // namespace sunload::test
