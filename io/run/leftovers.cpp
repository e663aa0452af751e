// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/leftovers.h"

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "geo/base/check.h"
#include "io/base/file_aside.h"
#include "io/base/merge_lock.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

const std::string kept = "kept";

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

void remove_if_empty(const fs::path& folder) {
  std::error_code not_empty;
  fs::remove(folder, not_empty);
}

/// A lock file whose holder died; taking it removes it.
void remove_unheld(const fs::path& lock) {
  std::error_code unreadable;
  if (fs::exists(lock, unreadable)) const MergeLock taken(lock.string());
}

}  // namespace

std::string merge_lock_path(const std::string& folder, const Study& study) {
  return folder + "/" + study.name + "/.work/" + study.variant + ".lock";
}

void keep_work(const std::string& folder, const VariantPlan& plan) {
  const std::string path = work_folder(folder, plan) + "/" + kept;
  if (!std::ofstream(path)) throw_cannot_write(path, errno);
}

void remove_work(const std::string& folder, const VariantPlan& plan) {
  remove_files(work_folder(folder, plan));
}

void remove_empty_folders(const std::string& folder, const VariantPlan& plan) {
  fs::path path = work_folder(folder, plan);
  constexpr int of_variant_work_and_study = 3;
  for (int level = 0; level < of_variant_work_and_study; ++level, path = path.parent_path())
    remove_if_empty(path);
}

void remove_finished_work(const std::string& folder, const Study& study, const std::string& hash) {
  VariantPlan finished;
  finished.study = study;
  finished.content_hash = hash;
  const std::string work = work_folder(folder, finished),
                    lock_path = merge_lock_path(folder, study);
  std::error_code unreadable;
  if (fs::exists(work + "/" + kept, unreadable)) return;
  // A process that died at the very end may have left no more than empty folders.
  if (!fs::exists(work, unreadable) && !fs::exists(lock_path, unreadable))
    return remove_empty_folders(folder, finished);
  try {
    const MergeLock lock(lock_path);
    if (lock.is_held()) remove_files(work);
  } catch (const MachineError&) {
    return;  // somebody else's results, to be read only
  }
  remove_empty_folders(folder, finished);
}

void remove_left_over(const std::string& folder, const std::string& study) {
  const std::string place = folder + "/" + study;
  remove_left_aside(place);
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(place + "/.work", unreadable)) {
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
