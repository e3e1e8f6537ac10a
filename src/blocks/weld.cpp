// SPDX-License-Identifier: MIT
#include "blocks/weld.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "base/check.h"

namespace deliso {
namespace {

// A part of a block's loop outside the seams: its arcs from point `first` on, counted on past the
// loop's end.
struct OuterRun {
  std::uint32_t block, loop;
  std::size_t first, arcs;
  std::uint32_t whole = kNoId;  // the loop of the whole, and the place of its first point there
  double place = 0;
};

std::vector<OuterRun> outer_runs(const std::vector<Block>& blocks) {
  std::vector<OuterRun> runs;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    if (!blocks[b].loops) continue;
    const BoundaryLoops& loops = *blocks[b].loops;
    for (std::uint32_t l = 0; l < loops.size(); ++l) {
      const std::vector<std::uint8_t>& fixed = loops[l].fixed;
      const std::size_t n = fixed.size();
      if (std::ranges::find(fixed, 1) == fixed.end()) {
        runs.push_back({b, l, 0, n});
        continue;
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (fixed[i] != 0 || fixed[(i + n - 1) % n] == 0) continue;
        std::size_t end = i;
        while (fixed[end % n] == 0) ++end;
        runs.push_back({b, l, i, end - i});
      }
    }
  }
  return runs;
}

class Welder {
 public:
  explicit Welder(std::vector<Block>& blocks) : blocks_(blocks), runs_(outer_runs(blocks)) {}

  WeldedMesh weld() {
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
    const std::vector<Vec3>& points = loop(run).points;
    return points[(run.first + at) % points.size()];
  }

  // Joins runs where one begins at the end of another. A place has at most one run that begins
  // there: the box's faces have no vertex on the planes between four blocks but at samples.
  void join_loops() {
    std::map<std::tuple<double, double, double>, std::size_t> begins;
    for (std::size_t r = 0; r < runs_.size(); ++r) begins[by_place(point(runs_[r], 0))] = r;
    DELISO_CHECK(begins.size() == runs_.size());
    for (std::size_t start = 0; start < runs_.size(); ++start) {
      if (runs_[start].whole != kNoId) continue;
      const auto number = static_cast<std::uint32_t>(loops_.size());
      BoundaryLoop& whole = loops_.emplace_back();
      for (std::size_t r = start; runs_[r].whole == kNoId;) {
        OuterRun& run = runs_[r];
        run.whole = number;
        run.place = static_cast<double>(whole.points.size());
        const std::vector<BoxFace>& faces = loop(run).faces;
        for (std::size_t i = 0; i < run.arcs; ++i) {
          whole.points.push_back(point(run, i));
          whole.faces.push_back(faces[(run.first + i) % faces.size()]);
        }
        const auto next = begins.find(by_place(point(run, run.arcs)));
        DELISO_CHECK(next != begins.end());
        r = next->second;
      }
      const std::size_t n = whole.points.size();
      whole.fixed.resize(n, 0);
      for (std::size_t i = 0; i < n; ++i) {
        whole.kept.push_back(whole.faces[i] != whole.faces[(i + n - 1) % n]);
      }
    }
  }

  bool is_on_seam(const Block& block, VertexId v) const {
    if (!block.mesh.chain.is_boundary(v)) return false;
    const auto [number, s] = block.mesh.chain.place(v);
    const std::vector<std::uint8_t>& fixed = (*block.loops)[number].fixed;
    const auto at = static_cast<std::size_t>(s);
    if (fixed[at] != 0) return true;
    return s == static_cast<double>(at) && fixed[(at + fixed.size() - 1) % fixed.size()] != 0;
  }

  // Numbers the vertices of all blocks in order. Vertices at one place of a seam have one number.
  void number_vertices() {
    struct SeamPoint {
      Vec3 at;
      std::uint32_t block;
      VertexId vertex;
    };
    std::vector<SeamPoint> seam;
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      const SurfaceMesh& s = blocks_[b].mesh;
      new_id_.emplace_back(s.mesh.points.size(), kNoId);
      for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
        if (is_on_seam(blocks_[b], v)) seam.push_back({s.mesh.points[v], b, v});
      }
    }
    std::ranges::sort(seam, {}, [](const SeamPoint& p) {
      return std::tuple(by_place(p.at), p.block, p.vertex.number());
    });
    // The first at a place keeps its own number; the others get it when all are known.
    std::vector<std::size_t> first(seam.size());
    for (std::size_t n = 0; n < seam.size(); ++n) {
      first[n] = n > 0 && seam[n].at == seam[n - 1].at ? first[n - 1] : n;
      if (first[n] != n) new_id_[seam[n].block][seam[n].vertex] = kShared;
    }
    std::size_t count = 0;
    for (IdArray<VertexId, VertexId>& ids : new_id_) {
      for (VertexId& id : ids) {
        if (id == kNoId) id = VertexId(count++);
      }
    }
    out_.on_seam.resize(count, 0);
    for (std::size_t n = 0; n < seam.size(); ++n) {
      const VertexId id = new_id_[seam[first[n]].block][seam[first[n]].vertex];
      new_id_[seam[n].block][seam[n].vertex] = id;
      out_.on_seam[id] = 1;
    }
    vertices_ = count;
  }

  void collect_chain(std::uint32_t b, std::vector<std::vector<std::pair<double, VertexId>>>& to) {
    const BoundaryChain& chain = blocks_[b].mesh.chain;
    const auto loop_of = [](const OuterRun& run) { return std::pair(run.block, run.loop); };
    for (VertexId v = 0; v < chain.vertex_capacity(); ++v) {
      if (!chain.is_boundary(v)) continue;
      const CurvePlace place = chain.place(v);
      const auto n = static_cast<double>((*blocks_[b].loops)[place.loop].points.size());
      for (auto run = std::ranges::lower_bound(runs_, std::pair(b, place.loop), {}, loop_of);
           run != runs_.end() && loop_of(*run) == std::pair(b, place.loop); ++run) {
        double along = place.s - static_cast<double>(run->first);
        if (along < 0) along += n;
        if (along >= static_cast<double>(run->arcs)) continue;
        to[run->whole].emplace_back(run->place + along, new_id_[b][v]);
      }
    }
  }

  // Moves the blocks' meshes to the whole, one array after the other, so that only one at a time
  // exists twice. Refine at the seams finds some room.
  void move_meshes() {
    SurfaceMesh& whole = out_.mesh;
    whole.mesh.points.reserve(with_room(vertices_));
    whole.mesh.points.resize(vertices_);
    std::size_t facets = 0;
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      IdArray<VertexId, Vec3> points = std::move(blocks_[b].mesh.mesh.points);
      for (VertexId v = 0; v < points.size(); ++v) whole.mesh.points[new_id_[b][v]] = points[v];
      facets += blocks_[b].mesh.mesh.faces.size();
    }
    whole.mesh.faces.reserve(with_room(facets));
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) append_faces(b);
    whole.duals.reserve(with_room(facets));
    for (Block& block : blocks_) {
      const IdArray<FaceId, Dual> duals = std::move(block.mesh.duals);
      whole.duals.insert(whole.duals.end(), duals.begin(), duals.end());
    }
  }

  static std::size_t with_room(std::size_t size) { return size + size / 16; }

  void append_faces(std::uint32_t b) {
    const IdArray<FaceId, Face> faces = std::move(blocks_[b].mesh.mesh.faces);
    const IdArray<VertexId, VertexId>& id = new_id_[b];
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
        if (face.n[i] != kNoId || !out_.on_seam[p] || !out_.on_seam[q]) continue;
        edges_.push_back({std::min(p, q), std::max(p, q), f, i});
      }
      whole.push_back(face);
    }
    const auto take = [](std::vector<Vec3>& from, std::vector<Vec3>& to) {
      to.insert(to.end(), from.begin(), from.end());
      std::vector<Vec3>().swap(from);
    };
    take(blocks_[b].samples_near_seams, out_.samples_near_seams);
    take(blocks_[b].samples, out_.samples);
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
  WeldedMesh out_;
};

}  // namespace

WeldedMesh weld(std::vector<Block>& blocks) {
  // One block may be a part of a larger volume: its seams stay, for other programs to weld.
  if (Block& only = blocks[0]; blocks.size() == 1) {
    IdArray<VertexId, std::uint8_t> on_seam(only.mesh.mesh.points.size(), 0);
    return {std::move(only.mesh), only.loops ? only.loops : std::make_shared<const BoundaryLoops>(),
            std::move(on_seam), std::move(only.samples_near_seams), std::move(only.samples)};
  }
  return Welder(blocks).weld();
}

}  // namespace deliso
