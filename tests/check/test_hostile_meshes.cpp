// SPDX-License-Identifier: MIT
// Meshes made to cost the square of their size: the check reports what it gave up, and the verdict
// does not depend on the number of threads.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "cases.h"
#include "check/hostile_meshes.h"
#include "check/self_intersections.h"
#include "check/verify.h"
#include "embedding/all_crossings.h"
#include "io/volume/builtin_volume.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct Ball {
  Volume volume = make_builtin_volume("builtin:sphere:24");
  double kappa =
      geometric_isovalue(volume.type(), find_builtin_field("builtin:sphere:24")->isovalue);

  Verification verify(const Hostile& mesh, int threads, double share = 0) const {
    VerifyOptions options;
    options.threads = threads;
    options.restricted_share = share;
    options.triangulate = true;
    options.limits[Criterion::distance] = 0.1;
    return deliso::verify(make_tri_mesh(mesh.points, mesh.triangles), volume, kappa, options);
  }
};

std::string summary(const Verification& v) {
  std::string all;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    all += std::to_string(v.faults.count(kind)) + " ";
    for (const Fault& fault : v.faults.first(kind)) all += fault.what + "; ";
  }
  const auto add = [&](double value) { all += std::to_string(value) + " "; };
  for (const Distances* d : {&v.to_surface, &v.from_surface}) {
    for (const double value : {d->max, d->mean, d->rms, d->quantile_999}) add(value);
    add(static_cast<double>(d->points));
    add(static_cast<double>(d->given_up));
  }
  for (const std::size_t count : {v.delaunay.delaunay, v.delaunay.restricted, v.delaunay.occupied,
                                  v.voronoi->missing, v.voronoi->multiple}) {
    add(static_cast<double>(count));
  }
  return all;
}

bool mentions(const Verification& v, FaultKind kind, const std::string& what) {
  const std::vector<Fault>& first = v.faults.first(kind);
  return std::any_of(first.begin(), first.end(), [&](const Fault& fault) {
    return fault.what.find(what) != std::string::npos;
  });
}

const Hostile& named(const std::vector<Hostile>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Hostile& h) { return h.name == name; });
  REQUIRE(found != all.end());
  return *found;
}

}  // namespace

TEST_CASE("every hostile mesh has faults, the same with any number of threads") {
  const Ball ball;
  int threads = 1;
  for (const Hostile& mesh : hostile_meshes(cases(1500u), 23)) {
    CAPTURE(mesh.name);
    const Verification one = ball.verify(mesh, 1);
    CHECK(one.faults.any());
    threads = threads == 2 ? 3 : threads == 3 ? 8 : 2;
    CHECK(summary(ball.verify(mesh, threads)) == summary(one));
  }
}

TEST_CASE("crossings of few triangles are all found, of very many up to the bound") {
  for (const std::size_t n : {40u, 300u}) {
    for (const Hostile& mesh : hostile_meshes(n, 23)) {
      if (mesh.name == "copies of one triangle" || mesh.name == "all vertices at one point" ||
          mesh.name == "all vertices on one line") {
        continue;  // no mesh of different vertices
      }
      CAPTURE(mesh.name);
      CAPTURE(n);
      const auto all = all_crossings(mesh.points, mesh.triangles);
      const TriangleTree tree(mesh.points, mesh.triangles);
      const Crossings found = find_crossings(mesh.points, mesh.triangles, tree);
      CHECK(std::includes(all.begin(), all.end(), found.pairs.begin(), found.pairs.end()));
      if (found.given_up.empty()) CHECK(found.pairs == all);
      if (mesh.name == "fan with a helix for its boundary" || mesh.name == "flat fan") {
        CHECK(found.given_up.empty());
        CHECK(found.pairs.empty());
      }
    }
  }
}

TEST_CASE("where all triangles cross, the search ends and reports it") {
  const Ball ball;
  const Hostile mesh = named(hostile_meshes(4000, 23), "triangles that all cross each other");
  const Verification v = ball.verify(mesh, 2);
  CHECK(mentions(v, FaultKind::not_measured, "crossings of "));
  const std::size_t found = v.faults.count(FaultKind::self_intersections);
  CHECK(found >= kMaxFoundPerLeaf);
  CHECK(found <= mesh.triangles.size() * (kMaxTestsPerLeaf / 4 + 16));
}

// Triangles that cross each other, on so few vertices that most of them have many triangles.
Hostile stars(std::size_t vertices, std::size_t n) {
  Hostile mesh{"stars", {}, {}};
  Random random(7);
  for (std::size_t v = 0; v < vertices; ++v) {
    mesh.add({random.uniform(0, 23), random.uniform(0, 23), random.uniform(0, 23)});
  }
  std::set<Triangle> taken;
  while (taken.size() < n) {
    const auto any = [&] { return random.below(static_cast<std::uint32_t>(vertices)); };
    const std::uint32_t a = any(), b = any(), c = any();
    const Triangle t = triangle_of(a, b, c);
    if (t[0] < t[1] && t[1] < t[2]) taken.insert(t);
  }
  mesh.triangles.assign(taken.begin(), taken.end());
  return mesh;
}

TEST_CASE("crossings of triangles at many stars are all found if they are few") {
  for (const std::size_t vertices : {25u, 40u}) {
    const Hostile mesh = stars(vertices, 800);
    const TriangleTree tree(mesh.points, mesh.triangles);
    const Crossings found = find_crossings(mesh.points, mesh.triangles, tree);
    CHECK(found.given_up.empty());
    CHECK(found.pairs == all_crossings(mesh.points, mesh.triangles));
  }
}

// Each pair of stars once had a budget of its own: 40,000 such triangles took 88 s and 3 GB.
TEST_CASE("the crossings of all stars share one budget") {
  const std::size_t n = 6000;
  const Hostile mesh = stars(200, n);
  const TriangleTree tree(mesh.points, mesh.triangles);
  const Crossings one = find_crossings(mesh.points, mesh.triangles, tree);
  CHECK(!one.given_up.empty());
  // A triangle has its own budget, and a share of the common one.
  CHECK(one.pairs.size() <= 2 * (n * kMaxFoundPerLeaf + kFoundShared));
  CHECK(one.pairs.size() >= n * kMaxFoundPerLeaf / 2);
  for (const int threads : {2, 3}) {
    const Crossings other = find_crossings(mesh.points, mesh.triangles, tree, threads);
    CHECK(other.pairs == one.pairs);
    CHECK(other.given_up == one.given_up);
  }
}

TEST_CASE("a Delaunay triangulation with a cell for every two vertices is given up") {
  const Ball ball;
  const Hostile mesh = named(hostile_meshes(4000, 23), "all vertices on a moment curve");
  for (const double share : {0.0, 0.9}) {
    const Verification v = ball.verify(mesh, 1, share);
    CHECK_FALSE(v.voronoi->measured);
    CHECK(v.voronoi->restricted == 0);
  }
}

// Few cells are made, but each walk goes half way around: 40,000 triangles once took 6 s,
// quadratic.
TEST_CASE("a Delaunay triangulation whose cells all lie around a center is given up") {
  const Ball ball;
  Hostile mesh{"crossing fan", {{11.5, 11.5, 11.5}}, {}};
  Random random(1);
  const VertexId n = 10000;
  for (VertexId i = 0; i < 2 * n; ++i) {
    const double u = random.uniform(0, 6.28);
    mesh.add({11.5 + 6 * std::cos(u), 11.5 + 6 * std::sin(u), 11.5 + random.uniform(-2e-3, 2e-3)});
  }
  for (VertexId i = 1; i <= n; ++i) mesh.triangles.push_back(triangle_of(0, i, n + i));
  const Verification v = ball.verify(mesh, 2);
  CHECK_FALSE(v.voronoi->measured);
  CHECK(v.delaunay.measured);  // balls tell without it
}

TEST_CASE("nearest triangles are those of brute force, or given up") {
  const Hostile needles = named(hostile_meshes(4000, 23), "needles across the box");
  Random random(3);
  std::vector<Vec3> points(20000);
  for (Vec3& p : points) p = {random.uniform(0, 23), random.uniform(0, 23), random.uniform(0, 23)};
  const TriangleTree tree(needles.points, needles.triangles);
  const std::vector<NearestTriangle> found = tree.nearest(points, 2);
  const auto given_up = std::count_if(
      found.begin(), found.end(), [](const NearestTriangle& t) { return t.distance2 == kGivenUp; });
  CHECK(given_up > 0);
  CHECK(given_up < 20000);
  std::size_t measured = 0;
  for (std::size_t n = 0; n < points.size(); n += 50) {
    if (found[n].distance2 == kGivenUp) continue;
    ++measured;
    double least = std::numeric_limits<double>::infinity();
    for (FaceId f = 0; f < needles.triangles.size(); ++f) {
      least = std::min(least, tree.distance2(f, points[n]));
    }
    CHECK(found[n].distance2 == least);
    CHECK(tree.distance2(found[n].triangle, points[n]) == least);
  }
  CHECK(measured > 0);
}
