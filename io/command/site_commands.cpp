// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "io/command/common_options.h"
#include "io/command/horizon_command.h"
#include "io/command/sub_commands.h"
#include "io/command/sun_and_sky.h"

namespace sunload {
namespace {

void add_image(const Command& command, std::string& image) {
  command.option("--image", image, "picture to write instead of CSV (.png)").written();
}

}  // namespace

void add_sun(CommandLine& line) {
  struct Given {
    std::string study, image;
  };
  const auto given = std::make_shared<Given>();
  const Command command = line.command("sun", "the sun path as CSV or as a stereographic diagram",
                                       [given] { return print_sun(given->study, given->image); });
  add_study(command, given->study);
  add_image(command, given->image);
  command.examples("sunload sun street.yaml > sun.csv\nsunload sun street.yaml --image sun.png");
}

void add_sky(CommandLine& line) {
  struct Given {
    std::string study;
    SkyOptions options;
  };
  const auto given = std::make_shared<Given>();
  SkyOptions& options = given->options;
  const Command command =
      line.command("sky", "the sky dome at one instant as CSV or as a fisheye picture",
                   [given] { return print_sky(given->study, given->options); });
  add_study(command, given->study);
  add_image(command, options.picture);
  command
      .option("--time", options.time,
              "instant, e.g. 2026-06-21T12:00 (civil time of the site), …Z, …+02:00")
      .required();
  command.choice("--colour", options.rules.kind,
                 {{"false", SkyPicture::luminance}, {"rgb", SkyPicture::colour}},
                 "of the picture, by luminance or as it looks");
  command.choice("--colour-model", options.rules.model,
                 {{"first", SkyColourModel::first}, {"second", SkyColourModel::second}},
                 "of rgb (default: second)");
  command.choice("--subdivision", options.subdivision,
                 {{"cells", std::nullopt},
                  {"tregenza", Subdivision::tregenza},
                  {"mf2", Subdivision::reinhart_mf2},
                  {"mf4", Subdivision::reinhart_mf4}},
                 "patches of the CSV (default: cells, 64 x 64)");
  command.examples("sunload sky street.yaml --time 2026-03-08T10:00 --image sky.png");
}

void add_horizon(CommandLine& line) {
  const auto given = std::make_shared<HorizonOptions>();
  const Command command =
      line.command("horizon", "the line of far hills of a site, from an elevation model",
                   [given] { return horizon(*given); });
  command.option("DEM", given->land, "raster of the land's height (GeoTIFF, ESRI ASCII)")
      .read()
      .required();
  const Option study = command.option("--study", given->study, "study whose site it is").read();
  command.option("--at", given->at, "place, latitude first: \"47.38 8.54\", UTM or MGRS")
      .excludes(study);
  command.option("--crs", given->crs, "map projection of a raster that names none");
  command.option("--unit-m", given->unit_m, "length of the raster's unit [m] (default: 1)")
      .positive();
  command.option("--above-m", given->above_m, "eye above the land of the place (default: 2)")
      .within(0.0, 10e3);
  command
      .option("--from-m", given->from_m,
              "land nearer than this is left out: it is the scene's own (default: as far as "
              "the study's scene reaches; of --at: 0)")
      .within(0.0, 1e6);
  command.option("--to-m", given->to_m, "how far is looked (default: 50000)").positive();
  command.option("--step-deg", given->step_deg, "between two azimuths (default: 1)")
      .within(0.01, 30.0);
  command.option("-o,--output", given->output, "file to write (.csv; default: standard output)")
      .written();
  command.examples(
      "sunload horizon dem.tif --study town.yaml -o hills.csv   # then site: {horizon: "
      "hills.csv}\n"
      "sunload horizon dem.tif --at \"47.38 8.54\" --from-m 500 > hills.csv");
}

}  // namespace sunload
