// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/* Makes the k-th call that changes a file fail, as a full or broken disk would, or the last one.
 *
 *   LD_PRELOAD=fail_writes.so FAIL_AT=k FAIL_WITH=errno FAIL_BELOW=path FAIL_COUNT=file FAIL_ON=1
 * program
 *
 * Counted are write, writev, pwrite, fsync, fdatasync, ftruncate, rename, mkdir and
 * open for writing, of files below FAIL_BELOW only. Without FAIL_AT nothing fails.
 * FAIL_ON=1: all later calls fail too, as on a disk that stays full. FAIL_KILL=1: the
 * process is killed (SIGKILL) before the call instead, and remove, unlink and rmdir are counted
 * too. At the end the number of calls is written to FAIL_COUNT.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;

static long number(const char* name, long otherwise) {
  const char* text = getenv(name);
  return text ? atol(text) : otherwise;
}

static int is_below(const char* path) {
  const char* below = getenv("FAIL_BELOW");
  if (!below || !path) return 0;
  char absolute[2 * PATH_MAX];
  if (path[0] != '/') {
    char here[PATH_MAX];
    if (!getcwd(here, sizeof here)) return 0;
    snprintf(absolute, sizeof absolute, "%s/%s", here, path);
    path = absolute;
  }
  return strncmp(path, below, strlen(below)) == 0;
}

static int is_file_below(int file) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = 0;
  return is_below(path);
}

/* Counts a call; nonzero where it is to fail, with errno set. */
static int fails(void) {
  const long call = atomic_fetch_add(&calls, 1) + 1;
  const long at = number("FAIL_AT", 0);
  if (at == 0 || call < at || (call > at && !number("FAIL_ON", 0))) return 0;
  if (number("FAIL_KILL", 0)) kill(getpid(), SIGKILL);
  errno = (int)number("FAIL_WITH", ENOSPC);
  return 1;
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("FAIL_COUNT");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", (long)calls);
  fclose(file);
}

#define REAL(result, name, ...)       \
  static result (*real)(__VA_ARGS__); \
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, name)

ssize_t write(int file, const void* data, size_t bytes) {
  REAL(ssize_t, "write", int, const void*, size_t);
  return is_file_below(file) && fails() ? -1 : real(file, data, bytes);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  REAL(ssize_t, "writev", int, const struct iovec*, int);
  return is_file_below(file) && fails() ? -1 : real(file, parts, count);
}

ssize_t pwrite(int file, const void* data, size_t bytes, off_t at) {
  REAL(ssize_t, "pwrite", int, const void*, size_t, off_t);
  return is_file_below(file) && fails() ? -1 : real(file, data, bytes, at);
}

ssize_t pwrite64(int file, const void* data, size_t bytes, off64_t at) {
  REAL(ssize_t, "pwrite64", int, const void*, size_t, off64_t);
  return is_file_below(file) && fails() ? -1 : real(file, data, bytes, at);
}

int fsync(int file) {
  REAL(int, "fsync", int);
  return is_file_below(file) && fails() ? -1 : real(file);
}

int fdatasync(int file) {
  REAL(int, "fdatasync", int);
  return is_file_below(file) && fails() ? -1 : real(file);
}

int ftruncate(int file, off_t length) {
  REAL(int, "ftruncate", int, off_t);
  return is_file_below(file) && fails() ? -1 : real(file, length);
}

int ftruncate64(int file, off64_t length) {
  REAL(int, "ftruncate64", int, off64_t);
  return is_file_below(file) && fails() ? -1 : real(file, length);
}

int rename(const char* from, const char* to) {
  REAL(int, "rename", const char*, const char*);
  return is_below(to) && fails() ? -1 : real(from, to);
}

int mkdir(const char* path, mode_t mode) {
  REAL(int, "mkdir", const char*, mode_t);
  return is_below(path) && fails() ? -1 : real(path, mode);
}

/* Removing makes room: a full disk does not hinder it, but a kill may come before it. */
static void count_removal(const char* path) {
  if (number("FAIL_KILL", 0) && is_below(path)) (void)fails();
}

int remove(const char* path) {
  REAL(int, "remove", const char*);
  count_removal(path);
  return real(path);
}

int unlink(const char* path) {
  REAL(int, "unlink", const char*);
  count_removal(path);
  return real(path);
}

int rmdir(const char* path) {
  REAL(int, "rmdir", const char*);
  count_removal(path);
  return real(path);
}

static int changes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

static mode_t mode_of(int flags, va_list more) {
  return flags & (O_CREAT | O_TMPFILE) ? va_arg(more, mode_t) : 0;
}

int open(const char* path, int flags, ...) {
  REAL(int, "open", const char*, int, ...);
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return changes(flags) && is_below(path) && fails() ? -1 : real(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  REAL(int, "open64", const char*, int, ...);
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return changes(flags) && is_below(path) && fails() ? -1 : real(path, flags, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  REAL(FILE*, "fopen64", const char*, const char*);
  return mode[0] != 'r' && is_below(path) && fails() ? NULL : real(path, mode);
}

FILE* fopen(const char* path, const char* mode) {
  REAL(FILE*, "fopen", const char*, const char*);
  return mode[0] != 'r' && is_below(path) && fails() ? NULL : real(path, mode);
}
