// SPDX-License-Identifier: MIT
// The division of a volume into blocks: the grid, the counts, the seams. tests/stress/division.cpp
// has storms.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "blocks/components.h"
#include "blocks/grid.h"
#include "blocks/mesh_in_blocks.h"
#include "blocks/patch.h"
#include "blocks/weld.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "check/verify.h"
#include "coarsen/coarsen.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/contour.h"
#include "deliso/mesh_isosurface.h"
#include "fields.h"
#include "io/volume/builtin_volume.h"
#include "mesh/meshes.h"
#include "see.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using stress::make_tiny_volume;
using test::same_mesh;

namespace {

Options in_blocks(int side) {
  Options options;
  options.block_side = side;
  options.threads = 1;
  return options;
}

std::uint64_t voxels_in(const SampleBox& box) {
  std::uint64_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    voxels *= static_cast<std::uint64_t>(box.end[axis] - box.begin[axis]);
  }
  return voxels;
}

// A mesh that is one patch, in a slab across an axis, and the rest.
struct Divided {
  Divided(const Scene& scene, int axis) : whole(contour_as_mesh(scene.contour)) {
    const double side = scene.volume.box().hi[axis];
    patch.place = 1;
    patch.free_box.lo[axis] = 0.3 * side;
    patch.free_box.hi[axis] = 0.6 * side;
    const TriMesh& mesh = whole.mesh;
    const auto is_held = [&](VertexId v) { return patch.free_box.holds(mesh.points[v]); };
    for (VertexId v = 0; v < mesh.points.size(); ++v) places.vertices.of.push_back(is_held(v));
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      const auto held = std::ranges::count_if(mesh.faces[f].v, is_held);
      places.facets.of.push_back(held == 3 ? 1 : held == 0 ? 0 : std::uint32_t{kNoId});
      (held > 0 ? patch.facets : others).push_back(f);
    }
    places.vertices.number.resize(mesh.points.size(), kNoId);
    places.facets.number.resize(mesh.faces.size(), kNoId);
    whole.duals.resize(mesh.faces.size());
  }
  SurfaceMesh whole;
  MeshPatch patch;
  PlacesInPatches places;
  std::vector<FaceId> others;  // facets
};

using FacetPlaces = std::array<std::tuple<double, double, double>, 3>;

FacetPlaces places_of(const TriMesh& mesh, FaceId f) {
  FacetPlaces places;
  std::ranges::transform(mesh.faces[f].v, places.begin(),
                         [&](VertexId v) { return by_place(mesh.points[v]); });
  std::rotate(places.begin(), std::ranges::min_element(places), places.end());
  return places;
}

}  // namespace

// Coarsening removes vertices, of the boundary too. Vertices in the middle of facets get their ids.
TEST_CASE("a patch that changed is put back, with its chain and its neighbors") {
  const Scene scene = builtin_scene("gyroid", 16);
  const Parameters parameters = resolve({}, scene.volume);
  const BoundaryCurves curves(scene.surface,
                              std::make_shared<const BoundaryLoops>(scene.contour.boundary.loops));
  for (int axis = 0; axis < 3; ++axis) {
    Divided mesh(scene, axis);
    std::vector<FacetPlaces> expected, found;
    for (const FaceId f : mesh.others) expected.push_back(places_of(mesh.whole.mesh, f));
    extract(mesh.whole, mesh.patch, mesh.places);
    MeshPatch& patch = mesh.patch;
    const FreeBox& free_box = patch.free_box;
    for (VertexId v = patch.first_held; v < patch.vertices.size(); ++v) patch.first.push_back(v);
    coarsen(patch.mesh, {scene.surface, curves, parameters, patch.report},
            coarsening_bound(parameters), {free_box, patch.first});
    TriMesh& part = patch.mesh.mesh;
    for (FaceId f = free_box.first_free; f < patch.facets.size(); ++f) {
      if (is_dead(part.faces[f])) continue;
      const auto [a, b, c] = part.faces[f].v;
      const VertexId v(part.points.size());
      part.points.push_back((part.points[a] + part.points[b] + part.points[c]) / 3);
      part.faces[f].v = {a, b, v};
      part.faces.push_back({{b, c, v}, {}});
      part.faces.push_back({{c, a, v}, {}});
    }
    link_faces(part);
    patch.mesh.duals.resize(part.faces.size());
    for (FaceId f = 0; f < part.faces.size(); ++f) {
      if (!is_dead(part.faces[f])) expected.push_back(places_of(part, f));
    }
    put_back(mesh.whole, patch);
    remove_dead(mesh.whole);
    REQUIRE(check_mesh(mesh.whole.mesh) == "");
    CHECK(ends_on_chain(mesh.whole));
    const std::size_t facets = mesh.whole.mesh.faces.size();
    for (FaceId f = 0; f < facets; ++f) found.push_back(places_of(mesh.whole.mesh, f));
    std::ranges::sort(expected);
    std::ranges::sort(found);
    CHECK(found == expected);
  }
}

TEST_CASE("the boundary curves of blocks join to those of the whole") {
  const Volume volume = make_builtin_volume("builtin:gyroid:24");
  const Options options = in_blocks(8);
  const VolumeSource source = source_of(volume);
  const Parameters parameters = resolve(options, volume);
  const double kappa = geometric_isovalue(volume.type(), 0);
  const Block whole = mesh_in_blocks({source, kappa, options, parameters}, {}, {});
  // By place: the next one, the face, and whether every chain must have it.
  const auto arcs = [](const BoundaryLoops& loops) {
    std::map<std::tuple<double, double, double>, std::tuple<Vec3, BoxFace, bool>> all;
    for (const BoundaryLoop& loop : loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto& [point, face, is_kept, is_fixed] = loop[k];
        all[by_place(point)] = {loop[(k + 1) % loop.size()].point, face, is_kept};
      }
    }
    return all;
  };
  const ContourMesh contour = build_contour(volume, kappa);
  CHECK(arcs(*whole.loops) == arcs(contour.boundary.loops));
  CHECK(whole.loops->size() == contour.boundary.size());
  const BoundaryChain& chain = whole.mesh.chain;
  std::size_t ends = 0;
  for (VertexId v = 0; v < whole.mesh.mesh.points.size(); ++v) {
    if (!chain.is_boundary(v)) continue;
    const auto [loop, s] = chain.place(v);
    if (s == std::floor(s)) {
      CHECK((*whole.loops)[loop][static_cast<std::size_t>(s)].point == whole.mesh.mesh.points[v]);
    }
    ends += chain.place(chain.next(v)).s <= s;
  }
  CHECK(ends == whole.loops->size());  // else it runs on to the next place
}

TEST_CASE("every voxel is in one block, and a block's samples are the volume's") {
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    Index3 dims;
    for (int axis = 0; axis < 3; ++axis) dims[axis] = 2 + static_cast<int>(random() % 30);
    const Volume volume = Volume::from_function(
        {{0, 0, 0}, {1, 1, 1}}, dims, [](const Vec3& p) { return p.x + 3 * p.y + 5 * p.z; });
    const int side = 1 + static_cast<int>(random() % 12);
    CAPTURE(side);
    const std::vector<SampleBox> boxes = BlockGrid(volume, side).boxes();
    std::uint64_t voxels = 0;
    for (const SampleBox& box : boxes) {
      voxels += voxels_in(box);
      for (int axis = 0; axis < 3; ++axis) {
        const int length = box.end[axis] - box.begin[axis];
        CHECK(length >= 1);
        // Rounded to the nearest number of blocks.
        if (dims[axis] - 1 > side) CHECK(length <= 1.5 * side + 1);
      }
      const Volume block = samples_of(volume, box);
      const Index3 last{block.dims().i - 1, block.dims().j - 1, block.dims().k - 1};
      CHECK(block.sample(0, 0, 0) == volume.sample(box.begin.i, box.begin.j, box.begin.k));
      CHECK(block.sample(last.i, last.j, last.k) == volume.sample(box.end.i, box.end.j, box.end.k));
    }
    const Index3 all = volume.voxels();
    CHECK(voxels == static_cast<std::uint64_t>(all.i) * static_cast<std::uint64_t>(all.j) *
                        static_cast<std::uint64_t>(all.k));
  }
}

TEST_CASE("components counted in blocks are those of the whole, in the same order") {
  std::size_t components = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(100u); ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 5, 14);
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    const ContourSummary whole = summarize_contour(tiny.volume, kappa);
    std::vector<BlockComponents> parts;
    for (const SampleBox& box : BlockGrid(tiny.volume, 2 + static_cast<int>(seed % 4)).boxes()) {
      const Volume block = samples_of(tiny.volume, box);
      parts.push_back(components_of(build_contour(block, kappa), block));
    }
    const AllComponents all = joined(parts, tiny.volume.whole_dims());
    CHECK(all.topology == whole.topology());
    REQUIRE(all.components.size() == whole.components.size());
    for (std::size_t c = 0; c < whole.components.size(); ++c) {
      CHECK(all.components[c].euler == whole.components[c].euler);
      CHECK(all.components[c].crossings == whole.components[c].crossings);
    }
    components += whole.components.size();
  }
  CHECK(components > test::cases(300u));
}

TEST_CASE("facets of two boxes at a seam never cross, and any number of threads makes one mesh") {
  for (const char* input : {"builtin:gyroid:24", "builtin:fuel:32", "builtin:noise:17"}) {
    CAPTURE(input);
    const Volume volume = make_builtin_volume(input);
    const double isovalue = find_builtin_field(input)->isovalue;
    Options options = in_blocks(8);
    Report report;
    const TriMesh mesh = mesh_isosurface(volume, isovalue, options, report);
    INFO(test::see_mesh(test::case_name(), mesh, build_contour(volume, report.kappa_effective)));
    CHECK(mesh_topology(mesh).counts() == report.exact);
    const Verification found = verify(mesh, volume, report.kappa_effective, {});
    CHECK(found.faults.count(FaultKind::self_intersections) == 0);
    CHECK(found.faults.count(FaultKind::holes) == 0);
    for (const int threads : {2, 5}) {
      options.threads = threads;
      CHECK(same_mesh(mesh_isosurface(volume, isovalue, options), mesh));
    }
  }
}

TEST_CASE(
    "a smooth surface in blocks costs few vertices, and no facet or sample is left to refine") {
  const Volume volume = make_builtin_volume("builtin:gyroid:40");
  const Options options = in_blocks(16);
  const VolumeSource source = source_of(volume);
  const Parameters parameters = resolve(options, volume);
  const Block block =
      mesh_in_blocks({source, geometric_isovalue(volume.type(), 0), options, parameters}, {}, {});
  const TriMesh& mesh = block.mesh.mesh;
  const TriMesh one = mesh_isosurface(volume, 0, in_blocks(0));
  // Blocks of 16 voxels have four times the seams of usual ones, for the same surface.
  CHECK(static_cast<double>(mesh.points.size()) < 1.01 * static_cast<double>(one.points.size()));
  CHECK(block.samples_near_seams.empty());
  std::size_t over = 0, not_delaunay = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Dual& dual = block.mesh.duals[f];
    over += violation(block.mesh.shape(mesh.faces[f].v, dual), parameters.refinement) > 1;
    const auto is_in_ball = [&](const Vec3& p) { return dual.holds(p); };
    not_delaunay += !dual.on_surface || std::ranges::any_of(mesh.points, is_in_ball);
  }
  CHECK(over == 0);
  CHECK(not_delaunay == 0);
}

TEST_CASE("work at seams begins with their facets, and with vertices up to two edges away") {
  const Volume volume = make_builtin_volume("builtin:gyroid:24");
  const Options options = in_blocks(12);
  const VolumeSource source = source_of(volume);
  const Parameters parameters = resolve(options, volume);
  const BlockGrid grid(volume, 12);
  std::vector<Block> blocks;
  std::size_t marked = 0;
  for (const SampleBox& box : grid.boxes()) {
    const BlockRun run{{source, geometric_isovalue(volume.type(), 0), options, parameters}, grid};
    Block& block = blocks.emplace_back(mesh_block(run, box, {}));
    mark_seam_work(block);
    const TriMesh& mesh = block.mesh.mesh;
    std::vector<std::set<VertexId>> near(mesh.points.size());  // up to an edge away
    for (const Face& face : mesh.faces) {
      for (const VertexId v : face.v) near[v.number()].insert(face.v.begin(), face.v.end());
    }
    const auto on_seam = [&](VertexId v) { return is_on_seam(block, v); };
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
      const bool may_thin = std::ranges::any_of(near[v.number()], [&](VertexId u) {
        return std::ranges::any_of(near[u.number()], on_seam);
      });
      CHECK(may_thin == (block.may_thin[v] != 0));
      marked += may_thin;
    }
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      CHECK(std::ranges::any_of(mesh.faces[f].v, on_seam) == (block.is_open[f] != 0));
    }
  }
  const Block whole = weld(blocks, volume, nullptr);
  const auto still = static_cast<std::size_t>(std::ranges::count(whole.may_thin, 1));
  CHECK(still < marked);  // those of two blocks are one
  CHECK(2 * still > marked);
}
