// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "geo/base/check.h"
#include "geo/time/time.h"
#include "io/base/text.h"
#include "io/export/format.h"

namespace sunload {
namespace {

/// Text in an element or attribute of XML 1.0, which knows no control characters but blanks.
std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return escaped;
}

/// The result as seen from the folder of the XDMF file.
std::string reference(const ResultReader& result, const std::string& path) {
  namespace fs = std::filesystem;
  // Links on the way lead elsewhere than their names.
  const auto folder = fs::weakly_canonical(fs::absolute(path).parent_path());
  const auto result_folder = fs::weakly_canonical(fs::absolute(result.path()).parent_path());
  const auto file = (result_folder / fs::path(result.path()).filename()).lexically_relative(folder);
  if (file.string().find_first_of(":\n\r") != std::string::npos)
    throw InputError({result.path()}, "XDMF cannot name this file",
                     "a colon parts the file from the dataset", "rename the result or its folder");
  return file.string();
}

std::string item(const std::string& file, const std::string& dataset, const std::string& shape,
                 const char* type, int precision) {
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" "
      "Format=\"HDF\">{}:/{}</DataItem>",
      shape, type, precision, xml_text(file), dataset);
}

std::string attribute(const std::string& name, const std::string& data) {
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n",
      name, data);
}

/// One grid: the mesh and the totals, and the row `interval` of every series.
class Grid {
 public:
  Grid(const ResultReader& result, std::string file, std::vector<std::string> series)
      : file_(std::move(file)),
        series_(std::move(series)),
        patches_(result.shape("patch_area").front()),
        intervals_(result.shape("time").front()) {
    const auto vertices = result.shape("vertex_position").front();
    const std::string count = std::to_string(patches_);
    fixed_ = fmt::format(
        "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n"
        "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        patches_, item(file_, "patch_vertices", count + " 3", "Int", 4),
        item(file_, "vertex_position", std::to_string(vertices) + " 3", "Float", 8));
    for (const auto& name : patch_datasets(result, PatchDatasets::totals))
      fixed_ += attribute(name, item(file_, name, count, "Float", 8));
    for (const char* name : {"patch_object", "patch_facade", "patch_material"})
      fixed_ += attribute(name, item(file_, name, count, "Int", 4));
    for (const char* name : {"patch_surface", "patch_side"})
      fixed_ += attribute(name, item(file_, name, count, "Char", 1));
  }

  std::string text(std::size_t interval, double time, const std::string& name) const {
    std::string out = fmt::format(
        "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n{}", name,
        time, fixed_);
    const std::string whole = fmt::format("{} {}", intervals_, patches_);
    for (const auto& series : series_)
      out += attribute(
          series,
          fmt::format("<DataItem ItemType=\"HyperSlab\" Dimensions=\"1 {}\">"
                      "<DataItem Dimensions=\"3 2\" Format=\"XML\">{} 0 1 1 1 {}</DataItem>{}"
                      "</DataItem>",
                      patches_, interval, patches_, item(file_, series, whole, "Float", 4)));
    return out + "      </Grid>\n";
  }

 private:
  std::string file_;
  std::vector<std::string> series_;
  std::size_t patches_, intervals_;
  std::string fixed_;
};

std::vector<std::string> chosen_series(const ResultReader& result, const ExportRules& rules) {
  if (!rules.time.empty())
    throw InputError({}, "--time with --to xdmf", "the file holds all intervals", "leave it out");
  auto all = patch_datasets(result, PatchDatasets::series);
  if (rules.quantity.empty()) return all;
  if (std::find(all.begin(), all.end(), rules.quantity) != all.end()) return {rules.quantity};
  shown_quantity(result, rules.quantity, "");  // refuses what is not known
  throw InputError({}, "--quantity " + rules.quantity + " with --to xdmf",
                   "all totals are in the file; the option chooses one of the stored series",
                   "leave it out");
}

}  // namespace

void export_xdmf(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  if (result.bands() != Bands::broadband)
    throw InputError({result.path()}, "--to xdmf cannot show a result in bands",
                     "it refers to the series of the file as they lie there, with three bands",
                     "export to vtk, ply or csv, with --band for one of them");
  const Grid grid(result, reference(result, target.path), chosen_series(result, rules));
  const auto time = result.doubles("time");
  const Vec3 origin = result.origin();
  auto& out = target.stream;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      << fmt::format("    <Information Name=\"origin\" Value=\"{} {} {}\"/>\n", origin.x, origin.y,
                     origin.z)
      << "    <Grid Name=\"intervals\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < time.size(); ++k) out << grid.text(k, time[k], iso_utc(time[k]));
  out << "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace sunload
