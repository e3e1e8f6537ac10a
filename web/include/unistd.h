// SPDX-License-Identifier: MIT
// <unistd.h>, with functions that WASI lacks (web/system.cpp).
#pragma once

#include_next <unistd.h>

extern "C" int dup(int descriptor);
