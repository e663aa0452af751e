// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a picture after loading, by stage:   render_bench RESULT.h5 [WIDTH HEIGHT]
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <string>

#include "io/picture/render_scene.h"
#include "io/result/shown_quantity.h"

using namespace sunload;

namespace {

class Stages {
 public:
  void end(const char* what) {
    const auto wall = std::chrono::steady_clock::now();
    const auto processor = std::clock();
    fmt::print("{:<24} {:6.2f} s processor, {:6.2f} s wall\n", what,
               static_cast<double>(processor - processor_) / CLOCKS_PER_SEC,
               std::chrono::duration<double>(wall - wall_).count());
    wall_ = wall;
    processor_ = processor;
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "render_bench RESULT.h5 [WIDTH HEIGHT]\n");
    return 2;
  }
  const int width = argc > 3 ? std::stoi(argv[2]) : 1920,
            height = argc > 3 ? std::stoi(argv[3]) : 1080;
  Stages stages;
  const ResultReader result(argv[1]);
  const auto shown = shown_quantity(result, "light_load", {});
  const PatchScene scene(result);
  stages.end("loading");
  fmt::print("{} patches\n", scene.patch_count());
  const PatchColours colours{shown.values,
                             scale_end({}, shown.values, scene.area()),
                             Palette::false_colour,
                             MeshLines::none,
                             {}};
  stages.end("scale");
  const RayCaster caster(scene.mesh());
  stages.end("ray caster");
  const auto camera = Camera::fitted(scene.focus_points(), {-1, -1, 1}, 27, width, height);
  const TracedPicture traced(scene, caster, camera, width, height, MeshLines::none);
  stages.end("rays");
  Picture picture(width, height);
  picture.paint(0, 0, width, traced.pixels(colours, {}));
  stages.end("colours");
  const auto png = picture.png();
  stages.end("PNG");
  return png.empty();
}
