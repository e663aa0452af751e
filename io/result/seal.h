// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The seal of a result: a checksum behind the end of the HDF5 data.
///
/// HDF5 checks most of its structures itself, but not the heaps where text
/// lies: reading those from a damaged file can end the process. The seal covers
/// the file but the part that was written while series came in: chunks, which
/// zlib checks when they are read, with their index, which HDF5 checks. HDF5
/// ignores what lies behind its end, and drops it when another program changes
/// the file: a file without a seal is taken as it is.
///
///     0  magic         8 bytes  "SLSEAL1\n"
///     8  series_begin  uint64   the bytes [series_begin, series_end) are not covered
///    16  series_end    uint64
///    24  file_bytes    uint64   length of the HDF5 data
///    32  crc           uint32   CRC-32 (RFC 1952) of the other bytes and of the three numbers
///    36  zero          uint32
#pragma once

#include <cstdint>
#include <string>

#include "io/result/h5.h"

namespace sunload {

/// Bytes [begin, end) of a file.
struct Extent {
  std::uint64_t begin = 0, end = 0;
};

/// Appends the seal to a finished and closed file. Throws h5::Error or MachineError.
void seal_result(const std::string& path, Extent series);

/// Empty, or what is wrong with a file that ends with a seal: asked before HDF5 sees damage.
/// Throws h5::Error.
std::string seal_problem(const std::string& path);

/// Empty, or what is wrong behind the end of the open file. Throws h5::Error.
std::string end_problem(const std::string& path, const h5::File& file);

}  // namespace sunload
