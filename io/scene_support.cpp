#include "io/scene_support.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace sunload {

namespace {

/// Readers keep the text and a tree of it in memory, and count in 32 bits.
constexpr std::uintmax_t largest_file_bytes = 2'000'000'000;

/// Projected coordinates with a zone prefix reach 6e7 m (Gauss–Krüger zones up to 60): one
/// decade of room; a double still resolves 0.1 µm there.
constexpr double largest_coordinate_m = 1e9;

/// Two million objects of 60 characters; tables hold each name up to four times.
constexpr std::size_t most_name_bytes = 120'000'000;

std::uintmax_t size_of_regular_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InputError({path}, "cannot be read", "there is no such file");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError({path}, "cannot be read", "it is not a regular file");
  }
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError({path}, "cannot be read", error.message());
  return size;
}

std::string read_bytes(const std::string& path, std::uintmax_t byte_count) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(byte_count), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(byte_count)) && byte_count > 0) {
    throw InputError({path}, "cannot be read", "opening or reading it failed",
                     "may this user read it?");
  }
  return bytes;
}

}  // namespace

SceneFromFile::SceneFromFile(const SceneFileRules& rules, char default_up, const std::string& file)
    : up_(rules.up == 0 ? default_up : rules.up), unit_m_(rules.unit_m) {
  if (up_ != 'x' && up_ != 'y' && up_ != 'z') {
    throw InputError({file}, std::string("up: ") + up_, "must be x, y or z");
  }
  if (!(unit_m_ > 0) || !std::isfinite(unit_m_)) {
    throw InputError({file}, "unit_m: " + std::to_string(unit_m_), "must be a positive length");
  }
}

Vec3 SceneFromFile::operator()(Vec3 p) const {
  const Vec3 turned = up_ == 'z' ? p : up_ == 'y' ? Vec3{p.x, -p.z, p.y} : Vec3{p.y, p.z, p.x};
  return turned * unit_m_;
}

bool is_usable(Vec3 p) {
  return std::abs(p.x) <= largest_coordinate_m && std::abs(p.y) <= largest_coordinate_m &&
         std::abs(p.z) <= largest_coordinate_m;
}

std::string read_whole_file(const std::string& path) {
  const auto size = size_of_regular_file(path);
  if (size > largest_file_bytes) {
    throw InputError({path}, "has " + std::to_string(size) + " bytes",
                     "at most " + std::to_string(largest_file_bytes) + " can be read",
                     "split it into tiles");
  }
  return read_bytes(path, size);
}

std::string read_file_head(const std::string& path, std::size_t byte_count) {
  return read_bytes(path, std::min<std::uintmax_t>(size_of_regular_file(path), byte_count));
}

Where place_in_text(const std::string& file, std::string_view text, std::size_t byte,
                    int first_line) {
  const auto before = text.substr(0, std::min(byte, text.size()));
  const auto line_start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  const auto line_breaks = std::count(before.begin(), before.end(), '\n');
  return {file, first_line + static_cast<int>(line_breaks),
          static_cast<int>(before.size() - line_start) + 1};
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string lower_extension(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

std::string UniqueNames::operator()(const std::string& name) {
  bytes_ += name.size();
  if (bytes_ > most_name_bytes) {
    throw InputError("names of objects take " + std::to_string(bytes_) +
                     " bytes (a scene has few names of some words); is one name very long?");
  }
  std::string candidate = name;
  for (int& n = last_.try_emplace(name, 1).first->second; !taken_.insert(candidate).second;)
    candidate = name + "_" + std::to_string(++n);
  return candidate;
}

std::vector<std::string> NoteCounter::lines() const {
  std::vector<std::string> notes;
  for (const auto& [what, times] : counts_) {
    notes.push_back(times == 0 ? what : std::to_string(times) + " " + what);
  }
  return notes;
}

}  // namespace sunload
