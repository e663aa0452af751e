// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/late_library.h"

#include <dlfcn.h>

#include <string>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// Why the last call failed.
std::string load_error() {
  const char* text = dlerror();
  return text != nullptr ? text : "no reason is given";
}

}  // namespace

void* late_address(const char* library, const char* function) {
  // What is loaded already is found again.
  void* handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    throw MachineError("cannot load the library " + std::string(library) + ": " + load_error() +
                       "; install its package");
  void* address = dlsym(handle, function);
  if (address == nullptr)
    throw MachineError("the library " + std::string(library) +
                       " is another edition: " + load_error());
  return address;
}

}  // namespace sunload
