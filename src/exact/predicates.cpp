// SPDX-License-Identifier: MIT
// The layers behind the filters of predicates.h: double-doubles, then expansions.
#include "exact/predicates.h"

#include <cfloat>
#include <initializer_list>

#include "exact/double_double.h"
#include "exact/expansion.h"

namespace deliso {
namespace {

static_assert(FLT_EVAL_METHOD == 0, "every operation on doubles must round to a double");

using predicates::largest;

// Rounding error of the determinants in double-doubles, relative to a sixth of the permanent.
// Differences of coordinates are exact. A term of orient3d passes through at most 5 rounded
// operations, of insphere 11. One more covers products of errors and the rounding of the bound.
constexpr double kOrient3dBound = 6 * 6 * kDoubleDoubleEpsilon;
constexpr double kInsphereBound = 12 * 6 * kDoubleDoubleEpsilon;

// If all differences are integers below 2^k in one unit, orient3d is below 6 * 2^3k units. The
// partial sums of insphere are below 24 * 3 * 2^5k. Both are exact in 53 bits for these k.
constexpr int kOrient3dShortBits = 16;
constexpr int kInsphereShortBits = 9;
static_assert(6.0 * (1LL << 3 * kOrient3dShortBits) < 0x1p53);
static_assert(72.0 * (1LL << 5 * kInsphereShortBits) < 0x1p53);

// True if all coordinates are such integers, in any unit. Adding and subtracting a large number
// rounds to a multiple of the unit in its last place, at least 2^-k of the largest coordinate. If
// the sum falls below a power of two, the unit is half of that. The largest coordinate may be
// almost twice that power. Hence two bits to spare.
bool are_short(std::initializer_list<Vec3> vectors, int k) {
  double size = 0;
  for (const Vec3& v : vectors) size = std::max(size, largest(v.x, v.y, v.z));
  constexpr int kDigits = std::numeric_limits<double>::digits;
  const double large = size * static_cast<double>(1LL << (kDigits - 1 - (k - 2)));
  const auto is_short = [large](double x) { return (x + large) - large == x; };
  return std::all_of(vectors.begin(), vectors.end(), [&](const Vec3& v) {
    return is_short(v.x) && is_short(v.y) && is_short(v.z);
  });
}

int sign_of(double x) {
  return (x > 0) - (x < 0);
}

int sign_beyond(double bound, const DoubleDouble& x) {
  return (x.high > bound) - (x.high < -bound);
}

// Returns the minor of the x, y rows of two vectors.
Expansion<4> minor2(const Vec3& a, const Vec3& b) {
  return determinant(a.x, b.x, a.y, b.y);
}

// Returns det[a, b, c] from the minors of its x, y rows.
Expansion<24> minor3(const Vec3& a, const Vec3& b, const Vec3& c, const Expansion<4>& bc,
                     const Expansion<4>& ca, const Expansion<4>& ab) {
  return bc * a.z + ca * b.z + ab * c.z;
}

Expansion<24> minor3(const Vec3& a, const Vec3& b, const Vec3& c) {
  return minor3(a, b, c, minor2(b, c), minor2(c, a), minor2(a, b));
}

// Returns det[b-a, c-a, d-a] from the determinants of three points each.
Expansion<96> minor4(const Expansion<24>& bcd, const Expansion<24>& acd, const Expansion<24>& abd,
                     const Expansion<24>& abc) {
  return (bcd - acd) + (abd - abc);
}

// Returns m * |v|^2.
template <int N>
Expansion<12 * N> times_length2(const Expansion<N>& m, const Vec3& v) {
  return m * v.x * v.x + m * v.y * v.y + m * v.z * v.z;
}

Expansion<96> orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return minor4(minor3(b, c, d), minor3(a, c, d), minor3(a, b, d), minor3(a, b, c));
}

// The 5 x 5 determinant of the lifted points, expanded by the column of squared lengths.
int insphere_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  const Expansion<4> ab = minor2(a, b), ac = minor2(a, c), ad = minor2(a, d), ae = minor2(a, e);
  const Expansion<4> bc = minor2(b, c), bd = minor2(b, d), be = minor2(b, e);
  const Expansion<4> cd = minor2(c, d), ce = minor2(c, e), de = minor2(d, e);
  const Expansion<24> abc = minor3(a, b, c, bc, -ac, ab), abd = minor3(a, b, d, bd, -ad, ab);
  const Expansion<24> abe = minor3(a, b, e, be, -ae, ab), acd = minor3(a, c, d, cd, -ad, ac);
  const Expansion<24> ace = minor3(a, c, e, ce, -ae, ac), ade = minor3(a, d, e, de, -ae, ad);
  const Expansion<24> bcd = minor3(b, c, d, cd, -bd, bc), bce = minor3(b, c, e, ce, -be, bc);
  const Expansion<24> bde = minor3(b, d, e, de, -be, bd), cde = minor3(c, d, e, de, -ce, cd);
  const auto lifted_a = times_length2(minor4(cde, bde, bce, bcd), a);
  const auto lifted_b = times_length2(minor4(cde, ade, ace, acd), b);
  const auto lifted_c = times_length2(minor4(bde, ade, abe, abd), c);
  const auto lifted_d = times_length2(minor4(bce, ace, abe, abc), d);
  const auto lifted_e = times_length2(minor4(bcd, acd, abd, abc), e);
  return (((lifted_b - lifted_a) + (lifted_d - lifted_c)) - lifted_e).sign();
}

// As above, with e at the origin.
int insphere_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Expansion<4> ab = minor2(a, b), bc = minor2(b, c), cd = minor2(c, d);
  const Expansion<4> da = minor2(d, a), ac = minor2(a, c), bd = minor2(b, d);
  return ((times_length2(minor3(b, c, d, cd, -bd, bc), a) -
           times_length2(minor3(c, d, a, da, ac, cd), b)) +
          (times_length2(minor3(d, a, b, ab, bd, da), c) -
           times_length2(minor3(a, b, c, bc, -ac, ab), d)))
      .sign();
}

}  // namespace

namespace predicates {

int orient3d_adaptive(const Vec3& pa, const Vec3& pb, const Vec3& pc, const Vec3& pd) {
  const auto fine_u = DoubleDouble3::difference(pb, pa), fine_v = DoubleDouble3::difference(pc, pa),
             fine_w = DoubleDouble3::difference(pd, pa);
  const Vec3 u = fine_u.rounded(), v = fine_v.rounded(), w = fine_w.rounded();
  const bool are_doubles = fine_u.is_double() && fine_v.is_double() && fine_w.is_double();
  if (are_doubles && are_short({u, v, w}, kOrient3dShortBits))
    return sign_of(orient3d_determinant(u, v, w));

  const DoubleDouble det = orient3d_determinant(fine_u, fine_v, fine_w);
  const double bound = kOrient3dBound * orient3d_scale(u, v, w);
  if (const int sign = sign_beyond(bound, det)) return sign;

  // Expansions are much shorter on differences, if these are doubles.
  return are_doubles ? minor3(u, v, w).sign() : orient3d_exact(pa, pb, pc, pd).sign();
}

int insphere_adaptive(const Vec3& pa, const Vec3& pb, const Vec3& pc, const Vec3& pd,
                      const Vec3& pe) {
  const auto fine_a = DoubleDouble3::difference(pa, pe), fine_b = DoubleDouble3::difference(pb, pe),
             fine_c = DoubleDouble3::difference(pc, pe), fine_d = DoubleDouble3::difference(pd, pe);
  const Vec3 a = fine_a.rounded(), b = fine_b.rounded(), c = fine_c.rounded(), d = fine_d.rounded();
  const bool are_doubles =
      fine_a.is_double() && fine_b.is_double() && fine_c.is_double() && fine_d.is_double();
  if (are_doubles && are_short({a, b, c, d}, kInsphereShortBits))
    return sign_of(insphere_determinant(a, b, c, d));

  const DoubleDouble det = insphere_determinant(fine_a, fine_b, fine_c, fine_d);
  const double bound = kInsphereBound * insphere_scale(a, b, c, d);
  if (const int sign = sign_beyond(bound, det)) return sign;

  return are_doubles ? insphere_exact(a, b, c, d) : insphere_exact(pa, pb, pc, pd, pe);
}

}  // namespace predicates

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  // One coordinate pair at a time: (b-a) x (c-a) = ab + bc + ca of the plane's minors.
  const auto flat = [](double ax, double ay, double bx, double by, double cx, double cy) {
    // Bound A of orient2d in Shewchuk 1997, Figure 21.
    constexpr double kFilter = 3.3306690738754716e-16;
    const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx);
    if (std::fabs(left - right) > kFilter * (std::fabs(left) + std::fabs(right))) return false;
    return ((determinant(ax, bx, ay, by) + determinant(bx, cx, by, cy)) +
            determinant(cx, ax, cy, ay))
               .sign() == 0;
  };
  return flat(a.x, a.y, b.x, b.y, c.x, c.y) && flat(a.y, a.z, b.y, b.z, c.y, c.z) &&
         flat(a.z, a.x, b.z, b.x, c.z, c.x);
}

double orient3d_value(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return orient3d_exact(a, b, c, d).estimate();
}

}  // namespace deliso
