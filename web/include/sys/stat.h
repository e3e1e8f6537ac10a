// SPDX-License-Identifier: MIT
// <sys/stat.h>, with functions that WASI lacks (web/system.cpp).
#pragma once

#include_next <sys/stat.h>

extern "C" int fchmod(int descriptor, mode_t mode);
