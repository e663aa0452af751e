// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Light that is none is refused before it is solved; all that can be is not.
#include "solver/light/sun_block.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/support/refusal_of.h"

namespace sunload::test {
namespace {

constexpr std::size_t cells = 8;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

IntervalLight noon() {
  IntervalLight light;
  light.direction = {0, -0.6, 0.8};
  light.dni = 800;
  light.dhi = 100;
  light.ground_exitance = 20;
  light.sky.assign(cells, 30);
  light.length_s = light.sunlit_s = 3600;
  return light;
}

template <class Change>
std::string refusal_after(const Change& change) {
  IntervalLight light = noon();
  change(light);
  return refusal_of<std::logic_error>([&] { expect_valid({&light, 1}, cells); });
}

TEST(IntervalLight, IsTakenAsItCanBe) {
  EXPECT_EQ(refusal_after([](IntervalLight&) {}), "");
  EXPECT_EQ(refusal_after([](IntervalLight& light) { light = {}; }), "") << "nothing";
  EXPECT_EQ(refusal_after([](IntervalLight& light) { light.sky.clear(); }), "") << "no sky";
  EXPECT_EQ(refusal_after([](IntervalLight& light) { light.sunlit_s = 0; }), "") << "no sun";
  EXPECT_EQ(refusal_after([](IntervalLight& light) {
              light.direction = {0, 0, -1};
              light.dni = 0;
            }),
            "")
      << "the sun is down";
  EXPECT_EQ(refusal_after([](IntervalLight& light) {
              light.sun_samples = {{{0, 0, 1}, 0.5, 0.5}, {{0, -0.6, 0.8}, 0.5, 0.5}};
              light.bands.assign(3, {700, 18, light.sky});
            }),
            "")
      << "suns and bands";
}

TEST(IntervalLight, OfASkyOfOtherCellsIsRefused) {
  for (const std::size_t count : {cells - 1, cells + 1}) {
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.sky.resize(count, 30); }), "");
    EXPECT_NE(refusal_after([&](IntervalLight& light) {
                light.bands.assign(3, {700, 18, std::vector<double>(count, 30)});
              }),
              "");
  }
}

TEST(IntervalLight, OfAnotherLengthOfDirectionIsRefused) {
  EXPECT_NE(refusal_after([](IntervalLight& light) { light.direction = {0, -1, 1}; }), "");
  EXPECT_NE(refusal_after([](IntervalLight& light) { light.direction = {nan, 0, 0}; }), "");
  EXPECT_NE(refusal_after([](IntervalLight& light) {
              light.sun_samples = {{{0, -1, 1}, 1, 1}};
            }),
            "");
  EXPECT_NE(refusal_after([](IntervalLight& light) {
              light.direct_suns = {{{0, 0, 2}, 1, 1}};
            }),
            "");
}

TEST(IntervalLight, OfNoNumbersIsRefused) {
  for (const double wrong : {nan, inf, -1.0}) {
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.dni = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.dhi = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.ground_exitance = wrong; }), "");
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.sky[3] = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.length_s = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.sunlit_s = wrong; }), "") << wrong;
    EXPECT_NE(refusal_after([&](IntervalLight& light) { light.disk_half_angle = wrong; }), "");
  }
}

}  // namespace
}  // namespace sunload::test
