// SPDX-License-Identifier: MIT
// Faults by place, of triangles where they are known.
#include "check/place_faults.h"

#include <doctest/doctest.h>

#include <vector>

using namespace deliso;

namespace {

using Triangles = std::vector<Triangle>;

}  // namespace

TEST_CASE("each kind of fault is counted, with the vertices that have a part in it") {
  std::vector<VertexId> where;
  // The second triangle goes through the first.
  const std::vector<Vec3> crossing{{0, 0, 0}, {4, 0, 0},   {0, 4, 0}, {1, 1, -1},
                                   {1, 1, 1}, {9, 9, 0.5}, {20, 0, 0}};
  const Triangles two{{0, 1, 2}, {3, 4, 5}};
  PlaceFaults faults = find_place_faults(crossing, two, 1, &where);
  CHECK(faults.crossings == 1);
  CHECK(faults.flat == 0);
  CHECK(faults.coincident == 0);
  CHECK(where == std::vector<VertexId>{0, 1, 2, 3, 4, 5});

  const std::vector<Vec3> flat{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {0, 5, 0}, {3, 3, 3}};
  faults = find_place_faults(flat, Triangles{{0, 1, 2}, {0, 3, 4}}, 1, &where);
  CHECK(faults.crossings == 0);
  CHECK(faults.flat == 1);
  CHECK(faults.coincident == 1);
  CHECK(where == std::vector<VertexId>{0, 1, 2, 4});
  CHECK(faults.beyond({0, 1, 0}).count() == 1);
  CHECK(PlaceFaults{}.beyond(faults).count() == 0);
}
