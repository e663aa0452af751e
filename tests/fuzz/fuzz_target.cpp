// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/fuzz_target.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "geo/base/check.h"
#include "geo/mesh/mesh_prepare.h"

namespace sunload::fuzz {

namespace {

constexpr std::size_t most_corners = 4000;  // some milliseconds of preparation

/// A folder of this process, gone at its end.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("sunload_fuzz_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code no_matter;
    std::filesystem::remove_all(path_, no_matter);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void check_mesh(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const auto v : triangle) {
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size())
        throw std::logic_error("a triangle without a vertex");
    }
  }
  for (const auto& vertex : mesh.vertices) {
    if (!std::isfinite(norm(vertex))) throw std::logic_error("a vertex that is not finite");
  }
}

}  // namespace

std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

void run(const Target& target, std::string_view bytes) {
  try {
    target(bytes);
  } catch (const InputError& error) {
    if (error.problems().empty()) throw std::logic_error("a refusal without a reason");
  }
}

std::string file_of(std::string_view bytes, const std::string& name) {
  static const Folder folder;
  const auto path = (folder.path() / name).string();
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  return path;
}

void prepare_small(const PolygonModel& model, std::size_t input_bytes) {
  if (model.ring_vertex.size() > most_corners) return;
  PrepareRules rules;
  rules.repair = static_cast<Repair>(input_bytes % 3);
  if (input_bytes % 2 == 0) rules.ground = GroundRules{};
  check_mesh(prepare(model, rules).mesh);
}

void read_and_prepare(std::string_view bytes, const std::string& name,
                      PolygonModel (*read)(const std::string&, const SceneFileRules&)) {
  const auto model = read(file_of(bytes, name), {});
  prepare_small(model, bytes.size());
}

unsigned char take_byte(std::string_view& bytes) {
  if (bytes.empty()) return 0;
  const auto first = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  return first;
}

}  // namespace sunload::fuzz
