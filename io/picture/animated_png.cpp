// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/animated_png.h"

#include <cerrno>

#include "geo/base/check.h"
#include "io/base/deflate.h"
#include "io/base/file_writing.h"

namespace sunload {
namespace {

const std::string signature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t length_bytes = 4, type_bytes = 4, crc_bytes = 4, size_bytes = 8;

std::string big_endian(std::uint32_t number, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    text += static_cast<char>((number >> shift) & 0xffU);
  return text;
}

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t k = 0; k < length_bytes; ++k)
    number = number << 8 | static_cast<unsigned char>(bytes.at(place + k));
  return number;
}

}  // namespace

AnimatedPng::AnimatedPng(const std::string& path, std::size_t pictures, int milliseconds_each)
    : path_(path), file_(path), pictures_(pictures), milliseconds_(milliseconds_each) {
  errno = 0;
  stream_.open(file_.aside(), std::ios::binary);
  stream_ << signature;
}

void AnimatedPng::add(const std::string& png) {
  SUNLOAD_EXPECT(png.starts_with(signature), "pictures of PNG");
  std::string header;
  for (std::size_t at = signature.size(); at < png.size();) {
    const std::size_t length = number_at(png, at);
    const std::string type = png.substr(at + length_bytes, type_bytes);
    const std::string data = png.substr(at + length_bytes + type_bytes, length);
    at += length_bytes + type_bytes + length + crc_bytes;
    if (type == "IHDR") {
      header = data;
      if (added_ > 0) {
        frame_control(header);
        continue;
      }
      chunk(type, data);
      constexpr std::uint32_t for_ever = 0;
      chunk("acTL", big_endian(static_cast<std::uint32_t>(pictures_), 4) + big_endian(for_ever, 4));
      frame_control(header);
    } else if (type == "IDAT") {
      added_ == 0 ? chunk(type, data) : chunk("fdAT", big_endian(sequence_++, 4) + data);
    }
  }
  ++added_;
}

/// The whole area, replaced by each picture.
void AnimatedPng::frame_control(const std::string& header) {
  constexpr std::uint32_t per_second = 1000;
  constexpr int leave_and_replace = 2;  // two bytes of zero
  chunk("fcTL", big_endian(sequence_++, 4) + header.substr(0, size_bytes) + big_endian(0, 4) +
                    big_endian(0, 4) + big_endian(static_cast<std::uint32_t>(milliseconds_), 2) +
                    big_endian(per_second, 2) + big_endian(0, leave_and_replace));
}

void AnimatedPng::chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  stream_ << big_endian(static_cast<std::uint32_t>(data.size()), 4) << body
          << big_endian(crc32(body.data(), body.size()), 4);
}

void AnimatedPng::finish() {
  SUNLOAD_EXPECT(added_ == pictures_, "as many pictures as announced");
  chunk("IEND", {});
  stream_.close();
  if (!stream_) throw_cannot_write(path_, errno);
  file_.publish();
}

}  // namespace sunload
