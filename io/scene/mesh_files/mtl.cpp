// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/mtl.h"

#include <array>
#include <optional>
#include <string_view>

#include "io/scene/base/words.h"

namespace sunload {

namespace {

/// One material as it stands in the library, before its statements are weighed.
struct Entry {
  std::optional<std::array<double, 3>> diffuse, specular;
  std::optional<double> dissolve, transparency;  // d = 1 - Tr
  double illumination_model = 0;
  bool glows = false;
};

constexpr double largest_glow = 1e12;  // Ke has no unit, and no upper end
constexpr std::array<double, 3> black{};
double mean(const std::array<double, 3>& rgb) { return (rgb[0] + rgb[1] + rgb[2]) / 3; }

bool asks_for_reflected_rays(double illumination_model) {
  return illumination_model == 3 || (illumination_model >= 5 && illumination_model <= 9);
}

class LibraryReader {
 public:
  LibraryReader(const std::string& path, NoteCounter& notes)
      : path_(path), text_(read_text_file(path)), words_(text_), notes_(notes) {}

  std::map<std::string, LibraryMaterial> read() {
    for (; !words_.at_end(); words_.go_to_next_line()) read_statement(words_.next());
    std::map<std::string, LibraryMaterial> materials;
    for (const auto& [name, entry] : entries_)
      materials[name] = {weighed(name, entry), is_transparent(entry)};
    return materials;
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "newmtl") current_ = &entries_[std::string(words_.rest())];
    if (current_ == nullptr) return;
    if (keyword == "Kd") current_->diffuse = colour();
    if (keyword == "Ks") current_->specular = colour();
    if (keyword == "Ke") current_->glows = mean(colour(largest_glow).value_or(black)) > 0;
    if (keyword == "d") current_->dissolve = dissolve();
    if (keyword == "Tr") current_->transparency = finite_number(words_.next());
    if (keyword == "map_Kd" || keyword == "map_d") notes_.count("textures of materials ignored");
    if (keyword == "illum") current_->illumination_model = number(words_.next());
  }

  /// `r g b`, or `r` alone for grey; nothing for spectra and CIE colours.
  std::optional<std::array<double, 3>> colour(double largest = 1) {
    const auto first = words_.next();
    if (first == "spectral" || first == "xyz") {
      notes_.count("colours by spectrum or CIE XYZ ignored");
      return std::nullopt;
    }
    std::array<double, 3> rgb{};
    rgb[0] = number(first);
    const auto second = words_.next();
    rgb[1] = second.empty() ? rgb[0] : number(second);
    rgb[2] = second.empty() ? rgb[0] : number(words_.next());
    if (largest > 1 ? mean(rgb) >= 0 && mean(rgb) <= largest : FileMaterial().set_diffuse(rgb))
      return rgb;
    notes_.count("colours outside [0, 1] ignored");
    return std::nullopt;
  }

  /// `share`, or `-halo share`: seen along the normal. For looks only, so that no other word hurts.
  std::optional<double> dissolve() {
    const auto first = words_.next();
    return finite_number(first == "-halo" ? words_.next() : first);
  }

  /// Some programs write both, and Tr with the meaning of d.
  static bool is_transparent(const Entry& entry) {
    return entry.dissolve ? *entry.dissolve < 1 : entry.transparency.value_or(0) > 0;
  }

  double number(std::string_view word) const {
    const auto value = finite_number(word);
    if (!value) {
      throw InputError(place_in_text(path_, text_, words_.byte_of(word)),
                       "'" + shortened(word) + "' is no finite number",
                       "a value of a material was expected");
    }
    return *value;
  }

  FileMaterial weighed(const std::string& name, const Entry& entry) {
    FileMaterial material;
    material.name = name;
    if (entry.diffuse) material.set_diffuse(*entry.diffuse);
    material.glows = entry.glows;
    if (asks_for_reflected_rays(entry.illumination_model)) {
      if (entry.specular) material.mirror = mean(*entry.specular);
    } else if (entry.specular && mean(*entry.specular) > 0) {
      notes_.count(
          "materials whose Ks is a highlight, not a mirror (illum asks for no "
          "reflected rays)");
    }
    return material;
  }

  std::string path_;
  std::string text_;
  Words words_;
  NoteCounter& notes_;
  std::map<std::string, Entry> entries_;
  Entry* current_ = nullptr;
};

}  // namespace

std::map<std::string, LibraryMaterial> read_material_library(const std::string& path,
                                                             NoteCounter& notes) {
  return LibraryReader(path, notes).read();
}

}  // namespace sunload
