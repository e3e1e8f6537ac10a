// SPDX-License-Identifier: MIT
#include "blocks/choose_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "base/sorted_list.h"
#include "blocks/seam.h"

namespace deliso {
namespace {

constexpr std::size_t kCrossingsPerChord = 2;
// A curve of at most this many crossings keeps them all. It bounds a component so thin that a chord
// could reverse it.
constexpr std::size_t kMaxShortCurve = 8;
// The least distance of two chords, in voxels, and the largest cosine between two with a common
// end.
constexpr double kMinGapVoxels = 1e-3, kMaxCosine = 0.9;

// A curve in one rectangle, by the crossings of grid edges.
struct Run {
  std::uint32_t loop;
  std::vector<std::size_t> points;  // numbers in the loop; a closed run ends with its first
  bool closed;
};

struct Chord {
  std::uint32_t run;
  std::size_t from, to;  // places in its points
};

// A rectangle of a face between planes of the grid: its sides along the axes u and v.
struct Rectangle {
  int u, v;
  std::array<double, 2> u_sides, v_sides;
};

class RectangleSeam {
 public:
  RectangleSeam(const Volume& volume, const Rectangle& rectangle, std::vector<Run> runs,
                BoundaryLoops& loops)
      : loops_(loops),
        volume_(volume),
        rectangle_(rectangle),
        u_(rectangle.u),
        v_(rectangle.v),
        voxel_(volume.voxel()),
        runs_(std::move(runs)) {}

  void choose() {
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

  void lay_chords(std::uint32_t r) {
    const std::size_t count = runs_[r].points.size();
    const std::size_t step = count <= kMaxShortCurve ? 1 : kCrossingsPerChord;
    for (std::size_t from = 0; from + 1 < count; from += step) {
      chords_.push_back({r, from, std::min(from + step, count - 1)});
    }
  }

  // True if a chord runs along a side of the rectangle, and so nearly in the next one too.
  bool runs_along_side(const Chord& c) const {
    const Vec3 &a = point(c.run, c.from), &b = point(c.run, c.to);
    const double apart = kMinGapVoxels * voxel_;
    const auto both_near = [&](int axis, double side) {
      return std::fabs(a[axis] - side) < apart && std::fabs(b[axis] - side) < apart;
    };
    return both_near(u_, rectangle_.u_sides[0]) || both_near(u_, rectangle_.u_sides[1]) ||
           both_near(v_, rectangle_.v_sides[0]) || both_near(v_, rectangle_.v_sides[1]);
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

  BoundaryLoops& loops_;
  const Volume& volume_;
  const Rectangle& rectangle_;
  int u_, v_;
  double voxel_;
  std::vector<Run> runs_;
  std::vector<Chord> chords_;
};

// The runs of one inner face, by the numbers of their rectangles along u and v.
class FaceRuns {
 public:
  FaceRuns(const Volume& volume, const BlockGrid& grid, BoundaryLoops& loops, BoxFace face)
      : volume_(volume),
        loops_(loops),
        face_(face),
        u_((axis_of(face) + 1) % 3),
        v_((axis_of(face) + 2) % 3),
        u_lines_(lines(grid, u_)),
        v_lines_(lines(grid, v_)) {
    for (std::uint32_t l = 0; l < loops_.size(); ++l) collect(l);
  }

  void choose() {
    for (auto& [number, runs] : runs_) {
      const auto [u, v] = number;
      const Rectangle rectangle{
          u_, v_, {u_lines_[u], u_lines_[u + 1]}, {v_lines_[v], v_lines_[v + 1]}};
      RectangleSeam(volume_, rectangle, std::move(runs), loops_).choose();
    }
  }

 private:
  using Lines = std::vector<double>;

  // Returns the coordinates of the block's sides and of the planes between them.
  Lines lines(const BlockGrid& grid, int axis) const {
    Lines lines;
    const int first = volume_.first()[axis], last = first + volume_.voxels()[axis];
    lines.push_back(volume_.box().lo[axis]);
    for (const int plane : grid.planes[axis]) {
      if (first < plane && plane < last) lines.push_back(plane * volume_.spacing()[axis]);
    }
    lines.push_back(volume_.box().hi[axis]);
    return lines;
  }

  static bool is_line(const Lines& lines, double at) {
    return std::ranges::binary_search(lines, at);
  }

  // True if a run begins at point i of the loop: the curve comes from another face or rectangle.
  bool begins_run(const BoundaryLoop& loop, std::size_t i) const {
    const std::size_t n = loop.points.size();
    return loop.faces[(i + n - 1) % n] != face_ || is_line(u_lines_, loop.points[i][u_]) ||
           is_line(v_lines_, loop.points[i][v_]);
  }

  void collect(std::uint32_t l) {
    BoundaryLoop& loop = loops_[l];
    const std::size_t n = loop.points.size();
    for (std::size_t i = 0; i < n; ++i) loop.fixed[i] |= loop.faces[i] == face_;
    std::size_t begin = 0;
    while (begin < n && !(loop.faces[begin] == face_ && begins_run(loop, begin))) ++begin;
    if (begin == n) {
      if (n > 0 && loop.faces[0] == face_) add_run(l, 0, n, true);
      return;
    }
    for (std::size_t i = begin; i < begin + n;) {
      if (loop.faces[i % n] != face_) {
        ++i;
        continue;
      }
      std::size_t end = i + 1;
      while (end < begin + n && loop.faces[end % n] == face_ && !begins_run(loop, end % n)) ++end;
      add_run(l, i, end, false);
      i = end;
    }
  }

  // Adds points number `begin` to `end` of the loop, counted on past its end.
  void add_run(std::uint32_t l, std::size_t begin, std::size_t end, bool closed) {
    const BoundaryLoop& loop = loops_[l];
    const std::size_t n = loop.points.size();
    Run run{l, {}, closed};
    std::vector<GridEdge> edges;
    for (std::size_t i = begin; i < end + !closed; ++i) {
      const auto edge = grid_edge_at(loop.points[i % n], volume_);
      if (!edge) continue;
      run.points.push_back(i % n);
      edges.push_back(*edge);
    }
    // In the order seen from one side of the face.
    if (face_ % 2 == 0) {
      std::reverse(run.points.begin(), run.points.end());
      std::reverse(edges.begin(), edges.end());
    }
    if (closed && !edges.empty()) {
      const auto first = std::ranges::min_element(edges, {}, &GridEdge::key) - edges.begin();
      std::rotate(run.points.begin(), run.points.begin() + first, run.points.end());
      run.points.push_back(run.points.front());
    }
    const Vec3 middle = 0.5 * (loop.points[begin % n] + loop.points[(begin + 1) % n]);
    const auto number = [&](const Lines& lines, int axis) {
      return static_cast<std::size_t>(
          std::upper_bound(lines.begin() + 1, lines.end() - 1, middle[axis]) - lines.begin() - 1);
    };
    runs_[{number(u_lines_, u_), number(v_lines_, v_)}].push_back(std::move(run));
  }

  const Volume& volume_;
  BoundaryLoops& loops_;
  BoxFace face_;
  int u_, v_;
  Lines u_lines_, v_lines_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Run>> runs_;
};

}  // namespace

void choose_seams(const Volume& block, const BlockGrid& grid, BoundaryLoops& loops) {
  for (BoxFace face = 0; face < 6; ++face) {
    if ((block.inner_faces() >> face & 1) != 0) FaceRuns(block, grid, loops, face).choose();
  }
}

}  // namespace deliso
