// SPDX-License-Identifier: MIT
#include "coarsen/waiting_vertices.h"

#include <doctest/doctest.h>

#include <vector>

using namespace deliso;

TEST_CASE("vertices near a change wait for the next pass, and refused ones for their facet") {
  WaitingVertices waiting(5);
  for (VertexId v = 0; v < 5; ++v) waiting.wake(v, v, true);
  std::vector<VertexId> tried;
  waiting.pass(
      [&](VertexId v) {
        tried.push_back(v);
        if (v == 3) waiting.refuse(v, {0, 1, 2});
        return v == 0 || v == 4;
      },
      [&](VertexId v, auto&& visit) {
        const VertexId beside(v == 0 ? 1 : 3);
        visit(beside);
        waiting.wake(beside, v, true);
      });
  // 4 is no corner of the facet for which 3 was refused.
  CHECK(tried == std::vector<VertexId>{0, 2, 3, 4, 1});
  waiting.wake(3, 2, true);
  tried.clear();
  waiting.pass([&](VertexId v) { return tried.push_back(v), false; }, [](VertexId, auto&&) {});
  CHECK(tried == std::vector<VertexId>{3});
}
