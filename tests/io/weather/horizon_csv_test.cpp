// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Horizon files: both kinds, and what is wrong with others.
#include "io/weather/horizon_csv.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "geo/base/check.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

Horizon read_horizon(const std::string& text) {
  return read_horizon_csv(test::folder_of_test().write("hills.csv", text));
}

TEST(HorizonCsv, ReadsNamedColumns) {
  for (const char* text :
       {"azimuth_deg,elevation_deg\n90,10\n270,20\n",
        "# hills\nelevation_deg; azimuth_deg; note\r\n10; 90; east\r\n\r\n20; 270; west\r\n",
        "\xEF\xBB\xBF"
        "azimuth_deg elevation_deg\n+90 10 # east\n270 20"}) {
    const Horizon horizon = read_horizon(text);
    ASSERT_EQ(horizon.points().size(), 2u) << text;
    EXPECT_EQ(horizon.elevation_deg(90), 10);
    EXPECT_EQ(horizon.elevation_deg(270), 20);
  }
}

// The layout of PVGIS's horizon table; west is +90 there, and 270 here.
TEST(HorizonCsv, ReadsPvgisTables) {
  const Horizon horizon = read_horizon(
      "Latitude (decimal degrees):\t45.815\nLongitude (decimal degrees):\t8.611\n\n"
      "A\t\tH_hor\tA_sun(w)\tH_sun(w)\tA_sun(s)\tH_sun(s)\n"
      "-180.0\t3.0\t-180.0\t-67.6\t-180.0\t-20.7\n-90.0\t10.0\t0\t0\t0\t0\n"
      "0.0\t1.5\t0\t0\t0\t0\n90.0\t20.0\t0\t0\t0\t0\n180.0\t3.0\t0\t0\t0\t0\n\n"
      "A: Azimuth (0 = S, 90 = W, -90 = E) (degree)\nH_hor: Horizon height (degree)\n");
  ASSERT_EQ(horizon.points().size(), 4u);
  EXPECT_EQ(horizon.elevation_deg(0), 3);
  EXPECT_EQ(horizon.elevation_deg(90), 10);
  EXPECT_EQ(horizon.elevation_deg(180), 1.5);
  EXPECT_EQ(horizon.elevation_deg(270), 20);
}

void expect_refused(const std::string& text, const std::string& part) {
  try {
    read_horizon(text);
    ADD_FAILURE() << text << " was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(HorizonCsv, TellsWhatIsWrong) {
  expect_refused("azimuth_deg;elevation_deg\n0;15,5\n90;1\n", "decimal points");
  expect_refused("", "no horizon file");
  expect_refused("0,1\n90,2\n", "azimuth_deg and elevation_deg, or A and H_hor");
  expect_refused("azimuth_deg,elevation_deg\n0,1\n90,x\n", ".csv:3: 'x' is no number");
  expect_refused("azimuth_deg,elevation_deg\n0,1\n90\n", ".csv:3: the row is too short");
  expect_refused("azimuth_deg,elevation_deg\n0,1\n90,nan\n", "'nan' is no number");
  expect_refused("azimuth_deg,elevation_deg\n0,1\n", "too few points");
  expect_refused("azimuth_deg,elevation_deg\n0,1\n10,-2\n", "below the horizon");
  expect_refused("azimuth_deg,elevation_deg\n0,1\n360,2\n", "another elevation");
  EXPECT_THROW(read_horizon_csv("/nowhere/horizon.csv"), InputError);
}

// Damaged text is read as a horizon that may be one, or refused by its name.
TEST(HorizonCsv, ReadsOrRefusesGarbage) {
  std::mt19937 random(1);
  int as_horizon = 0, refusals = 0;
  const std::string good = "azimuth_deg,elevation_deg\n0,1\n90,2\n180,3\n";
  for (int n = 0; n < 2000; ++n) {
    std::string text = good;
    text.resize(random() % (good.size() + 1));
    for (unsigned k = random() % 4; k > 0 && !text.empty(); --k)
      text[random() % text.size()] = static_cast<char>(random());
    try {
      const Horizon horizon = read_horizon(text);
      EXPECT_GE(horizon.points().size(), 2u) << text;
      for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 30) {
        EXPECT_GE(horizon.elevation_deg(azimuth_deg), 0) << text;
        EXPECT_LE(horizon.elevation_deg(azimuth_deg), 90) << text;
      }
      ++as_horizon;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("hills.csv"), std::string::npos) << error.what();
      ++refusals;
    }
  }
  EXPECT_GT(as_horizon, 20);
  EXPECT_GT(refusals, 1000);
}

}  // namespace
}  // namespace sunload
