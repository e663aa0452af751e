// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/part_merge.h"

#include <algorithm>

#include "geo/base/units.h"

namespace sunload {

namespace {

/// Of the intervals of a batch; empty where the part has no time in it.
std::vector<double> shares_of(const PeriodPart& part, std::size_t first, std::size_t count) {
  const auto is_before = [](const PartShare& share, std::size_t interval) {
    return share.interval < interval;
  };
  const auto& all = part.intervals;
  const auto begin = std::lower_bound(all.begin(), all.end(), first, is_before);
  const auto end = std::lower_bound(begin, all.end(), first + count, is_before);
  if (begin == end) return {};
  std::vector<double> shares(count, 0);
  for (auto share = begin; share != end; ++share) shares[share->interval - first] = share->share;
  return shares;
}

std::string kind_name(const PeriodDivision& division) {
  return part_kind_names[static_cast<std::size_t>(division.kind)];
}

}  // namespace

BatchParts parts_of_batch(const std::vector<PartTotals>& totals, std::size_t first,
                          std::size_t count) {
  BatchParts parts;
  std::size_t number = 0;
  for (const auto& [division, with_errors] : totals)
    for (const auto& part : division.parts) {
      BatchParts::Source source{number++, with_errors, {}};
      auto shares = shares_of(part, first, count);
      if (shares.empty()) continue;
      const bool is_all =
          std::all_of(shares.begin(), shares.end(), [](double share) { return share == 1; });
      if (!is_all) {
        const auto alike = std::find_if(parts.solved.begin(), parts.solved.end(),
                                        [&](const auto& of) { return of.share == shares; });
        source.solved = static_cast<std::size_t>(alike - parts.solved.begin());
        if (alike == parts.solved.end())
          parts.solved.push_back({std::move(shares), with_errors});
        else
          alike->with_errors = alike->with_errors || with_errors;
      }
      parts.sources.push_back(source);
    }
  return parts;
}

std::vector<ResultDivision> result_divisions(const VariantPlan& plan) {
  std::vector<ResultDivision> divisions;
  for (const auto& [division, with_errors] : plan.totals) {
    ResultDivision of{kind_name(division), {}, {}, {}, with_errors};
    for (const auto& part : division.parts) {
      of.label.push_back(part.label);
      of.duration_h.push_back(part.duration_s / seconds_per_hour);
      if (part.bounds[1] > part.bounds[0]) of.bounds.push_back(part.bounds);
    }
    divisions.push_back(std::move(of));
  }
  return divisions;
}

PartMerge::PartMerge(ResultWriter& writer, const VariantPlan& plan, const ResultGeometry& geometry)
    : writer_(writer, plan.study.solver.bands),
      realizations_(static_cast<std::size_t>(plan.study.solver.realizations)),
      patches_(geometry.patch_area.size()),
      facades_(geometry.facade_name.size()),
      sensors_(geometry.sensor_position.size()),
      means_(geometry.patch_facade, geometry.patch_area, facades_) {
  for (const auto& [division, with_errors] : plan.totals)
    for (std::size_t row = 0; row < division.parts.size(); ++row)
      places_.push_back({kind_name(division), row,
                         division.parts[row].intervals.back().interval / plan.batch_suns(),
                         with_errors});
}

void PartMerge::add(const BatchReader& batch) {
  for (const ArraySpec& spec : batch.arrays()) {
    const PartArray array = part_array(spec.name);
    if (array.part) open_[*array.part].add(array.name, spec.rule, batch.doubles(spec.name));
  }
  for (auto part = open_.begin(); part != open_.end();) {
    if (places_.at(part->first).last_batch > batch.header().batch) {
      ++part;
    } else {
      write(part->first, part->second);
      part = open_.erase(part);
    }
  }
}

void PartMerge::finish() {
  for (const auto& [part, totals] : open_) write(part, totals);
  open_.clear();
}

void PartMerge::write(std::size_t part, const Totals& totals) {
  const Place& place = places_.at(part);
  write_received(place, totals, "", patches_);
  if (sensors_ > 0) write_received(place, totals, sensor_prefix, sensors_);
  if (facades_ == 0) return;
  const std::string name = "facade_light_load_by_" + place.kind;
  const auto of_facades = [&](const char* of) {
    return [&totals, of, this](const std::string& band) {
      return means_.of(scaled(totals[band + of], kwh_per_joule), Divided::terms);
    };
  };
  const std::string total = sum_name(Part::total);
  writer_.write_part(name, place.row, 1, of_facades(total.c_str()));
  if (!place.with_errors) return;
  const auto of_realizations = of_facades(batch_array::exposure);
  writer_.write_part(name + "_realization", place.row, realizations_, of_realizations);
  writer_.write_part(name + "_se", place.row, 1, [&](const std::string& band) {
    return errors_of(of_realizations(band), facades_);
  });
}

void PartMerge::write_received(const Place& place, const Totals& totals, const std::string& prefix,
                               std::size_t receivers) {
  const auto of = [&](const std::string& array) {
    return [&totals, name = prefix + array](const std::string& band) {
      return scaled(totals[band + name], kwh_per_joule);
    };
  };
  const std::string by = "_by_" + place.kind, name = prefix + "light_load" + by;
  writer_.write_part(name, place.row, 1, of(sum_name(Part::total)));
  if (totals.has(writer_.first() + prefix + sum_name(Part::direct)))
    writer_.write_part(prefix + "light_load_direct" + by, place.row, 1, of(sum_name(Part::direct)));
  writer_.write_part_once(prefix + "sun_hours" + by, place.row,
                          scaled(totals[prefix + batch_array::sunlit], 1 / seconds_per_hour));
  if (!place.with_errors) return;
  const auto of_realizations = of(batch_array::exposure);
  writer_.write_part(name + "_realization", place.row, realizations_, of_realizations);
  writer_.write_part(name + "_se", place.row, 1, [&](const std::string& band) {
    return errors_of(of_realizations(band), receivers);
  });
}

}  // namespace sunload
