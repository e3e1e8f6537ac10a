// SPDX-License-Identifier: MIT
#include "contour/voxel_topology.h"

#include <algorithm>
#include <numeric>

// Keeps a function apart from its callers, whatever could be inferred of it.
#if __has_cpp_attribute(gnu::noipa)
#define DELISO_OPAQUE [[gnu::noipa]]
#else
#define DELISO_OPAQUE [[gnu::noinline]]
#endif

namespace deliso {
namespace {

// Corners of each face, counter-clockwise seen from outside the voxel.
constexpr int kFaceCorners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

constexpr int edge_between(int corner, int other) {
  const int low = std::min(corner, other);
  const int x = low & 1, y = low >> 1 & 1, z = low >> 2;
  switch (corner ^ other) {
    case 1:
      return y + 2 * z;
    case 2:
      return 4 + x + 2 * z;
    default:
      return 8 + x + 2 * y;
  }
}

constexpr bool is_inside(int mask, int corner) {
  return (mask >> corner & 1) != 0;
}

constexpr std::uint8_t find_ambiguous_faces(int mask) {
  int faces = 0;
  for (int f = 0; f < 6; ++f) {
    const auto& k = kFaceCorners[f];
    const bool a = is_inside(mask, k[0]), b = is_inside(mask, k[1]);
    if (a != b && a == is_inside(mask, k[2]) && b == is_inside(mask, k[3])) faces |= 1 << f;
  }
  return static_cast<std::uint8_t>(faces);
}

// Around a face, counter-clockwise, crossings alternate between entering and leaving the inside. A
// segment runs from an entering to a leaving one, with the inside on its right seen from outside
// the voxel. It runs to the next leaving one, which cuts off the inside corners between them. If
// the inside corners are joined, it runs to the leaving one before. The two faces of an edge pass
// it in opposite directions, so each crossing starts one segment and ends another.
constexpr VoxelLoops trace(int mask, std::uint8_t joined) {
  std::array<int, 12> next{}, face{};
  next.fill(-1);
  const std::uint8_t ambiguous = find_ambiguous_faces(mask);
  for (int f = 0; f < 6; ++f) {
    const auto& k = kFaceCorners[f];
    const bool reach_back = (ambiguous >> f & 1) != 0 && (joined >> f & 1) != 0;
    for (int s = 0; s < 4; ++s) {
      const int from = k[s], to = k[(s + 1) % 4];
      if (is_inside(mask, from) || !is_inside(mask, to)) continue;
      int leaving = s;
      do {
        leaving = (leaving + (reach_back ? 3 : 1)) % 4;
      } while (is_inside(mask, k[leaving]) == is_inside(mask, k[(leaving + 1) % 4]));
      const int e = edge_between(from, to);
      next[e] = edge_between(k[leaving], k[(leaving + 1) % 4]);
      face[e] = f;
    }
  }
  VoxelLoops loops;
  int size = 0;
  for (int start = 0; start < 12; ++start) {
    if (next[start] < 0) continue;
    for (int e = start; next[e] >= 0;) {
      loops.edge[size] = static_cast<std::uint8_t>(e);
      loops.face[size] = static_cast<std::uint8_t>(face[e]);
      ++size;
      const int following = next[e];
      next[e] = -1;
      e = following;
    }
    loops.first[++loops.count] = static_cast<std::uint8_t>(size);
  }
  return loops;
}

struct MaskTable {
  std::array<VoxelLoops, 256> loops;  // where no face is ambiguous
  std::array<std::uint8_t, 256> ambiguous;
};

constexpr MaskTable make_mask_table() {
  MaskTable table{};
  for (int mask = 0; mask < 256; ++mask) {
    table.ambiguous[mask] = find_ambiguous_faces(mask);
    table.loops[mask] = trace(mask, 0);
  }
  return table;
}

constexpr MaskTable kMasks = make_mask_table();

// The rule of the header comment for an ambiguous face. Both voxels at a face multiply the same
// values in the same order.
bool inside_corners_joined(int mask, const VoxelValues& v, int f) {
  const auto& k = kFaceCorners[f];
  const int a = std::min(k[0], k[2]), b = std::max(k[0], k[2]);
  const int p = std::min(k[1], k[3]), q = std::max(k[1], k[3]);
  const int corners = 1 << a | 1 << b | 1 << p | 1 << q;
  const int sign =
      sign_of(v, corners, [=](const auto& x) { return x.c(a) * x.c(b) - x.c(p) * x.c(q); });
  return is_inside(mask, a) ? sign >= 0 : sign <= 0;
}

// The plane swept along z. Columns are the edges along z, numbered as corners 0-3. A column's sign
// flips when the plane passes its crossing.
class Sweep {
 public:
  Sweep(int mask, const VoxelValues& values, const VoxelLoops& loops)
      : mask_(mask), values_(values) {
    std::iota(piece_.begin(), piece_.end(), 0);
    for (int l = 0; l < loops.count; ++l) {
      for (const int e : loops.edges(l)) loop_of_edge_[e] = l;
    }
    for (int m = 0; m < 4; ++m) {
      if (is_inside(mask, m) == is_inside(mask, m + 4)) continue;
      int at = events_++;
      for (; at > 0 && crosses_below(m, order_[at - 1]); --at) order_[at] = order_[at - 1];
      order_[at] = m;
    }
  }

  Tube run() {
    for (int slab = 0; slab <= events_; ++slab) {
      unite_arcs(slab);
      if (slab < events_) passed_[order_[slab]] = true;
    }
    for (int l = kMaxLoops - 1; l > 0; --l) {
      if (piece_[l] != l) return {piece_[l], l};
    }
    return {};
  }

 private:
  bool sign(int column) const { return is_inside(mask_, column + (passed_[column] ? 4 : 0)); }

  // True if the column becomes inside on the way up, so that d > 0; otherwise it becomes outside.
  bool rises(int column) const { return !is_inside(mask_, column); }

  // True if column m's crossing, at height -c / d, comes before column n's. Opaque: where this is
  // inlined into the loop that sorts, g++ 12.2 at -O3 unswitches that loop on rises(m) and sorts
  // wrongly (tests/contour/unswitched_loop.cpp).
  DELISO_OPAQUE bool crosses_below(int m, int n) const {
    const int sign =
        sign_of(values_, 0xff, [=](const auto& x) { return x.c(n) * x.d(m) - x.c(m) * x.d(n); });
    return sign == 0 ? rises(m) && !rises(n) : (sign < 0) == (rises(m) == rises(n));
  }

  void unite(int l, int m) {
    const int from = std::max(piece_[l], piece_[m]), to = std::min(piece_[l], piece_[m]);
    std::replace(piece_.begin(), piece_.end(), from, to);
  }

  // Returns the loop that holds the end of the slice's arc on the side face between two columns.
  // The arc's segment crosses the lower edge if neither column's crossing is passed, the upper edge
  // if both are, else the passed column.
  int loop_at(int column, int other) const {
    int e = 8 + (passed_[column] ? column : other);
    if (passed_[column] == passed_[other]) {
      const int up = passed_[column] ? 4 : 0;
      e = edge_between(column + up, other + up);
    }
    return loop_of_edge_[e];
  }

  // Unites the ends of an arc around one column, on the faces to its two neighbors.
  void unite_around(int column) { unite(loop_at(column, column ^ 1), loop_at(column, column ^ 2)); }

  void unite_arcs(int slab) {
    const bool s[4] = {sign(0), sign(1), sign(2), sign(3)};
    const int inside = s[0] + s[1] + s[2] + s[3];
    if (inside == 1 || inside == 3) {
      for (int m = 0; m < 4; ++m) {
        if (s[m] == (inside == 1)) unite_around(m);
      }
    } else if (inside == 2 && s[0] != s[3]) {
      const int across = s[0] == s[1] ? 2 : 1;  // the arc runs between columns m and m ^ across
      unite(loop_at(0, across), loop_at(3, 3 ^ across));
    } else if (inside == 2) {
      const bool joined_below = joined_at(slab - 1, s[0]), joined_above = joined_at(slab, s[0]);
      const bool both = joined_below != joined_above || saddle_flips(slab, s[0], joined_below);
      if (both || joined_below != s[0]) {
        unite_around(0);
        unite_around(3);
      }
      if (both || joined_below == s[0]) {
        unite_around(1);
        unite_around(2);
      }
    }
  }

  // True if the inside columns of an alternating slab are joined at one of its ends: the slice at
  // event number e, or a face of the voxel. At an event a column's value is zero. So its product is
  // zero, and the other product, of two values of equal sign, is positive.
  bool joined_at(int e, bool column_0_inside) const {
    if (e < 0) return inside_corners_joined(mask_, values_, 4);
    if (e >= events_) return inside_corners_joined(mask_, values_, 5);
    const int column = order_[e];
    const bool column_inside = (column == 0 || column == 3) == column_0_inside;
    return !column_inside;
  }

  // True if the saddle expression, of equal sign at both ends of an alternating slab, changes it
  // twice between. Then r(z) = (product of inside columns) - (product of outside ones) has its
  // extremum there, on the other side of zero (where zero counts as joined).
  bool saddle_flips(int slab, bool column_0_inside, bool joined) const {
    const int upwards = joined == column_0_inside ? 1 : -1;  // c0 c3 - c1 c2 falls, then rises
    if (slope_at(slab - 1) != -upwards || slope_at(slab) != upwards) return false;
    const int discriminant =
        sign_of(values_, 0xff, [](const auto& x) { return r1(x) * r1(x) - r2(x) * r0(x) * 4.0; });
    return discriminant >= (joined ? 1 : 0);
  }

  // c0 c3 - c1 c2 = r2 z^2 + r1 z + r0
  static auto r2(const auto& x) { return x.d(0) * x.d(3) - x.d(1) * x.d(2); }
  static auto r1(const auto& x) {
    return (x.c(0) * x.d(3) + x.c(3) * x.d(0)) - (x.c(1) * x.d(2) + x.c(2) * x.d(1));
  }
  static auto r0(const auto& x) { return x.c(0) * x.c(3) - x.c(1) * x.c(2); }

  // Returns the sign of its slope, r1 + 2 r2 z, at event number e or at a face of the voxel.
  int slope_at(int e) const {
    if (e < 0) return sign_of(values_, 0xff, [](const auto& x) { return r1(x); });
    if (e >= events_) {
      return sign_of(values_, 0xff, [](const auto& x) { return r1(x) + r2(x) * 2.0; });
    }
    const int m = order_[e];
    const int sign = sign_of(values_, 0xff,
                             [=](const auto& x) { return r1(x) * x.d(m) - r2(x) * x.c(m) * 2.0; });
    return rises(m) ? sign : -sign;
  }

  int mask_;
  const VoxelValues& values_;
  std::array<int, kMaxLoops> piece_{};  // smallest loop of the piece of each loop
  std::array<int, 12> loop_of_edge_{};
  std::array<int, 4> order_{};  // columns with a crossing, from below
  int events_ = 0;
  std::array<bool, 4> passed_{};
};

}  // namespace

std::uint8_t ambiguous_faces(int mask) {
  return kMasks.ambiguous[mask];
}

VoxelLoops trace_loops(int mask, std::uint8_t joined) {
  return trace(mask, joined);
}

VoxelLoops voxel_loops(int mask, const VoxelValues& values) {
  const std::uint8_t ambiguous = kMasks.ambiguous[mask];
  if (ambiguous == 0) return kMasks.loops[mask];
  int joined = 0;
  for (int f = 0; f < 6; ++f) {
    if ((ambiguous >> f & 1) != 0 && inside_corners_joined(mask, values, f)) joined |= 1 << f;
  }
  return trace(mask, static_cast<std::uint8_t>(joined));
}

Tube find_tube(int mask, const VoxelValues& values, const VoxelLoops& loops) {
  if (loops.count < 2) return {};
  return Sweep(mask, values, loops).run();
}

}  // namespace deliso
