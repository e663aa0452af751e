// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/container.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>

#include "geo/base/check.h"
#include "io/base/deflate.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"

static_assert(std::endian::native == std::endian::little,
              "numbers are stored as they lie in memory");

namespace sunload {
namespace {

using nlohmann::json;

/// The first byte is not ASCII; line ends and the end-of-file character of DOS
/// show a transfer as text: the reasons behind the magic of PNG.
constexpr std::array<unsigned char, 8> magic{0x89, 'S', 'L', 'B', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t block_alignment = 64;  // a cache line
constexpr std::size_t read_bytes = 1 << 20;  // verified at a time

struct Prologue {
  std::array<unsigned char, 8> magic_bytes = magic;
  std::uint32_t version = container_version, header_crc = 0;
  std::uint64_t header_bytes = 0, file_bytes = 0;
  std::uint32_t prologue_crc = 0, zero = 0;
};
static_assert(sizeof(Prologue) == 40 && offsetof(Prologue, prologue_crc) == 32, "file layout");

std::size_t aligned(std::size_t offset) {
  return (offset + block_alignment - 1) / block_alignment * block_alignment;
}

/// A file being written; errors name `path`, the name that it shall get.
class ContainerOutput {
 public:
  ContainerOutput(const std::string& aside, std::string path) : path_(std::move(path)) {
    constexpr mode_t as_umask_allows = 0666;
    file_ = ::open(aside.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, as_umask_allows);
    if (file_ < 0) throw_cannot_write(path_, errno);
  }
  ~ContainerOutput() {
    if (file_ >= 0) ::close(file_);
  }
  ContainerOutput(const ContainerOutput&) = delete;
  ContainerOutput& operator=(const ContainerOutput&) = delete;

  void write(const void* bytes, std::size_t count) {
    if (const int error = write_all(file_, {static_cast<const char*>(bytes), count}))
      throw_cannot_write(path_, error);
    position_ += count;
  }
  void pad_to(std::size_t offset) {
    const std::array<char, block_alignment> zeros{};
    write(zeros.data(), offset - position_);
  }
  void close() {
    const int file = file_;
    file_ = -1;
    if (::close(file) != 0) throw_cannot_write(path_, errno);
  }

 private:
  std::string path_;
  int file_ = -1;
  std::size_t position_ = 0;
};

}  // namespace

void write_container(const std::string& path, json header, const std::vector<BlockPieces>& blocks) {
  // Offsets count from the end of the header, whose length they would change.
  json table = json::array();
  std::size_t end = 0;
  for (const auto& block : blocks) {
    std::size_t bytes = 0;
    std::uint32_t crc = 0;
    for (const auto& piece : block) {
      bytes += piece.size();
      crc = crc32(piece.data(), piece.size(), crc);
    }
    table.push_back({{"offset", aligned(end)}, {"bytes", bytes}, {"crc32", crc}});
    end = aligned(end) + bytes;
  }
  header["blocks"] = table;
  const std::string text = header.dump();
  const std::size_t data = aligned(sizeof(Prologue) + text.size());
  Prologue prologue;
  prologue.header_crc = crc32(text.data(), text.size());
  prologue.header_bytes = text.size();
  prologue.file_bytes = data + end;
  prologue.prologue_crc = crc32(&prologue, offsetof(Prologue, prologue_crc));

  FileAside target(path);
  ContainerOutput output(target.aside(), path);
  output.write(&prologue, sizeof prologue);
  output.write(text.data(), text.size());
  output.pad_to(data);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    output.pad_to(data + table[i]["offset"].get<std::size_t>());
    for (const auto& piece : blocks[i]) output.write(piece.data(), piece.size());
  }
  output.close();
  target.publish();
}

Container::Container(const std::string& path) : path_(path) {
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw InputError({path}, "cannot be read", std::strerror(errno));
  try {
    read_header();
  } catch (const json::exception& error) {
    ::close(file_);
    refuse(error.what());
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Container::~Container() { ::close(file_); }

void Container::read_header() {
  struct stat status {};
  if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) refuse("it is not a file");
  const auto size = static_cast<std::size_t>(status.st_size);
  Prologue prologue;
  if (size < sizeof prologue) refuse("it is too short");
  read(0, reinterpret_cast<unsigned char*>(&prologue), sizeof prologue);
  if (prologue.magic_bytes != magic) refuse("it is something else");
  if (prologue.version != container_version) {
    refuse("its version is " + std::to_string(prologue.version) + ", not " +
           std::to_string(container_version));
  }
  if (prologue.prologue_crc != crc32(&prologue, offsetof(Prologue, prologue_crc))) {
    refuse("its beginning is damaged");
  }
  if (prologue.file_bytes != size) {
    refuse("it has " + std::to_string(size) + " of " + std::to_string(prologue.file_bytes) +
           " bytes");
  }
  if (prologue.header_bytes > size - sizeof prologue) refuse("its header is damaged");
  Bytes text(prologue.header_bytes);
  read(sizeof prologue, text.data(), text.size());
  if (prologue.header_crc != crc32(text.data(), text.size())) refuse("its header is damaged");
  header_ = json::parse(text.begin(), text.end());
  const std::size_t data = aligned(sizeof prologue + text.size());
  for (const json& row : header_.at("blocks")) {
    Block block{row.at("offset"), row.at("bytes"), row.at("crc32")};
    if (data > size || block.offset > size - data || block.bytes > size - data - block.offset) {
      refuse("a block lies outside of it");
    }
    block.offset += data;
    blocks_.push_back(block);
  }
}

void Container::verify() const {
  for (const Block& block : blocks_) verify(block);
}

void Container::verify(const Block& block) const {
  Bytes part(std::min(block.bytes, read_bytes));
  std::uint32_t crc = 0;
  for (std::size_t done = 0; done < block.bytes; done += part.size()) {
    part.resize(std::min(block.bytes - done, read_bytes));
    read(block.offset + done, part.data(), part.size());
    crc = crc32(part.data(), part.size(), crc);
  }
  if (crc != block.crc) refuse("its data are damaged");
}

Bytes Container::block(std::size_t i) const {
  Bytes bytes(blocks_[i].bytes);
  read(blocks_[i].offset, bytes.data(), bytes.size());
  if (crc32(bytes.data(), bytes.size()) != blocks_[i].crc) refuse("its data are damaged");
  return bytes;
}

void Container::read(std::size_t offset, unsigned char* to, std::size_t bytes) const {
  while (bytes > 0) {
    const ssize_t got = ::pread(file_, to, bytes, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(std::strerror(errno));
    if (got == 0) refuse("it ends too early");
    to += got;
    offset += static_cast<std::size_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
}

void Container::refuse(const std::string& why) const {
  throw InputError({path_}, "is not a valid batch file", why,
                   "remove it and run again with --resume");
}

}  // namespace sunload
