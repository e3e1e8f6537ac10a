// SPDX-License-Identifier: MIT
#include "more/bodies/bodies.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "base/sorted_list.h"
#include "base/stopwatch.h"
#include "more/bodies/coarsen_sheets.h"
#include "more/bodies/label_complex.h"
#include "more/bodies/refine_sheets.h"
#include "more/bodies/regions.h"
#include "more/bodies/sheet_topology.h"
#include "run/observer.h"

namespace deliso {
namespace {

constexpr int kUsualSide = 16;  // of a region, in voxels

class Builder {
 public:
  Builder(const Partition& partition, const Options& options, Report& report)
      : partition_(partition),
        options_(options),
        parameters_(resolve(options, partition.shape())),
        report_(report),
        side_(options.block_side == Options::kUsualSide ? kUsualSide : options.block_side) {
    parameters_.observer = nullptr;
    report_.r_min = parameters_.r_min;
    report_.max_distance = parameters_.refinement[Criterion::distance];
  }

  InterfaceMesh run() {
    begin_stage(options_.observer, "labels");
    make_sheets();
    begin_stage(options_.observer, "coarsen");
    for (int shift = 1; shift < Regions::kShifts; ++shift) change(shift, coarsen_sheets);
    report_.vertices_coarsened = sheets_.points.size();
    for (SheetFacet& f : sheets_.facets) f.is_done = false;
    if (!options_.stop_after_stage1) {
      begin_stage(options_.observer, "refine");
      for (int shift = 0; shift < Regions::kShifts; ++shift) change(shift, refine_sheets);
    }
    const std::vector<std::uint64_t> own(sheets_.points.size(), SurfaceCounts::kOwn);
    mesh_.topology = total(std::vector{count_surfaces(sheets_, partition_, options_.cap, own)},
                           partition_.size());
    take_facets();
    if (mesh_.points.size() > options_.max_vertices) {
      throw InputError("more than --max-vertices ", options_.max_vertices, " vertices needed");
    }
    return std::move(mesh_);
  }

 private:
  // A region of T_L, coarsened.
  struct Block {
    Sheets sheets;
    SurfaceCounts counts;            // of T_L
    std::vector<std::uint64_t> key;  // per vertex: its place in T_L if other blocks have it, too
    Report report;
  };

  SheetScope scope(const Regions& regions, std::size_t region) const {
    return {partition_, parameters_, parameters_.refinement[Criterion::distance],
            regions.box(region), regions.inner_faces(region)};
  }

  Block make_block(const Regions& regions, std::size_t region) const {
    Block block;
    LabelComplex complex = [&] {
      const StepTimer timer(block.report.seconds_contour);
      return label_complex(partition_, regions.samples(region));
    }();
    block.sheets = std::move(complex.sheets);
    block.key = std::move(complex.place);
    const SheetScope scope = this->scope(regions, region);
    for (std::size_t v = 0; v < block.key.size(); ++v) {
      const bool is_shared =
          (box_faces_at(block.sheets.points[v], scope.box) & scope.inner_faces) != 0;
      if (!is_shared) block.key[v] = SurfaceCounts::kOwn;
    }
    block.counts = count_surfaces(block.sheets, partition_, options_.cap, block.key);
    coarsen_sheets(block.sheets, scope, block.report);
    return block;
  }

  // Makes T_L, coarsened block by block, and joins the blocks at the vertices that they share.
  void make_sheets() {
    const Regions regions(partition_.shape(), side_, 0);
    std::vector<Block> blocks(regions.size());
    for_each_task(options_.threads, blocks.size(),
                  [&](std::size_t n) { blocks[n] = make_block(regions, n); });
    std::vector<std::uint64_t> keys;
    std::vector<SurfaceCounts> counts;
    for (Block& block : blocks) {
      for (const std::uint64_t key : block.key) {
        if (key != SurfaceCounts::kOwn) keys.push_back(key);
      }
      counts.push_back(std::move(block.counts));
      report_.add(block.report);
    }
    sort_unique(keys);
    sheets_.points.resize(keys.size());
    for (Block& block : blocks) add(block, keys);
    sheets_.free_facets = sheets_.facets.size();
    mesh_.exact = total(counts, partition_.size());
  }

  void add(const Block& block, std::span<const std::uint64_t> keys) {
    std::vector<VertexId> id(block.sheets.points.size(), kNoId);
    for (SheetFacet f : block.sheets.facets) {
      for (VertexId& v : f.v) {
        VertexId& known = id[v];
        if (known == kNoId) {
          const std::uint64_t key = block.key[v];
          if (key == SurfaceCounts::kOwn) {
            known = VertexId(sheets_.points.size());
            sheets_.points.emplace_back();
          } else {
            known = VertexId(std::ranges::lower_bound(keys, key) - keys.begin());
          }
          sheets_.points[known] = block.sheets.points[v];
        }
        v = known;
      }
      sheets_.facets.push_back(f);
    }
  }

  template <class Stage>
  void change(int shift, Stage&& stage) {
    const Regions regions(partition_.shape(), side_, shift);
    if (regions.size() == 1 && shift > 0) return;
    std::vector<Report> reports(regions.size());
    regions.for_each(sheets_, options_.threads, [&](Sheets& sheets, std::size_t region) {
      stage(sheets, scope(regions, region), reports[region]);
    });
    for (const Report& report : reports) report_.add(report);
  }

  // Moves the facets that are asked for out, sheet by sheet, with the vertices that they use.
  void take_facets() {
    std::ranges::stable_sort(sheets_.facets, {}, &SheetFacet::bodies);  // beyond the box last
    for (const SheetFacet& f : sheets_.facets) {
      const bool is_cap = partition_.is_beyond(f.bodies[0]);
      if (is_cap && (!options_.cap || f.bodies[1] == partition_.background())) continue;
      mesh_.facets.push_back({f.v, f.bodies});
      if (!is_cap) ++mesh_.inner_facets;
    }
    IdArray<VertexId, VertexId> known(sheets_.points.size(), kNoId);
    for (const VertexId v : number_vertices(mesh_.facets, known)) {
      mesh_.points.push_back(sheets_.points[v]);
    }
    report_.triangles_refined = mesh_.inner_facets;
    for (std::size_t f = 0; f < mesh_.inner_facets; ++f) {
      for (const VertexId v : mesh_.facets[f].v) {
        report_.vertices_refined = std::max<std::size_t>(report_.vertices_refined, v + 1);
      }
    }
  }

  const Partition& partition_;
  const Options& options_;
  Parameters parameters_;
  Report& report_;
  const int side_;
  Sheets sheets_;
  InterfaceMesh mesh_;
};

// Looks for the bound on the distance at which the mesh has at most the desired number of vertices
// or triangles, and nearly as many. Returns that with the most of those that have not more; if none
// has, that with the largest bound.
InterfaceMesh mesh_near_count(const Partition& partition, const Options& options, Report& report) {
  constexpr double kFirstVoxels = 0.1, kLeastVoxels = 2e-3, kMostVoxels = 2, kEnough = 0.98;
  constexpr int kMostRuns = 9;
  Options one = options;
  one.target_vertices = one.target_triangles = Options::kNoTarget;
  const auto share = [&](const Report& of) {  // of the desired number
    return std::max(
        static_cast<double>(of.vertices_refined) / static_cast<double>(options.target_vertices),
        static_cast<double>(of.triangles_refined) / static_cast<double>(options.target_triangles));
  };
  double least = kLeastVoxels, most = kMostVoxels, bound = kFirstVoxels, best = 0;
  InterfaceMesh found;
  for (int run = 0; run < kMostRuns && best < kEnough; ++run) {
    one.limits[Criterion::distance] = {bound, Length::Unit::voxel};
    Report made;
    InterfaceMesh mesh = Builder(partition, one, made).run();
    const double now = share(made);
    if (run == 0 || (now <= 1 && now > best) || (now > 1 && best == 0)) {
      found = std::move(mesh);
      report = made;
      if (now <= 1) best = now;
    }
    if (now == 0 || (now > 1 && bound == kMostVoxels)) break;
    (now > 1 ? least : most) = bound;
    // The number falls about as the bound grows.
    bound *= now;
    if (!(bound > least && bound < most)) {
      bound = most == kMostVoxels && now > 1 ? kMostVoxels : std::sqrt(least * most);
    }
  }
  return found;
}

}  // namespace

TriMesh InterfaceMesh::mesh_of(BodyId body) const {
  std::vector<InterfaceFacet> own;
  for (InterfaceFacet f : facets) {
    if (f.bodies[0] != body && f.bodies[1] != body) continue;
    if (f.bodies[0] == body) std::swap(f.v[1], f.v[2]);
    own.push_back(f);
  }
  std::vector<Vec3> used;
  IdArray<VertexId, VertexId> known(points.size(), kNoId);
  for (const VertexId v : number_vertices(own, known)) used.push_back(points[v]);
  std::vector<Triangle> triangles;
  triangles.reserve(own.size());
  for (const InterfaceFacet& f : own) triangles.push_back(f.v);
  return make_tri_mesh(std::move(used), triangles);
}

InterfaceMesh mesh_interfaces(const Partition& partition, const Options& options, Report& report) {
  const StepTimer total(report.seconds_total);
  require_limits(options, partition.shape());
  if (options.has_target()) return mesh_near_count(partition, options, report);
  return Builder(partition, options, report).run();
}

}  // namespace deliso
