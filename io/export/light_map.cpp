// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/light_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "io/picture/picture.h"

namespace sunload {
namespace {

constexpr std::size_t largest_edge = 8192;  // of textures on what is in use
constexpr std::size_t margin = 1;           // texels between a patch and the edge of its block
constexpr std::size_t constant_block = 4, interpolated_block = 8;

}  // namespace

LightMap::LightMap(const ExportColours& colours, const std::string& result)
    : colours_(colours),
      patches_(colours.patch_step.size()),
      block_(colours.corner_step.empty() ? constant_block : interpolated_block),
      columns_(std::max<std::size_t>(
          1, static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(patches_)))))),
      rows_(std::max<std::size_t>(1, (patches_ + columns_ - 1) / columns_)) {
  if (columns_ * block_ <= largest_edge) return;
  const std::size_t most = (largest_edge / block_) * (largest_edge / block_);
  throw InputError({result}, fmt::format("--lightmap of {} patches", patches_),
                   fmt::format("a texture of {} texels along an edge holds {}", largest_edge, most),
                   colours.corner_step.empty() ? "leave it out: vertices have colours without limit"
                                               : "leave out --interpolate, or --lightmap");
}

std::array<float, 2> LightMap::place(std::size_t patch, std::size_t corner) const {
  const std::size_t inside = block_ - 2 * margin;
  const std::size_t x = patch % columns_ * block_ + margin + (corner == 1 ? inside : 0);
  const std::size_t y = patch / columns_ * block_ + margin + (corner == 2 ? inside : 0);
  return {static_cast<float>(x) / static_cast<float>(width()),
          static_cast<float>(y) / static_cast<float>(height())};
}

std::int32_t LightMap::step_at(std::size_t patch, std::size_t x, std::size_t y) const {
  if (colours_.corner_step.empty()) return colours_.patch_step[patch];
  const auto& steps = colours_.corner_step[patch];
  const auto weight = [&](std::size_t texel) {
    return (static_cast<double>(texel) + 0.5 - static_cast<double>(margin)) /
           static_cast<double>(block_ - 2 * margin);
  };
  const double w1 = weight(x), w2 = weight(y), w0 = 1 - w1 - w2;
  const auto [least, largest] = std::minmax_element(steps.begin(), steps.end());
  if (*least < 0) return steps.at(w0 >= std::max(w1, w2) ? 0 : w1 >= w2 ? 1 : 2);
  const auto step = std::lround(w0 * steps[0] + w1 * steps[1] + w2 * steps[2]);
  return std::clamp(static_cast<std::int32_t>(step), *least, *largest);
}

std::string LightMap::png() const {
  Picture picture(width(), height());
  std::vector<Colour> texels(columns_ * block_ * block_);
  for (std::size_t row = 0; row < rows_; ++row) {
    std::fill(texels.begin(), texels.end(), no_value_colour(colours_.palette));
    const std::size_t first = row * columns_, end = std::min(first + columns_, patches_);
    for (std::size_t patch = first; patch < end; ++patch)
      for (std::size_t y = 0; y < block_; ++y)
        for (std::size_t x = 0; x < block_; ++x)
          texels[(y * columns_ + patch - first) * block_ + x] =
              export_colour(colours_.palette, step_at(patch, x, y));
    picture.paint(0, static_cast<int>(row * block_), width(), texels);
  }
  return picture.png();
}

}  // namespace sunload
