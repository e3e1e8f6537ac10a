// SPDX-License-Identifier: MIT
// TetGen's files of meshes whose facets have labels: markers of pairs of labels, and a point in
// each bounded region. That a point lies in its region is told by winding numbers.
#include <doctest/doctest.h>

#include <map>
#include <set>
#include <sstream>

#include "base/random.h"
#include "io/mesh/region_points.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

using Sides = std::vector<std::array<std::int64_t, 2>>;

struct Labeled {
  std::vector<Vec3> points;
  Triangles triangles;
  Sides sides;
  std::size_t first_cap = ~std::size_t{0};

  void add(const Triangles& more, std::array<std::int64_t, 2> labels) {
    triangles.insert(triangles.end(), more.begin(), more.end());
    sides.resize(triangles.size(), labels);
  }
  // Adds an octahedron.
  void add_ball(const Vec3& center, double radius, std::array<std::int64_t, 2> labels) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int n = 0; n < 6; ++n) {
      Vec3 p = center;
      p[n / 2] += n % 2 == 0 ? radius : -radius;
      points.push_back(p);
    }
    Triangles facets = octahedron();
    for (Triangle& t : facets) {
      for (VertexId& v : t) v = VertexId(first + v.number());
    }
    add(facets, labels);
  }

  RegionPoints regions() const { return region_points({points, triangles, sides, first_cap}); }

  // Returns how often the surface of the label winds around p: 1 in the label, 0 elsewhere.
  double winding(std::int64_t label, const Vec3& p) const {
    Triangles surface;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const auto& [a, b, c] = triangles[f];
      if (sides[f][1] == label) surface.push_back({a, b, c});
      if (sides[f][0] == label && f < first_cap) surface.push_back({a, c, b});
    }
    return winding_number(points, surface, p);
  }
};

// n x n x n cells, each of a label of its own from 1 on, in a box whose faces are caps. Points
// between cells are moved at random, less than makes facets cross.
Labeled cells(int n, std::uint64_t seed) {
  Labeled mesh;
  Random random(seed);
  const auto id = [n](const std::array<int, 3>& at) {
    return static_cast<std::uint32_t>(at[0] + (n + 1) * (at[1] + (n + 1) * at[2]));
  };
  std::array<int, 3> at{};
  for (at[2] = 0; at[2] <= n; ++at[2]) {
    for (at[1] = 0; at[1] <= n; ++at[1]) {
      for (at[0] = 0; at[0] <= n; ++at[0]) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
          const bool is_free = at[axis] > 0 && at[axis] < n;
          p[axis] = at[axis] + (is_free ? random.uniform(-0.2, 0.2) : 0);
        }
        mesh.points.push_back(p);
      }
    }
  }
  const auto label = [n](const std::array<int, 3>& cell) {
    return 1 + cell[0] + n * (cell[1] + n * cell[2]);
  };
  Labeled caps;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (at[axis] = 0; at[axis] <= n; ++at[axis]) {
      for (at[v] = 0; at[v] < n; ++at[v]) {
        for (at[u] = 0; at[u] < n; ++at[u]) {
          std::array<int, 3> before = at, b = at, c = at, d = at;
          --before[axis];
          ++b[u];
          ++c[u], ++c[v];
          ++d[v];
          // Seen from the high side of the axis, where the label in front is.
          Triangles square{triangle_of(id(at), id(b), id(c)), triangle_of(id(at), id(c), id(d))};
          if (at[axis] == 0) {
            for (Triangle& t : square) std::swap(t[1], t[2]);
            caps.add(square, {-1 - 2 * axis, label(at)});
          } else if (at[axis] == n) {
            caps.add(square, {-2 - 2 * axis, label(before)});
          } else {
            mesh.add(square, {label(at), label(before)});
          }
        }
      }
    }
  }
  mesh.first_cap = mesh.triangles.size();
  mesh.triangles.insert(mesh.triangles.end(), caps.triangles.begin(), caps.triangles.end());
  mesh.sides.insert(mesh.sides.end(), caps.sides.begin(), caps.sides.end());
  return mesh;
}

}  // namespace

TEST_CASE("each cell of a block has a region point inside, with its label") {
  for (const int n : {1, 2, 5}) {
    CAPTURE(n);
    const Labeled mesh = cells(n, 7);
    const RegionPoints found = mesh.regions();
    CHECK(found.open.empty());
    REQUIRE(found.points.size() == static_cast<std::size_t>(n * n * n));
    for (std::size_t at = 0; at < found.points.size(); ++at) {
      CHECK(found.points[at].label == static_cast<std::int64_t>(at + 1));
      CHECK(mesh.winding(found.points[at].label, found.points[at].p) == doctest::Approx(1));
    }
  }
}

TEST_CASE("without caps, the cells at the box are open and have no region point") {
  Labeled mesh = cells(3, 8);
  mesh.triangles.resize(mesh.first_cap);
  mesh.sides.resize(mesh.first_cap);
  const RegionPoints found = mesh.regions();
  REQUIRE(found.points.size() == 1);
  CHECK(found.points[0].label == 14);  // the cell in the middle
  CHECK(mesh.winding(14, found.points[0].p) == doctest::Approx(1));
  CHECK(found.open.size() == 26);
}

TEST_CASE("regions in regions: one point each, none in the background outside") {
  Labeled mesh;
  mesh.add_ball({}, 9, {0, 5});  // a shell of 5 around background, in which a 3 holds a 5
  mesh.add_ball({}, 7, {5, 0});
  mesh.add_ball({1, 0, 0}, 4, {0, 3});
  mesh.add_ball({1, 0.5, 0}, 1, {3, 5});
  mesh.add_ball({30, 0, 0}, 2, {0, -4});  // another one beside
  const RegionPoints found = mesh.regions();
  CHECK(found.open.empty());
  std::map<std::int64_t, int> count;
  for (const auto& [p, label] : found.points) {
    ++count[label];
    if (label == 0) {
      CHECK(mesh.winding(5, p) == doctest::Approx(0));
      CHECK(length(p) < 7);
    } else {
      CHECK(mesh.winding(label, p) == doctest::Approx(1));
    }
  }
  CHECK(count == std::map<std::int64_t, int>{{-4, 1}, {0, 1}, {3, 1}, {5, 2}});
}

TEST_CASE("TetGen's files: a table of markers, a marker for each pair, and regions") {
  const int n = 2;
  const Labeled cells_of_box = cells(n, 9);
  TriMesh mesh = make_tri_mesh(cells_of_box.points, cells_of_box.triangles);
  for (const double x_axis : {1.0, -1.0}) {  // the second mirrors
    mesh.frame.axes[0] = {x_axis, 0, 0};
    for (const MeshFormat format : {MeshFormat::smesh, MeshFormat::poly}) {
      const std::string bytes = written(mesh, {.format = format,
                                               .comment = "deliso -o a.smesh",
                                               .first_cap = cells_of_box.first_cap,
                                               .sides = cells_of_box.sides});
      std::istringstream in(bytes);
      std::string line;
      std::getline(in, line);
      std::getline(in, line);
      CHECK(line == "# deliso -o a.smesh");
      std::getline(in, line);
      CHECK(line ==
            "# marker, label in front, label behind; in front of faces of the box -1 low x, -2 "
            "high x, -3 low y, -4 high y, -5 low z, -6 high z");
      Sides pairs;
      while ((in >> std::ws).peek() == '#') {
        char hash = 0;
        std::size_t marker = 0;
        std::array<std::int64_t, 2> pair{};
        in >> hash >> marker >> pair[0] >> pair[1];
        pairs.push_back(pair);
        CHECK(marker == pairs.size());
      }
      // 12 squares between two cells; on each face of the box four of one cell.
      CHECK(pairs.size() == 12 + 24);
      CHECK(std::set(pairs.begin(), pairs.end()).size() == pairs.size());
      CHECK(pairs.front() == std::array<std::int64_t, 2>{2, 1});
      CHECK(pairs[12] == std::array<std::int64_t, 2>{-6, 5});

      std::size_t count = 0, number = 0;
      std::string rest;
      in >> count;
      std::getline(in, rest);
      Labeled as_written;
      as_written.sides = cells_of_box.sides;
      as_written.first_cap = cells_of_box.first_cap;
      as_written.points.resize(count);
      for (Vec3& p : as_written.points) in >> number >> p.x >> p.y >> p.z;
      in >> count;
      std::getline(in, rest);
      REQUIRE(count == cells_of_box.triangles.size());
      for (std::size_t f = 0; f < count; ++f) {
        std::size_t marker = 0, polygons = 1, holes = 0, corners = 0;
        std::array<std::uint32_t, 3> v{};
        if (format == MeshFormat::poly) in >> polygons >> holes >> marker;
        in >> corners >> v[0] >> v[1] >> v[2];
        if (format == MeshFormat::smesh) in >> marker;
        REQUIRE(marker - 1 < pairs.size());
        CHECK(pairs[marker - 1] == cells_of_box.sides[f]);
        as_written.triangles.push_back(triangle_of(v[0], v[1], v[2]));
      }
      std::size_t holes = 1;
      in >> holes >> count;
      CHECK(holes == 0);
      REQUIRE(count == n * n * n);
      for (std::size_t at = 1; at <= count; ++at) {
        Vec3 p;
        std::int32_t label = 0;
        double volume = 0;
        in >> number >> p.x >> p.y >> p.z >> label >> volume;
        CHECK(number == at);
        CHECK(volume == -1);
        CHECK(as_written.winding(label, p) == doctest::Approx(1));
      }
      CHECK_FALSE(in.fail());
      CHECK((in >> std::ws).eof());
    }
  }
}

TEST_CASE("TetGen's files say which labels have surfaces that bound no region") {
  TriMesh mesh = make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Triangles{{0, 1, 2}});
  CHECK(written(mesh, {.format = MeshFormat::smesh, .sides = {{0, 7}}}) ==
        "# DelIso\n# marker, label in front, label behind\n# 1 0 7\n"
        "# surfaces that end at the box bound no region; labels that have some: 0 7\n"
        "3 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n1 1\n3 0 1 2 1\n0\n0\n");
}
