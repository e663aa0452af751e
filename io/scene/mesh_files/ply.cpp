// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "io/scene/base/indexed_faces.h"
#include "io/scene/base/words.h"

namespace sunload {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr std::array type_names{
    TypeName{"char", Type::int8},      TypeName{"int8", Type::int8},
    TypeName{"uchar", Type::uint8},    TypeName{"uint8", Type::uint8},
    TypeName{"short", Type::int16},    TypeName{"int16", Type::int16},
    TypeName{"ushort", Type::uint16},  TypeName{"uint16", Type::uint16},
    TypeName{"int", Type::int32},      TypeName{"int32", Type::int32},
    TypeName{"uint", Type::uint32},    TypeName{"uint32", Type::uint32},
    TypeName{"float", Type::float32},  TypeName{"float32", Type::float32},
    TypeName{"double", Type::float64}, TypeName{"float64", Type::float64}};

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::float64:
      return 8;
  }
  return 8;
}

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< first byte of the body
};

class HeaderReader {
 public:
  HeaderReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  Header read() {
    bool has_format = false;
    for (line_ = next_line(); line_ != "end_header"; line_ = next_line()) {
      Words words(line_);
      const auto keyword = words.next();
      if (keyword == "format") has_format = true, read_format(words);
      if (keyword == "element") read_element(words);
      if (keyword == "property") read_property(words);
    }
    if (!has_format) fail("its header names no format");
    header_.end = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(place_in_text(path_, text_, begin_), "is no PLY file", why);
  }

  std::string_view next_line() {
    begin_ = at_;
    const auto end = text_.find_first_of("\r\n", at_);
    if (end == text_.npos) fail("its header has no end");
    at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
    auto line = text_.substr(begin_, end - begin_);
    while (line.ends_with(' ')) line.remove_suffix(1);
    return line;
  }

  void read_format(Words& words) {
    const auto name = words.next();
    if (name == "ascii")
      header_.encoding = Encoding::ascii;
    else if (name == "binary_little_endian")
      header_.encoding = Encoding::little_endian;
    else if (name == "binary_big_endian")
      header_.encoding = Encoding::big_endian;
    else
      fail("its format is '" + shortened(name) + "'");
  }

  void read_element(Words& words) {
    Element element;
    element.name = words.next();
    const auto count = words.next();
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size() || count.empty())
      fail("'" + shortened(count) + "' is no number of elements");
    header_.elements.push_back(std::move(element));
  }

  void read_property(Words& words) {
    if (header_.elements.empty()) fail("a property stands before all elements");
    Property property;
    auto type = words.next();
    if (type == "list") {
      property.count = type_of(words.next());
      type = words.next();
    }
    property.type = type_of(type);
    property.name = words.next();
    header_.elements.back().properties.push_back(std::move(property));
  }

  Type type_of(std::string_view name) const {
    for (const auto& known : type_names)
      if (known.name == name) return known.type;
    fail("'" + shortened(name) + "' is no type of a property");
  }

  const std::string& path_;
  std::string_view text_, line_;
  std::size_t at_ = 0, begin_ = 0;
  Header header_;
};

/// Numbers of a binary body; `swap` where its bytes run the other way around.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view bytes, std::size_t at, bool swap)
      : bytes_(bytes), at_(at), swap_(swap) {}

  bool has_next(Type type) const { return bytes_.size() - at_ >= size_of(type); }
  static std::size_t least_size(Type type) { return size_of(type); }

  double next(Type type) {
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return static_cast<double>(take<float>());
      case Type::float64:
        return take<double>();
    }
    return 0;
  }

  std::size_t byte() const { return at_; }

 private:
  template <class Number>
  Number take() {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), bytes_.data() + at_, sizeof(Number));
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    at_ += sizeof(Number);
    return std::bit_cast<Number>(bytes);
  }

  std::string_view bytes_;
  std::size_t at_;
  bool swap_;
};

/// Numbers of an ascii body, by blanks and line ends apart.
class AsciiNumbers {
 public:
  AsciiNumbers(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  bool has_next(Type) {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    return at_ < text_.size();
  }
  static std::size_t least_size(Type) { return 2; }  // a digit and a blank

  /// NaN for what is no number.
  double next(Type) {
    const auto end = std::min(text_.find_first_of(" \t\r\n", at_), text_.size());
    const auto value = finite_number(text_.substr(at_, end - at_));
    byte_ = at_;
    at_ = end;
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  std::size_t byte() const { return byte_; }

 private:
  std::string_view text_;
  std::size_t at_, byte_ = 0;
};

template <class Numbers>
class BodyReader {
 public:
  BodyReader(const std::string& path, std::string_view text, const Header& header, Numbers numbers,
             IndexedFaces& faces)
      : path_(path), text_(text), header_(header), numbers_(numbers), faces_(faces) {}

  void read() {
    check_sizes();
    for (const auto& element : header_.elements) {
      element_ = &element;
      if (element.name == "vertex")
        read_vertices();
      else if (element.name == "face")
        read_faces();
      else
        skip();
    }
    if (highest_.index >= static_cast<double>(faces_.vertex_count())) refuse_index(highest_);
  }

 private:
  /// A corner of a face, and where the file has it.
  struct Corner {
    double index = -1;
    const Element* element = nullptr;
    std::size_t face = 0, byte = 0;
  };

  [[noreturn]] void fail(std::size_t number, const std::string& what, const std::string& why,
                         const std::string& hint = {}) const {
    throw InputError(place(numbers_.byte()), fmt::format("{} {}: {}", element_->name, number, what),
                     why, hint);
  }

  [[noreturn]] void refuse_index(const Corner& corner) const {
    throw InputError(place(corner.byte),
                     fmt::format("{} {}: vertex index {} is out of range", corner.element->name,
                                 corner.face, corner.index),
                     fmt::format("{} vertices were read, counted from 0", faces_.vertex_count()),
                     "is the file cut off?");
  }

  Where place(std::size_t byte) const {
    const bool is_text = header_.encoding == Encoding::ascii;
    return is_text ? place_in_text(path_, text_, byte) : Where{path_};
  }

  /// A header may promise anything: what the body cannot hold is refused before memory is asked
  /// for.
  void check_sizes() {
    std::size_t vertices = 0, triangles = 0;
    for (const auto& element : header_.elements) {
      element_ = &element;
      std::size_t least = 0;
      for (const auto& p : element.properties)
        least += Numbers::least_size(p.count.value_or(p.type));
      const auto body = text_.size() - header_.end + 1;  // the last blank may be missing
      // Without properties it takes no bytes, and means nothing.
      if (least == 0 ? element.count > body : element.count > body / least) {
        fail(element.count, "is not there", "the file is too short for as many", "is it cut off?");
      }
      if (element.name == "vertex") vertices = element.count;
      if (element.name == "face") triangles = element.count;
    }
    if (vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      fail(vertices, "is one too many", "indices have 31 bits", "split the file into tiles");
    faces_.expect(vertices, triangles);
  }

  double number(Type type, std::size_t element_number) {
    if (!numbers_.has_next(type)) fail(element_number, "the file ends within it", "is it cut off?");
    return numbers_.next(type);
  }

  std::size_t list_size(const Property& property, std::size_t element_number) {
    const double size = number(*property.count, element_number);
    if (!(size >= 0) || size > static_cast<double>(text_.size()) || size != std::floor(size))
      fail(element_number, fmt::format("a list of {} entries", size), "no list has that length");
    return static_cast<std::size_t>(size);
  }

  void pass_over(const Property& property, std::size_t element_number) {
    const auto count = property.count ? list_size(property, element_number) : 1;
    for (std::size_t k = 0; k < count; ++k) number(property.type, element_number);
  }

  int axis_of(const Property& property) const {
    if (property.count) return -1;
    return property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
  }

  void read_vertices() {
    int axes = 0;
    bool are_single = false;
    for (const auto& p : element_->properties) {
      axes += axis_of(p) >= 0;
      are_single = are_single || (axis_of(p) >= 0 && p.type == Type::float32);
      if (p.name == "red") faces_.notes().count("colours per vertex ignored", element_->count);
    }
    if (axes != 3) fail(0, "has no x, y and z", "its properties were read from the header");
    std::array<double, 3> xyz{};
    for (std::size_t v = 0; v < element_->count; ++v) {
      for (const auto& p : element_->properties) {
        const int axis = axis_of(p);
        if (axis < 0)
          pass_over(p, v);
        else
          xyz[static_cast<std::size_t>(axis)] = number(p.type, v);
      }
      if (are_single) faces_.note_single_precision({xyz[0], xyz[1], xyz[2]});
      if (!faces_.add_vertex({xyz[0], xyz[1], xyz[2]})) {
        fail(v, "is no point on Earth", "a coordinate is no finite number below 1e9 m",
             "is unit_m right?");
      }
    }
  }

  static bool is_corner_list(const Property& p) {
    return p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  void read_faces() {
    const auto& all = element_->properties;
    if (element_->count > 0 && std::count_if(all.begin(), all.end(), is_corner_list) != 1)
      fail(0, "has no list vertex_indices", "its properties were read from the header");
    for (const auto& p : all)
      if (p.name == "red") faces_.notes().count("colours per face ignored", element_->count);
    for (std::size_t f = 0; f < element_->count; ++f) {
      for (const auto& p : all) {
        if (is_corner_list(p))
          read_corners(p, f);
        else
          pass_over(p, f);
      }
    }
  }

  void read_corners(const Property& property, std::size_t face) {
    const auto count = list_size(property, face);
    for (std::size_t k = 0; k < count; ++k) {
      const double index = number(property.type, face);
      if (!(index >= 0 && index <= std::numeric_limits<std::int32_t>::max()) ||
          std::floor(index) != index) {
        refuse_index({index, element_, face, numbers_.byte()});
      }
      // Faces may come before their vertices: only the end of the file tells.
      if (index > highest_.index) highest_ = {index, element_, face, numbers_.byte()};
      faces_.add_corner(static_cast<std::int32_t>(index));
    }
    faces_.end_face();
  }

  void skip() {
    if (element_->name == "tristrips" && element_->count > 0)
      fail(0, "triangle strips are not read", "only faces are", "store the mesh as faces");
    if (element_->properties.empty()) return;
    for (std::size_t n = 0; n < element_->count; ++n)
      for (const auto& p : element_->properties) pass_over(p, n);
    faces_.notes().count("elements '" + element_->name + "' left out", element_->count);
  }

  const std::string& path_;
  std::string_view text_;
  const Header& header_;
  Numbers numbers_;
  IndexedFaces& faces_;
  const Element* element_ = nullptr;
  Corner highest_;  ///< of the largest index, the first of these
};

}  // namespace

PolygonModel read_scene_ply(const std::string& path, const SceneFileRules& rules) {
  IndexedFaces faces(path, rules, 'z');
  const std::string text = read_text_file(path);
  const Header header = HeaderReader(path, text).read();
  if (header.encoding == Encoding::ascii) {
    BodyReader(path, text, header, AsciiNumbers(text, header.end), faces).read();
  } else {
    const bool swap = (header.encoding == Encoding::little_endian) !=
                      (std::endian::native == std::endian::little);
    BodyReader(path, text, header, BinaryNumbers(text, header.end, swap), faces).read();
  }
  return faces.finish();
}

}  // namespace sunload
