// SPDX-License-Identifier: MIT
// Distances of samples from a mesh, against the nearest of all facets.
#include "refine/coverage.h"

#include <doctest/doctest.h>

#include <numeric>

#include "more/counts/merge_vertices.h"
#include "refine/stage.h"

using namespace deliso;
using namespace deliso::test;

TEST_CASE("samples are far where none of all facets is near") {
  for (const int n : {0, 3, 5, 9, 17}) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene, {}, true);
    stage.r.parameters.refinement[Criterion::distance] = kNotAsked;
    merge_vertices(stage.r, used_vertices(stage.mesh) / 2);  // leaves dead facets
    Random random(static_cast<std::uint64_t>(n));
    std::vector<Vec3> samples;
    for (const Vec3& p : scene.contour.points) {
      const auto off = [&] { return random.uniform(-0.15, 0.15); };
      samples.push_back(p + Vec3{off(), off(), off()});
    }
    std::vector<double> distance2;
    for (const Vec3& p : samples) distance2.push_back(distance2_to_mesh(p, stage.mesh));
    for (const double limit : {0.05, 0.2}) {
      std::vector<std::uint32_t> numbers(samples.size()), expected;
      std::iota(numbers.begin(), numbers.end(), 0);
      for (const std::uint32_t k : numbers) {
        if (distance2[k] > limit * limit) expected.push_back(k);
      }
      CHECK(!expected.empty());
      CHECK(expected.size() < samples.size());
      const auto far = find_far(stage.mesh, stage.r.facets(), samples, limit, numbers);
      CHECK(numbers == expected);
      CHECK(!far.empty());
      for (const FarSample& at : far) CHECK(at.distance2 == distance2[at.sample]);
      // The second time only those that are left are held against the mesh.
      const auto again = find_far(stage.mesh, stage.r.facets(), samples, limit, numbers);
      CHECK(numbers == expected);
      CHECK(again.size() == far.size());
    }
  }
}
