// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/lod.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "geo/base/check.h"

namespace sunload {

namespace {

enum Class { above = 0, below = 1, met = 2 };

struct ParsedLod {
  Lod lod;
  bool has_minor = false;
};

std::optional<ParsedLod> parse_lod(std::string_view text) {
  ParsedLod parsed;
  const auto* const end = text.data() + text.size();
  const auto major = std::from_chars(text.data(), end, parsed.lod.major);
  if (major.ec != std::errc() || parsed.lod.major < 0) return std::nullopt;
  if (major.ptr == end) return parsed;
  if (*major.ptr != '.') return std::nullopt;
  const auto minor = std::from_chars(major.ptr + 1, end, parsed.lod.minor);
  if (minor.ec != std::errc() || minor.ptr != end || parsed.lod.minor < 0) return std::nullopt;
  parsed.has_minor = true;
  return parsed;
}

}  // namespace

Lod lod_of(std::string_view text) {
  const auto parsed = parse_lod(text);
  return parsed ? parsed->lod : Lod{};
}

LodWish::LodWish(const std::string& text, const std::string& file)
    : text_(text), highest_(text == "highest") {
  if (highest_) return;
  const auto parsed = parse_lod(text);
  if (!parsed) {
    throw InputError({file}, "lod: " + text, "must be highest or a level such as 2 or 2.2");
  }
  lod_ = parsed->lod;
  any_minor_ = !parsed->has_minor;
}

LodRank LodWish::rank(Lod lod) const {
  const bool matches = any_minor_ ? lod.major == lod_.major : lod == lod_;
  if (highest_ || matches) return {met, lod.major, lod.minor};
  if (lod < lod_) return {below, lod.major, lod.minor};
  return {above, -lod.major, -lod.minor};
}

bool LodWish::is_met_by(const LodRank& rank) const { return rank[0] == met; }

WholeOrParts unstacked(const LodRank& whole, std::span<const LodRank> parts, NoteCounter& notes) {
  const LodRank best = *std::max_element(parts.begin(), parts.end());
  if (whole < best) {
    notes.count("objects whose parts have a better level of detail: their own geometry left out");
    return WholeOrParts::parts;
  }
  if (best < whole) {
    notes.count("parts of objects with a better level of detail left out", parts.size());
    return WholeOrParts::whole;
  }
  return WholeOrParts::both;
}

}  // namespace sunload
