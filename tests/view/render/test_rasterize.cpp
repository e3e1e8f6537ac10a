// SPDX-License-Identifier: MIT
// The z-buffer against brute force: every sample against every facet, with exact coverage.
#include "view/render/rasterize.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/random.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr PictureSize kSize{40, 30};

// Looks down at the xy plane; the corner of the picture is at (0, 0) and y grows downwards.
Camera flat_camera() {
  Camera camera;
  camera.right = {1, 0, 0};
  camera.up = {0, -1, 0};
  camera.back = {0, 0, 1};
  camera.center = {0.5 * kSize.width, 0.5 * kSize.height, 0};
  camera.size = kSize;
  return camera;
}

// Sign of the area of (a, b, p), exact: corners are multiples of 1/256, samples of 1/2.
int side(const Vec3& a, const Vec3& b, double x, double y) {
  const double area = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  return (area > 0) - (area < 0);
}

bool covers(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
  const int whole = side(a, b, c.x, c.y);
  return whole != 0 && side(a, b, x, y) != -whole && side(b, c, x, y) != -whole &&
         side(c, a, x, y) != -whole;
}

// Value at (x, y) of the plane through three corners that carry these values.
double interpolated(const Vec3& a, const Vec3& b, const Vec3& c, double va, double vb, double vc,
                    double x, double y) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const double wb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
  const double wc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
  return va + wb * (vb - va) + wc * (vc - va);
}

// Facets over the picture and beyond; on a coarse grid edges and corners often meet samples.
TriMesh random_facets(Random& random, std::size_t count) {
  std::vector<Vec3> points;
  Triangles triangles;
  const bool coarse = random.below(2) == 0;
  const auto coordinate = [&](int side_length) {
    const double steps = coarse ? 2 : 256;
    return std::floor(random.uniform(-0.3, 1.3) * side_length * steps) / steps;
  };
  for (VertexId v = 0; v < 3 * count; ++v) {
    points.push_back({coordinate(kSize.width), coordinate(kSize.height), random.uniform(-5, 5)});
    if (v % 3 == 2) triangles.push_back(triangle_of(v - 2, v - 1, v));
  }
  return make_tri_mesh(points, triangles);
}

struct Counts {
  int covered = 0, hidden = 0, clipped = 0;
};

void check_against_brute_force(const TriMesh& mesh, const std::optional<ClipPlane>& clip,
                               Counts& counts) {
  constexpr double kNear = 1e-9;  // of rounding, in depth and height
  const ProjectedMesh projected = project(mesh, flat_camera(), 1, clip);
  const std::vector<FaceId> seen = visible_faces(mesh, projected, 0, projected.rows);
  REQUIRE(seen.size() == static_cast<std::size_t>(kSize.width * kSize.height));
  for (int row = 0; row < kSize.height; ++row) {
    for (int column = 0; column < kSize.width; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      const FaceId here = seen[static_cast<std::size_t>(row * kSize.width + column)];
      double depth_here = -INFINITY;
      int covering = 0;
      bool may_be_empty = true, found = here == kNoId;
      double nearest = -INFINITY;
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& t = mesh.faces[f].v;
        const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        if (!covers(a, b, c, x, y)) continue;
        const double depth = interpolated(a, b, c, a.z, b.z, c.z, x, y);
        const double height = clip ? clip->height({x, y, depth}) : -1;
        if (height > kNear) {
          ++counts.clipped;
          continue;
        }
        if (f == here) {
          found = true;
          depth_here = depth;
        }
        if (height > -kNear) continue;  // either way is right
        may_be_empty = false;
        nearest = std::max(nearest, depth);
        ++covering;
      }
      CAPTURE(row);
      CAPTURE(column);
      REQUIRE(found);
      if (here == kNoId) REQUIRE(may_be_empty);
      if (here != kNoId) REQUIRE(depth_here >= nearest - 1e-6);
      counts.covered += here != kNoId;
      counts.hidden += covering > 1;
    }
  }
}

}  // namespace

TEST_CASE("coverage, depth order and clipping, against every facet at every sample") {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TriMesh mesh = random_facets(random, 1 + random.below(12));
    std::optional<ClipPlane> clip;
    if (seed % 2 == 0) {
      clip = {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)},
              random.uniform(-10, 10)};
    }
    check_against_brute_force(mesh, clip, counts);
  }
  CHECK(counts.covered > 10000);
  CHECK(counts.hidden > 5000);
  CHECK(counts.clipped > 5000);
}

TEST_CASE("layers are peeled off in the order of depth, until every facet has been seen") {
  std::size_t deepest = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TriMesh mesh = random_facets(random, 1 + random.below(12));
    const ProjectedMesh projected = project(mesh, flat_camera(), 1, std::nullopt);
    std::vector<std::vector<FaceId>> seen(static_cast<std::size_t>(kSize.width * kSize.height));
    Layer last;
    for (std::size_t n = 0;; ++n) {
      REQUIRE(n <= mesh.faces.size());
      Layer layer = visible_layer(mesh, projected, 0, projected.rows, n == 0 ? nullptr : &last);
      std::size_t any = 0;
      for (std::size_t at = 0; at < seen.size(); ++at) {
        if (layer.faces[at] == kNoId) continue;
        ++any;
        if (n > 0) REQUIRE(layer.depths[at] <= last.depths[at]);
        seen[at].push_back(layer.faces[at]);
      }
      deepest = std::max(deepest, n);
      if (any == 0) break;
      last = std::move(layer);
    }
    for (std::size_t at = 0; at < seen.size(); ++at) {
      const double x = static_cast<double>(at % kSize.width) + 0.5;
      const double y = std::floor(static_cast<double>(at) / kSize.width) + 0.5;
      std::vector<FaceId> covering;
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& t = mesh.faces[f].v;
        if (covers(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], x, y)) {
          covering.push_back(f);
        }
      }
      std::ranges::sort(seen[at]);
      REQUIRE(seen[at] == covering);
    }
  }
  CHECK(deepest >= 5);
}

TEST_CASE("very many facets over each sample, sorted from the front to the back") {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    TriMesh mesh = random_facets(random, 150);
    std::optional<ClipPlane> clip;
    if (seed % 2 == 0) clip = {{0.3, -0.2, 1}, 2};
    check_against_brute_force(mesh, clip, counts);
    // What lies behind, wholly or as a copy, changes nothing.
    const ProjectedMesh before = project(mesh, flat_camera(), 2, clip);
    const std::vector<FaceId> seen = visible_faces(mesh, before, 0, before.rows);
    const std::size_t facets = mesh.faces.size();
    for (FaceId f = 0; f < facets; ++f) mesh.faces.push_back(mesh.faces[f]);
    const auto behind = VertexId(mesh.points.size());
    for (const Vec3& p : {Vec3{-9, -9, -9}, Vec3{200, -9, -9}, Vec3{-9, 200, -9}}) {
      mesh.points.push_back(p);
    }
    // It is seen where nothing else is, as far as it is not clipped.
    const Face back{triangle_of(behind, behind + 1, behind + 2), {kNoId, kNoId, kNoId}};
    mesh.faces.insert(mesh.faces.end(), 500, back);
    const ProjectedMesh after = project(mesh, flat_camera(), 2, clip);
    const std::vector<FaceId> again = visible_faces(mesh, after, 0, after.rows);
    for (std::size_t n = 0; n < seen.size(); ++n) {
      if (seen[n] != kNoId) {
        REQUIRE(again[n] == seen[n]);
      } else if (!clip) {
        REQUIRE(again[n] == 2 * facets);
      }
    }
  }
  CHECK(counts.hidden > 5000);
}

TEST_CASE("the one of the lower id at equal depth; bands of rows make up the whole") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    TriMesh mesh = random_facets(random, 6);
    const std::size_t facets = mesh.faces.size();
    for (FaceId f = 0; f < facets; ++f) mesh.faces.push_back(mesh.faces[f]);
    const ProjectedMesh projected = project(mesh, flat_camera(), 2, {});
    const std::vector<FaceId> whole = visible_faces(mesh, projected, 0, projected.rows);
    for (const FaceId f : whole) CHECK((f == kNoId || f < facets));
    std::vector<FaceId> bands;
    for (int row = 0; row < projected.rows; row += 7) {
      const auto band = visible_faces(mesh, projected, row, std::min(row + 7, projected.rows));
      bands.insert(bands.end(), band.begin(), band.end());
    }
    CHECK(bands == whole);
  }
}

TEST_CASE("facets that share edges leave no gap, wherever the edges run") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // A fan that fills the picture, around a point anywhere in it.
    const double w = kSize.width, h = kSize.height;
    std::vector<Vec3> points{{random.uniform(0, w), random.uniform(0, h), 0}};
    for (int n = 0; n < 4; ++n) {
      for (int part = 0; part < 8; ++part) {
        const double t = part / 8.0;
        const Vec3 corners[] = {{0, 0, 0}, {w, 0, 0}, {w, h, 0}, {0, h, 0}, {0, 0, 0}};
        points.push_back((1 - t) * corners[n] + t * corners[n + 1]);
      }
    }
    const TriMesh mesh = make_tri_mesh(points, one_ring(32));
    const ProjectedMesh projected = project(mesh, flat_camera(), 3, {});
    for (const FaceId f : visible_faces(mesh, projected, 0, projected.rows)) {
      REQUIRE(f != kNoId);
    }
  }
}
