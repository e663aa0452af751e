// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study/not_a_study.h"

#include <gtest/gtest.h>

#include "io/study/study.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

TEST(NotAStudy, SaysWhatAFileIsAndHowToBegin) {
  const WorkFolder folder;
  struct Case {
    const char *name, *text, *what;
  };
  for (const Case& c :
       {Case{"town.city.json", "{\"type\":\"CityJSON\",\"CityObjects\":{}}", "city model"},
        Case{"town.jsonl", "\xef\xbb\xbf{\"type\":\"CityJSONFeature\"}", "city model"},
        Case{"town.gml", "<?xml version='1.0'?>\n<core:CityModel>", "city model"},
        Case{"house.obj", "v 0 0 0\n", "is a model"}, Case{"HOUSE.OBJ", "v 0 0 0\n", "is a model"},
        Case{"land.TIF", "II*", "is a model"}, Case{"town.gpkg", "SQLite format 3", "is plan data"},
        Case{"room", "#VRML V2.0 utf8\n", "is a model"},
        Case{"WINTER.WEA", "place Berlin\n", "weather file"},
        Case{"berlin.epw", "LOCATION,Berlin\n", "weather file"},
        Case{"year.csv", "time;dni_w_m2\n", "is a table"},
        Case{"grid.pts", "0 0 1 0 0 1\n", "is a table"},
        Case{"street.h5", "\x89HDF\r\n\x1a\n", "file of results"}}) {
    const std::string told = refusal_of([&] { read_study(folder.write(c.name, c.text)); });
    EXPECT_NE(told.find(c.what), std::string::npos) << c.name << ": " << told;
    const bool offers_a_study = told.find("format: sunload-study-1") != std::string::npos;
    EXPECT_EQ(offers_a_study, std::string(c.what) != "file of results") << told;
  }
}

TEST(NotAStudy, TakesStudiesInJson) {
  const WorkFolder folder;
  EXPECT_NO_THROW(read_study(folder.write(
      "s.json",
      "{\"format\": \"sunload-study-1\", \"name\": \"s\", \"site\": {\"latitude_deg\": 50, "
      "\"longitude_deg\": 14, \"timezone\": \"UTC\"}, \"period\": {\"days\": [\"2026-03-21\"]}, "
      "\"scene\": {\"builtin\": {\"name\": \"street\"}}}")));
}

}  // namespace
}  // namespace sunload::test
