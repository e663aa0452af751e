// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/gltf_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

#include "io/base/json_text.h"
#include "io/scene/base/from_file.h"

namespace sunload {

namespace {

using nlohmann::json;

/// Little-endian number of `Size` bytes.
template <class Number>
Number little(std::string_view bytes, std::size_t at) {
  std::uint64_t bits = 0;
  for (std::size_t b = sizeof(Number); b-- > 0;)
    bits = (bits << 8) | static_cast<unsigned char>(bytes[at + b]);
  if constexpr (std::is_same_v<Number, float>)
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  else
    return static_cast<Number>(bits);
}

struct Component {
  std::size_t bytes;
  double largest;  ///< what a normalized integer of 1 is stored as
  double (*read)(std::string_view, std::size_t);
};

template <class Number>
double read_as(std::string_view bytes, std::size_t at) {
  return static_cast<double>(little<Number>(bytes, at));
}

/// glTF 2.0, 3.6.2.2.
const Component* component_of(int type) {
  static constexpr Component int8{1, 127, read_as<std::int8_t>};
  static constexpr Component uint8{1, 255, read_as<std::uint8_t>};
  static constexpr Component int16{2, 32767, read_as<std::int16_t>};
  static constexpr Component uint16{2, 65535, read_as<std::uint16_t>};
  static constexpr Component uint32{4, 4294967295.0, read_as<std::uint32_t>};
  static constexpr Component float32{4, 1, read_as<float>};
  switch (type) {
    case 5120:
      return &int8;
    case 5121:
      return &uint8;
    case 5122:
      return &int16;
    case 5123:
      return &uint16;
    case 5125:
      return &uint32;
    case 5126:
      return &float32;
    default:
      return nullptr;
  }
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+' || c == '-' ? 62
                      : c == '/' || c == '_' ? 63
                                             : -1;
    if (value < 0) continue;
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    if ((count += 6) >= 8) {
      count -= 8;
      bytes.push_back(static_cast<char>((bits >> count) & 0xFF));
    }
  }
  return bytes;
}

/// `%20` and the like in a URI.
std::string without_escapes(const std::string& uri) {
  std::string text;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                  : -1;
  };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      text.push_back(static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])));
      i += 2;
    } else {
      text.push_back(uri[i]);
    }
  }
  return text;
}

/// A count or an offset: 0 where it is absent, nothing where it is not a whole number.
std::optional<std::size_t> whole(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return 0;
  if (!found->is_number_unsigned()) return std::nullopt;
  return found->get<std::size_t>();
}

}  // namespace

GltfFile::GltfFile(const std::string& path) : path_(path) {
  std::string bytes = read_whole_file(path);
  bytes_ = bytes.size();
  if (bytes.starts_with("glTF")) {
    take_container_apart(bytes);
  } else {
    first_json_value_end(path, bytes);
    json_ = parse_json(path, bytes);
  }
  const auto version = json_.is_object() && json_.contains("asset") && json_["asset"].is_object()
                           ? json_["asset"].value("version", json())
                           : json();
  if (!version.is_string()) fail("is no glTF file", "it has no asset.version");
  if (!version.get<std::string>().starts_with("2"))
    fail("is of glTF version " + version.get<std::string>(), "version 2 is read");
}

void GltfFile::fail(const std::string& what, const std::string& why,
                    const std::string& hint) const {
  throw InputError({path_}, what, why, hint);
}

/// glTF 2.0, 4.4: header of 12 bytes, then chunks of length, type and content.
void GltfFile::take_container_apart(const std::string& bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  bool has_json = false;
  if (bytes.size() < header || little<std::uint32_t>(bytes, 8) > bytes.size())
    fail("is shorter than its header states", "", "is it cut off?");
  for (std::size_t at = header; at + chunk_header <= bytes.size();) {
    const std::size_t length = little<std::uint32_t>(bytes, at);
    const auto type = std::string_view(bytes).substr(at + 4, 4);
    at += chunk_header;
    if (length > bytes.size() - at) fail("ends within a chunk", "", "is it cut off?");
    if (type == "JSON" && !has_json) {
      const auto text = std::string_view(bytes).substr(at, length);
      first_json_value_end(path_, text);
      json_ = parse_json(path_, text);
      has_json = true;
    } else if (type == std::string_view("BIN\0", 4) && binary_chunk_.empty()) {
      binary_chunk_ = bytes.substr(at, length);
    }
    at += length;
  }
  if (!has_json) fail("is no GLB file", "it has no JSON chunk");
}

const json& GltfFile::entry(const std::string& list, const json& index) const {
  const auto found = json_.find(list);
  const bool is_there = found != json_.end() && found->is_array() && index.is_number_unsigned() &&
                        index.get<std::size_t>() < found->size() &&
                        (*found)[index.get<std::size_t>()].is_object();
  if (!is_there)
    fail("has no entry " + index.dump() + " in '" + list + "'", "something refers to it");
  return (*found)[index.get<std::size_t>()];
}

std::string GltfFile::load_buffer(const json& entry, std::size_t index) {
  const auto uri = entry.value("uri", json());
  if (uri.is_null() && index == 0) return binary_chunk_;
  if (!uri.is_string()) fail(fmt::format("buffer {} has no content", index));
  const auto text = uri.get<std::string>();
  if (text.starts_with("data:")) {
    const auto comma = text.find(";base64,");
    if (comma == text.npos) fail(fmt::format("buffer {} is no base64 data", index));
    return from_base64(std::string_view(text).substr(comma + 8));
  }
  const auto file = std::filesystem::path(path_).parent_path() / without_escapes(text);
  buffer_files_.push_back(file.string());
  return read_whole_file(file.string());
}

const std::string& GltfFile::buffer(const json& index) {
  const auto& stated = entry("buffers", index);
  const auto i = index.get<std::size_t>();
  if (buffers_.size() <= i) {
    buffers_.resize(i + 1);
    is_loaded_.resize(i + 1);
  }
  if (!is_loaded_[i]) {
    buffers_[i] = load_buffer(stated, i);
    bytes_ += buffers_[i].size();
    is_loaded_[i] = true;
    const auto length = whole(stated, "byteLength");
    if (!length || buffers_[i].size() < *length)
      fail(fmt::format("buffer {} is shorter than the file states", i), "", "is it cut off?");
  }
  return buffers_[i];
}

std::vector<double> GltfFile::numbers(const json& index, const std::string& type) {
  const auto& accessor = entry("accessors", index);
  const std::string name = "accessor " + index.dump();
  if (accessor.contains("sparse"))
    fail(name + " is sparse", "such accessors are not read", "export the model without them");
  if (accessor.value("type", json()) != type) fail(name + " is no " + type);
  const auto component_type = whole(accessor, "componentType");
  const auto* component =
      component_type ? component_of(static_cast<int>(std::min<std::size_t>(*component_type, 9999)))
                     : nullptr;
  if (component == nullptr) fail(name + " has no known componentType");
  const auto count = whole(accessor, "count"), offset = whole(accessor, "byteOffset");
  const auto& view = entry("bufferViews", accessor.value("bufferView", json()));
  const auto view_offset = whole(view, "byteOffset"), length = whole(view, "byteLength");
  const auto stated_stride = whole(view, "byteStride");
  const std::size_t width = type == "VEC4" ? 4 : type == "VEC3" ? 3 : 1;
  const std::size_t size = width * component->bytes;
  const auto& bytes = buffer(view.value("buffer", json()));
  if (!count || !offset || !view_offset || !length || !stated_stride ||
      *view_offset > bytes.size() || *length > bytes.size() - *view_offset)
    fail(name + " lies outside of its buffer", "", "is the file cut off?");
  const std::size_t stride = *stated_stride == 0 ? size : *stated_stride;
  if (stride < size || *offset > *length ||
      (*count > 0 &&
       (*length - *offset < size || (*length - *offset - size) / stride < *count - 1)))
    fail(name + " lies outside of its buffer view", "", "is the file cut off?");
  const auto normalized = accessor.value("normalized", json());
  const double scale =
      normalized.is_boolean() && normalized.get<bool>() ? 1 / component->largest : 1;
  std::vector<double> values;
  values.reserve(*count * width);
  for (std::size_t i = 0; i < *count; ++i) {
    for (std::size_t k = 0; k < width; ++k) {
      const auto at = *view_offset + *offset + i * stride + k * component->bytes;
      values.push_back(component->read(bytes, at) * scale);
    }
  }
  return values;
}

std::vector<Vec3> GltfFile::points(const json& accessor) {
  const auto values = numbers(accessor, "VEC3");
  std::vector<Vec3> points;
  points.reserve(values.size() / 3);
  for (std::size_t i = 0; i < values.size(); i += 3)
    points.push_back({values[i], values[i + 1], values[i + 2]});
  return points;
}

std::vector<std::array<double, 4>> GltfFile::quaternions(const json& accessor) {
  const auto values = numbers(accessor, "VEC4");
  std::vector<std::array<double, 4>> all;
  all.reserve(values.size() / 4);
  for (std::size_t i = 0; i < values.size(); i += 4)
    all.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
  return all;
}

std::vector<std::int32_t> GltfFile::indices(const json& accessor, std::size_t count) {
  const auto values = numbers(accessor, "SCALAR");
  std::vector<std::int32_t> indices;
  indices.reserve(values.size());
  for (const double value : values) {
    if (!(value >= 0 && value < static_cast<double>(count)))
      fail(fmt::format("vertex index {} is out of range", value),
           fmt::format("{} vertices are there, counted from 0", count));
    indices.push_back(static_cast<std::int32_t>(value));
  }
  return indices;
}

}  // namespace sunload
