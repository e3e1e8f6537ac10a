// SPDX-License-Identifier: MIT
// Whole pictures, against what a sphere must look like from anywhere.
#include "cases.h"
#include "view/render/render.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "mesh/meshes.h"
#include "view/render/rasterize.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr Vec3 kCenter{5, -7, 3};
constexpr double kRadius = 2;

// An octahedron, each facet cut into four and its corners moved to the sphere, `levels` times.
TriMesh sphere(int levels) {
  std::vector<Vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Triangles triangles = octahedron();
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<VertexId, VertexId>, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
      const auto [at, added] = middles.try_emplace(std::minmax(a, b), VertexId(points.size()));
      const Vec3 sum = points[a] + points[b];
      if (added) points.push_back(sum / length(sum));
      return at->second;
    };
    Triangles finer;
    for (const auto& [a, b, c] : triangles) {
      const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = finer;
  }
  for (Vec3& p : points) p = kCenter + kRadius * p;
  return make_tri_mesh(points, triangles);
}

TriMesh turned_round(TriMesh mesh) {
  for (Face& face : mesh.faces) {
    std::swap(face.v[1], face.v[2]);
    std::swap(face.n[1], face.n[2]);
  }
  return mesh;
}

// Without the light of the sky, which is found by many rays: a few tests here, and test_occlusion,
// have it.
RenderOptions small_picture() {
  RenderOptions options;
  options.size = {160, 120};
  options.view = View{40, 20};
  options.edges = Edges::hidden;
  options.occlusion = false;
  return options;
}

using Clip = std::optional<ClipPlane>;

Image render(const TriMesh& mesh, const RenderOptions& options, const Clip& clip = {}) {
  return deliso::render(std::array{Subject{&mesh, clip}}, options);
}

View view_of(const TriMesh& mesh, PictureSize size, const Clip& clip) {
  return best_view(std::array{Subject{&mesh, clip}}, size);
}

Camera camera_on(const TriMesh& mesh, const View& view, PictureSize size, const Clip& clip) {
  return fit_camera(std::array{Subject{&mesh, clip}}, view, {}, size);
}

struct Tally {
  int background = 0, outside = 0, inside = 0, dark = 0;
};

// The palette's outside is more blue than red at any light, the inside more red than blue.
Tally tally(const Image& image) {
  Tally counts;
  for (const Rgb& p : image.pixels) {
    if (p == Rgb{255, 255, 255}) {
      ++counts.background;
    } else if (p.blue < 60 && p.red < 60) {
      ++counts.dark;
    } else {
      ++(p.blue > p.red ? counts.outside : counts.inside);
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("the silhouette of a sphere is a disk of its radius, from everywhere") {
  const TriMesh mesh = sphere(5);
  const double disk = std::numbers::pi * kRadius * kRadius;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const View view{random.uniform(-360, 360), random.uniform(-90, 90)};
    const Camera camera = camera_on(mesh, view, {400, 300}, {});
    const ProjectedMesh projected = project(mesh, camera, 1, {});
    const std::vector<FaceId> seen = visible_faces(mesh, projected, 0, projected.rows);
    int covered = 0;
    const double radius = camera.scale * kRadius;
    for (int row = 0; row < projected.rows; ++row) {
      for (int column = 0; column < projected.columns; ++column) {
        const double x = column + 0.5 - 200, y = row + 0.5 - 150;
        const double from_middle = std::sqrt(x * x + y * y);
        const bool hit = seen[static_cast<std::size_t>(row * projected.columns + column)] != kNoId;
        covered += hit;
        if (from_middle < radius - 1) REQUIRE(hit);
        if (from_middle > radius + 1) REQUIRE_FALSE(hit);
      }
    }
    CHECK(covered / (camera.scale * camera.scale) == doctest::Approx(disk).epsilon(0.004));
    // The sphere fills the picture's height but for the margin.
    CHECK(2 * radius > 0.92 * 300);
    CHECK(2 * radius < 300);
  }
}

TEST_CASE("the outside has one color and the inside the other" *
          test::slow("pictures with the light of the sky, which is found by many rays")) {
  const TriMesh mesh = sphere(4);
  for (const Shading shading : {Shading::smooth, Shading::flat}) {
    RenderOptions options = small_picture();
    options.shading = shading;
    options.occlusion = true;
    const Tally outside = tally(render(mesh, options));
    CHECK(outside.outside > 5000);
    CHECK(outside.inside == 0);
    const Tally inside = tally(render(turned_round(mesh), options));
    // At the rim, pixels of background and dark orange can be of any hue.
    CHECK(inside.inside > 5000);
    CHECK(inside.outside == 0);
    CHECK(inside.background == outside.background);
  }
}

TEST_CASE("clipped in halves, a sphere shows its inside to one eye and its outside to the other") {
  const TriMesh mesh = sphere(4);
  RenderOptions options = small_picture();
  const ClipPlane clip{{1, 0, 0}, kCenter.x};
  options.view = View{0, 0};
  const Tally open = tally(render(mesh, options, clip));
  CHECK(open.inside > 5000);
  CHECK(open.outside == 0);
  options.view = View{180, 0};
  const Tally closed = tally(render(mesh, options, clip));
  CHECK(closed.outside > 5000);
  CHECK(closed.inside == 0);
  // From the side it is half a disk, which is fitted into the picture.
  options.view = View{90, 0};
  const Camera camera = camera_on(mesh, *options.view, {400, 300}, clip);
  const ProjectedMesh projected = project(mesh, camera, 1, clip);
  int covered = 0;
  for (const FaceId f : visible_faces(mesh, projected, 0, projected.rows)) covered += f != kNoId;
  CHECK(covered / (camera.scale * camera.scale) ==
        doctest::Approx(0.5 * std::numbers::pi * kRadius * kRadius).epsilon(0.01));
}

TEST_CASE("edges are drawn on request and where there is room for them") {
  RenderOptions options = small_picture();
  for (const int levels : {2, 6}) {
    const TriMesh mesh = sphere(levels);
    options.edges = Edges::hidden;
    const Image without = render(mesh, options);
    options.edges = Edges::drawn;
    const Image with = render(mesh, options);
    options.edges = Edges::automatic;
    CHECK(with.pixels != without.pixels);
    CHECK(render(mesh, options).pixels == (levels == 2 ? with : without).pixels);
  }
}

namespace {

// Whether a picture of one panel or more, 400 pixels high, changes where edges are wanted.
bool draws_edges(std::span<const Subject> subjects) {
  RenderOptions options = small_picture();
  options.size = {402 * static_cast<int>(subjects.size()), 400};
  const Image without = deliso::render(subjects, options);
  options.edges = Edges::automatic;
  return deliso::render(subjects, options).pixels != without.pixels;
}

}  // namespace

TEST_CASE("edges are drawn in all panels or in none" * test::slow("ten pictures of a fine mesh")) {
  const TriMesh coarse = sphere(3), fine = sphere(6);
  const Subject with{&coarse, {}}, without{&fine, {}};
  CHECK(draws_edges(std::array{with}));
  CHECK_FALSE(draws_edges(std::array{without}));
  CHECK(draws_edges(std::array{with, with}));
  CHECK_FALSE(draws_edges(std::array{with, without}));
  CHECK_FALSE(draws_edges(std::array{without, with}));
}

TEST_CASE(
    "edges leave most of the surface in sight, and take the same share of it wherever they are") {
  // How much darker a sphere is by its edges: with lines of a width that fits all of its triangles,
  // however many they are.
  RenderOptions options = small_picture();
  options.size = {400, 400};
  const auto brightness = [&](const TriMesh& mesh, Edges edges) {
    options.edges = edges;
    double sum = 0;
    for (const Rgb& p : render(mesh, options).pixels) sum += p == Rgb{255, 255, 255} ? 0 : p.blue;
    return sum;
  };
  double least = 1, most = 0;
  for (const int levels : {4, 5, 6, 7}) {
    const TriMesh mesh = sphere(levels);
    const double left = brightness(mesh, Edges::drawn) / brightness(mesh, Edges::hidden);
    least = std::min(least, left);
    most = std::max(most, left);
  }
  // A fifth is covered face on; towards the rim, where triangles are seen at an angle, more.
  CHECK(least > 0.7);
  CHECK(most < 0.9);
  CHECK(most - least < 0.1);
}

TEST_CASE("a view that is not given looks into every cut") {
  const TriMesh mesh = sphere(5);
  const Vec3 normals[] = {{1, 0, 0},    {-1, 0, 0}, {0, 1, 0},      {0, -1, 0},
                          {0, 0, 1},    {0, 0, -1}, {1, 1, 0},      {1, -2, 3},
                          {-1, -1, -1}, {0, 3, -1}, {0, 1e-9, 2e-9}};
  RenderOptions options = small_picture();
  options.view.reset();
  for (const Vec3& normal : normals) {
    CAPTURE(normal.x);
    CAPTURE(normal.y);
    CAPTURE(normal.z);
    const ClipPlane clip{normal, dot(normal, kCenter)};
    // c is the cosine between the view and the normal. Of a half sphere, the inside has the share
    // (1 + c) / 2 - (1 - c) / 2 = c of the disk's area, and 2 c / (1 + c) of all that is seen.
    const Tally seen = tally(render(mesh, options, clip));
    CHECK(seen.inside > 2 * 0.5 / 1.5 * 0.95 * (seen.inside + seen.outside));
    // So it does where only one of two panels is cut.
    const std::array both{Subject{&mesh, {}}, Subject{&mesh, clip}};
    const View view = best_view(both, {160, 120});
    CHECK(dot(direction_to(view), normal) >= 0.49999 * length(normal));
  }
  // Cuts that face away from each other cannot all be looked into.
  const std::array away{Subject{&mesh, ClipPlane{{1, 0, 0}, kCenter.x}},
                        Subject{&mesh, ClipPlane{{-1, 0, 0}, -kCenter.x}}};
  CHECK(best_view(away, {160, 120}).elevation == 25);
}

// The gray of a place is its x, so that a wrong place has a wrong gray.
TEST_CASE("a cut is filled with the grays of its places, and open where they have none") {
  const TriMesh mesh = sphere(4);
  Subject subject{&mesh, ClipPlane{{0.2, 1, -0.3}, dot({0.2, 1, -0.3}, kCenter) + 0.4}};
  const auto gray_at = [](const Vec3& p) { return 0.5 + 0.2 * (p.x - kCenter.x); };
  const auto in_ring = [](const Vec3& p) {
    return distance(p, kCenter) < kRadius && distance(p, kCenter) > 0.9;
  };
  subject.section = [&](const Vec3& p) {
    return in_ring(p) ? std::optional(gray_at(p)) : std::nullopt;
  };
  RenderOptions options = small_picture();
  const Vec3& normal = subject.clip->normal;
  Random random(19);
  for (const double azimuth : {60, 100, -80}) {
    CAPTURE(azimuth);
    options.view = View{azimuth, 10};
    const Camera camera = fit_camera(std::array{subject}, *options.view, {}, options.size);
    const Image image = deliso::render(std::array{subject}, options);
    const bool from_above = dot(normal, camera.back) > 0;
    int filled = 0, open = 0;
    for (int n = 0; n < 3000; ++n) {
      Vec3 p = kCenter + Vec3{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
      p = p - subject.clip->height(p) / dot(normal, normal) * normal;
      const double from_middle = distance(p, kCenter), pixel = 1 / camera.scale;
      // A pixel may look at a slant: twice its size and more stays free of borders.
      if (std::abs(from_middle - 0.9) < 5 * pixel || from_middle > kRadius - 5 * pixel) continue;
      const Camera::Projected at = camera.project(p);
      const Rgb& seen = image.at(static_cast<int>(at.x), static_cast<int>(at.y));
      const bool is_gray = seen.red == seen.green && seen.green == seen.blue;
      if (!from_above || !in_ring(p)) {
        CHECK_FALSE(is_gray);
        ++open;
      } else {
        ++filled;
        CHECK(is_gray);
        CHECK(std::abs(seen.red - 255 * gray_at(p)) < 255 * 0.2 * 4 * pixel);
      }
    }
    CHECK(open > 50);
    CHECK((filled > 200) == from_above);
  }
}

TEST_CASE("facets have the colors they are given, darker on the inside") {
  const TriMesh mesh = sphere(3);
  std::vector<Rgb> colors(mesh.faces.size(), Rgb{200, 0, 0});
  RenderOptions options = small_picture();
  const auto mean = [&](const TriMesh& of) {
    const Image image = deliso::render(std::array{Subject{&of, {}, colors}}, options);
    double red = 0, other = 0, count = 0;
    for (const Rgb& p : image.pixels) {
      if (p.blue > 200) continue;  // the background
      red += p.red;
      other += std::max(p.green, p.blue);
      ++count;
    }
    CHECK(count > 5000);
    CHECK(other < 0.1 * red);
    return red / count;
  };
  CHECK(mean(turned_round(mesh)) < 0.8 * mean(mesh));
  // One facet of another color is seen somewhere on the half that is in sight.
  const Camera camera = camera_on(mesh, *options.view, options.size, {});
  const ProjectedMesh projected = project(mesh, camera, 1, {});
  const FaceId middle = visible_faces(mesh, projected, 60, 61)[80];
  REQUIRE(middle != kNoId);
  colors[middle] = {0, 200, 0};
  const Image image = deliso::render(std::array{Subject{&mesh, {}, colors}}, options);
  CHECK(image.at(80, 60).green > 100);
  CHECK(image.at(80, 60).green > 5 * image.at(80, 60).red);
}

TEST_CASE("the largest zoom keeps to the bound of the rasterizer at every size") {
  CHECK(largest_zoom({1, 1}) == 64);
  CHECK(largest_zoom({8192, 8192}) == 64);
  CHECK(largest_zoom({kLargestSide, 1}) < 64);
  for (const int side : {1, 900, 10921, 10922, 10923, 14043, kLargestSide}) {
    CHECK(3 * side * largest_zoom({side, 5}) < 0x1p21);
    CHECK(largest_zoom({side, 5}) == largest_zoom({5, side}));
    CHECK(largest_zoom({side, 5}) > 40);
  }
}

TEST_CASE("a long narrow picture as wide as allowed is drawn") {
  const TriMesh mesh = sphere(4);
  RenderOptions options = small_picture();
  options.size = {kLargestSide, 40};
  options.aim.zoom = largest_zoom(options.size);
  options.aim.look_at = kCenter;
  const Tally seen = tally(render(mesh, options));
  CHECK(seen.outside + seen.dark > 1590 * 40);  // 0.94 * 40 * 42.6 pixels across, all of the height
}

TEST_CASE("labels and a color bar stand in strips of their own") {
  const TriMesh mesh = sphere(4);
  RenderOptions options = small_picture();
  options.size = {642, 300};
  const std::array two{Subject{&mesh, {}}, Subject{&mesh, {}}};
  options.captions = {"left", ""};
  options.bar = ColorBar{"angle", 60, false};
  const Image image = deliso::render(two, options);
  const Layout layout = layout_of(options, 2);
  REQUIRE(layout.captions > 8);
  REQUIRE(layout.bar > 16);
  CHECK(layout.panel.height == 300 - layout.captions - layout.bar);

  // The panels are as without them, in what is left of the height.
  RenderOptions plain = options;
  plain.captions.clear();
  plain.bar.reset();
  plain.size.height = layout.panel.height;
  const Image panels = deliso::render(two, plain);
  for (int y = 0; y < layout.panel.height; ++y) {
    for (int x = 0; x < 642; ++x) {
      REQUIRE(image.at(x, y + layout.captions) == panels.at(x, y));
    }
  }
  const auto ink = [&](int x0, int x1, int y0, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) count += !(image.at(x, y) == Rgb{255, 255, 255});
    }
    return count;
  };
  CHECK(ink(110, 210, 0, layout.captions) > 20);
  CHECK(ink(0, 110, 0, layout.captions) == 0);
  CHECK(ink(210, 320, 0, layout.captions) == 0);
  CHECK(ink(layout.left(1), 642, 0, layout.captions) == 0);
  CHECK(ink(0, 642, 300 - layout.bar, 300) > 1000);
  CHECK(ink(0, 642, 299, 300) == 0);

  options.palette.background = {0, 0, 0};
  const Image dark = deliso::render(two, options);
  CHECK(dark.at(0, 0) == Rgb{0, 0, 0});
  CHECK(dark.at(3, 299) == Rgb{0, 0, 0});
  int bright = 0;
  for (int y = 0; y < layout.captions; ++y) {
    for (int x = 110; x < 210; ++x) bright += dark.at(x, y).green > 100;
  }
  CHECK(bright > 20);
}

TEST_CASE("the same mesh gives the same picture; a view that is not given is the best one") {
  const TriMesh mesh = sphere(3);
  RenderOptions options = small_picture();
  options.edges = Edges::drawn;
  CHECK(render(mesh, options).pixels == render(mesh, options).pixels);
  const ClipPlane clip{{0, 1, 0}, kCenter.y};
  options.view.reset();
  const Image chosen = render(mesh, options, clip);
  options.view = view_of(mesh, options.size, clip);
  CHECK(render(mesh, options, clip).pixels == chosen.pixels);
}

TEST_CASE("the best view of a plate is the one nearest to face on") {
  for (const double angle : {0.0, 45.0, 110.0, 250.0}) {
    const double c = std::cos(angle * std::numbers::pi / 180);
    const double s = std::sin(angle * std::numbers::pi / 180);
    const Vec3 along{-s, c, 0}, up{0, 0, 1};
    const TriMesh plate =
        make_tri_mesh({Vec3{}, along, along + up, up}, Triangles{{0, 1, 2}, {0, 2, 3}});
    const View view = view_of(plate, {160, 120}, {});
    const double turn = (view.azimuth - angle) * std::numbers::pi / 180;
    CHECK(std::abs(std::cos(turn)) > 0.8);
  }
}

TEST_CASE("nothing to draw is said, not drawn") {
  CHECK_THROWS_AS(render(TriMesh{}, small_picture()), InputError);
  CHECK_THROWS_AS(render(sphere(1), small_picture(), ClipPlane{{0, 0, 1}, -100}), InputError);
  TriMesh huge = sphere(1);
  for (Vec3& p : huge.points) p = 1e300 * p;
  CHECK_THROWS_AS(render(huge, small_picture()), InputError);
}

TEST_CASE("a point, a line and facets seen edge on are drawn as nothing, without a fault") {
  const TriMesh point = make_tri_mesh({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, Triangles{{0, 1, 2}});
  const TriMesh line = make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Triangles{{0, 1, 2}});
  RenderOptions options = small_picture();
  for (const TriMesh* mesh : {&point, &line}) {
    CHECK(tally(render(*mesh, options)).background == 160 * 120);
  }
}

namespace {

// Every pixel of the picture's columns from `left` on, `width` of them.
Image columns_of(const Image& image, int left, int width) {
  Image part(width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < width; ++x) part.at(x, y) = image.at(left + x, y);
  }
  return part;
}

}  // namespace

TEST_CASE("panels show each subject as alone, by one camera, with a rule between them" *
          test::slow("pictures with the light of the sky, which is found by many rays")) {
  const TriMesh whole = sphere(4);
  const Clip lower = ClipPlane{{0, 0, 1}, kCenter.z};
  for (const int panels : {1, 2, 3, 5}) {
    for (int width = 301; width < 301 + panels; ++width) {
      CAPTURE(panels);
      CAPTURE(width);
      RenderOptions options = small_picture();
      options.size = {width, 90};
      options.occlusion = width == 301;
      std::vector<Subject> subjects(static_cast<std::size_t>(panels), {&whole, {}});
      if (panels > 1) subjects[1].clip = lower;
      const PictureSize panel = layout_of(options, subjects.size()).panel;
      const int gap = panels == 1 ? 0 : 2;
      CHECK(panel.height == 90);
      CHECK(panels * panel.width + (panels - 1) * gap <= width);
      CHECK(panels * (panel.width + 1) + (panels - 1) * gap > width);

      const Image image = render(subjects, options);
      REQUIRE(image.width == width);
      REQUIRE(image.height == 90);
      RenderOptions alone = options;
      alone.size = panel;
      const Image first = render(whole, alone);
      for (int n = 0; n < panels; ++n) {
        const Image part = columns_of(image, n * (panel.width + gap), panel.width);
        if (n != 1) {
          CHECK(part.pixels == first.pixels);
          continue;
        }
        // Half a sphere at the very place of the whole one: the lowest rows agree.
        const Tally half = tally(part), all = tally(first);
        // The opening is an ellipse, flat by the sine of the elevation.
        const double sine = std::sin(options.view->elevation * std::numbers::pi / 180);
        CHECK(half.inside == doctest::Approx(sine * all.outside).epsilon(0.05));
        CHECK(half.outside == doctest::Approx(0.5 * (1 - sine) * all.outside).epsilon(0.05));
        CHECK(half.background > all.background);
        int differing = 0;
        for (int y = 75; y < 90; ++y) {
          for (int x = 0; x < panel.width; ++x) {
            differing += !(part.at(x, y) == first.at(x, y));
          }
        }
        CHECK(differing == 0);
      }
      if (panels > 1) {
        const Image rule = columns_of(image, panel.width, gap);
        for (const Rgb& p : rule.pixels) REQUIRE(p == rule.pixels.front());
        CHECK_FALSE(rule.pixels.front() == Rgb{255, 255, 255});
      }
    }
  }
}

TEST_CASE("a small mesh beside a large one stays small: the camera fits all of them") {
  const TriMesh large = sphere(4);
  TriMesh small = large;
  for (Vec3& p : small.points) p = kCenter + 0.25 * (p - kCenter);
  RenderOptions options = small_picture();
  options.size = {322, 160};
  const Image image = render(std::array{Subject{&large, {}}, Subject{&small, {}}}, options);
  const auto covered = [&](int left) {
    return 160 * 160 - tally(columns_of(image, left, 160)).background;
  };
  CHECK(covered(0) / 16.0 == doctest::Approx(covered(162)).epsilon(0.1));
}

TEST_CASE("the axis that is up is up in the picture, from wherever the eye looks") {
  const TriMesh mesh = sphere(2);
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int axis = static_cast<int>(seed % 3);
    const double sign = seed % 2 == 0 ? 1 : -1, elevation = random.uniform(-89, 89);
    Vec3 up;
    up[axis] = sign;
    const View view{random.uniform(-360, 360), elevation, {axis, sign}};
    const Camera camera = camera_on(mesh, view, {400, 300}, {});
    CHECK(length(camera.right) == doctest::Approx(1));
    CHECK(std::abs(dot(camera.right, up)) < 1e-12);
    CHECK(dot(camera.up, up) == doctest::Approx(std::cos(elevation * std::numbers::pi / 180)));
    CHECK(dot(camera.back, up) == doctest::Approx(std::sin(elevation * std::numbers::pi / 180)));
    CHECK(length(cross(camera.right, camera.up) - camera.back) < 1e-12);
    CHECK(camera.project(kCenter + up).y < camera.project(kCenter).y);
    CHECK(camera.project(kCenter + camera.back).depth > camera.project(kCenter).depth);
    const Up chosen = best_view(std::array{Subject{&mesh, {}}}, {40, 30}, {axis, sign}).up;
    CHECK(chosen == Up{axis, sign});
  }
}

TEST_CASE("what is looked at is in the middle, at any zoom; what is beside all is refused") {
  const TriMesh mesh = sphere(4);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const View view{random.uniform(-360, 360), random.uniform(-89, 89)};
    Aim aim;
    aim.zoom = random.uniform(0.1, largest_zoom({400, 300}));
    aim.look_at =
        mesh.points[VertexId(random.below(static_cast<std::uint32_t>(mesh.points.size())))];
    const std::array subject{Subject{&mesh, {}}};
    const Camera camera = fit_camera(subject, view, aim, {400, 300});
    CHECK(camera.project(*aim.look_at).x == doctest::Approx(200));
    CHECK(camera.project(*aim.look_at).y == doctest::Approx(150));
    CHECK(camera.scale == doctest::Approx(aim.zoom * camera_on(mesh, view, {400, 300}, {}).scale));
    aim.look_at = kCenter + 1.01 * kRadius * camera.up;
    CHECK_THROWS_AS(fit_camera(subject, view, aim, {400, 300}), InputError);
    aim.look_at = kCenter + 100 * kRadius * camera.back;  // in front of it: only depth differs
    CHECK(fit_camera(subject, view, aim, {400, 300}).project(kCenter).x == doctest::Approx(200));
  }
}
