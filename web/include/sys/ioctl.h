// SPDX-License-Identifier: MIT
// The header for devices, with the size of a terminal, which WASI does not tell.
#pragma once

#include_next <sys/ioctl.h>

struct winsize {
  unsigned short ws_row, ws_col;
};
constexpr int TIOCGWINSZ = 0;  // ioctl() knows no such request and fails
