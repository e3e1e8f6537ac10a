// SPDX-License-Identifier: MIT
// The header for the state of a file, with a function that WASI lacks (web/system.cpp).
#pragma once

#include_next <sys/stat.h>

extern "C" int fchmod(int descriptor, mode_t mode);
