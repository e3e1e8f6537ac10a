// SPDX-License-Identifier: MIT
// Seams of T between blocks, on random volumes: both blocks have the same points there, which are
// crossings of grid edges; nothing else of T lies on the face, and T is embedded.
#include "contour/plain_seams.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "blocks/grid.h"
#include "cases.h"
#include "check/self_intersections.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/fine_contour.h"
#include "mesh/check_mesh.h"
#include "stress/tiny_volume.h"

using namespace deliso;

namespace {

using EndPoints = std::set<std::tuple<double, double, double>>;

}  // namespace

TEST_CASE("blocks end on their common face alike, at crossings of grid edges") {
  std::size_t lifted = 0, segments = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(280u); ++seed) {
    CAPTURE(seed);
    const auto tiny = stress::make_tiny_volume(seed, 4, 9);
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    std::map<EndPoints, int> ends;  // of all blocks on inner faces
    for (const SampleBox& box : BlockGrid(tiny.volume, 2 + static_cast<int>(seed % 3)).boxes()) {
      const Volume block = samples_of(tiny.volume, box);
      ContourMesh t = fine_contour(build_contour(block, kappa), block, kappa);
      if (t.points.empty()) continue;
      const std::size_t before = t.triangles.size();
      make_seams_plain(t, block);
      lifted += t.triangles.size() - before;
      const unsigned inner = block.inner_faces();
      const SurfaceMesh mesh = contour_as_mesh(t);
      CHECK(check_mesh(mesh.mesh) == "");
      CHECK(ends_on_chain(mesh));
      for (VertexId v = 0; v < t.points.size(); ++v) {
        const unsigned faces = box_faces_at(t.points[v], block.box()) & inner;
        CHECK((faces == 0 || mesh.chain.is_boundary(v)));
      }
      for (std::size_t c = 0; c < t.boundary.size(); ++c) {
        const BoundaryLoop& loop = t.boundary.loops[c];
        for (std::size_t k = 0; k < loop.size(); ++k) {
          CHECK(loop[k].point == t.points[t.boundary.vertices[c][k]]);
          CHECK(loop[k].is_fixed == ((inner >> loop[k].face & 1) != 0));
          if (is_on_fixed(loop, static_cast<double>(k))) CHECK(loop[k].is_kept);
          if (!loop[k].is_fixed) continue;
          EndPoints segment;
          for (const Vec3& p : {loop[k].point, loop[(k + 1) % loop.size()].point}) {
            segment.insert({p.x, p.y, p.z});
          }
          ++ends[segment];
        }
      }
      if (t.triangles.size() == before) continue;
      const std::vector<Triangle> triangles(t.triangles.begin(), t.triangles.end());
      const TriangleTree tree(t.points, triangles);
      CHECK(find_crossings(t.points, triangles, tree).pairs.empty());
    }
    segments += ends.size();
    for (const auto& [segment, blocks] : ends) CHECK(blocks == 2);
  }
  CHECK(lifted > 0);
  CHECK(segments > 0);
}
