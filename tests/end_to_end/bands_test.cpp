// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A study in bands as its users meet it: runs, shards, result, listings, pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "geo/time/time.h"
#include "io/result/reader.h"
#include "io/result/shown_quantity.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

const std::string sensors = "sensors: {points: [{position_m: [0, -5, 1.5], normal: [0, -1, 0]}]}\n";

struct ColouredSquare : SquareFolder {
  enum class Walls { by_light, grey };
  /// Walls are grey under white light, else as asked for.
  void write(const std::string& solver, const std::string& errors = "totals",
             const std::string& colour = "sky", Walls walls = Walls::by_light) const {
    std::string text = square_study(errors, solver) + sensors;
    const auto put = [&](const std::string& old, const std::string& now) {
      text.replace(text.find(old), old.size(), now);
    };
    put("source: clear_sky", "source: clear_sky, colour: " + colour);
    if (colour == "sky" && walls == Walls::by_light)
      put("{diffuse: 0.6}", "{diffuse: [0.8, 0.6, 0.4]}");
    write_study(text);
  }
};

using Strings = std::vector<std::string>;
using Shape = std::vector<std::size_t>;

TEST(BandStudy, SameBitsForThreadsShardsAndResumedRuns) {
  const ColouredSquare square;
  for (const char* errors : {"instants", "totals"}) {
    square.write(", bands: rgb", errors);
    const Ran one = square.run("one", {"--threads", "1", "--overwrite"});
    ASSERT_EQ(one.code, 0) << one.err;
    ASSERT_EQ(square.run("two", {"--threads", "2", "--overwrite"}).code, 0);
    EXPECT_EQ(different_data(square.result("one"), square.result("two")), Strings{});
  }
  for (const char* shard : {"2/3", "1/3"})
    ASSERT_EQ(square.run("shards", {"--threads", "1", "--shard", shard}).code, 0) << shard;
  ASSERT_EQ(
      program(square.folder, {"merge", "square.yaml", "--output", "shards", "--partial"}).code, 0);
  ASSERT_EQ(square.run("shards", {"--threads", "1", "--resume"}).code, 0);
  EXPECT_EQ(different_data(square.result("one"), square.result("shards")), Strings{});
  // The twin: another colour of the light is noticed.
  square.write(", bands: rgb", "totals", "white");
  ASSERT_EQ(square.run("white", {"--threads", "1"}).code, 0);
  const auto different = different_data(square.result("one"), square.result("white"));
  EXPECT_NE(std::find(different.begin(), different.end(), "irradiance_sky"), different.end());
}

// The pilot takes broadband light; what is met is the mean of the bands.
TEST(BandStudy, MayAskForAnAccuracy) {
  const ColouredSquare square;
  square.write(", bands: rgb, accuracy: {light_load_relative: 0.2}, max_lines_per_patch: 128");
  const Ran ran = square.run("accurate", {"--threads", "1"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const ResultReader result(square.result("accurate"));
  const double share = result.number_attribute("accuracy_area_share");
  EXPECT_TRUE(share > 0 && share <= 1) << share;
}

// White light on grey surfaces: series bit for bit, what realizations bring but for rounding.
TEST(BandStudy, EveryBandOfWhiteLightOnGreyIsTheBroadbandResult) {
  const ColouredSquare square;
  square.write("", "totals", "white");
  ASSERT_EQ(square.run("broad", {"--threads", "1"}).code, 0);
  square.write(", bands: rgb", "totals", "white");
  ASSERT_EQ(square.run("rgb", {"--threads", "1"}).code, 0);
  const ResultReader broadband(square.result("broad")), mean(square.result("rgb"));
  for (const char* series :
       {"irradiance", "irradiance_mirror", "facade_irradiance", "sensor_irradiance", "light_load",
        "irradiance_max", "power_sun", "power_residual", "sun_hours", "sky_view_factor"}) {
    EXPECT_EQ(mean.shape(series), broadband.shape(series)) << series;
    for (std::size_t b = 0; b < band_count; ++b)
      EXPECT_EQ(ResultReader(square.result("rgb"), b).doubles(series), broadband.doubles(series))
          << series;
  }
  for (const char* total : {"light_load_realization", "light_load_se", "facade_light_load_se",
                            "sensor_light_load_realization"}) {
    const auto a = mean.doubles(total), b = broadband.doubles(total);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 1e-6 * (mean.doubles("light_load")[0] + std::abs(b[i]))) << total;
  }
}

// Bands are at their largest at different times: reddish at sunrise, bluish in the shade.
TEST(BandStudy, LargestOfTheMeanIsOfTheMeansSeries) {
  const ColouredSquare square;
  square.write(", bands: rgb");
  ASSERT_EQ(square.run("rgb", {"--threads", "1"}).code, 0);
  const ResultReader mean(square.result("rgb"));
  bool is_below_the_mean_of_largest = false;
  for (const std::string receiver : {"", "sensor_"}) {
    const auto largest = mean.doubles(receiver + "irradiance_max");
    std::vector<double> of_series(largest.size(), 0), of_bands(largest.size(), 0);
    for (std::size_t k = 0; k < mean.shape("time").front(); ++k) {
      const auto row = mean.row(receiver + "irradiance", k);
      for (std::size_t i = 0; i < row.size(); ++i) of_series[i] = std::max(of_series[i], row[i]);
    }
    for (std::size_t b = 0; b < band_count; ++b) {
      const auto of_band =
          ResultReader(square.result("rgb"), b).doubles(receiver + "irradiance_max");
      for (std::size_t i = 0; i < of_band.size(); ++i) of_bands[i] += of_band[i] / band_count;
    }
    for (std::size_t i = 0; i < largest.size(); ++i) {
      EXPECT_NEAR(largest[i], of_series[i], float_rounding * of_series[i]) << receiver << i;
      EXPECT_LE(largest[i], of_bands[i] * (1 + float_rounding)) << receiver << i;
      if (largest[i] < 0.999 * of_bands[i]) is_below_the_mean_of_largest = true;
    }
  }
  EXPECT_TRUE(is_below_the_mean_of_largest) << "nothing tells the two apart";
}

// Each band's light is reflected by that band's reflectance: the mean is of the products. At an
// instant and over the period, from the series and from the totals.
TEST(BandStudy, RadianceIsTheMeanOfTheBands) {
  const ColouredSquare square;
  square.write(", bands: rgb");
  ASSERT_EQ(square.run("rgb", {"--threads", "1"}).code, 0);
  const std::string path = square.result("rgb"), noon = "2026-03-21T12:30";
  const ResultReader result(path);
  const auto at_noon = shown_quantity(result, "radiance", noon).values;
  const auto material = result.integers("patch_material");
  const auto names = result.strings("material_name");
  std::vector<double> sum(at_noon.size(), 0);
  const std::array<double, band_count> plaster{0.8, 0.6, 0.4};
  for (std::size_t b = 0; b < band_count; ++b) {
    const ResultReader band(path, b);
    const auto irradiance = shown_quantity(band, "irradiance", noon).values,
               radiance = shown_quantity(band, "radiance", noon).values;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += radiance[i];
      if (names[static_cast<std::size_t>(material[i])] != "plaster") continue;
      EXPECT_NEAR(radiance[i], plaster[b] * irradiance[i] / pi, 1e-6 * irradiance[i]);
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(at_noon[i], sum[i] / 3, 1e-6 * sum[i]);
  std::vector<double> of_series(sum.size(), 0);
  const std::size_t hours = result.shape("time").front();
  for (const double time : result.doubles("time")) {
    const auto row = shown_quantity(result, "radiance", iso_utc(time)).values;
    for (std::size_t i = 0; i < row.size(); ++i)
      of_series[i] += row[i] / static_cast<double>(hours);
  }
  const auto mean = shown_quantity(result, "radiance", "").values;
  for (std::size_t i = 0; i < mean.size(); ++i) EXPECT_NEAR(mean[i], of_series[i], 1e-5 * mean[i]);
}

// Transport is linear: on grey surfaces the mean of coloured bands is the broadband light,
// whichever part of a sky of many colours comes by lines or by samples about the sun.
TEST(BandStudy, MeanOfColouredLightOnGreyIsTheBroadbandResult) {
  const ColouredSquare square;
  square.write("", "totals", "sky", ColouredSquare::Walls::grey);
  ASSERT_EQ(square.run("broad", {"--threads", "1"}).code, 0);
  square.write(", bands: rgb", "totals", "sky", ColouredSquare::Walls::grey);
  ASSERT_EQ(square.run("rgb", {"--threads", "1"}).code, 0);
  const ResultReader broadband(square.result("broad")), mean(square.result("rgb"));
  for (const char* name : {"irradiance", "irradiance_sky", "irradiance_reflected",
                           "irradiance_mirror", "sensor_irradiance_sky", "light_load",
                           "light_load_realization", "power_escaped", "power_absorbed"}) {
    const auto a = mean.doubles(name), b = broadband.doubles(name);
    const double largest = *std::max_element(b.begin(), b.end());
    double difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      difference = std::max(difference, std::abs(a[i] - b[i]));
    EXPECT_LT(difference, float_rounding * largest) << name;
    // Planted fault: one of the bands in place of their mean.
    const auto red = ResultReader(square.result("rgb"), 0).doubles(name);
    double of_red = 0;
    for (std::size_t i = 0; i < b.size(); ++i) of_red = std::max(of_red, std::abs(red[i] - b[i]));
    EXPECT_GT(of_red, 100 * float_rounding * largest) << name;
  }
}

constexpr const char* band_check = R"(
import sys, xarray
data = xarray.open_dataset(sys.argv[1], engine='h5netcdf')
assert list(data.band.values) == ['red', 'green', 'blue'], data.band
for name, dims in {'irradiance': 'time band patch', 'facade_irradiance': 'time band facade',
                   'sensor_irradiance': 'time band sensor', 'light_load': 'band patch',
                   'light_load_realization': 'realization band patch', 'power_sun': 'time band',
                   'power_sun_se': 'band', 'sun_hours': 'patch', 'dni': 'time'}.items():
    assert ' '.join(data[name].dims) == dims, (name, data[name].dims)
assert data.attrs['bands'] == 'rgb' and data.attrs['light_colour'] == 'sky'
data.load()
red, blue = data.sel(band='red'), data.sel(band='blue')
assert float(red.irradiance_direct.sum()) > 1.01 * float(blue.irradiance_direct.sum())
assert float(blue.irradiance_sky.sum()) > 1.05 * float(red.irradiance_sky.sum())
hours = (data.time_bounds[:, 1] - data.time_bounds[:, 0]).values.astype(float) / 3.6e12
energy = (data.irradiance * xarray.DataArray(hours, dims='time')).sum('time') / 1000
assert abs(energy - data.light_load).max() < 1e-4 * data.light_load.max()
print(float(abs(data.light_load.mean('band').sum())))
)";

TEST(BandStudy, IsReadByXarrayAndByEveryCommand) {
  const ColouredSquare square;
  square.write(", bands: rgb");
  const Ran ran = square.run("rgb", {"--threads", "1"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  for (const char* band : {"  red", "  green", "  blue"})  // the ledger of each
    EXPECT_NE(ran.err.find(band), std::string::npos) << ran.err;
  const std::string result = square.result("rgb");
  const Ran read = python(square.folder, band_check, {result});
  EXPECT_EQ(read.code, 0) << read.err;

  const ResultReader mean(result), red(result, 0), blue(result, 2);
  EXPECT_EQ(mean.shape("irradiance"), (Shape{12, mean.shape("patch_area")[0]}));
  EXPECT_EQ(mean.shape("power_sun"), Shape{12});
  EXPECT_EQ(mean.shape("light_load_realization").front(), 16u);
  EXPECT_GT(red.number_attribute("power_sun", "time_sum_kwh"),
            blue.number_attribute("power_sun", "time_sum_kwh"));
  for (std::size_t b = 0; b < band_count; ++b) {
    const ResultReader band(result, b);
    const double residual = band.number_attribute("power_residual", "time_sum_kwh");
    const double error = band.number_attribute("power_residual", "time_sum_se_kwh");
    EXPECT_LT(std::abs(residual), 6 * error) << b;
  }

  const auto succeeds = [&](std::vector<std::string> words) {
    const Ran done = program(square.folder, words);
    EXPECT_EQ(done.code, 0) << words[0] << ": " << done.err;
    return done.out;
  };
  EXPECT_NE(succeeds({"info", result}).find("bands        red, green, blue"), std::string::npos);
  EXPECT_NE(succeeds({"info", result, "--band", "red"}), succeeds({"info", result}));
  succeeds({"compare", result, result, "--band", "green"});
  succeeds({"render", result, "-o", "colour.png", "--colour", "rgb", "--size", "400x320"});
  succeeds({"render", result, "-o", "mean.png", "--size", "400x320"});
  succeeds({"export", result, "--to", "vtk", "-o", "a.vtk", "--band", "blue"});

  const auto refused = [&](std::vector<std::string> words, const std::string& text) {
    const Ran done = program(square.folder, words);
    EXPECT_EQ(done.code, 2) << words[0];
    EXPECT_NE(done.err.find(text), std::string::npos) << done.err;
  };
  refused({"info", result, "--band", "violet"}, "choose one of: red, green, blue");
  refused({"export", result, "--to", "xdmf", "-o", "a.xdmf"}, "cannot show a result in bands");
  refused({"render", result, "-o", "a.png", "--colour", "rgb", "--band", "red"}, "needs all bands");
  square.write("");
  ASSERT_EQ(square.run("broad", {"--threads", "1"}).code, 0);
  refused({"info", square.result("broad"), "--band", "red"}, "has no bands");
  refused({"render", square.result("broad"), "-o", "a.png", "--colour", "rgb"}, "needs all bands");
}

}  // namespace
}  // namespace sunload::test
