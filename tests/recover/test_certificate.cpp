// SPDX-License-Identifier: MIT
// The conditions C1 to C4 of the certificate, each broken by itself. A surface is drawn as rows of
// letters, one letter for each vertex of T (recover/labeled.h). The vertices of a region lie
// around its site as they lie in the drawing.
#include "recover/certificate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "recover/labeled.h"

using namespace deliso;
using namespace deliso::test;

namespace {

using Rows = std::vector<std::string>;

// The surface of the rows: a disk whose boundary lies on the box, or a sphere. A sphere has one
// more vertex above the first row and one below the last; `poles` has their letters.
struct Drawing {
  Rows rows;
  std::string poles;  // empty: a disk

  bool is_sphere() const { return !poles.empty(); }
  int height() const { return static_cast<int>(rows.size()); }
  int width() const { return static_cast<int>(rows[0].size()); }
  ContourId at(int row, int column) const { return ContourId(row * width() + column % width()); }
  ContourId pole(int n) const { return ContourId(height() * width() + n); }
  std::string letters() const {
    std::string all;
    for (const std::string& row : rows) all += row;
    return all + poles;
  }
};

std::vector<ContourTriangle> triangles_of(const Drawing& d) {
  std::vector<ContourTriangle> triangles;
  const int columns = d.is_sphere() ? d.width() : d.width() - 1;
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r + 1 < d.height(); ++r) {
      triangles.push_back({d.at(r, c), d.at(r + 1, c), d.at(r, c + 1)});
      triangles.push_back({d.at(r, c + 1), d.at(r + 1, c), d.at(r + 1, c + 1)});
    }
    if (!d.is_sphere()) continue;
    triangles.push_back({d.pole(0), d.at(0, c), d.at(0, c + 1)});
    triangles.push_back({d.pole(1), d.at(d.height() - 1, c + 1), d.at(d.height() - 1, c)});
  }
  return triangles;
}

// Where the vertex lies in the drawing as seen from another; rows are a little further apart, so
// that few vertices are as far.
Vec3 offset(const Drawing& d, ContourId from, ContourId to) {
  const auto row = [&](ContourId v) {
    if (v == d.pole(0)) return -1;
    return v == d.pole(1) ? d.height() : static_cast<int>(v) / d.width();
  };
  int columns = 0;
  if (std::max(from, to) < d.pole(0)) {
    columns = static_cast<int>(to) % d.width() - static_cast<int>(from) % d.width();
    if (d.is_sphere() && 2 * columns > d.width()) columns -= d.width();
    if (d.is_sphere() && 2 * columns < -d.width()) columns += d.width();
  }
  return {0.1 * columns, 0.11 * (row(to) - row(from)), 0};
}

Shape shape_of(const Drawing& d) {
  Shape shape{d.letters(), triangles_of(d), {}};
  for (ContourId v = 0; v < shape.letters.size(); ++v) {
    shape.offsets.push_back(offset(d, shape.site(v), v));
  }
  return shape;
}

// Checks that exactly the sites of `broken` break a condition, that `site` breaks `violation`, and
// that its verdict names the vertex `named`. After insertions as the verdicts name them, the dual
// must be a mesh of T's topology.
void check_broken(const Drawing& drawing, char site, paper::Reason violation, ContourId named,
                  const std::string& broken) {
  Labeled t(shape_of(drawing));
  CHECK(t.broken() == broken);
  const Verdict verdict = t.check(site);
  CHECK(verdict.violation == violation);
  REQUIRE(verdict.insert == named);
  t.insert(named);
  CHECK(t.insert_until_certified() < static_cast<int>(drawing.letters().size()) / 2);
  CHECK(t.broken().empty());
  CHECK(t.fault_of_dual() == "");
}

// Checks that exactly the sites of `broken` break a condition, and only this one. All sites have
// facets, but the dual is no mesh of T's topology. After the insertions it is.
void check_alone(const Shape& shape, paper::Reason violation, const std::string& broken) {
  Labeled t(shape);
  CHECK(t.broken() == broken);
  CHECK(t.broken_conditions() == std::set{violation});
  CHECK(t.has_facets_at_all_sites());
  CHECK(t.fault_of_dual() != "");
  t.insert_until_certified();
  CHECK(t.fault_of_dual() == "");
}

}  // namespace

// The vertex furthest from the site is not in the stray piece. The Euler number is wrong too, and
// must not decide which vertex is named.
TEST_CASE("C1: a region in two pieces breaks it; the furthest vertex of the stray piece is named") {
  const Drawing sphere{{"AbaabCcc", "abbbbccc", "abbBbccc", "abbbbccc", "abbbbccc"}, "cb"};
  check_broken(sphere, 'A', paper::Reason::region, sphere.at(0, 3), "ABC");
}

// Three regions fill the hole, so that each meets the one around it in one arc.
TEST_CASE("C1: a region with a hole breaks it") {
  const Drawing belt{{"bbCcDd", "Aaaaaa", "eeFfGg"}, "BE"};
  check_broken(belt, 'A', paper::Reason::region, belt.at(1, 3), "A");
}

TEST_CASE("C2: two regions that meet twice, with other regions between, break it") {
  const Drawing sphere{{"cCcceEee", "BbAaaabb", "bbaaaabb", "dDddfFff"}, "cd"};
  check_broken(sphere, 'A', paper::Reason::interface, sphere.at(2, 5), "AB");
}

TEST_CASE("C3: three labels that meet on two triangles break it") {
  const Drawing sphere{{"AaBbcC", "aabbcc"}, "aa"};
  check_broken(sphere, 'A', paper::Reason::triple, sphere.pole(1), "ABC");
}

TEST_CASE("C4: a region on the box whose site is inside breaks it") {
  const Drawing disk{{"BbbccC", "baaaac", "baAaac", "baaaac"}, ""};
  check_broken(disk, 'A', paper::Reason::boundary, disk.at(3, 4), "A");
}

TEST_CASE("C4: a region that meets the box in two arcs breaks it") {
  const Drawing disk{{"BbAacC", "bbaacc", "ddaaee", "DdaaeE"}, ""};
  check_broken(disk, 'A', paper::Reason::boundary, disk.at(3, 3), "A");
}

TEST_CASE("C4: two regions that meet in two edges on the box break it") {
  const Drawing disk{{"AaBb", "aabb", "aabb"}, ""};
  check_broken(disk, 'A', paper::Reason::boundary, disk.at(2, 1), "AB");
}

// The pictures of docs/proof.md.
TEST_CASE("C1: labels that break it alone have a dual unlike T") {
  check_alone(
      shape_of("aaaABC", {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}}),
      paper::Reason::region, "A");
}

TEST_CASE("C2: labels that break it alone have a dual unlike T") {
  check_alone(
      shape_of("ABCaDE",
               {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}, {4, 3, 5}}),
      paper::Reason::interface, "AB");
}

TEST_CASE("C3: labels that break it alone have a dual unlike T") {
  check_alone(shape_of("AaBC", {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}), paper::Reason::triple,
              "ABC");
}

TEST_CASE("C4: labels that break it alone have a dual unlike T") {
  check_alone(shape_of("ABCbDE", {{0, 2, 1}, {1, 2, 3}, {1, 3, 4}, {4, 3, 5}}),
              paper::Reason::boundary, "B");
}

TEST_CASE("C1: a region that is a whole torus breaks it") {
  ContourTriangles torus;
  for (ContourId v = 0; v < 9; ++v) {
    const ContourId right(v / 3 * 3 + (v + 1) % 3);
    const ContourId above((v + 3) % 9), across((right + 3) % 9);
    torus.insert(torus.end(), {{v, right, across}, {v, across, above}});
  }
  Labeled t(shape_of("Aaaaaaaaa", torus));
  CHECK(t.check('A').violation == paper::Reason::region);
  CHECK(t.check('A').insert == 8);
}

TEST_CASE("labels without a dual facet: one region or two that are a whole sphere or disk") {
  const ContourTriangles sphere{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, disk{{0, 1, 2}};
  const auto check = [](const std::string& letters, const ContourTriangles& triangles,
                        paper::Reason violation) {
    CAPTURE(letters);
    Labeled t(shape_of(letters, triangles));
    CHECK(t.dual().triangles.empty());
    CHECK(t.broken_conditions() == std::set{violation});
    t.insert_until_certified();
    CHECK(t.fault_of_dual() == "");
  };
  check("Aaaa", sphere, paper::Reason::region);
  check("AaBb", sphere, paper::Reason::interface);
  check("Aaa", disk, paper::Reason::boundary);
  check("AaB", disk, paper::Reason::boundary);
}
