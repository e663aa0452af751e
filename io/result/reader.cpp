// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/reader.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <new>
#include <numeric>

#include "geo/base/check.h"
#include "io/base/names.h"
#include "io/result/h5.h"
#include "io/result/part_of_period.h"
#include "io/result/schema.h"
#include "io/result/seal.h"
#include "io/result/soundness.h"
#include "solver/base/spread.h"

namespace sunload {

namespace {

// Sums over all patches and instants of values below it are numbers, and series hold it as floats.
constexpr double largest_value = 1e30;

constexpr std::string_view error_ending = "_se";

/// The total that these errors are of.
std::string total_of_error(const std::string& error) {
  return error.substr(0, error.size() - error_ending.size());
}

}  // namespace

struct ResultReader::File {
  std::string path;
  h5::File file;
  Bands bands = Bands::broadband;
  std::optional<std::size_t> band = {};
  PeriodChoice choice = {};
  std::optional<PartOfPeriod> part = {};  ///< of the period, where one is chosen
  /// The total that was asked for last: realizations are asked for one by one.
  std::pair<std::string, std::vector<double>> last_total = {};
  mutable std::deque<std::pair<std::string, h5::Dataset>> open_by_rows = {};

  bool is_of_part(const std::string& dataset) const { return part && part->tells(dataset); }
  /// A total of the chosen part of the period.
  const std::vector<double>& total(const std::string& dataset) {
    if (!part->has(dataset)) refuse("there is no dataset " + dataset, "of " + choice.words());
    if (last_total.first != dataset) last_total = {dataset, part->values(dataset)};
    return last_total.second;
  }

  bool is_banded(const std::string& dataset) const {
    if (bands == Bands::broadband) return false;
    const ResultVariable* variable = find_result_variable(dataset);
    return variable != nullptr && has_bands(*variable);
  }

  /// Of errors of the bands' mean: whether they can be had from realizations.
  bool has_realizations_of_bands(const std::string& dataset) const {
    if (band || !is_banded(dataset) || !dataset.ends_with(error_ending)) return false;
    const std::string realizations = realizations_of(total_of_error(dataset));
    return !realizations.empty() && file.has(dataset) && file.has(realizations);
  }

  /// Where the dimension of bands stands: last in the ledger, else before the last.
  std::size_t band_axis(const std::string& dataset, const std::vector<std::size_t>& shape) const {
    const bool is_last = find_result_variable(dataset)->part == ResultPart::ledger;
    const std::size_t behind = is_last ? 1 : 2;
    if (shape.size() < behind || shape[shape.size() - behind] != band_count)
      refuse("dataset " + dataset + " cannot be read", "it has no dimension of bands");
    return shape.size() - behind;
  }

  std::vector<std::size_t> without_bands(const std::string& dataset,
                                         std::vector<std::size_t> shape) const {
    if (is_banded(dataset))
      shape.erase(shape.begin() + static_cast<std::ptrdiff_t>(band_axis(dataset, shape)));
    return shape;
  }

  /// Values of rows of a dataset of that shape: of the chosen band, or the bands' mean.
  std::vector<double> without_bands(const std::string& dataset, std::vector<double> values,
                                    const std::vector<std::size_t>& shape) const {
    if (!is_banded(dataset)) return values;
    const std::size_t axis = band_axis(dataset, shape);
    const std::size_t n = axis + 1 < shape.size() ? shape.back() : 1;
    const std::size_t rows = n > 0 ? values.size() / (band_count * n) : 0;
    std::vector<double> chosen(rows * n);
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t i = 0; i < n; ++i) {
        const auto at = [&](std::size_t b) { return values[(row * band_count + b) * n + i]; };
        chosen[row * n + i] = band ? at(*band) : mean_of({at(0), at(1), at(2)});
      }
    return chosen;
  }

  /// Values as they are: numbers that light can have, or NaN for what is not known.
  std::vector<double> possible(const std::string& dataset, std::vector<double> values) const {
    const auto wrong = std::find_if(values.begin(), values.end(),
                                    [](double x) { return std::abs(x) > largest_value; });
    if (wrong != values.end())
      refuse("dataset " + dataset + " cannot be used",
             fmt::format("it has {} among its values", *wrong));
    return values;
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& why) const {
    throw InputError({path}, what, why);
  }

  /// A dataset that is read by its rows stays open until two others are.
  const h5::Dataset& by_rows(const std::string& dataset) const {
    constexpr std::size_t most_open = 2;
    const auto found = std::find_if(open_by_rows.begin(), open_by_rows.end(),
                                    [&](const auto& open) { return open.first == dataset; });
    if (found != open_by_rows.end()) return found->second;
    if (open_by_rows.size() == most_open) open_by_rows.pop_front();
    return open_by_rows.emplace_back(dataset, file.dataset(dataset, h5::File::Access::rows)).second;
  }

  /// Does something with a dataset; every error names file and dataset.
  template <class Action>
  auto with(const std::string& dataset, const Action& action,
            h5::File::Access access = h5::File::Access::whole) const {
    try {
      if (!file.has(dataset)) refuse("there is no dataset " + dataset, "");
      if (access == h5::File::Access::rows) return action(by_rows(dataset));
      return action(file.dataset(dataset));
    } catch (const h5::Error& error) {
      refuse("dataset " + dataset + " cannot be read", error.what());
    } catch (const std::bad_alloc&) {
      refuse("dataset " + dataset + " cannot be read", "it does not fit into memory");
    }
  }
};

namespace {

double one_number(const h5::Object& object, const std::string& attribute) {
  const auto values = object.numbers(attribute);
  const bool is_known = values && values->size() == 1 && std::abs(values->front()) <= largest_value;
  return is_known ? values->front() : std::numeric_limits<double>::quiet_NaN();
}

h5::File opened(const std::string& path, Opens opens) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError({path}, "there is no such file");
  if (::access(path.c_str(), R_OK) != 0)
    throw InputError({path}, "cannot be read", std::strerror(errno));
  const auto refuse_damage = [&](const std::string& problem) {
    if (!problem.empty())
      throw InputError({path}, "is damaged", problem, "run the study again with --overwrite");
  };
  try {
    refuse_damage(seal_problem(path));
    h5::File file = h5::File::open(path);
    refuse_damage(end_problem(path, file));
    const auto format = file.text("sunload_format");
    if (!format) throw InputError({path}, "is not a result of sunload", "no sunload_format");
    const bool is_wanted =
        *format == result_format || (opens == Opens::derived_too &&
                                     (*format == comparison_format || *format == place_map_format));
    for (const auto& [derived, words] :
         {std::pair{comparison_format, "a comparison"}, {place_map_format, "a map of a place"}})
      if (!is_wanted && *format == derived)
        throw InputError({path}, std::string("is ") + words + ", no result",
                         "it has a value per patch, and no suns and times",
                         "render and export show it; name the result that it was made of");
    if (!is_wanted) {
      throw InputError({path}, "has the format " + *format,
                       "this program reads " + std::string(result_format));
    }
    expect_sound(path, file);
    return file;
  } catch (const h5::Error& problem) {
    throw InputError({path}, "is not a readable HDF5 file", problem.what(),
                     "name a result of sunload run (sunload check reads studies and models); a "
                     "damaged one: remove it, and run its study with --resume");
  }
}

}  // namespace

ResultReader::ResultReader(const std::string& path, std::optional<std::size_t> band, Opens opens)
    : file_(std::make_unique<File>(File{path, opened(path, opens)})) {
  file_->bands = has("band") ? Bands::rgb : Bands::broadband;
  file_->band = band;
  if (band && file_->bands == Bands::broadband)
    file_->refuse("has no bands", "its study was computed without solver.bands: rgb");
}

ResultReader::~ResultReader() = default;

void ResultReader::choose(const PeriodChoice& choice) {
  file_->part.reset();
  file_->last_total = {};
  file_->choice = choice;
  if (choice.any()) file_->part.emplace(*this, choice);
}

const PeriodChoice& ResultReader::chosen() const { return file_->choice; }

std::vector<double> ResultReader::chosen_shares() const {
  if (file_->part) return file_->part->shares();
  return std::vector<double>(shape("time").front(), 1);
}

const std::string& ResultReader::path() const { return file_->path; }

bool ResultReader::is_comparison() const {
  return text_attribute("sunload_format") == comparison_format;
}

std::string ResultReader::compared() const {
  const std::string other = text_attribute("compared");
  return other.empty() ? std::string(usual_compared) : other;
}

bool ResultReader::is_place_map() const {
  return text_attribute("sunload_format") == place_map_format;
}

bool ResultReader::has(const std::string& dataset) const {
  try {
    return file_->file.has(dataset) && (!file_->is_of_part(dataset) || file_->part->has(dataset));
  } catch (const h5::Error& error) {
    file_->refuse("cannot be read", error.what());
  }
}

std::vector<std::size_t> ResultReader::shape(const std::string& dataset) const {
  return file_->with(dataset, [&](const h5::Dataset& data) {
    return file_->without_bands(dataset, data.shape());
  });
}

namespace {

/// Standard errors of the bands' mean, from its realizations: bands share lines, so that theirs do
/// not tell it.
std::vector<double> error_of_mean_of_bands(const ResultReader& result, const std::string& error) {
  const std::string realizations = realizations_of(total_of_error(error));
  const auto values = result.doubles(realizations);
  const std::size_t count = result.shape(realizations).front();
  const std::size_t receivers = count > 0 ? values.size() / count : 0;
  if (const auto wanted = result.shape(error);
      receivers !=
      std::accumulate(wanted.begin(), wanted.end(), std::size_t{1}, std::multiplies<>()))
    throw InputError({result.path()}, "dataset " + realizations + " cannot be read",
                     "it has other receivers than " + error);
  std::vector<double> errors(receivers);
  for (std::size_t i = 0; i < receivers; ++i)
    errors[i] = standard_error(
        variance_of(count, [&](std::size_t r) { return values[r * receivers + i]; }), count);
  return errors;
}

}  // namespace

std::vector<double> ResultReader::doubles(const std::string& dataset) const {
  if (file_->is_of_part(dataset)) return file_->total(dataset);
  if (file_->has_realizations_of_bands(dataset)) return error_of_mean_of_bands(*this, dataset);
  if (const std::string of_mean = largest_of_mean_dataset(dataset);
      file_->is_banded(dataset) && !file_->band && has(of_mean))
    return doubles(of_mean);
  return file_->with(dataset, [&](const h5::Dataset& data) {
    return file_->without_bands(dataset, file_->possible(dataset, data.doubles()), data.shape());
  });
}

std::vector<std::int32_t> ResultReader::integers(const std::string& dataset) const {
  return file_->with(dataset, [](const h5::Dataset& data) { return data.integers(); });
}

std::vector<std::string> ResultReader::strings(const std::string& dataset) const {
  return file_->with(dataset, [](const h5::Dataset& data) { return data.strings(); });
}

std::vector<double> ResultReader::row(const std::string& dataset, std::size_t time) const {
  return rows(dataset, time, 1);
}

std::vector<double> ResultReader::rows(const std::string& dataset, std::size_t first,
                                       std::size_t count) const {
  if (file_->is_of_part(dataset)) {
    const auto& all = file_->total(dataset);
    const std::size_t of_row = all.size() / std::max<std::size_t>(shape(dataset).front(), 1);
    SUNLOAD_EXPECT((first + count) * of_row <= all.size(), "rows of " + dataset);
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first * of_row);
    return {begin, begin + static_cast<std::ptrdiff_t>(count * of_row)};
  }
  return file_->with(
      dataset,
      [&](const h5::Dataset& data) {
        return file_->without_bands(dataset, file_->possible(dataset, data.rows(first, count)),
                                    data.shape());
      },
      h5::File::Access::rows);
}

std::string ResultReader::units(const std::string& dataset) const {
  return file_->with(dataset,
                     [](const h5::Dataset& data) { return data.text("units").value_or(""); });
}

std::string ResultReader::text_attribute(const std::string& name) const {
  try {
    return without_controls(file_->file.text(name).value_or(""));
  } catch (const h5::Error& error) {
    file_->refuse("attribute " + name + " cannot be read", error.what());
  }
}

std::string ResultReader::text_attribute(const std::string& dataset,
                                         const std::string& name) const {
  return file_->with(dataset, [&](const h5::Dataset& data) {
    return without_controls(data.text(name).value_or(""));
  });
}

std::vector<double> ResultReader::number_attributes(const std::string& dataset,
                                                    const std::string& name) const {
  return file_->with(dataset, [&](const h5::Dataset& data) {
    return data.numbers(name).value_or(std::vector<double>{});
  });
}

double ResultReader::number_attribute(const std::string& dataset, const std::string& name) const {
  return file_->with(dataset, [&](const h5::Dataset& data) {
    const auto values = data.numbers(name);
    if (!file_->is_banded(dataset) || !values || values->size() != band_count)
      return one_number(data, name);
    return file_->band ? (*values)[*file_->band]
                       : mean_of({(*values)[0], (*values)[1], (*values)[2]});
  });
}

Bands ResultReader::bands() const { return file_->bands; }
std::optional<std::size_t> ResultReader::band() const { return file_->band; }

Quantity ResultReader::quantity() const {
  return text_attribute("quantity") == "illuminance" ? Quantity::illuminance : Quantity::irradiance;
}

Vec3 ResultReader::origin() const {
  try {
    const auto origin = file_->file.numbers("origin");
    return origin && origin->size() == 3 ? Vec3{(*origin)[0], (*origin)[1], (*origin)[2]} : Vec3{};
  } catch (const h5::Error& error) {
    file_->refuse("attribute origin cannot be read", error.what());
  }
}

double ResultReader::number_attribute(const std::string& name) const {
  try {
    return one_number(file_->file, name);
  } catch (const h5::Error& error) {
    file_->refuse("attribute " + name + " cannot be read", error.what());
  }
}

}  // namespace sunload
