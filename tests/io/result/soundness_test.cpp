// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A result that another program has changed is refused when it is opened, with what is wrong.
// tests/fuzz/changed_results_test.cpp changes every dataset.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/base/check.h"
#include "io/result/reader.h"
#include "tests/support/refusal_of.h"
#include "tests/support/result_change.h"
#include "tests/support/small_result.h"

namespace sunload::test {
namespace {

struct Changed {
  std::string path = write_small_result({}, "changed");

  const ResultPlace place(const std::string& dataset, const std::string& attribute = {}) const {
    const auto places = places_of(path);
    return *std::find_if(places.begin(), places.end(), [&](const ResultPlace& p) {
      return p.dataset == dataset && p.attribute == attribute;
    });
  }
  std::string refusal() const {
    return refusal_of([&] { const ResultReader opened(path); });
  }
  void expect_refused(const std::string& what) const {
    const auto said = refusal();
    EXPECT_NE(said.find(what), std::string::npos) << "wanted: " << what << "\nsaid:   " << said;
    EXPECT_EQ(said.find(path), 0u) << said;
  }
};

struct Case {
  const char* dataset;
  std::size_t place;
  double value;
  const char* said;
};

TEST(ResultSoundness, OneWrongValueIsSaidWithItsPlace) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  for (const Case& c : {
           Case{"patch_vertices", 4, 100000, "dataset patch_vertices has 100000 at place 4 (0 … "},
           Case{"patch_vertices", 0, -1, "dataset patch_vertices has -1 at place 0"},
           Case{"patch_object", 2, 99, "entries of the dimension object"},
           Case{"patch_facade", 2, -2, "-1 … "},
           Case{"patch_surface", 1, 6,
                "dataset patch_surface has 6 at place 1 (0 … 5 are its flags)"},
           Case{"patch_area", 3, 0, "dataset patch_area has 0 at place 3 (no area)"},
           Case{"patch_area", 3, nan, "dataset patch_area has nan"},
           Case{"vertex_position", 7, inf, "dataset vertex_position has inf at place 7"},
           Case{"patch_normal", 0, 2, "the length of a direction is 1"},
           Case{"time", 1, 0, "dataset time has 0 at place 1 (times increase"},
           Case{"time_bounds", 1, 0, "an interval ends after its begin"},
           Case{"dni", 0, -1, "no irradiance"},
       }) {
    const Changed result;
    change_number(result.path, c.dataset, c.place, c.value);
    result.expect_refused(c.said);
  }
}

TEST(ResultSoundness, ShapesAndKinds) {
  {
    const Changed result;
    const auto place = result.place("light_load");
    ChangedResult(result.path).reshape(place, {place.shape[0] - 1});
    result.expect_refused("the dimension patch has");
  }
  {
    const Changed result;
    ChangedResult(result.path).retype(result.place("object_name"));
    result.expect_refused(
        "dataset object_name holds numbers (texts of variable length belong there)");
  }
  {
    const Changed result;
    ChangedResult(result.path).remove(result.place("patch_normal"));
    result.expect_refused("there is no dataset patch_normal");
  }
  const Changed result;
  ChangedResult(result.path).set(result.place("", "timezone"), "Europe/Nowhere");
  result.expect_refused("the attribute timezone is no time zone");
}

TEST(ResultSoundness, AllThatIsWrongIsSaidAtOnce) {
  const Changed result;
  change_number(result.path, "patch_object", 0, 99);
  change_number(result.path, "patch_area", 0, -1);
  result.expect_refused("patch_object has 99");
  result.expect_refused("patch_area has -1");
}

TEST(ResultSoundness, ValuesThatNoLightHasAreRefusedWhereTheyAreRead) {
  const Changed result;
  change_number(result.path, "irradiance", 5, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.refusal(), "");
  const auto said = refusal_of([&] { ResultReader(result.path).row("irradiance", 0); });
  EXPECT_NE(said.find("dataset irradiance cannot be used"), std::string::npos) << said;
}

// The twin: what is not changed, and what is not known, is accepted.
TEST(ResultSoundness, AResultIsAcceptedAsItWasWritten) {
  EXPECT_EQ(Changed().refusal(), "");
  const Changed partial;
  change_number(partial.path, "irradiance", 5, std::nan(""));
  EXPECT_EQ(partial.refusal(), "");
  EXPECT_TRUE(std::isnan(ResultReader(partial.path).row("irradiance", 0)[5]));
}

}  // namespace
}  // namespace sunload::test
