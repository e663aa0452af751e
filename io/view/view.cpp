// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view/view.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <deque>
#include <fstream>
#include <set>

#include "geo/base/check.h"
#include "io/base/colour_map.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"
#include "io/base/scene_colours.h"
#include "io/base/standard_streams.h"
#include "io/result/lacking.h"
#include "io/view/data.h"
#include "io/view/page.h"

namespace sunload {
namespace {

// Halves of all series together; deflate and base64 leave about five sixths of
// them, and geometry and totals take a few megabytes more.
constexpr std::size_t most_series_bytes = 60'000'000;
constexpr std::size_t most_results = 2;
constexpr std::size_t palette_colours = 256;

std::size_t chosen_step(const std::deque<ResultReader>& results) {
  std::size_t bytes = 0;
  for (const auto& result : results)
    if (const auto name = viewed_series(result); !name.empty())
      bytes += 2 * result.shape(name).at(0) * result.shape(name).at(1);
  return std::max<std::size_t>(1, (bytes + most_series_bytes - 1) / most_series_bytes);
}

/// sRGB colours, 3 numbers of 0 … 255 each; `colour_of` a number from 0.
template <class ColourOf>
nlohmann::json colours(std::size_t count, const ColourOf& colour_of) {
  auto list = nlohmann::json::array();
  for (std::size_t k = 0; k < count; ++k) {
    const Colour colour = colour_of(k);
    for (const double channel : {colour.red, colour.green, colour.blue})
      list.push_back(static_cast<int>(std::lround(255 * channel)));
  }
  return list;
}

nlohmann::json palette(Palette which) {
  return colours(palette_colours, [&](std::size_t k) {
    return map_colour(which, static_cast<double>(k) / (palette_colours - 1));
  });
}

/// Number of the colour of each material by its name, so that it has one in all results.
nlohmann::json colours_of_materials(const std::deque<ResultReader>& results) {
  std::set<std::string> all;
  for (const auto& result : results) {
    if (!result.has("material_name")) continue;
    const auto of_result = result.strings("material_name");
    all.insert(of_result.begin(), of_result.end());
  }
  const std::vector<std::string> names(all.begin(), all.end());
  const auto colours = material_colours(names);
  auto numbers = nlohmann::json::object();
  for (std::size_t i = 0; i < names.size(); ++i) numbers[names[i]] = colours[i];
  return numbers;
}

TwoResults what_two_share(const std::deque<ResultReader>& results, std::size_t step) {
  const ResultReader &first = results.front(), &second = results.back();
  const std::string series = viewed_series(first);
  return two_results(first, second, series == viewed_series(second) ? series : "", step);
}

/// JSON that cannot end the element it stands in, whatever the names of a scene are.
std::string script_text(const nlohmann::json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    c == '<' ? text += "\\u003c" : text += c;
  return text;
}

void write_page(std::ostream& page, const nlohmann::json& about, const ViewBlocks& blocks) {
  for (const auto piece : viewer_page_head()) page << piece;
  page << "<script type=\"application/json\" id=\"about\">" << script_text(about) << "</script>\n";
  for (std::size_t k = 0; k < blocks.base64.size(); ++k)
    page << "<script type=\"text/plain\" id=\"block-" << k << "\">" << blocks.base64[k]
         << "</script>\n";
  for (const auto piece : viewer_page_tail()) page << piece;
}

}  // namespace

void view_html(const std::vector<std::string>& paths, const ViewRules& rules,
               const std::string& path) {
  if (viewer_page_head().empty())
    throw MachineError(
        "the viewer's page is not part of this build, because npm was missing or could not install "
        "its packages; install npm (Debian: npm) and build again");
  if (paths.size() > most_results)
    throw InputError({}, fmt::format("view of {} results", paths.size()),
                     "a page shows one result or two side by side", "name at most two");
  std::deque<ResultReader> results;
  for (const auto& name : paths) results.emplace_back(name, rules.band).choose(rules.period);
  if (results.back().quantity() != results.front().quantity())
    throw InputError({results.back().path()},
                     "is of another quantity than " + results.front().path(),
                     "irradiance and illuminance have no scale in common", "view each by itself");
  const std::size_t step = rules.step.value_or(chosen_step(results));
  if (step > 1)
    tell(fmt::format("{}: holds every {}. interval only{}", path, step,
                     rules.step ? "" : ", to stay small; --step sets this"));

  ViewBlocks blocks;
  nlohmann::json about{
      {"false", palette(Palette::false_colour)},
      {"grey", palette(Palette::grey)},
      {"no_value",
       {{"false", colours(1, [](std::size_t) { return no_value_colour(Palette::false_colour); })},
        {"grey", colours(1, [](std::size_t) { return no_value_colour(Palette::grey); })}}},
      {"surfaces", colours(surface_colour_count, surface_colour)},
      {"materials", colours(material_colour_count, material_colour)},
      {"colour_of_material", colours_of_materials(results)}};
  for (const auto& result : results) {
    warn_of_lacking(result);
    if (result.shape("patch_area").at(0) == 0)
      throw InputError({result.path()}, "no patches", "there is nothing to view");
    about["results"].push_back(view_data(result, step, blocks));
  }
  if (results.size() > 1) about["two"] = view_data(what_two_share(results, step), blocks);
  FileAside file(path);
  errno = 0;
  std::ofstream page(file.aside(), std::ios::binary);
  write_page(page, about, blocks);
  page.close();
  if (!page) throw_cannot_write(path, errno);
  file.publish();
}

}  // namespace sunload
