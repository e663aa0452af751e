// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hostile polygons: rings on a coarse grid cross, touch, repeat and enclose one another.
//
// Bytes: scale, plane, then corners (two bytes, in the free plane three); 128 ends a ring,
// 129 a polygon, 130 an object.
#include <array>
#include <cmath>

#include "geo/base/check.h"
#include "geo/mesh/mesh_prepare.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

namespace {

enum Mark : unsigned char { ring_end = 128, polygon_end, object_end };
enum class Lie { flat, upright, tilted, free };

constexpr std::size_t most_corners = 120;  // with all their crossings: milliseconds

class PolygonText {
 public:
  explicit PolygonText(std::string_view bytes) : bytes_(bytes) {
    constexpr std::array<double, 6> scales{1, 0.1, 1e-5, 1e-12, 3000, 1e7};
    scale_ = scales[take_byte(bytes_) % scales.size()];
    const auto choice = take_byte(bytes_);
    lie_ = static_cast<Lie>(choice % 4);
    if (choice >= 128) offset_ = {4.5e6, 5.4e6, 311};  // as in national grids
  }

  PolygonModel read() {
    model_.object_names = {"object_0"};
    model_.source = "polygons";
    while (!bytes_.empty() && model_.vertices.size() < most_corners) read_one();
    end_polygon();
    model_.object_kinds.resize(model_.object_names.size());
    return std::move(model_);
  }

 private:
  void read_one() {
    const auto byte = take_byte(bytes_);
    if (byte == ring_end) return end_ring();
    if (byte == polygon_end) return end_polygon();
    if (byte == object_end) {
      end_polygon();
      model_.object_names.push_back("object_" + std::to_string(model_.object_names.size()));
      return;
    }
    ring_.push_back(static_cast<std::int32_t>(model_.vertices.size()));
    model_.vertices.push_back(corner(byte));
  }

  Vec3 corner(unsigned char first) {
    const double u = scale_ * static_cast<signed char>(first);
    const double v = scale_ * static_cast<signed char>(take_byte(bytes_));
    switch (lie_) {
      case Lie::flat:
        return Vec3{u, v, 3} + offset_;
      case Lie::upright:
        return Vec3{u, 2, v} + offset_;
      case Lie::tilted:
        return Vec3{u, v, u / 3 + v / 7} + offset_;
      case Lie::free:
        return Vec3{u, v, scale_ * static_cast<signed char>(take_byte(bytes_))} + offset_;
    }
    return {};
  }

  void end_ring() {
    if (ring_.size() >= 3) rings_.push_back(ring_);
    ring_.clear();
  }

  void end_polygon() {
    end_ring();
    if (rings_.empty()) return;
    model_.add_polygon(rings_, {.object = make_id<ObjectId>(model_.object_names.size() - 1)});
    rings_.clear();
  }

  std::string_view bytes_;
  double scale_ = 1;
  Lie lie_ = Lie::flat;
  Vec3 offset_;
  PolygonModel model_;
  std::vector<std::int32_t> ring_;
  std::vector<std::vector<std::int32_t>> rings_;
};

}  // namespace

static const Registered target("polygon", [](std::string_view bytes) {
  const auto length = bytes.size();
  prepare_small(PolygonText(bytes).read(), length);
});

}  // namespace sunload::fuzz
