// SPDX-License-Identifier: MIT
// Voronoi edges and vertices against exact rational solutions.
#include "cases.h"
#include "delaunay/voronoi.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "delaunay/point_sets.h"
#include "exact/big_int.h"
#include "exact/predicates.h"

using namespace deliso;
using oracle::BigInt;
using oracle::BigVec3;

namespace {

struct LongVec3 {
  long double x, y, z;
};

long double norm(const LongVec3& v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

BigVec3 operator+(const BigVec3& a, const BigVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
BigVec3 operator*(const BigInt& s, const BigVec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}

// Everything exact up to the last division, in units of 2^unit, from the corner a.
struct Exact {
  int unit;
  BigVec3 u, v, w;

  explicit Exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
      : unit(oracle::common_unit({a, b, c, d})) {
    const BigVec3 o = oracle::to_integers(a, unit);
    u = oracle::to_integers(b, unit) - o;
    v = oracle::to_integers(c, unit) - o;
    w = oracle::to_integers(d, unit) - o;
  }

  long double value(const BigInt& x, int degree) const {
    return x.divided_by_power(-degree * unit);
  }
  LongVec3 value(const BigVec3& x, int degree) const {
    return {value(x.x, degree), value(x.y, degree), value(x.z, degree)};
  }

  BigInt det() const { return dot(u, cross(v, w)); }
  BigVec3 scaled_circumcenter() const {
    return dot(u, u) * cross(v, w) + dot(v, v) * cross(w, u) + dot(w, w) * cross(u, v);
  }
  LongVec3 circumcenter() const {
    const LongVec3 n = value(scaled_circumcenter(), 4);
    const long double d = 2 * value(det(), 3);
    return {n.x / d, n.y / d, n.z / d};
  }
  LongVec3 facet_circumcenter() const {
    const BigVec3 n = cross(u, v);
    const LongVec3 c = value(dot(u, u) * cross(v, n) + dot(v, v) * cross(n, u), 5);
    const long double d = 2 * value(dot(n, n), 4);
    return {c.x / d, c.y / d, c.z / d};
  }
  long double parameter() const {
    const BigVec3 n = cross(u, v);
    return value(dot(n, scaled_circumcenter()), 6) /
           (2 * std::sqrt(value(dot(n, n), 4)) * value(det(), 3));
  }
};

LongVec3 minus(const Vec3& a, const Vec3& b) {
  return {static_cast<long double>(a.x) - b.x, static_cast<long double>(a.y) - b.y,
          static_cast<long double>(a.z) - b.z};
}

long double distance(const LongVec3& a, const LongVec3& b) {
  return norm({a.x - b.x, a.y - b.y, a.z - b.z});
}

// The four points of a cell that is well shaped, flat, thin or cocircular, down to the last bit.
std::array<Vec3, 4> some_cell(Random& random, int trial) {
  const auto in_cube = [&] {
    return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  const Vec3 o = trial % 2 ? 100 * in_cube() : Vec3{};
  const double tiny = std::ldexp(1.0, -static_cast<int>(random.below(60)));
  const Vec3 u = in_cube(), v = in_cube(), n = cross(u, v);
  std::array<Vec3, 4> p{o, o + u, o + v, o + in_cube()};
  switch (trial / 2 % 5) {
    case 1:  // flat
      p[3] = o + random.uniform(-2, 2) * u + random.uniform(-2, 2) * v + tiny * n;
      break;
    case 2:  // a facet whose corners are all but on a line
      p[2] = o + random.uniform(-2, 2) * u + std::max(tiny, 0x1p-30) * v;
      break;
    case 3: {  // flat and cocircular, as on the face of a voxel
      const double s = random.uniform(0.1, 1), t = random.uniform(0.1, 1);
      p = {o, o + Vec3{s, 0, 0}, o + Vec3{0, t, 0}, o + Vec3{s, t, tiny * random.uniform()}};
      break;
    }
    case 4:  // apex next to a corner
      p[3] = p[trial % 3] + std::max(tiny, 0x1p-20) * in_cube();
      break;
    default:
      break;
  }
  return p;
}

}  // namespace

TEST_CASE("facet lines, their ends and circumspheres agree with exact solutions") {
  int flat = 0;
  for (int trial = 0; trial < test::cases(200'000); ++trial) {
    CAPTURE(trial);
    Random random(trial);
    const auto [a, b, c, d] = some_cell(random, trial);
    if (orient3d(a, b, c, d) == 0 || collinear(a, b, c)) continue;
    const Exact exact(a, b, c, d);

    const FacetLine line = facet_line(a, b, c);
    const LongVec3 center = exact.facet_circumcenter();
    const long double radius = norm(center), ulp = 0x1p-52L * length(a);
    REQUIRE(std::fabs(line.radius - radius) <= 1e-9L * radius);
    REQUIRE(distance(minus(line.center, a), center) <= 1e-9L * radius + ulp);
    const LongVec3 n = exact.value(cross(exact.u, exact.v), 2);
    const long double n1 = norm(n);
    REQUIRE(distance(minus(line.normal, Vec3{}), LongVec3{n.x / n1, n.y / n1, n.z / n1}) <= 1e-9L);

    const long double t_exact = exact.parameter();
    const double t = equidistant_parameter(a, b, c, d, line);
    REQUIRE(!std::isnan(t));
    const long double reach = std::sqrt(radius * radius + t_exact * t_exact);
    REQUIRE(std::fabs(t - t_exact) <= 1e-8L * reach + ulp);
    flat += std::fabs(t_exact) > 1e10;

    const Circumsphere sphere = circumsphere(a, b, c, d);
    const LongVec3 vertex = exact.circumcenter();
    const long double sphere_radius = norm(vertex);
    REQUIRE(std::fabs(sphere.radius - sphere_radius) <= 1e-9L * sphere_radius);
    REQUIRE(distance(minus(sphere.center, a), vertex) <= 1e-9L * sphere_radius + ulp);
  }
  CHECK(flat > test::cases(1000));
}

// Rows of a matrix of determinant 1 whose entries have up to 50 bits: double-doubles lose all
// digits of it.
TEST_CASE("of the flattest cells, too, ends are on the right side of the facet and no NaN") {
  for (int trial = 0; trial < 2000; ++trial) {
    CAPTURE(trial);
    Random random(trial);
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    while (std::max({length(rows[0]), length(rows[1]), length(rows[2])}) < 0x1p49) {
      const std::uint32_t n = random.below(3), m = (n + 1 + random.below(2)) % 3;
      rows[n] = rows[n] + (random.below(2) == 0 ? 1.0 : -1.0) * rows[m];
    }
    const Exact exact({}, rows[0], rows[1], rows[2]);
    const FacetLine line = facet_line({}, rows[0], rows[1]);
    const double t = equidistant_parameter({}, rows[0], rows[1], rows[2], line);
    REQUIRE((t > 0) == (exact.parameter() > 0));
    REQUIRE(!std::isnan(circumsphere({}, rows[0], rows[1], rows[2]).radius));
  }
}

TEST_CASE("facet_dual is the same from both cells, with ends at circumcenters or infinity") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < 10 * static_cast<int>(oracle::PointSet::kCount); ++trial) {
    CAPTURE(trial);
    const auto kind =
        static_cast<oracle::PointSet>(trial % static_cast<int>(oracle::PointSet::kCount));
    const auto points = oracle::make_point_set(kind, 60, 5000 + trial);
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    int infinite_ends = 0;
    for (CellId c = 0; c < t.cell_capacity(); ++c) {
      if (!t.is_live(c)) continue;
      for (int i = 0; i < 4; ++i) {
        const Facet f{c, i}, g = t.mirror(f);
        if (has_infinite_vertex(t, f)) continue;
        const FacetDual dual = facet_dual(t, f), back = facet_dual(t, g);
        REQUIRE(dual.center == back.center);
        REQUIRE(dual.normal == back.normal);
        REQUIRE(dual.radius == back.radius);
        REQUIRE(dual.t_lo == back.t_lo);
        REQUIRE(dual.t_hi == back.t_hi);
        REQUIRE(dual.t_lo <= dual.t_hi);

        // The normal points away from the cell at the low end.
        const auto offset = [&](Facet h) {
          const SiteId apex = t.vertex(h.cell, h.index);
          return apex == Triangulation::kInfinite ? 0
                                                  : dot(dual.normal, t.point(apex) - dual.center);
        };
        // Corners in the order of their ids turn counter-clockwise as seen from the high end.
        SiteTriangle v = facet_vertices(t, f);
        std::ranges::sort(v);
        const bool f_is_finite = t.vertex(c, i) != Triangulation::kInfinite;
        const Facet finite_one = f_is_finite ? f : g;
        const bool is_above = orient3d(t.point(v[0]), t.point(v[1]), t.point(v[2]),
                                       t.point(t.vertex(finite_one.cell, finite_one.index))) > 0;
        const Facet low = is_above == f_is_finite ? g : f, high = is_above == f_is_finite ? f : g;
        REQUIRE(offset(low) <= 1e-9 * dual.radius);
        REQUIRE(offset(high) >= -1e-9 * dual.radius);
        REQUIRE((dual.t_lo == -kInfinity) == t.is_infinite(low.cell));
        REQUIRE((dual.t_hi == kInfinity) == t.is_infinite(high.cell));
        infinite_ends += t.is_infinite(low.cell) + t.is_infinite(high.cell);

        // A finite end is the cell's circumcenter.
        for (const bool at_low : {true, false}) {
          const Facet h = at_low ? low : high;
          if (t.is_infinite(h.cell)) continue;
          const Circumsphere sphere = circumsphere(t, h.cell);
          const double end = at_low ? dual.t_lo : dual.t_hi;
          const double ulp = 0x1p-51 * length(dual.center);
          REQUIRE(distance(dual.at(end), sphere.center) <= 1e-8 * sphere.radius + ulp);
        }
      }
    }
    CHECK(infinite_ends >= 8);
  }
}

TEST_CASE(
    "a facet that survives an insertion keeps its line, bit for bit, and a part of its edge") {
  const auto points = oracle::make_point_set(oracle::PointSet::kRandom, 120, 6);
  Triangulation t;
  std::vector<SiteId> ids;
  REQUIRE(t.build(std::span(points).first(60), ids));
  ConflictZone zone;
  std::vector<CellId> created;
  for (std::size_t i = 60; i < points.size(); ++i) {
    CAPTURE(i);
    t.find_conflicts(points[i], kNoId, zone);
    std::vector<FacetDual> before;
    for (const Facet& f : zone.boundary)
      before.push_back(has_infinite_vertex(t, f) ? FacetDual{} : facet_dual(t, f));
    t.insert_in_zone(points[i], zone, created);
    for (std::size_t k = 0; k < created.size(); ++k) {
      const Facet f{created[k], zone.boundary[k].index};
      if (has_infinite_vertex(t, f)) continue;
      const FacetDual after = facet_dual(t, f);
      REQUIRE(after.center == before[k].center);
      REQUIRE(after.normal == before[k].normal);
      REQUIRE(after.radius == before[k].radius);
      REQUIRE(after.t_lo >= before[k].t_lo - 1e-9);
      REQUIRE(after.t_hi <= before[k].t_hi + 1e-9);
    }
  }
}
