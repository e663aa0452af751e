// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/work_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "geo/base/check.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"
#include "io/base/machine.h"
#include "io/base/merge_lock.h"
#include "io/result/reader.h"
#include "io/run/measure_merge.h"
#include "io/run/stored_series.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

const std::string kept = "kept";

std::string work_of_study(const std::string& folder, const std::string& study) {
  return folder + "/" + study + "/.work";
}

/// The files of a work folder, and the folder if nothing else is in it.
void remove_files(const fs::path& work) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(work, ignored)) {
    const fs::path& path = entry.path();
    const bool is_ours = path.extension() == ".batch" || path.filename() == "prepared" ||
                         path.filename() == "prepared.lock" || path.filename() == "partial.h5" ||
                         path.filename() == kept;
    if (is_ours) fs::remove(path, ignored);
  }
  fs::remove(work, ignored);
}

/// A result was written without series that are wanted now.
bool lacks_series(const ResultReader& result, const std::vector<std::string>& unwanted) {
  std::istringstream left_out(result.text_attribute("series_left_out"));
  for (std::string series; left_out >> series;)
    if (std::find(unwanted.begin(), unwanted.end(), series) == unwanted.end()) return true;
  return false;
}

bool exists(const std::string& path) {
  std::error_code unreadable;
  return fs::exists(path, unreadable);
}

void remove_if_empty(const fs::path& folder) {
  std::error_code not_empty;
  fs::remove(folder, not_empty);
}

/// A lock file whose holder died; taking it removes it.
void remove_unheld(const fs::path& lock) {
  if (exists(lock)) const MergeLock taken(lock.string());
}

}  // namespace

std::string result_path(const std::string& folder, const Study& study) {
  return folder + "/" + study.name + "/" + study.variant + ".h5";
}

WorkFolder::WorkFolder(const std::string& folder, const Study& study, std::string content_hash,
                       std::size_t batches)
    : work_(work_of_study(folder, study.name)),
      variant_(study.variant),
      content_hash_(std::move(content_hash)),
      measures_hash_(measures_hash(study)),
      result_(result_path(folder, study)),
      path_(work_ + "/" + variant_ + "-" + content_hash_),
      unwanted_(unwanted_series(study)),
      batches_(batches) {}

WorkFolder WorkFolder::with_hash(const std::string& content_hash) const {
  WorkFolder other = *this;
  other.content_hash_ = content_hash;
  other.path_ = work_ + "/" + variant_ + "-" + content_hash;
  return other;
}

bool WorkFolder::has_others() const {
  std::error_code unreadable;
  const auto folders = fs::directory_iterator(work_, unreadable);
  const std::size_t length = variant_.size() + 1 + content_hash_.size();
  return std::any_of(begin(folders), end(folders), [&](const fs::directory_entry& each) {
    const std::string name = each.path().filename().string();
    return name.size() == length && name.starts_with(variant_ + "-") &&
           each.path() != fs::path(path_) && each.is_directory();
  });
}

std::string WorkFolder::batch(std::size_t number) const {
  return path_ + fmt::format("/{:06}.batch", number);
}

std::string WorkFolder::merge_lock() const { return work_ + "/" + variant_ + ".lock"; }

bool WorkFolder::is_there() const { return exists(path_); }

std::optional<ResultState> WorkFolder::state() const {
  if (!exists(result_)) return {};
  const ResultReader result(result_);
  return ResultState{result.text_attribute("study_sha256"),
                     result.text_attribute("measures_sha256"), lacks_series(result, unwanted_)};
}

BatchCheck WorkFolder::check(std::size_t number) const {
  return check_batch(batch(number), content_hash_, number, unwanted_);
}

MissingBatches WorkFolder::missing_batches() const {
  MissingBatches missing;
  for (std::size_t b = 0; b < batches_; ++b) {
    const BatchCheck found = check(b);
    if (found.valid) continue;
    missing.numbers.push_back(b);
    if (found.exists) missing.reasons.push_back(found.reason);
  }
  return missing;
}

std::vector<std::size_t> WorkFolder::batches_not_there() const {
  std::vector<std::size_t> missing;
  for (std::size_t b = 0; b < batches_; ++b)
    if (!exists(batch(b))) missing.push_back(b);
  return missing;
}

double WorkFolder::bytes_there() const {
  double bytes = 0;
  const auto add = [&](const std::string& path) {
    std::error_code not_there;
    const auto size = fs::file_size(path, not_there);
    if (!not_there) bytes += static_cast<double>(size);
  };
  for (std::size_t b = 0; b < batches_; ++b) add(batch(b));
  add(prepared());
  return bytes;
}

void WorkFolder::make() const { make_writable_folder(path_); }

void WorkFolder::keep_work() const {
  const std::string mark = path_ + "/" + kept;
  if (!std::ofstream(mark)) throw_cannot_write(mark, errno);
}

void WorkFolder::remove_work() const { remove_files(path_); }

void WorkFolder::remove_empty_folders() const {
  fs::path path = path_;
  constexpr int of_variant_work_and_study = 3;
  for (int level = 0; level < of_variant_work_and_study; ++level, path = path.parent_path())
    remove_if_empty(path);
}

void WorkFolder::remove_finished_work() const {
  if (exists(path_ + "/" + kept)) return;
  // A process that died at the very end may have left no more than empty folders.
  if (!is_there() && !exists(merge_lock())) return remove_empty_folders();
  try {
    const MergeLock lock(merge_lock());
    if (lock.is_held()) remove_files(path_);
  } catch (const MachineError&) {
    return;  // somebody else's results, to be read only
  }
  remove_empty_folders();
}

void remove_left_over(const std::string& folder, const std::string& study) {
  remove_left_aside(folder + "/" + study);
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(work_of_study(folder, study), unreadable)) {
    std::error_code removed_meanwhile;
    if (!entry.is_directory(removed_meanwhile)) continue;
    remove_left_aside(entry.path().string());
    try {
      remove_unheld(entry.path() / "prepared.lock");
    } catch (const MachineError&) {
      continue;  // of another user, or a file system without locks
    }
    remove_if_empty(entry.path());
  }
}

}  // namespace sunload
