// SPDX-License-Identifier: MIT
// Exercise 5, three hours: the roots of a cubic, by a formula.
//
// Along a line the trilinear interpolant is a cubic, and the paper solves it by Schwarze's program
// (Graphics Gems, 1990; §4.2). Here c[0] + c[1] t + c[2] t^2 + c[3] t^3 = 0. Return all real roots,
// in any order, without polishing them; a double or a triple root once.
//
// Divide by c[3]: t^3 + A t^2 + B t + C. With t = y - A/3 the square vanishes, and what is left is
//   y^3 + 3 p y + 2 q = 0,   p = B/3 - A^2/9,   q = A^3/27 - A B/6 + C/2.
// D = q^2 + p^3 decides.
//   D > 0  one root: Cardano's. y = u + v with u^3 = -q + sqrt D, v^3 = -q - sqrt D, and u v = -p.
//   D < 0  three roots: y = 2 sqrt(-p) cos((phi + 2 n pi) / 3), with cos phi = -q / sqrt(-p^3).
//   D = 0  q is 0: the triple root y = 0. Else y = 2 u and the double root y = -u, with u^3 = -q.
// Where the discriminant is not exactly 0, the tests know the number of roots from integers, and
// expect it. If all that you compute is exact, as it is for small integers, then D = 0 is told
// exactly, too.
//
// |c[3]| at most 2^-30 of the largest |c[k]| counts as 0: then solve the quadratic, and where its
// leading coefficient is as small, the linear equation. None of a constant, nor of zeros alone.
//
// A formula loses digits where it subtracts. Of u and v one has no cancellation, by the sign of q:
// compute that, and the other from u v = -p. Of the two roots of the quadratic likewise one comes
// from the sum -(b + sign(b) sqrt d) and the other from the product of both. The tests demand a
// value of at most 1e-9 of the terms' size, and roots of the quadratic to 1e-12.
//
// `Roots::push` (roots/cubic.h) adds a root. std::cbrt and std::acos do.
//
// Hint: the argument of acos may be 1 + 1e-16.
Roots closed_form_roots(const Cubic& c) {
  throw std::logic_error("exercise 5: your work");
}
