// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What this machine and the job's limits allow.
#pragma once

#include <cstdint>
#include <string>

namespace sunload {

inline constexpr double mib = 1024.0 * 1024, gib = 1024 * mib;  ///< [bytes]

/// Memory this process may still take [bytes]: the smallest of what the system
/// has available, what the control groups leave, and what `ulimit -v` leaves.
double available_memory_bytes();
/// Free space of the file system that `path` (or its nearest existing parent) lies on.
double free_disk_bytes(const std::string& path);
/// Why nothing can be written into a folder (or its nearest existing parent), other than for want
/// of bytes: it is read-only, forbidden, or its file system has no inodes for more files. Empty
/// where something can.
std::string folder_problem(const std::string& path);
/// A count of bytes in words: "512 bytes", "29.5 GiB".
std::string bytes_text(double bytes);
/// Processors this process may run on: affinity and the quota of its control groups.
int permitted_processors();
/// Largest resident memory of this process so far [bytes].
double peak_memory_bytes();

/// From now on memory that has run out is told: a little is set aside for who unwinds and says so,
/// and for what is destroyed meanwhile.
void keep_memory_to_end_with();

/// Creates the folder with its parents. Throws MachineError where that fails
/// or nothing can be written there.
void make_writable_folder(const std::string& path);

}  // namespace sunload
