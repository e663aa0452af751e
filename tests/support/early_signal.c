// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/* Preloaded, sends this process the signal of EARLY_SIGNAL while libraries are being set up:
 * before `main` begins. */
#include <signal.h>
#include <stdlib.h>

__attribute__((constructor)) static void send_early(void) {
  const char* number = getenv("EARLY_SIGNAL");
  if (number) raise(atoi(number));
}
