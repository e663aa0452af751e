// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdint>

#include "geo/base/keys.h"
#include "geo/builtin/scenes.h"
#include "geo/builtin/shapes.h"

namespace sunload::builtin {
namespace {

constexpr double plot_width = 20, plot_depth = 24;  // half of the streets around it included
constexpr double wall_grey = 0.3;                   // Oke (1987), table 7.4
constexpr double roof_grey = 0.25, land_grey = 0.2;

// Of a gable house: floor 2, long walls 4, gables 6, roof 4; of its plot, a plate with a shaft:
// top 8, bottom 8, sides 8 + 8.
constexpr double triangles_per_house = 16 + 32;

/// Sizes that differ from house to house, in steps of a decimetre.
class Sizes {
 public:
  explicit Sizes(std::size_t house) : house_(house) {}
  double next(double least, int steps) {
    const auto number = mixed(house_ * 8 + ++draw_);
    return least + 0.1 * static_cast<double>(number % static_cast<std::uint64_t>(steps + 1));
  }

 private:
  std::uint64_t house_, draw_ = 0;
};

struct Finishes {
  Finish wall, roof, floor, land, buried;
};

/// A gable house whose ridge runs east, about the origin of its placement.
void house(Builder& b, Point2 half, double eaves, double ridge, const Finishes& finish) {
  const auto corner = [&](int k, double z) {
    return Vec3{k == 0 || k == 3 ? -half.u : half.u, k < 2 ? -half.v : half.v, z};
  };
  const std::array<Vec3, 4> foot{corner(0, 0), corner(1, 0), corner(2, 0), corner(3, 0)};
  const std::array<Vec3, 4> top{corner(0, eaves), corner(1, eaves), corner(2, eaves),
                                corner(3, eaves)};
  const Vec3 west{-half.u, 0, ridge}, east{half.u, 0, ridge};
  b.face({{foot[3], foot[2], foot[1], foot[0]}}, finish.floor);
  b.face({{foot[0], foot[1], top[1], top[0]}}, finish.wall);
  b.face({{foot[2], foot[3], top[3], top[2]}}, finish.wall);
  b.face({{foot[1], foot[2], top[2], east, top[1]}}, finish.wall);
  b.face({{foot[3], foot[0], top[0], west, top[3]}}, finish.wall);
  b.face({{top[0], top[1], east, west}}, finish.roof);
  b.face({{top[2], top[3], west, east}}, finish.roof);
}

void plot(Builder& b, Point2 half_house, const Finishes& finish) {
  const Point2 half{plot_width / 2 - joint / 2, plot_depth / 2 - joint / 2};
  const Point2 shaft{half_house.u + joint, half_house.v + joint};
  prism(b, rectangle({-half.u, -half.v}, half), -plate_thickness, 0,
        {finish.buried, finish.land, finish.buried, finish.buried},
        {rectangle({-shaft.u, -shaft.v}, shaft)});
}

}  // namespace

PolygonModel city(double triangles) {
  const auto houses =
      static_cast<std::size_t>(std::max(1.0, std::round(triangles / triangles_per_house)));
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(houses))));
  Builder b("builtin:city");
  const MaterialId wall = b.material("wall", wall_grey), roof = b.material("roof", roof_grey),
                   land = b.material("land", land_grey);
  const Finishes finish{{wall, Surface::wall},
                        {roof, Surface::roof},
                        {wall, Surface::floor},
                        {land, Surface::ground},
                        {land, Surface::floor}};
  for (std::size_t h = 0; h < houses; ++h) {
    const std::size_t column = h % columns, row = h / columns;
    const Placement place{
        {plot_width * static_cast<double>(column), plot_depth * static_cast<double>(row), 0}};
    Sizes size(h);
    const Point2 half{size.next(4, 30), size.next(4, 20)};
    const double eaves = size.next(3, 120), ridge = eaves + size.next(2, 20);
    const auto number = std::to_string(h + 1);
    b.begin_object("house_" + number, place);
    house(b, half, eaves, ridge, finish);
    b.begin_object("plot_" + number, place);
    plot(b, half, finish);
  }
  return b.take();
}

}  // namespace sunload::builtin
