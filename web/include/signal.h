// SPDX-License-Identifier: MIT
// <signal.h>, with the set of signals that WASI has no functions for.
#pragma once

#include_next <signal.h>

#include <__typedef_sigset_t.h>
