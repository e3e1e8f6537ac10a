// SPDX-License-Identifier: MIT
#include "surface/boundary.h"

#include <doctest/doctest.h>

#include "fields.h"
#include "run/options.h"

using namespace deliso;

namespace {

bool on_box(const Box3& box, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == box.lo[axis] || p[axis] == box.hi[axis]) return true;
  }
  return false;
}

}  // namespace

TEST_CASE(
    "every chain keeps the points on edges of the box; splits are on Sigma, on the box, in order") {
  int loops = 0, splits = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 14, {1, 1, seed % 3 == 0 ? 3.0 : 1.0});
    const BoundaryCurves curves = BoundaryCurves(
        scene.surface, std::make_shared<const BoundaryLoops>(scene.contour.boundary.loops));
    for (std::uint32_t loop = 0; loop < scene.contour.boundary.size(); ++loop) {
      ++loops;
      const std::size_t n = curves.loop(loop).size();
      // A chain of the kept points, and of others where the sagitta asks for them.
      const auto at = [&](std::size_t k) -> CurvePoint {
        const CurvePlace place{loop, static_cast<double>(k)};
        return {place, curves.point(place)};
      };
      const auto turns = [&](std::size_t k) {
        return curves.loop(loop)[k].face != curves.loop(loop)[(k + n - 1) % n].face;
      };
      std::vector<CurvePlace> chain;
      for (std::size_t k = 0, last = 0; k < n; ++k) {
        const CurvePlace place = at(k).place;
        CHECK(curves.is_kept(place) == turns(k));
        const double chord = distance(at(last).point, at((k + 1) % n).point);
        if (k == 0 || curves.is_kept(place) ||
            curves.strays(at(last), at((k + 1) % n), 0.1 * chord)) {
          chain.push_back(place);
          last = k;
        }
      }
      for (std::size_t k = 0; k < chain.size(); ++k) {
        // Halve one arc again and again, far below voxel size.
        CurvePlace a = chain[k], b = chain[(k + 1) % chain.size()];
        Vec3 pa = curves.point(a), pb = curves.point(b);
        for (int level = 0; level < 12; ++level) {
          const auto split = curves.split({a, pa}, {b, pb});
          if (!split) break;
          ++splits;
          CHECK(on_box(scene.volume.box(), split->point));
          CHECK(std::abs(scene.volume.value(split->point) - scene.surface.kappa()) < 1e-9);
          // Neither half is much shorter than the other.
          const double before = distance(pa, split->point), after = distance(split->point, pb);
          CHECK(std::min(before, after) > 0.15 * std::max(before, after));
          // The arc stays as close to its chord as its middle is, at least.
          CHECK(curves.sagitta({a, pa}, {b, pb}) + 1e-9 >=
                0.999 * length(cross(split->point - pa, pb - pa)) / distance(pa, pb));
          const double end = b.s > a.s ? b.s : b.s + static_cast<double>(n);
          const double s = split->place.s > a.s ? split->place.s : split->place.s + double(n);
          CHECK(a.s < s);
          CHECK(s < end);
          (level % 2 == 0 ? b : a) = split->place;
          (level % 2 == 0 ? pb : pa) = split->point;
        }
      }
    }
  }
  CHECK(loops > 60);
  CHECK(splits > 5000);
}

TEST_CASE("a chain links vertices in both directions, also after insertion and renumbering") {
  BoundaryChain chain;
  const std::vector<VertexId> vertices = {5, 7, 9};
  const std::vector<CurvePlace> places = {{0, 0}, {0, 4}, {0, 8}};
  chain.add_loop(vertices, places);
  CHECK(chain.next(5) == 7);
  CHECK(chain.previous(5) == 9);
  CHECK(chain.is_edge(9, 5));
  CHECK_FALSE(chain.is_boundary(6));
  chain.insert_after(5, 13, {0, 2});
  chain.remove(13);
  CHECK(chain.is_edge(5, 7));
  CHECK_FALSE(chain.is_boundary(13));
  chain.insert_after(7, 11, {0, 6});
  CHECK(chain.next(7) == 11);
  CHECK(chain.next(11) == 9);
  CHECK(chain.previous(9) == 11);
  CHECK_FALSE(chain.is_edge(7, 9));
  std::vector<VertexId> new_id(14, kNoId);
  new_id[5] = 0, new_id[7] = 1, new_id[11] = 2, new_id[9] = 3;
  const BoundaryChain after = chain.renumbered(new_id);
  CHECK(after.next(1) == 2);
  CHECK(after.previous(0) == 3);
  CHECK(after.place(2).s == 6);
}

// A Stage 1 of an earlier state lost all facets at a vertex of the chain. Its neighbors pointed to
// nobody, and collapsing needles along the box read far outside of the chain.
TEST_CASE("a chain stays closed when a vertex is removed") {
  BoundaryChain chain;
  chain.add_loop(std::vector<VertexId>{5, 7, 9, 11, 13},
                 std::vector<CurvePlace>{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}});
  std::vector<VertexId> new_id(14, kNoId);
  new_id[5] = 0, new_id[11] = 1, new_id[13] = 2;
  const BoundaryChain after = chain.renumbered(new_id);
  CHECK(after.next(0) == 1);
  CHECK(after.previous(1) == 0);
  CHECK(after.next(1) == 2);
  CHECK(after.next(2) == 0);
  CHECK_FALSE(after.is_boundary(3));
}
