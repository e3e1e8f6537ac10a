// SPDX-License-Identifier: MIT
// Perspective, and pictures whose edges stay lines.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/random.h"
#include "io/files/temporary_folder.h"
#include "mesh/meshes.h"
#include "view/render/render.h"
#include "view/render/seen_edges.h"
#include "view/render/write_svg.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr PictureSize kPicture{400, 300};

TriMesh random_octahedra(Random& random, int count) {
  std::vector<Vec3> points;
  Triangles triangles;
  for (int n = 0; n < count; ++n) {
    const VertexId first(points.size());
    const Vec3 c{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {0.6, -0.6}) {
        Vec3 p = c;
        p[axis] += sign;
        points.push_back(p);
      }
    }
    for (const Triangle& t : octahedron()) {
      triangles.push_back({VertexId(first + t[0]), VertexId(first + t[1]), VertexId(first + t[2])});
    }
  }
  return make_tri_mesh(points, triangles);
}

Camera camera_at(const Subject& subject, double angle, Random& random) {
  Aim aim;
  aim.angle = angle;
  const View view{random.uniform(-180, 180), random.uniform(-89, 89)};
  return fit_camera({&subject, 1}, view, aim, kPicture);
}

}  // namespace

TEST_CASE("in perspective all is in the picture, and touches its margin") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TriMesh mesh = random_octahedra(random, 4);
    const Subject subject{&mesh, {}};
    const Camera camera = camera_at(subject, random.uniform(1, 120), random);
    double reach = 0;
    for (const Vec3& p : mesh.points) {
      const auto at = camera.project(p);
      CHECK(at.magnified > 0);
      reach = std::max(
          {reach, std::fabs(at.x / kPicture.width - 0.5), std::fabs(at.y / kPicture.height - 0.5)});
    }
    CHECK(reach == doctest::Approx(0.47));
  }
}

TEST_CASE("the picture is that of straight lines through the eye") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TriMesh mesh = random_octahedra(random, 3);
    const Subject subject{&mesh, {}};
    const Camera camera = camera_at(subject, random.uniform(5, 120), random);
    const Vec3 eye = camera.center + camera.back / camera.nearness;
    const Vec3 p = mesh.points[0], q = mesh.points[7];
    // Any place between p and the eye has p's place in the picture, and is nearer.
    const auto at = camera.project(p), closer = camera.project(p + 0.3 * (eye - p));
    CHECK(closer.x == doctest::Approx(at.x));
    CHECK(closer.y == doctest::Approx(at.y));
    CHECK(closer.depth > at.depth);
    CHECK(length(cross(camera.to_eye(p), eye - p)) < 1e-9 * length2(eye - p));
    // Depth and magnification are linear over the picture of a line.
    const auto to = camera.project(q), middle = camera.project(0.5 * (p + q));
    const double t = (middle.x - at.x) / (to.x - at.x);
    CHECK(middle.depth == doctest::Approx(at.depth + t * (to.depth - at.depth)));
    CHECK(middle.magnified == doctest::Approx(at.magnified + t * (to.magnified - at.magnified)));
  }
}

TEST_CASE("in perspective what is looked at is in the middle, however deep it lies") {
  Random random(4);
  const TriMesh mesh = random_octahedra(random, 8);
  const Subject subject{&mesh, {}};
  for (const Vec3& p : mesh.points) {
    Aim aim;
    aim.angle = 60;
    aim.look_at = p;
    const Camera camera = fit_camera({&subject, 1}, {30, 20}, aim, kPicture);
    CHECK(camera.project(p).x == doctest::Approx(200));
    CHECK(camera.project(p).y == doctest::Approx(150));
    for (const Vec3& other : mesh.points) CHECK(camera.project(other).magnified > 0);
  }
}

TEST_CASE("seen edges are those of facets that face the eye, whole where nothing is before them") {
  int looked_at = 0;
  for (const double angle : {0.0, 50.0}) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      CAPTURE(angle);
      CAPTURE(seed);
      Random random(seed);
      const TriMesh mesh = random_octahedra(random, 1);
      const Subject subject{&mesh, {}};
      const Camera camera = camera_at(subject, angle, random);
      const ProjectedMesh projected = project(mesh, camera, 3, {});
      const Layer layer = visible_layer(mesh, projected, 0, projected.rows);
      const std::vector<SeenEdge> edges = seen_edges(mesh, projected, layer, 0);
      std::size_t facing = 0;
      bool is_thin = false;  // a facet nearly from its edge, of hardly a sample
      double expected = 0, seen = 0;
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        const auto faces_eye = [&](FaceId g) {
          const Triangle& t = mesh.faces[g].v;
          const CornerWeights w = corners_at(projected, t, 0, 0);
          constexpr auto kThin = 300 * 4 * ProjectedMesh::kUnit * ProjectedMesh::kUnit;
          is_thin |= std::abs(w.area) < kThin;
          return w.area < 0;  // y points down
        };
        for (std::size_t i = 0; i < 3; ++i) {
          const FaceId g = mesh.faces[f].n[i];
          if (g < f || (!faces_eye(f) && !faces_eye(g))) continue;
          ++facing;
          const auto a = camera.project(mesh.points[mesh.faces[f].v[(i + 1) % 3]]);
          const auto b = camera.project(mesh.points[mesh.faces[f].v[(i + 2) % 3]]);
          expected += 3 * std::hypot(a.x - b.x, a.y - b.y);
        }
      }
      if (is_thin) continue;
      ++looked_at;
      for (const SeenEdge& e : edges) seen += std::sqrt(distance2(e.from, e.to));
      CHECK(edges.size() >= facing);
      // Beside a silhouette an edge behind it shows for a sample or two.
      CHECK(seen == doctest::Approx(expected).epsilon(0.02));
    }
  }
  CHECK(looked_at > 20);
}

TEST_CASE("bands of rows have the same edges, cut at the bands") {
  Random random(5);
  const TriMesh mesh = random_octahedra(random, 12);
  const Subject subject{&mesh, {}};
  const Camera camera = camera_at(subject, 40, random);
  const ProjectedMesh projected = project(mesh, camera, 3, {});
  const auto length_in = [&](int begin, int end) {
    double sum = 0;
    const Layer layer = visible_layer(mesh, projected, begin, end);
    for (const SeenEdge& e : seen_edges(mesh, projected, layer, begin)) {
      CHECK(std::min(e.from.y, e.to.y) >= begin);
      CHECK(std::max(e.from.y, e.to.y) <= end);
      sum += std::sqrt(distance2(e.from, e.to));
    }
    return sum;
  };
  const double whole = length_in(0, projected.rows);
  const double parts = length_in(0, 301) + length_in(301, 302) + length_in(302, projected.rows);
  CHECK(parts == doctest::Approx(whole).epsilon(0.01));
}

TEST_CASE("SVG has the pixels without edges and letters, and these as lines") {
  Random random(6);
  const TriMesh mesh = random_octahedra(random, 2);
  const std::array subjects{Subject{&mesh, {}}};
  RenderOptions options;
  options.size = kPicture;
  options.view = View{20, 30};
  options.edges = Edges::drawn;
  options.captions = {"two octahedra"};
  const Image painted = render(subjects, options);
  options.keep_strokes = true;
  const Image kept = render(subjects, options);
  CHECK(painted.strokes.empty());
  CHECK(kept.strokes.size() > 40);
  CHECK(kept.pixels != painted.pixels);
  options.keep_strokes = false;
  options.edges = Edges::hidden;
  options.captions = {" "};
  CHECK(render(subjects, options).pixels == kept.pixels);

  const TemporaryFolder folder;
  write_svg(kept, folder.path("a.svg"));
  std::ifstream file(folder.path("a.svg"));
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  CHECK(svg.starts_with("<svg xmlns="));
  CHECK(svg.ends_with("</g>\n</svg>\n"));
  CHECK(static_cast<std::size_t>(std::ranges::count(svg, 'L')) >= kept.strokes.size());
}
