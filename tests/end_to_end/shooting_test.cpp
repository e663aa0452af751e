// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Studies with `transport: shoot`, from the file to the result.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "io/result/reader.h"
#include "solver/light/tally.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr double closes = 1e-6;  // share of in, promised for shooting

std::string run(const WorkFolder& folder, const std::string& output, const std::string& study,
                std::vector<std::string> more = {}) {
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", study);
  std::vector<std::string> words{"run", "square.yaml", "--output", output};
  words.insert(words.end(), more.begin(), more.end());
  const Ran ran = program(folder, words);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return folder / (output + "/square/baseline.h5");
}

std::string shooting_study(const std::string& more = "", const std::string& errors = "totals") {
  return square_study(errors, ", transport: shoot" + more) +
         "sensors: {points: [{position_m: [0, 0, 0], normal: [0, 0, 1]}, "
         "{position_m: [0, 2.9, 2], normal: [0, -1, 0]}]}\n";
}

/// Energy on all patches, per realization [kWh].
std::vector<double> energies(const std::string& path) {
  const ResultReader result(path);
  const auto area = result.doubles("patch_area"), rows = result.doubles("light_load_realization");
  std::vector<double> energies(rows.size() / area.size(), 0);
  for (std::size_t r = 0; r < energies.size(); ++r)
    for (std::size_t i = 0; i < area.size(); ++i)
      energies[r] += area[i] * rows[r * area.size() + i];
  return energies;
}

/// Energy of one part of the light on all patches [kWh].
double energy_of_part(const std::string& path, const std::string& part) {
  const ResultReader result(path);
  const auto area = result.doubles("patch_area"), load = result.doubles("light_load_" + part);
  return std::inner_product(area.begin(), area.end(), load.begin(), 0.0);
}

TEST(ShootingStudy, ClosesItsLedgerAndAgreesWithGathering) {
  const WorkFolder folder;
  const MeanError gathered = mean_error(energies(run(folder, "gather", square_study())));
  for (const char* jacobi : {"incremental", "regular"}) {
    const std::string path =
        run(folder, jacobi, shooting_study(std::string(", seed: 2, jacobi: ") + jacobi));
    EXPECT_EQ(ledger_problem(path), "");
    EXPECT_EQ(sums_problem(path), "");
    const Energy energy = energy_of(path);
    EXPECT_LE(std::abs(energy.residual), closes * energy.in) << jacobi;
    EXPECT_EQ(ResultReader(path).text_attribute("transport"), "shoot");
    const MeanError shot = mean_error(energies(path));
    const double limit = accepted_t(16) * std::hypot(shot.standard_error, gathered.standard_error);
    EXPECT_LE(std::abs(shot.mean - gathered.mean), limit);
    // Planted fault: a tenth of the reflected light is lost.
    EXPECT_GT(std::abs(shot.mean - 0.1 * energy_of_part(path, "reflected") - gathered.mean), limit);
  }
}

TEST(ShootingStudy, LightsSensors) {
  const WorkFolder folder;
  const ResultReader result(run(folder, "sensors", shooting_study("", "instants")));
  const auto load = result.doubles("sensor_light_load"),
             se = result.doubles("sensor_light_load_se");
  ASSERT_EQ(load.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_GT(load[s], 0);
    EXPECT_GT(se[s], 0);
    EXPECT_LT(se[s], 0.1 * load[s]);
    double parts = 0;
    for (const char* part : {"direct", "sky", "mirror", "lamps", "reflected"})
      parts += result.doubles(std::string("sensor_light_load_") + part)[s];
    EXPECT_NEAR(parts, load[s], 1e-5 * load[s]);  // series are floats
  }
}

TEST(ShootingStudy, SameBitsForThreadsAndShards) {
  const WorkFolder folder;
  for (const char* errors : {"totals", "instants"}) {
    const std::string study = shooting_study("", errors), name = errors;
    const std::string one = run(folder, name + "1", study, {"--threads", "1"});
    for (const char* threads : {"2", "3"})
      EXPECT_EQ(different_data(one, run(folder, name + threads, study, {"--threads", threads})),
                std::vector<std::string>{})
          << threads << " threads";
    std::string shards;
    for (const char* shard : {"0/3", "2/3", "1/3"})
      shards = run(folder, name + "shards", study, {"--shard", shard, "--resume"});
    EXPECT_EQ(different_data(one, shards), std::vector<std::string>{});
  }
}

// What can change a number is another content: its batches are not mixed.
TEST(ShootingStudy, HasItsOwnContent) {
  const WorkFolder folder;
  const auto hash = [&](const std::string& study) {
    folder.write("square.obj", square_obj);
    folder.write("square.yaml", study);
    const Ran ran = program(folder, {"check", "square.yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto at = ran.out.find("(content ");
    return ran.out.substr(at + 9, 12);
  };
  const auto by_default = hash(shooting_study());
  EXPECT_NE(by_default, hash(square_study()));
  EXPECT_EQ(by_default, hash(shooting_study(", jacobi: incremental, power_per_sample_w: auto")));
  EXPECT_NE(by_default, hash(shooting_study(", jacobi: regular")));
  EXPECT_NE(by_default, hash(shooting_study(", power_per_sample_w: 2")));
}

TEST(ShootingStudy, FewerSamplesOfMorePower) {
  const WorkFolder folder;
  const ResultReader coarse(run(folder, "coarse", shooting_study(", power_per_sample_w: 20"))),
      fine(run(folder, "fine", shooting_study(", power_per_sample_w: 2")));
  EXPECT_LT(coarse.number_attribute("samples_shot"), fine.number_attribute("samples_shot"));
  // More than memory can keep is refused beforehand, with the key that asks for it.
  folder.write("square.yaml", shooting_study(", power_per_sample_w: 1e-9"));
  const Ran ran = program(folder, {"run", "square.yaml", "--output", "too_many"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("power_per_sample_w"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace sunload::test
