// SPDX-License-Identifier: MIT
#include "blocks/weld.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/memory.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

// Memory goes back to the system after so many facets, about 64 MB of blocks: it costs time.
constexpr std::size_t kFacetsGivenBack = 1 << 18;

// Parts that a process reads may be forged.
void require_fit(bool condition) {
  if (!condition) throw InputError("the boundary curves of the parts do not fit together");
}

// A part of a block's loop outside the seams that are welded: its arcs from point `first` on,
// counted on past the loop's end.
struct OuterRun {
  std::uint32_t block, loop;
  std::size_t first, arcs;
  std::uint32_t whole = kNoId;  // the loop of the whole, and the place of its first point there
  double place = 0;
};

// Returns the voxel on the other side of the block's inner face that has arc i of the loop.
Index3 voxel_beyond(const Block& block, const BoundaryLoop& loop, std::size_t i,
                    const Grid& shape) {
  const Vec3 middle = 0.5 * (loop[i].point + loop[(i + 1) % loop.size()].point);
  const BoxFace face = loop[i].face;
  Index3 voxel;
  for (int axis = 0; axis < 3; ++axis) {
    voxel[axis] = std::clamp(static_cast<int>(shape.in_all_samples(middle, axis)),
                             block.box.begin[axis], block.box.end[axis] - 1);
  }
  const int across = axis_of(face);
  voxel[across] = (face & 1) != 0 ? block.box.end[across] : block.box.begin[across] - 1;
  return voxel;
}

std::vector<OuterRun> outer_runs(const std::vector<Block>& blocks, const Grid& shape,
                                 const IsElsewhere& is_elsewhere) {
  std::vector<OuterRun> runs;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    if (!blocks[b].loops) continue;
    const BoundaryLoops& loops = *blocks[b].loops;
    for (std::uint32_t l = 0; l < loops.size(); ++l) {
      // Per arc: nonzero if it lies on a seam that is welded.
      std::vector<std::uint8_t> welded;
      const std::size_t n = loops[l].size();
      const auto has_neighbor = [&](std::size_t i) {
        return !is_elsewhere || !is_elsewhere(voxel_beyond(blocks[b], loops[l], i, shape));
      };
      for (std::size_t i = 0; i < n; ++i) {
        welded.push_back(loops[l][i].is_fixed && has_neighbor(i));
      }
      if (std::ranges::find(welded, 1) == welded.end()) {
        runs.push_back({b, l, 0, n});
        continue;
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (welded[i] != 0 || welded[(i + n - 1) % n] == 0) continue;
        std::size_t end = i;
        while (welded[end % n] == 0) ++end;
        runs.push_back({b, l, i, end - i});
      }
    }
  }
  return runs;
}

class Welder {
 public:
  Welder(std::vector<Block>& blocks, const Grid& shape, const IsElsewhere& is_elsewhere)
      : blocks_(blocks), runs_(outer_runs(blocks, shape, is_elsewhere)) {}

  Block weld() {
    join_loops();
    number_vertices();
    std::vector<std::vector<std::pair<double, VertexId>>> chains(loops_.size());
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      collect_chain(b, chains);
      blocks_[b].mesh.chain = {};
    }
    move_meshes();
    link_seams();
    for (std::uint32_t l = 0; l < chains.size(); ++l) {
      std::ranges::sort(chains[l]);
      std::vector<VertexId> vertices;
      std::vector<CurvePlace> places;
      for (const auto& [s, v] : chains[l]) {
        vertices.push_back(v);
        places.push_back({l, s});
      }
      out_.mesh.chain.add_loop(vertices, places);
    }
    out_.loops = std::make_shared<const BoundaryLoops>(std::move(loops_));
    return std::move(out_);
  }

 private:
  struct HalfEdge {
    VertexId low, high;
    FaceId face;
    int index;
  };

  const BoundaryLoop& loop(const OuterRun& run) const {
    return (*blocks_[run.block].loops)[run.loop];
  }
  const Vec3& point(const OuterRun& run, std::size_t at) const {
    const BoundaryLoop& own = loop(run);
    return own[(run.first + at) % own.size()].point;
  }

  // Joins runs where one begins at the end of another. A place has at most one run that begins
  // there: the box's faces have no vertex on the planes between four blocks but at samples.
  void join_loops() {
    std::map<std::tuple<double, double, double>, std::size_t> begins;
    for (std::size_t r = 0; r < runs_.size(); ++r) begins[by_place(point(runs_[r], 0))] = r;
    require_fit(begins.size() == runs_.size());
    for (std::size_t start = 0; start < runs_.size(); ++start) {
      if (runs_[start].whole != kNoId) continue;
      const auto number = static_cast<std::uint32_t>(loops_.size());
      BoundaryLoop& whole = loops_.emplace_back();
      for (std::size_t r = start; runs_[r].whole == kNoId;) {
        OuterRun& run = runs_[r];
        run.whole = number;
        run.place = static_cast<double>(whole.size());
        const BoundaryLoop& own = loop(run);
        for (std::size_t i = 0; i < run.arcs; ++i) {
          whole.push_back(own[(run.first + i) % own.size()]);
        }
        const auto next = begins.find(by_place(point(run, run.arcs)));
        require_fit(next != begins.end());
        r = next->second;
      }
      // What was kept for a seam that is welded is so no more.
      const std::size_t n = whole.size();
      for (std::size_t i = 0; i < n; ++i) {
        LoopPoint &at = whole[i], &before = whole[(i + n - 1) % n];
        if (!at.is_fixed && !before.is_fixed) at.is_kept = at.face != before.face;
      }
    }
  }

  // Numbers the vertices of all blocks in order. Vertices at one place of a seam have one number.
  void number_vertices() {
    std::vector<Vec3> places;  // of the vertices on seams
    std::vector<std::pair<std::uint32_t, VertexId>> seam;
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      const SurfaceMesh& s = blocks_[b].mesh;
      new_id_.emplace_back(s.mesh.points.size(), kNoId);
      for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
        if (!is_on_seam(blocks_[b], v)) continue;
        places.push_back(s.mesh.points[v]);
        seam.emplace_back(b, v);
      }
    }
    const auto new_id = [&](std::size_t n) -> VertexId& {
      return new_id_[seam[n].first][seam[n].second];
    };
    // The first at a place keeps its own number; the others get it when all are known.
    const std::vector<VertexId> first = first_at_place(places);
    for (std::size_t n = 0; n < seam.size(); ++n) {
      if (first[n] != n) new_id(n) = kShared;
    }
    std::size_t count = 0;
    for (IdArray<VertexId, VertexId>& ids : new_id_) {
      for (VertexId& id : ids) {
        if (id == kNoId) id = VertexId(count++);
      }
    }
    on_seam_.resize(count, 0);
    for (std::size_t n = 0; n < seam.size(); ++n) {
      new_id(n) = new_id(first[n]);
      on_seam_[new_id(n)] = 1;
    }
    vertices_ = count;
  }

  void collect_chain(std::uint32_t b, std::vector<std::vector<std::pair<double, VertexId>>>& to) {
    const BoundaryChain& chain = blocks_[b].mesh.chain;
    const auto loop_of = [](const OuterRun& run) { return std::pair(run.block, run.loop); };
    for (VertexId v = 0; v < chain.vertex_capacity(); ++v) {
      if (!chain.is_boundary(v)) continue;
      const CurvePlace place = chain.place(v);
      const auto n = static_cast<double>((*blocks_[b].loops)[place.loop].size());
      for (auto run = std::ranges::lower_bound(runs_, std::pair(b, place.loop), {}, loop_of);
           run != runs_.end() && loop_of(*run) == std::pair(b, place.loop); ++run) {
        double along = place.s - static_cast<double>(run->first);
        if (along < 0) along += n;
        if (along >= static_cast<double>(run->arcs)) continue;
        to[run->whole].emplace_back(run->place + along, new_id_[b][v]);
      }
    }
  }

  // Moves the blocks' meshes to the whole, block by block, so that only one at a time exists twice.
  // Refine at the seams finds some room.
  void move_meshes() {
    SurfaceMesh& whole = out_.mesh;
    whole.mesh.points.reserve(with_room(vertices_));
    whole.mesh.points.resize(vertices_);
    out_.may_thin.resize(vertices_, 0);
    std::size_t facets = 0;
    for (const Block& block : blocks_) facets += block.mesh.mesh.faces.size();
    whole.mesh.faces.reserve(with_room(facets));
    whole.duals.reserve(with_room(facets));
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      const std::size_t before = whole.mesh.faces.size() / kFacetsGivenBack;
      Block block = std::move(blocks_[b]);
      const IdArray<VertexId, VertexId> id = std::move(new_id_[b]);
      const auto& points = block.mesh.mesh.points;
      for (VertexId v = 0; v < points.size(); ++v) {
        whole.mesh.points[id[v]] = points[v];
        out_.may_thin[id[v]] |= block.may_thin[v];
      }
      append_facets(block.mesh.mesh.faces, id);
      whole.duals.insert(whole.duals.end(), block.mesh.duals.begin(), block.mesh.duals.end());
      append_seam_work(block);
      block = {};
      if (whole.mesh.faces.size() / kFacetsGivenBack > before) give_back_freed_memory();
    }
  }

  static std::size_t with_room(std::size_t size) { return size + size / 16; }

  // Moves the block's facets to the whole. Collects their sides that two vertices of seams have.
  void append_facets(const IdArray<FaceId, Face>& faces, const IdArray<VertexId, VertexId>& id) {
    IdArray<FaceId, Face>& whole = out_.mesh.mesh.faces;
    const std::size_t first = whole.size();
    for (Face face : faces) {
      const FaceId f(whole.size());
      for (int i = 0; i < 3; ++i) {
        face.v[i] = id[face.v[i]];
        if (face.n[i] != kNoId) face.n[i] = FaceId(first + face.n[i]);
      }
      for (int i = 0; i < 3; ++i) {
        const VertexId p = face.v[(i + 1) % 3], q = face.v[(i + 2) % 3];
        if (face.n[i] != kNoId || !on_seam_[p] || !on_seam_[q]) continue;
        edges_.push_back({std::min(p, q), std::max(p, q), f, i});
      }
      whole.push_back(face);
    }
  }

  // Moves what is left to do, in the order of facets, and what is known of the block.
  void append_seam_work(Block& block) {
    const auto append = [](auto& from, auto& to) {
      to.insert(to.end(), std::move_iterator(from.begin()), std::move_iterator(from.end()));
    };
    append(block.samples_near_seams, out_.samples_near_seams);
    append(block.samples, out_.samples);
    append(block.is_open, out_.is_open);
    append(block.components, out_.components);
    out_.report.add(block.report);
  }

  // An edge between two vertices of seams may also be one of the box.
  void link_seams() {
    std::ranges::sort(edges_, {},
                      [](const HalfEdge& e) { return std::tuple(e.low, e.high, e.face); });
    IdArray<FaceId, Face>& faces = out_.mesh.mesh.faces;
    for (std::size_t n = 1; n < edges_.size(); ++n) {
      const HalfEdge &e = edges_[n - 1], &g = edges_[n];
      if (e.low != g.low || e.high != g.high) continue;
      faces[e.face].n[e.index] = g.face;
      faces[g.face].n[g.index] = e.face;
    }
  }

  static constexpr VertexId kShared{0xfffffffeu};

  std::vector<Block>& blocks_;
  std::vector<OuterRun> runs_;
  BoundaryLoops loops_;
  std::vector<IdArray<VertexId, VertexId>> new_id_;
  std::size_t vertices_ = 0;  // of the whole
  std::vector<HalfEdge> edges_;
  IdArray<VertexId, std::uint8_t> on_seam_;
  Block out_;
};

}  // namespace

Block weld(std::vector<Block>& blocks, const Grid& shape, const IsElsewhere& is_elsewhere) {
  if (blocks.size() == 1) {
    if (!blocks[0].loops) blocks[0].loops = std::make_shared<const BoundaryLoops>();
    return std::move(blocks[0]);
  }
  return Welder(blocks, shape, is_elsewhere).weld();
}

}  // namespace deliso
