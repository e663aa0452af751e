#include "io/prepared_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/chunk.h"
#include "io/file_aside.h"

namespace sunload {

namespace {

// Layout, in the byte order of the machine: magic, content hash, then the
// arrays of `visit`, each as count and bytes, then CRC-32 of all before.
constexpr char magic[16] = "sunload-lines-1";

/// Calls `array` for every array of the lines, in the order of the file.
template <class Set, class Array>
void visit_set(Set& set, Array&& array) {
  for (auto* table : {&set.patches, &set.sky, &set.sky_by_mirror})
    for (auto& block : table->blocks) {
      array(block.begin);
      array(block.target);
      array(block.weight);
    }
  array(set.ends);
  array(set.first_light.escaped);
  array(set.first_light.backs);
  array(set.first_light.cut);
}

class Output {
 public:
  explicit Output(const std::string& path) : path_(path), file_(path, std::ios::binary) {}
  void bytes(const void* data, std::size_t count) {
    crc_ = crc32(data, count, crc_);
    file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    bytes(&count, sizeof(count));
    bytes(values.data(), count * sizeof(T));
  }
  void finish() {
    const std::uint32_t crc = crc_;
    file_.write(reinterpret_cast<const char*>(&crc), sizeof(crc));
    file_.close();
    if (!file_) throw_cannot_write(path_, errno);
  }

 private:
  std::string path_;
  std::ofstream file_;
  std::uint32_t crc_ = 0;
};

/// Reads arrays from bytes that may be damaged: never past their end.
class Input {
 public:
  explicit Input(const std::string& bytes) : at_(bytes.data()), left_(bytes.size()) {}
  bool take(void* to, std::size_t count) {
    if (count > left_) return false;
    std::memcpy(to, at_, count);
    at_ += count;
    left_ -= count;
    return true;
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t count = 0;
    if (!take(&count, sizeof(count)) || count > left_ / sizeof(T)) {
      good_ = false;
      return;
    }
    values.resize(count);
    good_ = good_ && take(values.data(), count * sizeof(T));
  }
  bool is_good_end() const { return good_ && left_ == 0; }

 private:
  const char* at_;
  std::size_t left_;
  bool good_ = true;
};

std::string whole_file(const std::string& path) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable)) return {};
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::string bytes(static_cast<std::size_t>(file.tellg()), '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file ? bytes : std::string();
}

}  // namespace

void write_prepared(const std::string& path, const std::string& content_hash, const Lines& lines) {
  FileAside target(path);
  Output out(target.aside());
  out.bytes(magic, sizeof(magic));
  out(std::vector<char>(content_hash.begin(), content_hash.end()));
  out(std::vector<std::uint64_t>{lines.realizations.size(), lines.pooled.ends.size(), lines.rays});
  for (const auto& set : lines.realizations) visit_set(set, out);
  visit_set(lines.pooled, out);
  out.finish();
  target.publish();
}

std::optional<Lines> read_prepared(const std::string& path, const std::string& content_hash) {
  std::string bytes = whole_file(path);
  constexpr std::size_t crc_bytes = sizeof(std::uint32_t);
  if (bytes.size() < sizeof(magic) + crc_bytes) return {};
  std::uint32_t crc = 0;
  std::memcpy(&crc, bytes.data() + bytes.size() - crc_bytes, crc_bytes);
  bytes.resize(bytes.size() - crc_bytes);
  if (std::memcmp(bytes.data(), magic, sizeof(magic)) != 0) return {};
  if (crc32(bytes.data(), bytes.size()) != crc) return {};

  Input in(bytes);
  char skipped[sizeof(magic)];
  in.take(skipped, sizeof(magic));
  std::vector<char> hash;
  std::vector<std::uint64_t> counts;
  in(hash);
  in(counts);
  if (std::string(hash.begin(), hash.end()) != content_hash || counts.size() != 3) return {};
  Lines lines;
  const auto rows = static_cast<std::size_t>(counts[1]);
  const LineSet empty{LinkTable(rows), LinkTable(rows), LinkTable(rows), {}, {}};
  lines.realizations.assign(static_cast<std::size_t>(counts[0]), empty);
  lines.pooled = empty;
  lines.rays = counts[2];
  for (auto& set : lines.realizations) visit_set(set, in);
  visit_set(lines.pooled, in);
  if (!in.is_good_end()) return {};
  return lines;
}

}  // namespace sunload
