// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The few solutions that serve a period (node_light.h).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/light/packed_columns.h"
#include "solver/light/tally.h"

namespace sunload {

/// How near the light of few solutions comes to that of each interval.
struct Reduction {
  std::size_t skies = 0, suns = 0;  ///< that are solved
  /// Root mean squares over patches, by area, and over intervals that are no nodes [W m-2]: of the
  /// difference between light that is made up and light that is solved, and of the standard error
  /// of the latter.
  double error_w_m2 = 0, standard_error_w_m2 = 0;
  bool is_met = false;  ///< error ≤ a third of the standard error
  /// The error, of the standard error.
  double share() const { return standard_error_w_m2 > 0 ? error_w_m2 / standard_error_w_m2 : 0; }
};

/// Up to `block_width` sources side by side, and what they bring.
struct NodeBlock {
  /// Irradiance of receivers by each source of the block, [receiver][source] W m-2.
  struct Received {
    PackedColumns sky;        ///< straight from the sky; empty: nothing
    PackedColumns mirror;     ///< of the sky, by mirrors; empty: nothing
    PackedColumns reflected;  ///< after a diffuse reflection, and of the far ground
  };
  Received patches, sensors;
  std::array<Ledger, block_width> ledger{};  ///< but for first light of the sun's rays
  /// Of suns: first light of their rays that surfaces reflect diffusely [W].
  std::array<double, block_width> reflected_first{};
  std::vector<PackedColumns> circumsolar;  ///< [R] part of the sky, per realization
  /// [source][cells] π · radiance of that part; empty ones: none.
  std::vector<std::vector<double>> circumsolar_sky;

  /// Calls `array` for each array, and `array.each(list, visit)` for lists of them, to write or to
  /// read them.
  template <class Self, class Array>
  static void visit(Self& self, Array& array) {
    for (auto* received : {&self.patches, &self.sensors})
      for (auto* kind : {&received->sky, &received->mirror, &received->reflected})
        PackedColumns::visit(*kind, array);
    array(self.ledger);
    array(self.reflected_first);
    array.each(self.circumsolar, [&](auto& samples) { PackedColumns::visit(samples, array); });
    array.each(self.circumsolar_sky, array);
  }
};

/// All solutions that serve a period, kept so that other processes, and later ones, need not solve
/// them.
struct SolvedNodes {
  Reduction reduction;
  NodeBlock lamps, ground;
  std::vector<NodeBlock> skies, suns;

  /// As NodeBlock::visit; the reduction is not among them.
  template <class Self, class Array>
  static void visit(Self& self, Array& array) {
    const auto visit_block = [&](auto& block) { NodeBlock::visit(block, array); };
    visit_block(self.lamps);
    visit_block(self.ground);
    array.each(self.skies, visit_block);
    array.each(self.suns, visit_block);
  }
};

}  // namespace sunload
