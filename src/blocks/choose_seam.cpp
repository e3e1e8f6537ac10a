// SPDX-License-Identifier: MIT
#include "blocks/choose_seam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "base/sorted_list.h"
#include "blocks/seam.h"

namespace deliso {
namespace {

// Bounds on a chord: its distance from the curve, as a share of D (without D, in voxels) and of its
// length; and its length.
constexpr double kMaxShareOfD = 0.5, kMaxDistanceVoxels = 0.05, kMaxShareOfLength = 0.25;
constexpr double kMaxChordVoxels = 3;
// A curve of at most this many crossings keeps them all. It bounds a component so thin that a chord
// could reverse it.
constexpr std::size_t kMaxShortCurve = 8;
// The least distance of two chords, in voxels, and the largest cosine between two with a common
// end.
constexpr double kMinGapVoxels = 1e-3, kMaxCosine = 0.9;

// A curve on one face, by the crossings of grid edges.
struct Run {
  std::uint32_t loop;
  std::vector<std::size_t> points;  // numbers in the loop; a closed run ends with its first
  bool closed;
};

struct Chord {
  std::uint32_t run;
  std::size_t from, to;  // places in its points
};

class FaceSeam {
 public:
  FaceSeam(const Volume& volume, const Parameters& parameters, std::vector<BoundaryLoop>& loops,
           int face)
      : loops_(loops),
        volume_(volume),
        face_(face),
        u_((face / 2 + 1) % 3),
        v_((face / 2 + 2) % 3),
        voxel_(parameters.voxel),
        near_(std::isfinite(parameters.refinement[Criterion::distance])
                  ? kMaxShareOfD * parameters.refinement[Criterion::distance]
                  : kMaxDistanceVoxels * parameters.voxel) {}

  void choose() {
    for (std::uint32_t l = 0; l < loops_.size(); ++l) collect_runs(l);
    for (std::uint32_t r = 0; r < runs_.size(); ++r) lay_chords(r);
    while (halve_near_chords()) {
    }
    for (const Chord& chord : chords_) {
      const Run& run = runs_[chord.run];
      for (const std::size_t at : {chord.from, chord.to}) {
        loops_[run.loop].kept[run.points[at]] = 1;
      }
    }
  }

 private:
  const Vec3& point(std::uint32_t run, std::size_t at) const {
    return loops_[runs_[run].loop].points[runs_[run].points[at]];
  }

  void collect_runs(std::uint32_t l) {
    const BoundaryLoop& loop = loops_[l];
    const std::size_t n = loop.points.size();
    std::size_t begin = 0;  // a point where an arc of this face follows one of another
    while (begin < n && (loop.faces[begin] != face_ || loop.faces[(begin + n - 1) % n] == face_)) {
      ++begin;
    }
    if (begin == n) {
      if (n > 0 && loop.faces[0] == face_) add_run(l, 0, n, true);
      return;
    }
    for (std::size_t i = begin; i < begin + n;) {
      std::size_t end = i;
      while (end < begin + n && loop.faces[end % n] == face_) ++end;
      if (end > i) add_run(l, i, end, false);
      i = std::max(end, i + 1);
    }
  }

  // Adds points number `begin` to `end` of the loop, counted on past its end.
  void add_run(std::uint32_t l, std::size_t begin, std::size_t end, bool closed) {
    const BoundaryLoop& loop = loops_[l];
    Run run{l, {}, closed};
    std::vector<GridEdge> edges;
    for (std::size_t i = begin; i < end + !closed; ++i) {
      const std::size_t at = i % loop.points.size();
      const auto edge = grid_edge_at(loop.points[at], volume_);
      if (!edge) continue;
      run.points.push_back(at);
      edges.push_back(*edge);
    }
    // In the order seen from one side of the face.
    if (face_ % 2 == 0) {
      std::reverse(run.points.begin(), run.points.end());
      std::reverse(edges.begin(), edges.end());
    }
    if (closed && !edges.empty()) {
      const auto first = std::min_element(edges.begin(), edges.end()) - edges.begin();
      std::rotate(run.points.begin(), run.points.begin() + first, run.points.end());
      run.points.push_back(run.points.front());
    }
    runs_.push_back(std::move(run));
  }

  void lay_chords(std::uint32_t r) {
    const Run& run = runs_[r];
    if (run.points.size() < 2) return;
    const std::size_t last = run.points.size() - 1;
    std::vector<std::size_t> ends{0};
    if (run.closed) ends.insert(ends.end(), {last / 3, 2 * last / 3});
    ends.push_back(last);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) lay_chords(r, ends[k], ends[k + 1]);
  }

  void lay_chords(std::uint32_t r, std::size_t from, std::size_t end) {
    const bool is_short = runs_[r].points.size() <= kMaxShortCurve;
    while (from < end) {
      std::size_t to = from + 1;
      while (!is_short && to < end && is_near(r, from, to + 1)) ++to;
      chords_.push_back({r, from, to});
      from = to;
    }
  }

  // True if the curve from one point to the other stays near the chord.
  bool is_near(std::uint32_t r, std::size_t from, std::size_t to) const {
    const Vec3 &a = point(r, from), &b = point(r, to);
    const double length = distance(a, b);
    if (length > kMaxChordVoxels * voxel_) return false;
    const double limit = std::min(near_, kMaxShareOfLength * length);
    for (std::size_t at = from + 1; at < to; ++at) {
      if (distance2_to_chord(point(r, at), a, b) > limit * limit) return false;
    }
    return true;
  }

  // True if a chord runs along a side of the face, and so nearly in the next face too.
  bool runs_along_side(const Chord& c) const {
    const Vec3 &a = point(c.run, c.from), &b = point(c.run, c.to);
    const Box3 box = volume_.box();
    const double apart = kMinGapVoxels * voxel_;
    const auto both_near = [&](int axis, double side) {
      return std::fabs(a[axis] - side) < apart && std::fabs(b[axis] - side) < apart;
    };
    return both_near(u_, box.lo[u_]) || both_near(u_, box.hi[u_]) || both_near(v_, box.lo[v_]) ||
           both_near(v_, box.hi[v_]);
  }

  // Halves all chords that come near another one, or a side. Returns whether there were any.
  bool halve_near_chords() {
    std::vector<std::uint8_t> must_halve;
    for (const Chord& chord : chords_) must_halve.push_back(runs_along_side(chord));
    for (const auto& [c, d] : neighbors()) {
      if (!are_near(chords_[c], chords_[d])) continue;
      must_halve[c] = must_halve[d] = 1;
    }
    bool any = false;
    const std::size_t before = chords_.size();
    for (std::size_t c = 0; c < before; ++c) {
      const auto [run, from, to] = chords_[c];
      if (!must_halve[c] || to == from + 1) continue;
      const std::size_t middle = (from + to) / 2;
      chords_[c] = {run, from, middle};
      chords_.push_back({run, middle, to});
      any = true;
    }
    return any;
  }

  // Returns pairs of chords with a common voxel of the face, of which one can be halved.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbors() const {
    struct Place {
      std::int64_t u, v;
      std::uint32_t chord;
    };
    std::vector<Place> places;
    for (std::uint32_t c = 0; c < chords_.size(); ++c) {
      const Vec3 &a = point(chords_[c].run, chords_[c].from),
                 &b = point(chords_[c].run, chords_[c].to);
      const auto range = [&](int axis) {
        const double spacing = volume_.spacing()[axis];
        const auto [low, high] = std::minmax({a[axis], b[axis]});
        const double apart = kMinGapVoxels * voxel_;
        return std::pair(static_cast<std::int64_t>(std::floor((low - apart) / spacing)),
                         static_cast<std::int64_t>(std::floor((high + apart) / spacing)));
      };
      const auto in_u = range(u_), in_v = range(v_);
      for (std::int64_t i = in_u.first; i <= in_u.second; ++i) {
        for (std::int64_t j = in_v.first; j <= in_v.second; ++j) places.push_back({i, j, c});
      }
    }
    std::ranges::sort(places, {}, [](const Place& p) { return std::tuple(p.u, p.v, p.chord); });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    const auto can_halve = [&](std::uint32_t c) { return chords_[c].to > chords_[c].from + 1; };
    for (std::size_t i = 0, end = 0; i < places.size(); i = end) {
      while (end < places.size() && places[end].u == places[i].u && places[end].v == places[i].v) {
        ++end;
      }
      for (std::size_t a = i; a < end; ++a) {
        for (std::size_t b = a + 1; b < end; ++b) {
          const std::uint32_t c = places[a].chord, d = places[b].chord;
          if (can_halve(c) || can_halve(d)) pairs.emplace_back(c, d);
        }
      }
    }
    sort_unique(pairs);
    return pairs;
  }

  // True if two chords come near each other; the same for both orders, to the last bit.
  bool are_near(const Chord& c, const Chord& d) const {
    const std::array<Vec3, 2> p{point(c.run, c.from), point(c.run, c.to)};
    const std::array<Vec3, 2> q{point(d.run, d.from), point(d.run, d.to)};
    for (const std::size_t i : {0u, 1u}) {
      for (const std::size_t j : {0u, 1u}) {
        if (p[i] != q[j]) continue;
        const Vec3 s = p[1 - i] - p[i], t = q[1 - j] - q[j];
        return dot(s, t) > kMaxCosine * std::sqrt(length2(s) * length2(t));
      }
    }
    const double apart = kMinGapVoxels * voxel_;
    for (const int axis : {u_, v_}) {
      const auto [p_low, p_high] = std::minmax({p[0][axis], p[1][axis]});
      const auto [q_low, q_high] = std::minmax({q[0][axis], q[1][axis]});
      if (p_high + apart < q_low || q_high + apart < p_low) return false;
    }
    return !is_on_one_side(p, q, apart) && !is_on_one_side(q, p, apart);
  }

  // True if q lies on one side of the line through p, at least `apart` from it.
  bool is_on_one_side(const std::array<Vec3, 2>& p, const std::array<Vec3, 2>& q,
                      double apart) const {
    const Vec3 along = p[1] - p[0];
    const auto side = [&](const Vec3& x) {
      return along[u_] * (x[v_] - p[0][v_]) - along[v_] * (x[u_] - p[0][u_]);
    };
    const double off = apart * length(along);
    return (side(q[0]) > off && side(q[1]) > off) || (side(q[0]) < -off && side(q[1]) < -off);
  }

  std::vector<BoundaryLoop>& loops_;
  const Volume& volume_;
  int face_, u_, v_;  // the face, and the axes in it
  double voxel_, near_;
  std::vector<Run> runs_;
  std::vector<Chord> chords_;
};

// Marks the points of seams as kept, and no others on inner faces.
void choose_seams(const Volume& volume, const Parameters& parameters,
                  std::vector<BoundaryLoop>& loops) {
  for (int face = 0; face < 6; ++face) {
    if ((volume.inner_faces() >> face & 1) != 0) FaceSeam(volume, parameters, loops, face).choose();
  }
}

}  // namespace

BoundaryCurves boundary_curves(const Isosurface& surface, const ContourMesh& contour,
                               const Parameters& parameters) {
  const BoundaryChains& chains = contour.boundary;
  std::vector<BoundaryLoop> loops(chains.size());
  for (std::size_t c = 0; c < loops.size(); ++c) {
    for (std::uint32_t k = chains.first[c]; k < chains.first[c + 1]; ++k) {
      loops[c].points.push_back(contour.points[chains.vertices[k]]);
      loops[c].kept.push_back(chains.on_box_edge[k]);
      loops[c].faces.push_back(chains.face[k]);
    }
  }
  choose_seams(surface.volume(), parameters, loops);
  return {surface, std::move(loops)};
}

}  // namespace deliso
