// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What pages and headers claim is what tests see: who changes one of the two meets the other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numeric>
#include <regex>
#include <string>
#include <vector>

#include "io/result/patches.h"
#include "solver/first_light/circumsolar_sky.h"
#include "solver/light/work.h"
#include "tests/support/paths.h"

namespace sunload {
namespace {

/// A file of the repository, its lines joined and signs of comments left out.
std::string text_of(const std::string& path) {
  std::ifstream file(test::source_folder() + "/" + path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return std::regex_replace(text, std::regex("\\n *(/// ?)?"), " ");
}

TEST(Claims, HaveATestThatHoldsThem) {
  struct Claim {
    const char *page, *words, *tests, *test;
  };
  for (const auto& [page, words, tests, test] :
       {Claim{"docs/study-file.md", "soft edges of shadows and of the sun in mirrors",
              "tests/physics/glints_test.cpp", "TEST(SunDiskInAMirror, BlursTheEdgeOfTheGlint)"},
        Claim{"solver/first_light/mirror_sun.h",
              "Samples of a sun with a disk look at the images of their own points on it",
              "tests/physics/glints_test.cpp", "TEST(SunDiskInAMirror, BlursTheEdgeOfTheGlint)"}}) {
    EXPECT_NE(text_of(page).find(words), std::string::npos) << page << ": " << words;
    EXPECT_NE(text_of(tests).find(test), std::string::npos) << tests << ": " << test;
  }
}

TEST(Claims, ViewerBeginsWithTheCreaseAngleOfExport) {
  EXPECT_NE(text_of("scripts/viewer/page.html")
                .find(fmt::format("id=\"crease\" type=\"number\" min=\"0\" max=\"180\" step=\"5\" "
                                  "value=\"{}\"",
                                  default_crease_deg)),
            std::string::npos);
  for (const char* header : {"io/export/export.h", "io/picture/render.h"})
    EXPECT_NE(
        text_of(header).find(fmt::format("crease angle ({}° where left out)", default_crease_deg)),
        std::string::npos)
        << header;
}

TEST(Claims, PageOfResultsNamesTheWorkThatIsTold) {
  const std::string page = text_of("docs/result-file.md");
  for (const WorkKind& kind : work_kinds)
    EXPECT_EQ(page.find(std::string("`") + kind.name + "`") != std::string::npos,
              kind.told != WorkKind::Told::never)
        << kind.name;
}

/// Uniform but for one cell, so bright that what exceeds the cap has this share of the whole.
std::vector<double> sky_with_circumsolar(const SkyGrid& grid, std::size_t cell, double share) {
  const auto& projected = grid.projected();
  const auto cells = static_cast<double>(projected.size());
  constexpr double cap_by_mean = 3;
  const double own =
      cap_by_mean * projected[cell] / std::accumulate(projected.begin(), projected.end(), 0.0);
  std::vector<double> radiance(projected.size(), 1);
  radiance[cell] = (share * (cells - 1) + cap_by_mean - own) / (1 - own - share);
  return radiance;
}

TEST(Claims, CircumsolarLightIsLeftOutBelowTheShareThatItsHeaderNames) {
  const std::string header = text_of("solver/first_light/circumsolar_sky.h");
  std::smatch number;
  ASSERT_TRUE(std::regex_search(header, number, std::regex("less than ([0-9.]+) of the sky")));
  const double share = std::stod(number[1]);
  const SkyGrid grid;
  const Vec3 sun = normalized({0.3, 0.4, 0.7});
  const auto cell = static_cast<std::size_t>(grid.cell(sun));
  const auto circumsolar = [&](double of_share) {
    IntervalLight light;
    light.direction = sun;
    light.sky = sky_with_circumsolar(grid, cell, of_share * share);
    return CircumsolarSky(grid, light);
  };
  EXPECT_FALSE(circumsolar(0.99).any());
  EXPECT_TRUE(circumsolar(1.01).any());
}

}  // namespace
}  // namespace sunload
