// SPDX-License-Identifier: MIT
// What meshes of built-in fields are worth at least: a change that halves their quality fails here.
// Bounds lie well beyond the spread of the turns; what pays within them, `make quality` says.
#include <doctest/doctest.h>

#include <array>
#include <string>

#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "support/quality.h"

using namespace deliso;

namespace {

struct Bounds {
  const char* field;
  // At most. Lengths in voxels.
  double vertices, needles, facets_over, points_far;
  double mesh_999, mesh_max, surface_999, surface_max;
  double restricted;  // at least, in percent
};

// Some 1.1 times the vertices and 1.5 to 2 times the other medians of eight runs. noise:20 and
// marschner_lobb:41 have features below a voxel, and points that no facet reaches.
constexpr std::array kBounds{
    Bounds{"orbital:48", 1710, 2, 2, 2, 0.2, 0.28, 0.2, 0.25, 99.9},
    Bounds{"fuel:32", 1310, 2, 2, 2, 0.21, 0.28, 0.22, 0.26, 99.9},
    Bounds{"machine:40", 2520, 2, 2, 2, 0.23, 0.32, 0.23, 0.3, 99.4},
    Bounds{"gyroid:48", 5800, 2, 2, 2, 0.22, 0.28, 0.17, 0.22, 99.9},
    Bounds{"noise:20", 7400, 9, 32, 4, 0.26, 0.45, 0.25, 0.35, 99.5},
    Bounds{"marschner_lobb:41", 15900, 340, 350, 6, 0.28, 0.5, 0.25, 0.35, 97.5},
};

}  // namespace

TEST_CASE("meshes of built-in fields keep their quality") {
  for (const Bounds& bounds : kBounds) {
    CAPTURE(bounds.field);
    const std::string input = std::string("builtin:") + bounds.field;
    const double isovalue = find_builtin_field(input)->isovalue;
    const Volume volume = make_builtin_volume(input);
    const Options options;
    Report report;
    const Measured m = measure(mesh_isosurface(volume, isovalue, options, report), volume, isovalue,
                               options, options.threads);
    CHECK(m[Metric::exact] == 1);
    CHECK(m[Metric::crossings] == 0);
    CHECK(m[Metric::other_faults] == 0);
    CHECK(m[Metric::vertices] <= bounds.vertices);
    CHECK(m[Metric::needles] <= bounds.needles);
    CHECK(m[Metric::facets_over] <= bounds.facets_over);
    CHECK(m[Metric::points_far] <= bounds.points_far);
    CHECK(m[Metric::mesh_999] <= bounds.mesh_999);
    CHECK(m[Metric::mesh_max] <= bounds.mesh_max);
    CHECK(m[Metric::surface_999] <= bounds.surface_999);
    CHECK(m[Metric::surface_max] <= bounds.surface_max);
    CHECK(m[Metric::restricted] >= bounds.restricted);
  }
}
