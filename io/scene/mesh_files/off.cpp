// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/off.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/scene/base/indexed_faces.h"
#include "io/scene/base/words.h"

namespace sunload {

namespace {

class OffReader {
 public:
  OffReader(const std::string& path, const SceneFileRules& rules)
      : path_(path), text_(read_text_file(path)), words_(text_), faces_(path, rules, 'z') {}

  PolygonModel read() {
    auto word = next_word();
    if (word.ends_with("OFF")) {
      for (const char c : word.substr(0, word.size() - 3)) {
        if (c == '4' || c == 'n') fail(word, "has four or more dimensions", "a scene has three");
      }
      word = next_word();
      if (word == "BINARY") fail(word, "is a binary OFF file", "only the text form is read");
    }
    const auto vertices = count(word), faces = count(next_word());
    count(next_word());                     // edges, which nobody needs
    constexpr std::size_t least_bytes = 2;  // of a number and its blank
    if (vertices > text_.size() / least_bytes || faces > text_.size() / least_bytes)
      fail({}, "is too short for what its header promises", "is the file cut off?");
    faces_.expect(vertices, faces);
    for (std::size_t v = 0; v < vertices; ++v) read_vertex();
    for (std::size_t f = 0; f < faces; ++f) read_face(vertices);
    return faces_.finish();
  }

 private:
  [[noreturn]] void fail(std::string_view word, const std::string& what,
                         const std::string& why = {}, const std::string& hint = {}) const {
    throw InputError(place_in_text(path_, text_, words_.byte_of(word)), what, why, hint);
  }

  /// The next word on this line or a later one.
  std::string_view next_word() {
    for (auto word = words_.next();; word = words_.next()) {
      if (!word.empty()) return word;
      if (words_.at_end()) fail({}, "the file ends too early", "is it cut off?");
      words_.go_to_next_line();
    }
  }

  /// A whole number; nothing for others.
  static std::optional<std::size_t> whole_number(std::string_view word) {
    const auto value = finite_number(word);
    if (!value || *value < 0 || *value > std::numeric_limits<std::int32_t>::max() ||
        std::floor(*value) != *value)
      return {};
    return static_cast<std::size_t>(*value);
  }

  std::size_t count(std::string_view word) const {
    const auto value = whole_number(word);
    if (!value) fail(word, "'" + shortened(word) + "' is no number of vertices, faces or edges");
    return *value;
  }

  void read_vertex() {
    std::array<double, 3> xyz{};
    std::string_view word;
    for (auto& coordinate : xyz) {
      word = next_word();
      const auto value = finite_number(word);
      if (!value)
        fail(word, "'" + shortened(word) + "' is no finite number", "a coordinate was expected");
      coordinate = *value;
    }
    if (!faces_.add_vertex({xyz[0], xyz[1], xyz[2]}))
      fail(word, "vertex beyond all coordinates on Earth", "no map projection reaches 1e9 m",
           "is unit_m right?");
    words_.go_to_next_line();  // normals, colours, texture coordinates
  }

  void read_face(std::size_t vertices) {
    const auto corners = count(next_word());
    for (std::size_t k = 0; k < corners; ++k) {
      const auto word = next_word();
      const auto value = whole_number(word);
      if (!value || *value >= vertices)
        fail(word, "vertex index " + shortened(word) + " is out of range",
             std::to_string(vertices) + " vertices were read, counted from 0");
      faces_.add_corner(static_cast<std::int32_t>(*value));
    }
    faces_.end_face();
    if (!words_.next().empty()) faces_.notes().count("colours per face ignored");
    words_.go_to_next_line();
  }

  std::string path_;
  std::string text_;
  Words words_;
  IndexedFaces faces_;
};

}  // namespace

PolygonModel read_scene_off(const std::string& path, const SceneFileRules& rules) {
  return OffReader(path, rules).read();
}

}  // namespace sunload
