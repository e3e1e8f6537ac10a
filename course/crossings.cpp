// SPDX-License-Identifier: MIT
// Exercise 6, four hours: where does a line meet the surface within a voxel?
//
// Along a line the trilinear interpolant is a cubic (§4.2), given here by its Bernstein
// coefficients:
//   p(t) = b0 (1-t)^3 + 3 b1 (1-t)^2 t + 3 b2 (1-t) t^2 + b3 t^3.
// Return where it passes from p >= 0 to p < 0 or back, for t in [0, 1], increasing (roots/cubic.h).
// Where there is one, `from_inside` tells the side on which the line begins: p(0) >= 0.
// All of the program rests on the parity: the number is odd exactly when b0 and b3 are on different
// sides, whatever is rounded. A touch is none or two. Where you say that there is a crossing, |p|
// must be at most 2e-11 of the largest coefficient.
//
// The paper solves it in closed form (Schwarze 1990), which loses digits at double roots. Or: cut
// [0, 1] at the roots of p'. Each piece is monotone, so the signs at its ends decide, and bisection
// or Newton's method in a bracket finds the root. `critical_points`, `value_at`, `single_root` and
// `bracketed_root` (roots/bracket.h) are there to be called, and take coefficients of powers of t.
// Or write your own. `method` may be ignored.
//
// Hint: count the changes of sign in b0, b1, b2, b3. What do none and one say? For the parity use
// b0 and b3 themselves as the values at the ends, not what a formula gives there.
Roots crossings(const Cubic& b, CubicMethod method) {
  throw std::logic_error("exercise 6: your work");
}
