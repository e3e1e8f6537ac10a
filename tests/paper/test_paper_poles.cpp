// SPDX-License-Identifier: MIT
// ComputePoles, against every Voronoi vertex of every vertex by itself.
#include "paper/poles.h"

#include <doctest/doctest.h>

#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// A field whose inside is known without its samples.
template <class F>
Field known(F&& f) {
  return {sampled<float>({17, 17, 17}, {1, 1, 1},
                         [&](int i, int j, int k) {
                           return f(Vec3{1.0 * i, 1.0 * j, 1.0 * k});
                         }),
          0};
}

double in_ball(const Vec3& p) {
  return 5.1 - distance(p, {8.1, 7.9, 8.2});
}

double in_torus(const Vec3& p) {
  const Vec3 d = p - Vec3{8.1, 7.9, 8.2};
  return 2.2 - std::hypot(std::hypot(d.x, d.y) - 4.9, d.z);
}

// Under a sheet that the box cuts on four sides. Beyond the box it goes on as a cylinder.
double under_sheet(const Vec3& p) {
  const double x = std::clamp(p.x, 0.0, 16.0), y = std::clamp(p.y, 0.0, 16.0);
  return 7.3 + 0.05 * (x - 7) * (x - 7) - 0.03 * (y - 9) * (y - 9) - p.z;
}

}  // namespace

TEST_CASE("pole heights: the nearer of the two furthest Voronoi vertices, one on each side") {
  struct Case {
    std::string name;
    double (*inside)(const Vec3&);
  };
  for (const Case& field :
       {Case{"ball", in_ball}, Case{"torus", in_torus}, Case{"sheet", under_sheet}}) {
    CAPTURE(field.name);
    Program program(known(field.inside), few_vertices(4000));
    program.recovery.recover();
    const Triangulation& t = program.del().del();
    const std::vector<double> heights = paper::compute_poles(t, program.sigma);
    CHECK(heights.size() == t.vertex_capacity());
    std::size_t compared = 0;
    for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
      if (program.del().is_auxiliary(q)) continue;
      double above = 0, below = 0;
      bool is_sure = true;
      for (CellId c = 0; c < t.cell_capacity(); ++c) {
        if (!t.is_live(c) || t.is_infinite(c) || std::ranges::count(t.vertices(c), q) == 0)
          continue;
        // The center of the ball through the cell's corners.
        const auto& v = t.vertices(c);
        const Vec3 center =
            circumsphere(t.point(v[0]), t.point(v[1]), t.point(v[2]), t.point(v[3])).center;
        const double g = field.inside(center);
        double& far = g > 0 ? above : below;
        far = std::max(far, distance(center, t.point(q)));
        // The samples are not the function: very near to Sigma the side may be another.
        is_sure &= std::fabs(g) > 0.05;
      }
      if (!is_sure) continue;
      ++compared;
      CHECK(above > 0);
      CHECK(below > 0);
      CHECK(heights[q] == doctest::Approx(std::min(above, below)).epsilon(1e-9));
    }
    CHECK(compared > 50);
  }
}

TEST_CASE("every vertex of a facet has a pole on each side, on the box too") {
  Program program(builtin("gyroid", 16), few_vertices(4000));
  program.recovery.recover();
  const std::vector<double> heights = paper::compute_poles(program.del().del(), program.sigma);
  for (const auto& [q, d_q] : stars(stored_hits(program.del()))) CHECK(heights[q] > 0);
}
