// SPDX-License-Identifier: MIT
// Functions that decide samples and vertices, the same bits on every machine. The system library's
// exp, sin, cos and cbrt differ in their last bits between systems, and between processors with
// and without fused multiply-add. These use only operations that IEEE 754 rounds correctly, in a
// fixed order. Errors are at most three units in the last place.
#pragma once

namespace deliso {

// pre: |x| <= 700
double exponential(double x);

// In radians. pre: |x| <= 2^20
double sine(double x);
double cosine(double x);

double cube_root(double x);

}  // namespace deliso
