// SPDX-License-Identifier: MIT
// The stages of Shewchuk (1997), §4.3 and §4.4, behind the filters of predicates.h. Bounds carry
// his names A, B, C; each is (his figure) times the permanent, as derived there.
#include "delaunay/predicates.h"

#include "delaunay/expansion.h"

namespace deliso {
namespace {

// A sum of a few rounded terms, see §4.2 of the paper: how far stage B's estimate is off.
constexpr double kResultBound = (3 + 8 * kEpsilon) * kEpsilon;

constexpr double kOrient3dA = (7 + 56 * kEpsilon) * kEpsilon;
constexpr double kOrient3dB = (3 + 28 * kEpsilon) * kEpsilon;
constexpr double kOrient3dC = (26 + 288 * kEpsilon) * kEpsilon * kEpsilon;

constexpr double kInsphereA = (16 + 224 * kEpsilon) * kEpsilon;
constexpr double kInsphereB = (5 + 72 * kEpsilon) * kEpsilon;
constexpr double kInsphereC = (71 + 1408 * kEpsilon) * kEpsilon * kEpsilon;

int sign_of(double x) {
  return (x > 0) - (x < 0);
}

Vec3 rounding_of_difference(const Vec3& a, const Vec3& b, const Vec3& difference) {
  return {difference_error(a.x, b.x, difference.x), difference_error(a.y, b.y, difference.y),
          difference_error(a.z, b.z, difference.z)};
}

bool is_zero(const Vec3& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

// The x, y rows of two vectors.
Expansion<4> minor2(const Vec3& a, const Vec3& b) {
  return determinant(a.x, b.x, a.y, b.y);
}

// det[a, b, c] from the minors of its x, y rows.
Expansion<24> minor3(const Vec3& a, const Vec3& b, const Vec3& c, const Expansion<4>& bc,
                     const Expansion<4>& ca, const Expansion<4>& ab) {
  return bc * a.z + ca * b.z + ab * c.z;
}

Expansion<24> minor3(const Vec3& a, const Vec3& b, const Vec3& c) {
  return minor3(a, b, c, minor2(b, c), minor2(c, a), minor2(a, b));
}

// det[b-a, c-a, d-a] from the determinants of three points each.
Expansion<96> minor4(const Expansion<24>& bcd, const Expansion<24>& acd, const Expansion<24>& abd,
                     const Expansion<24>& abc) {
  return (bcd - acd) + (abd - abc);
}

// m * |v|^2
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

}  // namespace

namespace predicates {

int orient3d_adaptive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // Stage A: all in doubles.
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double vxwy = v.x * w.y, wxvy = w.x * v.y, wxuy = w.x * u.y;
  const double uxwy = u.x * w.y, uxvy = u.x * v.y, vxuy = v.x * u.y;
  double det = u.z * (vxwy - wxvy) + v.z * (wxuy - uxwy) + w.z * (uxvy - vxuy);
  const double permanent = (std::fabs(vxwy) + std::fabs(wxvy)) * std::fabs(u.z) +
                           (std::fabs(wxuy) + std::fabs(uxwy)) * std::fabs(v.z) +
                           (std::fabs(uxvy) + std::fabs(vxuy)) * std::fabs(w.z);
  if (std::fabs(det) > kOrient3dA * permanent) return sign_of(det);

  // Stage B: the determinant of the rounded differences, exactly.
  const Expansion<24> rounded = minor3(u, v, w);
  det = rounded.estimate();
  if (std::fabs(det) >= kOrient3dB * permanent && det != 0) return sign_of(det);
  const Vec3 du = rounding_of_difference(b, a, u), dv = rounding_of_difference(c, a, v),
             dw = rounding_of_difference(d, a, w);
  if (is_zero(du) && is_zero(dv) && is_zero(dw)) return rounded.sign();

  // Stage C: what the rounding of the differences changes, to first order.
  const double bound = kOrient3dC * permanent + kResultBound * std::fabs(det);
  det += (u.z * ((v.x * dw.y + w.y * dv.x) - (v.y * dw.x + w.x * dv.y)) +
          du.z * (v.x * w.y - v.y * w.x)) +
         (v.z * ((w.x * du.y + u.y * dw.x) - (w.y * du.x + u.x * dw.y)) +
          dv.z * (w.x * u.y - w.y * u.x)) +
         (w.z * ((u.x * dv.y + v.y * du.x) - (u.y * dv.x + v.x * du.y)) +
          dw.z * (u.x * v.y - u.y * v.x));
  if (std::fabs(det) > bound) return sign_of(det);

  return orient3d_exact(a, b, c, d).sign();
}

int insphere_adaptive(const Vec3& pa, const Vec3& pb, const Vec3& pc, const Vec3& pd,
                      const Vec3& pe) {
  // Stage A: all in doubles.
  const Vec3 a = pa - pe, b = pb - pe, c = pc - pe, d = pd - pe;
  struct Minor {
    double value, permanent;
  };
  const auto rough_minor = [](const Vec3& p, const Vec3& q) {
    const double pxqy = p.x * q.y, qxpy = q.x * p.y;
    return Minor{pxqy - qxpy, std::fabs(pxqy) + std::fabs(qxpy)};
  };
  const Minor ab = rough_minor(a, b), bc = rough_minor(b, c), cd = rough_minor(c, d);
  const Minor da = rough_minor(d, a), ac = rough_minor(a, c), bd = rough_minor(b, d);
  const double abc = a.z * bc.value - b.z * ac.value + c.z * ab.value;
  const double bcd = b.z * cd.value - c.z * bd.value + d.z * bc.value;
  const double cda = c.z * da.value + d.z * ac.value + a.z * cd.value;
  const double dab = d.z * ab.value + a.z * bd.value + b.z * da.value;
  const double a2 = length2(a), b2 = length2(b), c2 = length2(c), d2 = length2(d);
  double det = (a2 * bcd - b2 * cda) + (c2 * dab - d2 * abc);
  const double az = std::fabs(a.z), bz = std::fabs(b.z), cz = std::fabs(c.z), dz = std::fabs(d.z);
  const double permanent = (cd.permanent * bz + bd.permanent * cz + bc.permanent * dz) * a2 +
                           (da.permanent * cz + ac.permanent * dz + cd.permanent * az) * b2 +
                           (ab.permanent * dz + bd.permanent * az + da.permanent * bz) * c2 +
                           (bc.permanent * az + ac.permanent * bz + ab.permanent * cz) * d2;
  if (std::fabs(det) > kInsphereA * permanent) return sign_of(det);

  // Stage B: the determinant of the rounded differences, exactly.
  const Expansion<4> xab = minor2(a, b), xbc = minor2(b, c), xcd = minor2(c, d);
  const Expansion<4> xda = minor2(d, a), xac = minor2(a, c), xbd = minor2(b, d);
  const auto rounded = (times_length2(minor3(b, c, d, xcd, -xbd, xbc), a) -
                        times_length2(minor3(c, d, a, xda, xac, xcd), b)) +
                       (times_length2(minor3(d, a, b, xab, xbd, xda), c) -
                        times_length2(minor3(a, b, c, xbc, -xac, xab), d));
  det = rounded.estimate();
  if (std::fabs(det) >= kInsphereB * permanent && det != 0) return sign_of(det);
  const Vec3 ra = rounding_of_difference(pa, pe, a), rb = rounding_of_difference(pb, pe, b),
             rc = rounding_of_difference(pc, pe, c), rd = rounding_of_difference(pd, pe, d);
  if (is_zero(ra) && is_zero(rb) && is_zero(rc) && is_zero(rd)) return rounded.sign();

  // Stage C: what the rounding of the differences changes, to first order.
  const double bound = kInsphereC * permanent + kResultBound * std::fabs(det);
  const auto minor_change = [](const Vec3& p, const Vec3& dp, const Vec3& q, const Vec3& dq) {
    return (p.x * dq.y + q.y * dp.x) - (p.y * dq.x + q.x * dp.y);
  };
  const double rab = minor_change(a, ra, b, rb), rbc = minor_change(b, rb, c, rc);
  const double rcd = minor_change(c, rc, d, rd), rda = minor_change(d, rd, a, ra);
  const double rac = minor_change(a, ra, c, rc), rbd = minor_change(b, rb, d, rd);
  const double change_bcd =
      (b.z * rcd - c.z * rbd + d.z * rbc) + (rb.z * cd.value - rc.z * bd.value + rd.z * bc.value);
  const double change_cda =
      (c.z * rda + d.z * rac + a.z * rcd) + (rc.z * da.value + rd.z * ac.value + ra.z * cd.value);
  const double change_dab =
      (d.z * rab + a.z * rbd + b.z * rda) + (rd.z * ab.value + ra.z * bd.value + rb.z * da.value);
  const double change_abc =
      (a.z * rbc - b.z * rac + c.z * rab) + (ra.z * bc.value - rb.z * ac.value + rc.z * ab.value);
  det += ((a2 * change_bcd + c2 * change_dab) - (b2 * change_cda + d2 * change_abc)) +
         2 * ((dot(a, ra) * bcd + dot(c, rc) * dab) - (dot(b, rb) * cda + dot(d, rd) * abc));
  if (std::fabs(det) > bound) return sign_of(det);

  return insphere_exact(pa, pb, pc, pd, pe);
}

}  // namespace predicates

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  // One coordinate pair at a time: (b-a) x (c-a) = ab + bc + ca of the plane's minors.
  const auto flat = [](double ax, double ay, double bx, double by, double cx, double cy) {
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
