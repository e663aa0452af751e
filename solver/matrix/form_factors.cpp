// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/form_factors.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "geo/base/check.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/lines/patch_lines.h"
#include "solver/matrix/dense_solve.h"
#include "solver/matrix/full_view.h"
#include "solver/matrix/polygon_exchange.h"

namespace sunload {

namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Hierarchy& hierarchy, std::size_t patch) {
  return {hierarchy.corner(patch, 0), hierarchy.corner(patch, 1), hierarchy.corner(patch, 2)};
}

/// Factors by lines, and exchange of pairs by formula.
class Builder {
 public:
  Builder(const Mesh& mesh, const Hierarchy& hierarchy, const RayCaster& caster,
          const FormFactorRules& rules, Watch& watch)
      : hierarchy_(hierarchy),
        caster_(caster),
        rules_(rules),
        watch_(watch),
        view_(mesh),
        n_(hierarchy.patch_count()),
        R_(static_cast<std::size_t>(rules.realizations)) {
    SUNLOAD_EXPECT(n_ <= most_matrix_patches, "a small scene");
    factors_.patches = n_;
    factors_.realizations.assign(R_, std::vector<float>(n_ * n_, 0));
    for (const Vec3& vertex : hierarchy.vertices())
      touch_m_ = std::max(touch_m_, rounding * norm(vertex));
  }

  FormFactors made() && {
    step(&Builder::cast_lines);
    step(&Builder::look_for_full_views);
    exchange();
    take_mean();
    return std::move(factors_);
  }

 private:
  static constexpr double rounding = 1e-9;

  std::size_t lines_each() const {
    SUNLOAD_EXPECT(R_ > 0, "at least one realization");
    return std::max<std::size_t>(static_cast<std::size_t>(rules_.lines_per_patch) / R_, 1);
  }

  /// For every patch.
  void step(void (Builder::*of_patch)(std::size_t)) {
    constexpr double steps = 2;
    parallel_for(n_, [&](std::size_t i) {
      (this->*of_patch)(i);
      watch_.advance(Stage::lines,
                     static_cast<double>(++done_) / (steps * static_cast<double>(n_)));
    });
  }

  void cast_lines(std::size_t i) {
    for (std::size_t r = 0; r < R_; ++r) {
      const PatchLines lines(hierarchy_, i, caster_.offset_m(),
                             random_words({.seed = rules_.seed,
                                           .purpose = Purpose::form_factors,
                                           .realization = static_cast<std::uint32_t>(r),
                                           .element = hierarchy_.key()[i]}));
      float* row = factors_.realizations[r].data() + i * n_;
      for (std::size_t first = 0; first < lines_each(); first += packet_size) {
        const LinePacket packet(lines, first, lines_each());
        const PacketHits hits = packet.first_hits(caster_);
        for (std::size_t l = 0; l < packet.count; ++l) {
          const Hit hit = hits[l];
          if (hit.left_scene()) continue;
          const auto j = hierarchy_.patch_at(hit.triangle, hit.u, hit.v, hit.front);
          if (j >= 0) ++row[j];
        }
      }
    }
    watch_.cast(static_cast<double>(R_ * lines_each()));
  }

  /// A_i F_ij of the pairs (i, j), j > i, that are in full view.
  void look_for_full_views(std::size_t i) {
    const Corners a = corners_of(hierarchy_, i);
    const Vec3 n = hierarchy_.normal(i);
    for (std::size_t j = i + 1; j < n_; ++j) {
      const Corners b = corners_of(hierarchy_, j);
      const Vec3 m = hierarchy_.normal(j);
      const auto from = in_front(a, b[0], m, touch_m_), to = in_front(b, a[0], n, touch_m_);
      if (from.empty() || to.empty() || !view_.is_proved(from, n, to, m)) continue;
      by_formula_[i].push_back({j, exchange_area(from, to)});
    }
  }

  /// Both ends of a pair agree on what goes between them.
  void exchange() {
    const std::vector<double>& area = hierarchy_.area();
    const double of_line = 1 / static_cast<double>(lines_each());
    std::vector<std::size_t> by_lines(R_, 0);
    parallel_for(R_, [&](std::size_t r) {
      std::vector<float>& F = factors_.realizations[r];
      for (std::size_t i = 0; i < n_; ++i) {
        F[i * n_ + i] = 0;  // a rounding of rays: patches are plane
        for (std::size_t j = i + 1; j < n_; ++j) {
          float &there = F[i * n_ + j], &back = F[j * n_ + i];
          if (there > 0 || back > 0) ++by_lines[r];
          const double exchanged =
              (area[i] * static_cast<double>(there) + area[j] * static_cast<double>(back)) *
              of_line / 2;
          there = static_cast<float>(exchanged / area[i]);
          back = static_cast<float>(exchanged / area[j]);
        }
        for (const auto& [j, exchanged] : by_formula_[i]) {
          if (F[i * n_ + j] > 0) --by_lines[r];
          F[i * n_ + j] = static_cast<float>(exchanged / area[i]);
          F[j * n_ + i] = static_cast<float>(exchanged / area[j]);
        }
      }
    });
    for (const auto& row : by_formula_) factors_.pairs_by_formula += row.size();
    factors_.pairs_by_lines = *std::max_element(by_lines.begin(), by_lines.end());
    factors_.rays = n_ * R_ * lines_each();
  }

  void take_mean() {
    factors_.mean.resize(n_ * n_);
    parallel_for(n_, [&](std::size_t i) {
      for (std::size_t at = i * n_; at < (i + 1) * n_; ++at) {
        double sum = 0;
        for (const auto& F : factors_.realizations) sum += static_cast<double>(F[at]);
        factors_.mean[at] = static_cast<float>(sum / static_cast<double>(R_));
      }
    });
  }

  struct Exchange {
    std::size_t with;
    double area_m2;
  };
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const FormFactorRules& rules_;
  Watch& watch_;
  FullView view_;
  std::size_t n_, R_;
  double touch_m_ = 0;
  FormFactors factors_;
  std::vector<std::vector<Exchange>> by_formula_ = std::vector<std::vector<Exchange>>(n_);
  std::atomic<std::size_t> done_ = 0;
};

LinkTable table_of(const std::vector<float>& matrix, std::size_t n) {
  LinkTable table(n, n);
  parallel_for(table.blocks.size(), [&](std::size_t b) {
    const std::size_t end = std::min((b + 1) * LinkTable::rows_per_block, n);
    std::vector<LinkTable::Link> links;
    for (std::size_t i = b * LinkTable::rows_per_block; i < end; ++i) {
      links.clear();
      for (std::size_t j = 0; j < n; ++j)
        if (matrix[i * n + j] > 0)
          links.push_back({static_cast<std::uint32_t>(j), matrix[i * n + j]});
      table.blocks[b].append_row(links, 1);
    }
  });
  return table;
}

/// Irradiance straight from the patches that emit.
std::vector<double> of_emitters(const std::vector<float>& F, const PatchOptics& optics) {
  const std::size_t n = optics.emission.size();
  std::vector<double> irradiance(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      irradiance[i] += static_cast<double>(F[i * n + j]) * static_cast<double>(optics.emission[j]);
  return irradiance;
}

}  // namespace

FormFactors form_factors(const Mesh& mesh, const Hierarchy& hierarchy, const RayCaster& caster,
                         const FormFactorRules& rules, Watch& watch) {
  return Builder(mesh, hierarchy, caster, rules, watch).made();
}

void put_form_factors(const FormFactors& factors, const PatchOptics& optics, Reflections followed,
                      Lines& lines) {
  const std::size_t R = lines.realizations.size();
  const auto put = [&](const std::vector<float>& F, LineSet& set) {
    if (optics.any_emission) set.lamps = of_emitters(F, optics);
    set.all_reflections = followed == Reflections::all;
    set.patches = set.all_reflections
                      ? table_of(all_reflections(F, optics.diffuse), factors.patches)
                      : table_of(F, factors.patches);
  };
  parallel_for(R + 1, [&](std::size_t r) {
    if (r < R)
      put(factors.realizations[r], lines.realizations[r]);
    else
      put(factors.mean, lines.pooled);
  });
}

}  // namespace sunload
