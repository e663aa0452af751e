// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Photometry of luminaires: planes that symmetry leaves out, factors, and what is wrong.
#include "io/scene/ies_file.h"

#include <gtest/gtest.h>

#include "geo/base/check.h"
#include "tests/support/program.h"
#include "tests/support/refusal_of.h"

namespace sunload::test {
namespace {

IntensityWeb read_ies(const std::string& text) {
  const WorkFolder folder;
  return read_ies_file(folder.write("lamp.ies", text));
}

std::string problem(const std::string& text) {
  const WorkFolder folder;
  const std::string path = folder.write("lamp.ies", text);
  const std::string said = refusal_of([&] { read_ies_file(path); });
  return said.substr(std::min(said.find("lamp.ies"), said.size()));
}

/// Three angles; a value is 100 times the plane's number plus the angle's.
std::string file_of(const std::string& planes, int count,
                    const std::string& head = "IESNA:LM-63-2002",
                    const std::string& factors = "1 1 40") {
  std::string text = head + "\n[TEST] made up\nTILT=NONE\n1 1000 2 3 " + std::to_string(count) +
                     " 1 2 0 0 0\n" + factors + "\n0 45 90\n" + planes + "\n";
  for (int p = 1; p <= count; ++p)
    for (int g = 0; g < 3; ++g) text += std::to_string(100 * p + g) + (g < 2 ? " " : "\n");
  return text;
}

TEST(IesFile, OnePlaneStandsForAll) {
  const IntensityWeb web = read_ies(file_of("0", 1));
  EXPECT_EQ(web.planes_deg, (std::vector<double>{0}));
  EXPECT_EQ(web.gammas_deg, (std::vector<double>{0, 45, 90}));
  EXPECT_EQ(web.intensities, (std::vector<double>{200, 202, 204}));  // the multiplier is 2
}

// LM-63, 5.13. Seen at γ = 45 degrees, 1 cd and a multiplier of 2 above even hundreds.
TEST(IesFile, PlanesThatSymmetryLeavesOutAreFilledIn) {
  const auto seen = [](const IntensityWeb& web, double plane) {
    return (web.at(plane, 45) - 2) / 200;
  };
  const IntensityWeb quarter = read_ies(file_of("0 30 90", 3));
  EXPECT_EQ(quarter.planes_deg, (std::vector<double>{0, 30, 90, 150, 180, 210, 270, 330, 360}));
  for (const double plane : {30, 150, 210, 330}) EXPECT_DOUBLE_EQ(seen(quarter, plane), 2);
  for (const double plane : {0, 180, 360}) EXPECT_DOUBLE_EQ(seen(quarter, plane), 1);
  for (const double plane : {90, 270}) EXPECT_DOUBLE_EQ(seen(quarter, plane), 3);

  const IntensityWeb half = read_ies(file_of("0 30 180", 3));
  EXPECT_EQ(half.planes_deg, (std::vector<double>{0, 30, 180, 330, 360}));
  EXPECT_DOUBLE_EQ(seen(half, 330), 2);
  EXPECT_DOUBLE_EQ(seen(half, 180), 3);

  const IntensityWeb sides = read_ies(file_of("90 100 180 270", 4));
  EXPECT_EQ(sides.planes_deg, (std::vector<double>{0, 80, 90, 100, 180, 270, 360}));
  for (const double plane : {80, 100}) EXPECT_DOUBLE_EQ(seen(sides, plane), 2);
  for (const double plane : {0, 180, 360}) EXPECT_DOUBLE_EQ(seen(sides, plane), 3);
  EXPECT_DOUBLE_EQ(seen(sides, 270), 4);

  EXPECT_EQ(read_ies(file_of("0 120 240 360", 4)).planes_deg,
            (std::vector<double>{0, 120, 240, 360}));
  const IntensityWeb open = read_ies(file_of("0 120 240", 3));  // its last plane is left out
  EXPECT_EQ(open.planes_deg, (std::vector<double>{0, 120, 240, 360}));
  EXPECT_DOUBLE_EQ(seen(open, 360), 1);
}

TEST(IesFile, FactorsOfItsEdition) {
  // The second one dims by the lamp until 1991; later it means nothing, or how it was measured.
  EXPECT_DOUBLE_EQ(read_ies(file_of("0", 1, "IESNA:LM-63-1995", "0.5 0.9 40")).at(0, 0), 100);
  EXPECT_DOUBLE_EQ(read_ies(file_of("0", 1, "IES:LM-63-2019", "0.5 1.10100 40")).at(0, 0), 100);
  for (const char* head : {"\xEF\xBB\xBFIES:LM-63-2019", " IESNA:LM-63-1995", "iesna:LM-63-1995"})
    EXPECT_DOUBLE_EQ(read_ies(file_of("0", 1, head, "0.5 1.1 40")).at(0, 0), 100) << head;
  EXPECT_DOUBLE_EQ(read_ies(file_of("0", 1, "IESNA91", "0.5 0.9 40")).at(0, 0), 90);
  EXPECT_DOUBLE_EQ(read_ies(file_of("0", 1, "a lamp of 1986", "0.5 0.9 40")).at(0, 0), 90);
}

TEST(IesFile, LinesBreakWhereTheyLike) {
  const IntensityWeb web = read_ies(
      "IESNA:LM-63-2002\r\nTILT= NONE\r\n1,1000,1\r\n2 1 1\r\n2 0 0 0 1 1\r\n40 0\r\n"
      "180\r\n\r\n0\r\n7\r\n9");
  EXPECT_EQ(web.gammas_deg, (std::vector<double>{0, 180}));
  EXPECT_EQ(web.intensities, (std::vector<double>{7, 9}));
}

TEST(IesFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(problem("x\n1 2 3\n"),
            "lamp.ies: is no IES file (no line of it begins with TILT=); luminaires are read from "
            "files of ANSI/IES LM-63 (.ies)");
  EXPECT_NE(problem("IESNA91\nTILT=INCLUDE\n").find("lamp.ies:2: TILT is not NONE"),
            std::string::npos);
  EXPECT_NE(problem("IESNA91\nTILT=NONE\n1 1000 1 2 1 2 2 0 0 0\n").find("photometry of type B"),
            std::string::npos);
  const std::string whole = file_of("0", 1);
  EXPECT_NE(problem(whole.substr(0, whole.size() - 5)).find("ends before a candela value"),
            std::string::npos);
  EXPECT_NE(problem(file_of("0", 1).replace(whole.find("45"), 2, "x5"))
                .find("lamp.ies:6: 'x5' is no number (it stands for vertical angle)"),
            std::string::npos);
  EXPECT_NE(problem(file_of("0 30 20", 3)).find("horizontal angles do not ascend"),
            std::string::npos);
  EXPECT_NE(problem(file_of("20 90", 2)).find("planes from 20 to 90 degrees"), std::string::npos);
  EXPECT_NE(problem(file_of("90 270", 2)).find("planes do not close the circle"),
            std::string::npos);
  EXPECT_NE(problem("TILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n0 0\n").find("sends no light"),
            std::string::npos);
  EXPECT_NE(problem("TILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n5 -1\n")
                .find("a candela value is -1 (it lies in 0"),
            std::string::npos);
  EXPECT_NE(problem("TILT=NONE\n1 1 1 1e9 1 1 2 0 0 0\n").find("the number of vertical angles"),
            std::string::npos);
}

}  // namespace
}  // namespace sunload::test
