// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions that are there for every width of vectors that processors have; the program takes the
/// widest when it starts. Their numbers are the same for all (no contraction of products and sums).
/// Compilers leave loops scalar where what is written might be what is read: __restrict says that
/// it is not, and -fopt-info-vec-optimized what became of each loop. The compiler's own vector
/// types have one width in all of these functions, and a processor with less goes by way of memory.
#pragma once

/// Before a function. Not with the thread sanitizer: functions are chosen before it is ready.
#ifdef __SANITIZE_THREAD__
#define SUNLOAD_VECTOR_CODE
#else
#define SUNLOAD_VECTOR_CODE __attribute__((target_clones("default", "avx2", "avx512f")))
#endif
