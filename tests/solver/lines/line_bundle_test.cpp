// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines in packets are those of their numbers, and casting them together changes no hit.

#include "solver/lines/line_bundle.h"

#include <gtest/gtest.h>

#include <string>

#include "solver/lines/lines.h"
#include "solver/mesh/linked_element.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

/// Blocks on a plane, and sheets of two sides and of one.
const Scene& blocks() {
  static SceneBuilder builder = [] {
    SceneBuilder b;
    const int m = b.material({"m", 0.3, 0, 0});
    b.object("ground").quad({-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}, m);
    for (int i = 0; i < 16; ++i) {
      const double x = -50 + 25.0 * (i % 4), y = -50 + 25.0 * (i / 4);
      b.object("block " + std::to_string(i));
      b.box({x, y, 0.01}, {x + 12, y + 9, 6.0 + i}, m, Facing::outward);
    }
    b.object("sheet").sides(Sides::two);
    b.triangle({-8, -60, 1}, {-8, 60, 1}, {-8, 0, 12}, m);
    b.object("sheet with a back").sides(Sides::one);
    b.triangle({18, -60, 1}, {18, 60, 1}, {18, 0, 12}, m);
    return b;
  }();
  return builder.scene();
}

TEST(PatchLines, PacketsAreTheLinesOfTheirNumbers) {
  const Hierarchy mesh(blocks(), {.max_edge_m = 20});
  for (const std::size_t patch : {std::size_t{0}, mesh.patch_count() / 2, mesh.patch_count() - 1}) {
    const PatchLines lines(mesh, patch, 1e-3, line_seeds(mesh, patch, 3, 7));
    for (const std::size_t first : {0u, 16u, 48u, 1024u, 4080u}) {
      PacketLines packet;
      lines.packet(first, packet);
      for (std::size_t l = 0; l < packet_size; ++l) {
        const auto alone = lines[static_cast<std::uint32_t>(first + l)];
        const PatchLines::Line line = packet[l];
        EXPECT_EQ(line.origin, alone.origin) << first + l;
        EXPECT_EQ(line.w, alone.w) << first + l;
        EXPECT_GT(dot(line.w, mesh.normal(patch)), 0);
      }
    }
  }
}

TEST(LineBundle, MeetsWhatEachLineMeetsAlone) {
  const Scene& scene = blocks();
  const Hierarchy mesh(scene, {.max_edge_m = 6});
  constexpr std::size_t count = 40, patches = 7;  // packets that are not full, too
  constexpr double largest_links[] = {0, 1e-3, 0.03};
  const SkyGrid grid;
  for (const char* isa : {"sse4.2", "auto"}) {
    const RayCaster caster(scene.mesh, isa);
    std::size_t compared = 0, left = 0, to_sky = 0, backs = 0, above = 0;
    LineBundle bundle;
    for (std::size_t first = 0; first + patches <= mesh.patch_count(); first += patches) {
      bundle.clear();
      const auto lines_of = [&](std::size_t patch) {
        return PatchLines(mesh, patch, caster.offset_m(), line_seeds(mesh, patch, 0, 1));
      };
      for (std::size_t p = 0; p < patches; ++p)
        bundle.add(lines_of(first + p), count, largest_links[p % 3]);
      bundle.cast(caster, mesh, grid);
      for (std::size_t p = 0; p < patches; ++p) {
        const PatchLines lines = lines_of(first + p);
        for (std::size_t at = 0; at < count; at += packet_size) {
          const LinePacket packet(lines, at, count);
          const PacketHits hits = packet.first_hits(caster);
          for (std::size_t l = 0; l < packet.count; ++l, ++compared) {
            const auto& [together, patch, target] = bundle.met(p * count + at + l);
            const Hit alone = hits[l];
            ASSERT_EQ(bundle.line(p * count + at + l).w, packet.line[l].w);
            ASSERT_EQ(together.triangle, alone.triangle);
            if (alone.left_scene()) {
              ASSERT_EQ(patch, -1);
              ++left;
              const Vec3 w = packet.line[l].w;
              if (w.z <= 0) continue;
              ASSERT_EQ(target, static_cast<std::uint32_t>(grid.cell(w)));
              ++to_sky;
              continue;
            }
            ASSERT_EQ(together.u, alone.u);
            ASSERT_EQ(together.v, alone.v);
            ASSERT_EQ(together.distance_m, alone.distance_m);
            ASSERT_EQ(together.front, alone.front);
            ASSERT_EQ(patch, mesh.patch_at(alone.triangle, alone.u, alone.v, alone.front));
            backs += patch < 0;
            if (patch < 0) continue;
            const PatchLines::Line& line = packet.line[l];
            ASSERT_EQ(target, linked_element(mesh, static_cast<std::size_t>(patch),
                                             line.origin + line.w * alone.distance_m,
                                             alone.distance_m, largest_links[p % 3]));
            above += target >= mesh.patch_count();
          }
        }
      }
    }
    EXPECT_GT(compared, 100'000u);
    EXPECT_GT(left, compared / 10);
    EXPECT_LT(left, compared * 9 / 10);
    EXPECT_GT(to_sky, left / 2);
    EXPECT_GT(backs, 0u);
    EXPECT_GT(above, 1000u);
  }
}

}  // namespace
}  // namespace sunload::test
