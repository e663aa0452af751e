// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/* Preloaded, makes every file system one without POSIX locks. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>

static int without_locks(const char* name, int file, int command, void* argument) {
  if (command == F_SETLK || command == F_SETLKW) {
    errno = ENOLCK;
    return -1;
  }
  int (*next)(int, int, ...);
  *(void**)&next = dlsym(RTLD_NEXT, name);
  return next(file, command, argument);
}

#define DEFINE(name)                                      \
  int name(int file, int command, ...) {                  \
    va_list arguments;                                    \
    va_start(arguments, command);                         \
    void* argument = va_arg(arguments, void*);            \
    va_end(arguments);                                    \
    return without_locks(#name, file, command, argument); \
  }
DEFINE(fcntl)
DEFINE(fcntl64)
