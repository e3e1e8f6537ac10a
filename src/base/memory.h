// SPDX-License-Identifier: MIT
// What becomes of memory that was freed, where the C library (glibc) lets a program choose.
#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace deliso {

// Keeps it for later, but for arrays from 1 MiB on. A page that comes from the system again is
// cleared first, which takes time. For a program to call as it begins.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 27);
  mallopt(M_TOP_PAD, 1 << 24);
#endif
}

// Gives what is kept back to the system.
inline void give_back_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace deliso
