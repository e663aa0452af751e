# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes HEADER with VERSION and the commit of SOURCE, where it has changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT [[#pragma once
#define SUNLOAD_VERSION "@VERSION@"
#define SUNLOAD_COMMIT "@commit@"
]] @ONLY)
