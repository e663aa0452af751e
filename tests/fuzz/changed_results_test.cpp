// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every dataset and attribute of a result with other values, of another shape and kind, and gone:
// refused, or read by every command. The fuzzer result_values does the same at random.
#include <gtest/gtest.h>

#include "geo/base/check.h"
#include "io/result/reader.h"
#include "tests/fuzz/changed_result.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {
namespace {

class ChangedResults : public testing::TestWithParam<Valid> {
 protected:
  const std::vector<test::ResultPlace>& places() const { return places_of(GetParam()); }

  /// Whether the file is refused as a whole, by name.
  bool is_refused(const ChangeAt& at) const {
    try {
      const ResultReader opened(changed_result(GetParam(), {at}));
      return false;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("changed.h5: "), std::string::npos) << error.what();
      return true;
    }
  }

  /// That change at every place, one after the other, with the value that `value_of` says. Those
  /// that are not refused are then read by every command, many of them in one file, as that takes
  /// a second. Returns how many were refused.
  template <class ValueOf>
  std::size_t refused(ResultChange change, const ValueOf& value_of) const {
    std::vector<ChangeAt> accepted;
    for (std::size_t p = 0; p < places().size(); ++p) {
      const ChangeAt at{change, p, p, value_of(p)};
      const std::string trace = places()[p].dataset + " " + places()[p].attribute;
      bool refused = false;
      EXPECT_NO_THROW(refused = is_refused(at)) << trace;
      if (!refused) accepted.push_back(at);
    }
    constexpr std::size_t files = 4;
    for (std::size_t file = 0; file < files; ++file) {
      std::vector<ChangeAt> changes;
      std::string trace;
      for (std::size_t i = file; i < accepted.size(); i += files) {
        changes.push_back(accepted[i]);
        const auto& place = places()[accepted[i].place];
        trace += place.dataset + " " + place.attribute + ", ";
      }
      EXPECT_NO_THROW(run(
          [&](std::string_view) { read_by_all(changed_result(GetParam(), changes), GetParam()); },
          {}))
          << trace;
    }
    return places().size() - accepted.size();
  }
};

TEST_P(ChangedResults, AreReadByEveryCommandWhereNothingIsChanged) {
  // All 33 but those that cannot show it: EnergyPlus, which wants a year (2), and of bands XDMF
  // (2).
  EXPECT_EQ(read_by_all(changed_result(GetParam(), {}), GetParam()),
            GetParam() == Valid::bands ? 29u : 31u);
}

TEST_P(ChangedResults, OneValueOfEachPlace) {
  EXPECT_GT(refused(ResultChange::one_value, [](std::size_t p) { return p; }), 0u);
}

TEST_P(ChangedResults, NoIndexLeadsOutOfAnArray) {
  const auto& all = places();
  std::size_t indices = 0;
  for (std::size_t p = 0; p < all.size(); ++p) {
    const auto& name = all[p].dataset;
    const bool is_index =
        all[p].attribute.empty() && !all[p].is_text &&
        (name.ends_with("_vertices") || name.ends_with("_object") || name.ends_with("_facade") ||
         name.ends_with("_material") || name.ends_with("_input_triangle") ||
         name.ends_with("_surface") || name.ends_with("_side"));
    if (!is_index) continue;
    ++indices;
    constexpr std::size_t largest_int = 3, least_int = 5;
    for (const std::size_t value : {largest_int, least_int})
      for (const std::size_t element : {std::size_t{0}, std::size_t{1000}})
        EXPECT_TRUE(is_refused({ResultChange::one_value, p, element, value})) << name;
  }
  EXPECT_EQ(indices, 8u);
}

TEST_P(ChangedResults, AllValuesOfEachPlace) {
  EXPECT_GT(refused(ResultChange::all_values, [](std::size_t p) { return p + 4; }), 0u);
}

TEST_P(ChangedResults, OtherSizesAndRanks) {
  EXPECT_GT(refused(ResultChange::size, [](std::size_t p) { return p; }), 50u);
  EXPECT_GT(refused(ResultChange::rank, [](std::size_t p) { return p; }), 50u);
}

TEST_P(ChangedResults, OtherKindsAndNothing) {
  EXPECT_GT(refused(ResultChange::type, [](std::size_t) { return std::size_t{0}; }), 50u);
  EXPECT_GT(refused(ResultChange::removal, [](std::size_t) { return std::size_t{0}; }), 15u);
}

INSTANTIATE_TEST_SUITE_P(Of, ChangedResults, testing::Values(Valid::broadband, Valid::bands),
                         [](const auto& which) {
                           return which.param == Valid::broadband ? "broadband" : "bands";
                         });

}  // namespace
}  // namespace sunload::fuzz
