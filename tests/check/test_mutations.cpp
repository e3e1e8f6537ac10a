// SPDX-License-Identifier: MIT
// A sound mesh with one random change is never called sound.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "mesh/meshes.h"

using namespace deliso;

namespace {

constexpr std::array kMutations{"moved vertex", "flipped facet", "removed facet",
                                "duplicated facet", "swapped vertices"};

// A mesh as a file holds it.
struct Soup {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  std::uint32_t any_triangle(Random& random) const {
    return random.below(static_cast<std::uint32_t>(triangles.size()));
  }

  void mutate(std::size_t kind, const Volume& volume, Random& random) {
    const std::uint32_t f = any_triangle(random);
    Triangle& t = triangles[f];
    switch (kind) {
      case 0: {  // off the surface: a thousandth of a voxel, and up to ten
        const double voxels = std::pow(10, random.uniform(-3, 1));
        Vec3& p = points[t[0]];
        const Vec3 gradient = volume.gradient(p);
        p = p + (voxels / length(gradient)) * gradient;
        break;
      }
      case 1:
        std::swap(t[1], t[2]);
        break;
      case 2:
        t = triangles.back();
        triangles.pop_back();
        break;
      case 3:
        triangles.push_back(t);
        break;
      default: {  // with a neighbor, or with any other vertex
        const VertexId other = random.below(2) == 0 ? t[1] : triangles[any_triangle(random)][0];
        if (other != t[0]) std::swap(points[t[0]], points[other]);
        break;
      }
    }
  }
};

}  // namespace

TEST_CASE("each of 200 random changes of sound meshes is a fault") {
  std::size_t caught = 0;
  for (const std::string name : {"gyroid:16", "five_spheres:24", "fuel:20", "linked_tori:20"}) {
    const Volume volume = make_builtin_volume("builtin:" + name);
    const double kappa =
        geometric_isovalue(volume.type(), find_builtin_field("builtin:" + name)->isovalue);
    Report report;
    const TriMesh mesh = mesh_isosurface(volume, kappa, {}, report);
    const Soup sound{mesh.points, test::triangles_of(mesh)};
    const auto has_fault = [&](const Soup& soup) {
      return verify(make_tri_mesh(soup.points, soup.triangles), volume, kappa, {}).faults.any();
    };
    CAPTURE(name);
    CHECK_FALSE(has_fault(sound));
    Random random(20);
    for (std::size_t n = 0; n < 50; ++n) {
      const std::size_t kind = n % kMutations.size();
      Soup mutant = sound;
      while (mutant.points == sound.points && mutant.triangles == sound.triangles) {
        mutant.mutate(kind, volume, random);
      }
      const bool is_caught = has_fault(mutant);
      CAPTURE(n);
      CAPTURE(std::string(kMutations[kind]));
      CHECK(is_caught);
      caught += is_caught;
    }
  }
  CHECK(caught == 200);
}
