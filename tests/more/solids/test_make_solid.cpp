// SPDX-License-Identifier: MIT
// Solids by check_solid, which shares nothing with them; by volumes; by the region of each cell, as
// labels or rays say it.
#include "more/solids/make_solid.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>

#include "cases.h"
#include "check/place_faults.h"
#include "deliso/mesh_isosurface.h"
#include "mesh/meshes.h"
#include "more/bodies/bodies.h"
#include "more/solids/skins.h"
#include "stress/label_volumes.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::test;

namespace {

bool same_solid(const Solid& a, const Solid& b) {
  const auto same_walls = [](const Wall& s, const Wall& t) {
    return s.v == t.v && s.front == t.front && s.behind == t.behind && s.kind == t.kind;
  };
  return a.points == b.points && a.cells == b.cells && a.regions == b.regions &&
         std::ranges::equal(a.walls, b.walls, same_walls);
}

// The skin of a mesh between bodies. Region b + 1 is body b; the background, and what is beyond the
// box, is outside.
Skin labels_skin(const Partition& partition, const InterfaceMesh& mesh) {
  Skin skin{mesh.points, {}};
  const auto region = [&](BodyId body) {
    return partition.is_beyond(body) || body == partition.background() ? kOutside : body + 1;
  };
  for (const InterfaceFacet& facet : mesh.facets) {
    skin.walls.push_back({facet.v, region(facet.bodies[0]), region(facet.bodies[1])});
  }
  return skin;
}

}  // namespace

TEST_CASE("closed meshes of tiny volumes are filled, with their triangles and their volume") {
  int filled = 0, turned_on = 0;
  for (std::uint64_t seed = 1; seed <= costly_cases(45u); ++seed) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed);
    Options options;
    options.cap = true;
    Report report;
    const TriMesh mesh = mesh_isosurface(tiny.volume, tiny.isovalue, options, report);
    if (mesh.faces.empty() || !report.cap.failure.empty() ||
        find_place_faults(mesh.points, mesh.triangles()).count() > 0) {
      continue;
    }
    const Skin skin = numbered(without_unused(skin_of(mesh)));
    SolidOptions how;
    how.fills = seed % 3 != 0;
    const Solid solid = make_solid(skin, how);
    const SolidCheck check = check_against(solid, skin);
    ++filled;
    turned_on += solid.recovery.missing_walls > 0;
    CHECK(solid.walls.size() == check.border_facets);
    if (how.fills) CHECK(check.angles.least > 0);
    // The middle of a cell is inside.
    const Triangles triangles = triangles_of(mesh);
    for (std::size_t c = 0; c < solid.cells.size(); c += 1 + solid.cells.size() / 20) {
      // A whole number but for rounding, which near needles is large.
      CHECK(std::round(10 * winding_number(mesh.points, triangles, test::middle_of(solid, c))) ==
            10);
    }
  }
  CHECK(filled >= static_cast<int>(costly_cases(37u)));
  CHECK(turned_on > static_cast<int>(costly_cases(3u)));
}

TEST_CASE("cubes of random labels: the region of each cell is the label of its cube") {
  int missing = 0;
  for (std::uint64_t seed = 1; seed <= cases(200u); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 2 + static_cast<int>(random.below(3));
    const RegionId labels = 1 + random.below(4);
    std::vector<RegionId> label(static_cast<std::size_t>(n * n * n));
    for (RegionId& l : label) l = random.below(labels + 1);
    const auto region = [&](int i, int j, int k) {
      return label[static_cast<std::size_t>(i + n * (j + n * k))];
    };
    if (std::ranges::all_of(label, [](RegionId l) { return l == 0; })) continue;
    const Skin skin = numbered(cubes_skin(n, region, random));
    SolidOptions options;
    options.fills = seed % 4 != 0;
    const Solid solid = make_solid(skin, options);
    check_against(solid, skin);
    missing += solid.recovery.missing_walls > 0;
    for (std::size_t c = 0; c < solid.cells.size(); ++c) {
      const Vec3 p = test::middle_of(solid, c);
      CHECK(solid.regions[c] == region(static_cast<int>(std::floor(p.x)),
                                       static_cast<int>(std::floor(p.y)),
                                       static_cast<int>(std::floor(p.z))));
    }
  }
  CHECK(missing > static_cast<int>(cases(100u)));
}

TEST_CASE("meshes between labels are filled, each label with its region and volume") {
  int filled = 0;
  for (std::uint64_t seed = 1; seed <= cases(100u); ++seed) {
    CAPTURE(seed);
    const Partition partition = stress::partition_of(stress::make_label_volume(seed, 6));
    Options options;
    options.cap = true;
    Report report;
    const InterfaceMesh mesh = mesh_interfaces(partition, options, report);
    const Skin skin = without_unused(labels_skin(partition, mesh));
    if (find_place_faults(skin.points, surface_of(skin).triangles()).count() > 0) continue;
    if (skin.walls.empty()) continue;
    const Solid solid = make_solid(skin, {});
    check_against(solid, skin);
    std::set<RegionId> wanted, found(solid.regions.begin(), solid.regions.end());
    for (const Wall& wall : skin.walls) {
      wanted.insert(wall.front);
      wanted.insert(wall.behind);
    }
    wanted.erase(kOutside);
    CHECK(found == wanted);
    ++filled;
  }
  CHECK(filled > static_cast<int>(cases(80u)));
}

// A cell at an edge was looked for on the other side of a vertex at which the solid touches itself.
TEST_CASE("a solid that touches itself in many edges and vertices is improved") {
  Random random(3);
  const auto region = [](int i, int j, int k) {
    return static_cast<RegionId>((i + j + k) % 7 < 2 ? 0 : 1 + (i * j + k) % 3);
  };
  const Skin skin = cubes_skin(6, region, random);
  check_against(make_solid(skin, {}), skin);
}

TEST_CASE("the same skin gives the same solid, and a wall's kind is that of its parts") {
  Random random(7);
  Skin skin = cubes_skin(
      3, [](int i, int j, int k) { return static_cast<RegionId>(1 + (i + j * k) % 3); }, random);
  // A kind for each plane.
  for (Wall& wall : skin.walls) {
    const Vec3 n =
        area_normal(skin.points[wall.v[0]], skin.points[wall.v[1]], skin.points[wall.v[2]]);
    const int axis = n.x != 0 ? 0 : n.y != 0 ? 1 : 2;
    wall.kind = static_cast<std::uint32_t>(10 * axis + skin.points[wall.v[0]][axis]);
  }
  const Solid solid = make_solid(skin, {});
  CHECK(same_solid(solid, make_solid(skin, {})));
  for (const Wall& wall : solid.walls) {
    const int axis = static_cast<int>(wall.kind / 10);
    for (const VertexId v : wall.v) CHECK(solid.points[v][axis] == wall.kind % 10);
  }
}

TEST_CASE("a tiny skin gives the solid of a large one, bit by bit") {
  Random random(5);
  const Skin skin = cubes_skin(
      3, [](int i, int j, int k) { return static_cast<RegionId>((i + j * k) % 3); }, random);
  const double scale = std::ldexp(1, -260);  // 1e-78: insphere() underflows
  Skin tiny = skin;
  for (Vec3& p : tiny.points) p = scale * p;
  SolidOptions options, tiny_options;
  options.lattice.max_edge = .7;
  tiny_options.lattice.max_edge = scale * .7;
  Solid solid = make_solid(skin, options);
  for (Vec3& p : solid.points) p = scale * p;
  CHECK(same_solid(make_solid(tiny, tiny_options), solid));
}

TEST_CASE("lengths of edges: the largest, and the growth inwards") {
  Random random(3);
  const Skin skin = cubes_skin(
      8, [](int, int, int) { return 1u; }, random);
  const auto cells_with = [&](double growth, double max_edge) {
    SolidOptions options;
    options.lattice = {growth, max_edge};
    const Solid solid = make_solid(skin, options);
    check_against(solid, skin);
    return solid.cells.size();
  };
  const double none = std::numeric_limits<double>::infinity();
  const std::size_t even = cells_with(0, none), grown = cells_with(.35, none);
  const std::size_t fine = cells_with(.35, .5), coarse = cells_with(2, none);
  CHECK(even > grown);
  CHECK(grown > coarse);
  CHECK(fine > 2 * even);
}

TEST_CASE("points inside make better cells, and passes better ones still") {
  Random random(4);
  const Skin skin = cubes_skin(
      6, [](int, int, int) { return 1u; }, random);
  const auto angles_with = [&](int passes) {
    SolidOptions options;
    options.passes = passes;
    return check_against(make_solid(skin, options), skin).angles;
  };
  const DihedralAngles raw = angles_with(0), done = angles_with(6);
  CHECK(done.least > 2 * raw.least);
  CHECK(done.at_1_percent > 20);
  CHECK(done.at_1_percent > raw.at_1_percent);
}
