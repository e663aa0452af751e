// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensor files: CSV and .pts, and what is wrong with them.
#include "io/scene/sensor_file.h"

#include <gtest/gtest.h>

#include "geo/base/check.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

std::vector<SensorPoint> read(const std::string& text, const std::string& name = "grid.csv") {
  const WorkFolder folder;
  return read_sensor_file(folder.write(name, text));
}

/// Problems without the folder.
std::vector<std::string> problems(const std::string& text) {
  const WorkFolder folder;
  const std::string path = folder.write("grid.csv", text);
  try {
    read_sensor_file(path);
  } catch (const InputError& error) {
    std::vector<std::string> list;
    for (const auto& problem : error.problems())
      list.push_back(problem.substr(problem.find("grid.csv")));
    return list;
  }
  ADD_FAILURE() << "no problem was found";
  return {};
}

void expect_two(const std::vector<SensorPoint>& points) {
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, (Vec3{1, 2.5, -3}));
  EXPECT_EQ(points[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(points[1].position, (Vec3{155000.25, 463000.5, 1e1}));
  EXPECT_EQ(points[1].normal, (Vec3{0, -2, 0}));
}

TEST(SensorFile, ReadsEveryKindOfTable) {
  expect_two(read("1,2.5,-3,0,0,1\n155000.25,463000.5,1e1,0,-2,0\n"));
  expect_two(read("1;2.5;-3;0;0;1\r\n155000.25;463000.5;10;0;-2;0"));
  expect_two(read("x,y,z,nx,ny,nz\n1,2.5,-3,0,0,1\n\n155000.25,463000.5,10,0,-2,0\n"));
  expect_two(
      read("\xEF\xBB\xBF\"NX\"; \"NY\"; \"NZ\"; name; X; Y; Z\n0;0;1;a;1;2.5;-3\n"
           "0;-2;0;b;155000.25;463000.5;10\n"));
  expect_two(read("# a grid\n1.0\t2.5\t-3\t0 0 1\n\n155000.25 463000.5 +10 0 -2.0 0 # last\n",
                  "grid.pts"));
}

TEST(SensorFile, SaysWhatIsWrongAndWhere) {
  using Strings = std::vector<std::string>;
  EXPECT_EQ(problems("1,2,3,0,0\n1,2,3,0,0,1\n1,2,b,0,0,1\n1,2,3,0,0,0\n"),
            (Strings{"grid.csv:1: the row has 5 fields, not 6 (a sensor is x y z nx ny nz)",
                     "grid.csv:3: z: 'b' is no number",
                     "grid.csv:4: the normal has no length (it tells where the sensor looks)"}));
  EXPECT_EQ(
      problems("1,5;2,0;3,0;0;0;1\n"),
      (Strings{"grid.csv:1: semicolons and commas stand in one row (a decimal comma would make two "
               "numbers of one); write decimal points"}));
  EXPECT_EQ(problems("x;y;z;nx;ny;nz\n1,5;2,5;10,25;0;0,5;1\n").size(), 1u);
  EXPECT_EQ(
      problems("x,y,z,nx,ny,nz\n1,5,2,0,0,0,1\n"),
      (Strings{"grid.csv:2: the row has 7 fields, not 6 (a sensor is x y z nx ny nz); decimal "
               "commas are not read: write points"}));
  EXPECT_EQ(
      problems("\nx,y,z,nx,ny\n1,2,3,0,0\n"),
      (Strings{"grid.csv:2: the header names no column nz (sensors are x, y, z, nx, ny, nz)"}));
  EXPECT_EQ(problems("x,y,z,nx,ny,nz\n1,2,3,0,0\n"),
            (Strings{"grid.csv:2: the row has 5 fields, not 6 (a sensor is x y z nx ny nz)"}));
  EXPECT_EQ(problems("1 2 nan 0 0 1\n"), (Strings{"grid.csv:1: z: 'nan' is no number"}));
  EXPECT_EQ(problems("1e300 2 3 0 0 1\n"),
            (Strings{"grid.csv:1: the position lies beyond any map projection of the Earth"}));
  EXPECT_EQ(problems("# nothing\n\n"),
            (Strings{"grid.csv: holds no sensors (a row is x y z nx ny nz)"}));
  EXPECT_EQ(problems(std::string("1,2\n") + std::string(100, '\n') + std::string("1,2\n")).size(),
            2u);
  std::string many;
  for (int k = 0; k < 100; ++k) many += "1,2\n";
  EXPECT_EQ(problems(many).size(), 20u);
  EXPECT_THROW(read_sensor_file("/nowhere/grid.csv"), InputError);
}

}  // namespace
}  // namespace sunload::test
