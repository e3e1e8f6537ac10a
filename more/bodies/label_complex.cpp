// SPDX-License-Identifier: MIT
#include "more/bodies/label_complex.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

namespace deliso {
namespace {

// Points keep this share of an edge from its ends, and of a triangle's heights from its sides. So
// rounding, which moves points off their simplices, makes nothing cross.
constexpr double kFromEnds = 0.02, kFromSides = 0.05;

// The simplices of which a sample is the least, by the steps to the others: a step is a set of
// axes. Edges are numbered 0 to 6, triangles 7 to 18, tetrahedra 19 to 24; 25 is the sample.
constexpr int kFirstTriangle = 7, kFirstTetrahedron = 19, kSampleItself = 25;
constexpr int edge_number(int step) {
  return step - 1;
}
// Of a triangle, by its two steps.
constexpr auto kTriangleNumbers = [] {
  std::array<std::array<int, 8>, 8> number{};
  int next = kFirstTriangle;
  for (int a = 1; a < 7; ++a) {
    for (int b = a + 1; b < 8; ++b) {
      if ((a & b) == a) number[a][b] = next++;
    }
  }
  return number;
}();
static_assert(kTriangleNumbers[6][7] == kFirstTetrahedron - 1);

// The paths from corner 0 of a voxel to corner 7, and whether (v0, v1, v2, v3) is positive.
struct Path {
  std::array<int, 4> corner;
  bool is_positive;
};
constexpr std::array<Path, 6> kPaths{{{{0, 1, 3, 7}, true},
                                      {{0, 1, 5, 7}, false},
                                      {{0, 2, 3, 7}, false},
                                      {{0, 2, 6, 7}, true},
                                      {{0, 4, 5, 7}, true},
                                      {{0, 4, 6, 7}, false}}};

// True if the corners i, j, k, l of a positive tetrahedron are in a positive order.
constexpr bool is_even(int i, int j, int k, int l) {
  const std::array<int, 4> p{i, j, k, l};
  int swaps = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) swaps += p[a] > p[b] ? 1 : 0;
  }
  return swaps % 2 == 0;
}

class Complex {
 public:
  Complex(const Partition& partition, const SampleBox& box)
      : partition_(partition), box_(box), dims_(box.dims()) {
    const std::size_t samples = static_cast<std::size_t>(dims_.i) *
                                static_cast<std::size_t>(dims_.j) *
                                static_cast<std::size_t>(dims_.k);
    used_.resize(samples);
    first_.resize(samples);
  }

  LabelComplex build() {
    for_each_tetrahedron([&](const Tetrahedron& t) { mark(t); });
    number_points();
    for_each_tetrahedron([&](const Tetrahedron& t) { add_facets(t); });
    made_.sheets.free_facets = made_.sheets.facets.size();
    return std::move(made_);
  }

 private:
  struct Tetrahedron {
    Index3 voxel;
    int path;
    std::array<Index3, 4> sample;
    std::array<BodyId, 4> body;
    bool is_positive;
    int bodies;  // how many
    // Per corner: the face of the box that holds the other three; 6: none.
    std::array<int, 4> outside;
  };

  std::size_t index(Index3 s) const {
    return static_cast<std::size_t>(s.i - box_.begin.i) +
           static_cast<std::size_t>(dims_.i) *
               (static_cast<std::size_t>(s.j - box_.begin.j) +
                static_cast<std::size_t>(dims_.j) * static_cast<std::size_t>(s.k - box_.begin.k));
  }

  template <class Visit>
  void for_each_tetrahedron(Visit&& visit) {
    const Index3 last = partition_.shape().voxels();
    Index3 at;
    for (at.k = box_.begin.k; at.k < box_.end.k; ++at.k) {
      for (at.j = box_.begin.j; at.j < box_.end.j; ++at.j) {
        for (at.i = box_.begin.i; at.i < box_.end.i; ++at.i) {
          std::array<BodyId, 8> body;
          for (int m = 0; m < 8; ++m) body[m] = partition_.body_at(corner_of(at, m));
          const bool is_at_box = at.i == 0 || at.j == 0 || at.k == 0 || at.i + 1 == last.i ||
                                 at.j + 1 == last.j || at.k + 1 == last.k;
          if (!is_at_box && std::ranges::all_of(body, [&](BodyId b) { return b == body[0]; })) {
            continue;
          }
          for (int path = 0; path < 6; ++path) {
            const auto& corner = kPaths[path].corner;
            Tetrahedron t{at, path, {}, {}, kPaths[path].is_positive, 1, {6, 6, 6, 6}};
            for (int n = 0; n < 4; ++n) {
              t.sample[n] = corner_of(at, corner[n]);
              t.body[n] = body[corner[n]];
              bool is_new = n > 0;
              for (int m = 0; m < n; ++m) is_new &= t.body[m] != t.body[n];
              t.bodies += is_new ? 1 : 0;
            }
            if (is_at_box) set_outside(t);
            if (t.bodies > 1 || t.outside != std::array{6, 6, 6, 6}) visit(t);
          }
        }
      }
    }
  }

  // Only the faces opposite the first and the last corner of a path can lie on the box.
  void set_outside(Tetrahedron& t) const {
    const Index3 count = partition_.shape().dims();
    for (const int n : {0, 3}) {
      unsigned faces = 63;
      for (int m = 0; m < 4; ++m) {
        if (m != n) faces &= outer_faces(t.sample[m], count);
      }
      if (faces != 0) t.outside[n] = std::countr_zero(faces);
    }
  }

  struct Simplex {
    Index3 least;
    int number;
  };
  Simplex edge(const Tetrahedron& t, int i, int j) const {
    if (i > j) std::swap(i, j);
    const auto& c = kPaths[t.path].corner;
    return {t.sample[i], edge_number(c[j] ^ c[i])};
  }
  Simplex triangle(const Tetrahedron& t, int opposite) const {
    const int i = opposite == 0 ? 1 : 0, j = opposite <= 1 ? 2 : 1, k = opposite == 3 ? 2 : 3;
    const auto& c = kPaths[t.path].corner;
    return {t.sample[i], kTriangleNumbers[c[j] ^ c[i]][c[k] ^ c[i]]};
  }
  Simplex inside(const Tetrahedron& t) const { return {t.voxel, kFirstTetrahedron + t.path}; }

  void use(const Simplex& s) { used_[index(s.least)] |= 1u << s.number; }
  VertexId point(const Simplex& s) const {
    const std::size_t at = index(s.least);
    const std::uint32_t before = used_[at] & ((1u << s.number) - 1);
    return VertexId(first_[at] + static_cast<std::uint32_t>(std::popcount(before)));
  }
  bool has_three(const Tetrahedron& t, int opposite) const {
    const auto& b = t.body;
    const BodyId x = b[opposite == 0 ? 1 : 0], y = b[opposite <= 1 ? 2 : 1],
                 z = b[opposite == 3 ? 2 : 3];
    return x != y && y != z && x != z;
  }

  void mark(const Tetrahedron& t) {
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        if (t.body[i] != t.body[j]) use(edge(t, i, j));
      }
      if (t.bodies > 2 && has_three(t, i)) use(triangle(t, i));
      for (const int at : {0, 3}) {
        if (t.outside[at] < 6 && at != i) use({t.sample[i], kSampleItself});
      }
    }
    if (t.bodies > 2) use(inside(t));
  }

  // Numbers the points in the order of their simplices, and places them.
  void number_points() {
    const Index3 all = partition_.shape().dims();
    Index3 s;
    for (s.k = box_.begin.k; s.k <= box_.end.k; ++s.k) {
      for (s.j = box_.begin.j; s.j <= box_.end.j; ++s.j) {
        for (s.i = box_.begin.i; s.i <= box_.end.i; ++s.i) {
          const std::size_t at = index(s);
          first_[at] = static_cast<std::uint32_t>(made_.simplex.size());
          const std::uint64_t sample =
              s.i + std::uint64_t(all.i) * (s.j + std::uint64_t(all.j) * s.k);
          for (std::uint32_t rest = used_[at]; rest != 0; rest &= rest - 1) {
            made_.simplex.push_back(sample * LabelComplex::kSimplices +
                                    static_cast<std::uint64_t>(std::countr_zero(rest)));
          }
        }
      }
    }
    made_.sheets.points.resize(made_.simplex.size());
    std::vector<std::uint8_t> is_placed(made_.simplex.size());
    std::vector<Vec3>& points = made_.sheets.points;
    const auto place = [&](const Simplex& simplex, auto&& where) {
      const VertexId v = point(simplex);
      if (std::exchange(is_placed[v], 1) == 0) points[v] = where();
      return points[v];
    };
    for_each_tetrahedron([&](const Tetrahedron& t) {
      Vec3 sum;
      int faces = 0;
      for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
          if (t.body[i] == t.body[j]) continue;
          place(edge(t, i, j), [&] { return tie_on_edge(t, i, j); });
        }
        if (t.bodies > 2 && has_three(t, i)) {
          sum = sum + place(triangle(t, i), [&] { return tie_in_triangle(t, i); });
          ++faces;
        }
        for (const int at : {0, 3}) {
          if (t.outside[at] == 6 || at == i) continue;
          place({t.sample[i], kSampleItself},
                [&] { return partition_.shape().position(t.sample[i]); });
        }
      }
      if (t.bodies > 2) points[point(inside(t))] = sum / faces;
    });
  }

  // Where the fields of the bodies of corners i and j are equal on the edge. Along it their
  // difference is a polynomial, in Bernstein's form by the samples of the smallest box around it.
  Vec3 tie_on_edge(const Tetrahedron& t, int i, int j) const {
    const int from = kPaths[t.path].corner[i], step = kPaths[t.path].corner[j] ^ from;
    const int degree = std::popcount(static_cast<unsigned>(step));
    std::array<double, 4> sum{};
    for (int m = 0; m < 8; ++m) {
      if ((m & ~step) != 0) continue;
      const Index3 sample = corner_of(t.voxel, from | m);
      sum[std::popcount(static_cast<unsigned>(m))] +=
          partition_.value(t.body[i], sample) - partition_.value(t.body[j], sample);
    }
    const auto value = [&](double x) {
      const double y = 1 - x;
      switch (degree) {
        case 1:
          return y * sum[0] + x * sum[1];
        case 2:
          return y * y * sum[0] + x * y * sum[1] + x * x * sum[2];
        default:
          return y * y * y * sum[0] + x * y * (y * sum[1] + x * sum[2]) + x * x * x * sum[3];
      }
    };
    double lo = 0, hi = 1, at_lo = sum[0], at_hi = sum[static_cast<std::size_t>(degree)], x = 0.5;
    for (int n = 0; n < 24 && hi - lo > 1e-6; ++n) {
      x = at_lo > at_hi ? (at_lo * hi - at_hi * lo) / (at_lo - at_hi) : 0.5;
      const double least = 0.05 * (hi - lo);
      x = n % 3 == 2 ? 0.5 * (lo + hi) : std::clamp(x, lo + least, hi - least);
      const double here = value(x);
      (here > 0 ? lo : hi) = x;
      (here > 0 ? at_lo : at_hi) = here;
    }
    x = std::clamp(x, kFromEnds, 1 - kFromEnds);
    const Vec3 a = partition_.shape().position(t.sample[i]),
               b = partition_.shape().position(t.sample[j]);
    return between(a, b, x);
  }

  // Coordinates that both have stay as they are.
  static Vec3 between(const Vec3& a, const Vec3& b, double x) {
    Vec3 p = a;
    for (int axis = 0; axis < 3; ++axis) {
      if (a[axis] != b[axis]) p[axis] = a[axis] + x * (b[axis] - a[axis]);
    }
    return p;
  }

  // Where the fields of three bodies, linear in the triangle, are equal.
  Vec3 tie_in_triangle(const Tetrahedron& t, int opposite) const {
    const std::array<int, 3> n{opposite == 0 ? 1 : 0, opposite <= 1 ? 2 : 1, opposite == 3 ? 2 : 3};
    Vec3 first, second;  // differences at the corners
    for (int m = 0; m < 3; ++m) {
      const Index3 s = t.sample[n[m]];
      const double own = partition_.value(t.body[n[0]], s);
      first[m] = own - partition_.value(t.body[n[1]], s);
      second[m] = own - partition_.value(t.body[n[2]], s);
    }
    Vec3 share = cross(first, second);
    double sum = share.x + share.y + share.z;
    if (!(std::fabs(sum) > 0)) share = {1, 1, 1}, sum = 3;
    double total = 0;
    for (int m = 0; m < 3; ++m) {
      share[m] = std::clamp(share[m] / sum, kFromSides, 1.0);
      total += share[m];
    }
    std::array<Vec3, 3> p;
    for (int m = 0; m < 3; ++m) p[m] = partition_.shape().position(t.sample[n[m]]);
    return between(between(p[0], p[1], share[1] / (share[0] + share[1])), p[2], share[2] / total);
  }

  // Adds the facet v between two bodies: counter-clockwise seen from `up` if `is_up`, else from
  // `down`.
  void add(Triangle v, bool is_up, BodyId up, BodyId down) {
    const std::array<BodyId, 2> order = partition_.in_order(up, down);
    if ((order[0] == up) != is_up) std::swap(v[1], v[2]);
    made_.sheets.facets.push_back({v, order});
  }

  void add_facets(const Tetrahedron& t) {
    if (t.bodies == 2) add_plane(t);
    if (t.bodies > 2) {
      const VertexId apex = point(inside(t));
      for (int n = 0; n < 4; ++n) add_cone(t, n, apex);
    }
    for (const int n : {0, 3}) {
      if (t.outside[n] < 6) add_region(t, n);
    }
  }

  bool is_positive(const Tetrahedron& t, int i, int j, int k, int l) const {
    return is_even(i, j, k, l) == t.is_positive;
  }

  // The triangle or the quadrilateral of marching tetrahedra.
  void add_plane(const Tetrahedron& t) {
    std::array<int, 4> own{}, other{};
    int owns = 0, others = 0;
    for (int n = 0; n < 4; ++n) {
      (t.body[n] == t.body[0] ? own[owns++] : other[others++]) = n;
    }
    if (owns != 2) {
      const auto& [a, b, c, rest] = owns == 3 ? own : other;
      const int odd = owns == 3 ? other[0] : own[0];
      add({point(edge(t, odd, a)), point(edge(t, odd, b)), point(edge(t, odd, c))},
          is_positive(t, a, b, c, odd), t.body[odd], t.body[a]);
      return;
    }
    const int i = own[0], j = own[1], k = other[0], l = other[1];
    const VertexId ik = point(edge(t, i, k)), il = point(edge(t, i, l)), jl = point(edge(t, j, l)),
                   jk = point(edge(t, j, k));
    const bool is_up = is_positive(t, i, j, k, l);
    const std::vector<Vec3>& p = made_.sheets.points;
    if (distance2(p[ik], p[jl]) <= distance2(p[il], p[jk])) {
      add({ik, il, jl}, is_up, t.body[k], t.body[i]);
      add({ik, jl, jk}, is_up, t.body[k], t.body[i]);
    } else {
      add({ik, il, jk}, is_up, t.body[k], t.body[i]);
      add({il, jl, jk}, is_up, t.body[k], t.body[i]);
    }
  }

  // The cone over the segments in the face opposite corner n.
  void add_cone(const Tetrahedron& t, int n, VertexId apex) {
    const std::array<int, 3> f{n == 0 ? 1 : 0, n <= 1 ? 2 : 1, n == 3 ? 2 : 3};
    const bool is_branched = has_three(t, n);
    for (int m = 0; m < 3; ++m) {
      const int i = f[m], j = f[(m + 1) % 3], k = f[(m + 2) % 3];
      if (is_branched) {
        add({point(edge(t, i, j)), point(triangle(t, n)), apex}, is_positive(t, i, k, n, j),
            t.body[j], t.body[i]);
      } else if (t.body[i] == t.body[j] && t.body[i] != t.body[k]) {
        // The segment from the edge ki to kj has k on one side.
        add({point(edge(t, k, i)), point(edge(t, k, j)), apex}, is_positive(t, i, j, n, k),
            t.body[k], t.body[i]);
      }
    }
  }

  // The regions in the face opposite corner n, which lies on the box.
  void add_region(const Tetrahedron& t, int n) {
    std::array<int, 3> f{n == 0 ? 1 : 0, n <= 1 ? 2 : 1, n == 3 ? 2 : 3};
    if (is_positive(t, f[0], f[1], f[2], n)) std::swap(f[1], f[2]);  // seen from outside
    const BodyId beyond = partition_.beyond(t.outside[n]);
    const auto cap = [&](VertexId a, VertexId b, VertexId c, int corner) {
      made_.sheets.facets.push_back({{a, b, c}, {beyond, t.body[corner]}});
    };
    const auto at = [&](int m) { return point({t.sample[f[m]], kSampleItself}); };
    const auto on = [&](int m, int l) { return point(edge(t, f[m], f[l])); };
    if (has_three(t, n)) {
      const VertexId middle = point(triangle(t, n));
      for (int m = 0; m < 3; ++m) {
        const int l = (m + 1) % 3, k = (m + 2) % 3;
        cap(at(m), on(m, l), middle, f[m]);
        cap(at(m), middle, on(m, k), f[m]);
      }
      return;
    }
    for (int m = 0; m < 3; ++m) {
      const int l = (m + 1) % 3, k = (m + 2) % 3;
      if (t.body[f[l]] != t.body[f[k]]) continue;
      if (t.body[f[m]] == t.body[f[l]]) {
        cap(at(0), at(1), at(2), f[0]);
      } else {
        cap(at(m), on(m, l), on(m, k), f[m]);
        cap(on(m, l), at(l), at(k), f[l]);
        cap(on(m, l), at(k), on(m, k), f[l]);
      }
      return;
    }
  }

  const Partition& partition_;
  SampleBox box_;
  Index3 dims_;
  std::vector<std::uint32_t> used_, first_;  // per sample: its simplices with a point
  LabelComplex made_;
};

}  // namespace

LabelComplex label_complex(const Partition& partition, const SampleBox& box) {
  return Complex(partition, box).build();
}

}  // namespace deliso
