// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The container of batch files: a verified JSON header and blocks of bytes.
///
///     0  magic         8 bytes  89 53 4C 42 0D 0A 1A 0A
///     8  version       uint32   container_version
///    12  header_crc    uint32   CRC-32 of the header
///    16  header_bytes  uint64   length of the header, from byte 40 on
///    24  file_bytes    uint64   length of the whole file
///    32  prologue_crc  uint32   CRC-32 of bytes 0 … 31
///    36  zero          uint32
///    40  header        JSON, UTF-8; its key "blocks" lists offset, bytes, crc32
///        blocks, each at a multiple of 64 bytes, zeros between; offsets count
///        from the first multiple of 64 after the header
///
/// Numbers are little-endian; CRC-32 is that of gzip (RFC 1952).
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/batch/chunk.h"

namespace sunload {

inline constexpr std::uint32_t container_version = 1;

/// Bytes of a block, one piece after another.
using BlockPieces = std::vector<std::span<const unsigned char>>;

/// Writes aside, flushes to the disk, renames. Throws MachineError.
void write_container(const std::string& path, nlohmann::json header,
                     const std::vector<BlockPieces>& blocks);

/// An open container. Blocks are read when asked for, so that memory stays small, and verified
/// then.
class Container {
 public:
  /// Verifies the header. Throws InputError naming the file and what is wrong with it.
  explicit Container(const std::string& path);
  ~Container();
  Container(const Container&) = delete;
  Container& operator=(const Container&) = delete;

  const std::string& path() const { return path_; }
  const nlohmann::json& header() const { return header_; }
  std::size_t block_count() const { return blocks_.size(); }
  std::size_t block_bytes(std::size_t i) const { return blocks_[i].bytes; }
  /// Throws InputError where it is damaged.
  Bytes block(std::size_t i) const;
  /// Reads all blocks, keeping none. Throws InputError where one is damaged.
  void verify() const;
  /// Throws InputError "`path`: is not a valid batch file (`why`); …".
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  struct Block {
    std::size_t offset = 0, bytes = 0;
    std::uint32_t crc = 0;
  };
  void read_header();
  void verify(const Block& block) const;
  void read(std::size_t offset, unsigned char* to, std::size_t bytes) const;

  std::string path_;
  int file_ = -1;
  nlohmann::json header_;
  std::vector<Block> blocks_;
};

}  // namespace sunload
