// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/gzip.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

#include "geo/base/check.h"

namespace sunload {

bool is_gzip(const std::string& bytes) { return bytes.starts_with("\x1F\x8B"); }

std::string unpack_gzip(const std::string& bytes, const std::string& path,
                        std::size_t largest_bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  const auto refuse_size = [&] {
    throw InputError({path}, "unpacks to too much",
                     "at most " + std::to_string(largest_bytes) + " bytes can be read");
  };
  // The trailer's length is not to be trusted: the buffer grows as the content asks for it. What
  // one part leaves of it is for the next: files of bgzip have one for every 64 kB.
  std::string content(std::max<std::size_t>(4 * bytes.size(), 4096), '\0');
  std::size_t end = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t used = 0, written = 0;
    const auto outcome =
        libdeflate_gzip_decompress_ex(decompressor.get(), bytes.data() + at, bytes.size() - at,
                                      content.data() + end, content.size() - end, &used, &written);
    if (outcome == LIBDEFLATE_INSUFFICIENT_SPACE) {
      if (content.size() > largest_bytes) refuse_size();
      content.resize(2 * content.size());
      continue;
    }
    if (outcome != LIBDEFLATE_SUCCESS) {
      throw InputError({path}, "is a damaged gzip file",
                       at == 0 ? "it cannot be unpacked" : "what follows its first part is no gzip",
                       "was it copied completely?");
    }
    end += written;
    at += used;
  }
  if (end > largest_bytes) refuse_size();
  content.resize(end);
  return content;
}

}  // namespace sunload
