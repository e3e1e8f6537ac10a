// SPDX-License-Identifier: MIT
#include "more/bodies/label_complex.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

#include "base/disjoint_sets.h"
#include "more/bodies/face_regions.h"

namespace deliso {
namespace {

// Points keep this share of an edge from its ends, and of a face or a voxel from its sides: T_L has
// no sharp triangles to begin with, and rounding makes nothing cross.
constexpr double kFromEnds = 0.15;

// The points of a voxel, by number: its corners; edges, by axis and the place of the lower end
// among four; two points in each face, where three bodies meet; one more in each, in the middle of
// a region; and one on the line between the two of a face.
constexpr int kEdges = 8, kMeetings = 20, kMiddles = 32, kBetween = 38, kPoints = 44;
// Their places in the whole: of edges and faces at the least corner, by axis; of the sample itself;
// and of those within the voxel, which are copies of points towards its middle, and an apex.
constexpr std::uint64_t kEdgePlace = 0, kMeetingPlace = 3, kMiddlePlace = 9, kSamplePlace = 12,
                        kCopyPlace = 13, kApexPlace = kCopyPlace + kPoints;
constexpr int kSharedPlaces = 13;  // those that are not within a voxel
static_assert(kApexPlace < LabelComplex::kPlaces);

constexpr int edge_of(int axis, int lower) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return kEdges + 4 * axis + (lower >> u & 1) + 2 * (lower >> v & 1);
}
constexpr int lower_end(int edge) {
  const int axis = (edge - kEdges) / 4, place = (edge - kEdges) % 4;
  return (place & 1) << (axis + 1) % 3 | (place >> 1) << (axis + 2) % 3;
}
// The corners of a face (base/box3.h), counter-clockwise seen from the end of its axis.
constexpr std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  const int first = (face % 2) << axis;
  return {first, first | u, first | u | v, first | v};
}
constexpr FacePlaces places_of(int face) {
  const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::array<int, 4> c = face_corners(face);
  return {c,
          {edge_of(u, c[0]), edge_of(v, c[1]), edge_of(u, c[3]), edge_of(v, c[0])},
          {kMeetings + 2 * face, kMeetings + 2 * face + 1},
          kMiddles + face};
}

// Coordinates that both have stay as they are.
Vec3 between(const Vec3& a, const Vec3& b, double x) {
  Vec3 p = a;
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis]) p[axis] = a[axis] + x * (b[axis] - a[axis]);
  }
  return p;
}

// The same sum in whatever direction the corners are counted.
double sum_around(double a, double b, double c, double d) {
  return (a + c) + (b + d);
}

class Complex {
 public:
  Complex(const Partition& partition, const SampleBox& box)
      : partition_(partition), box_(box), dims_(box.dims()) {
    const std::size_t slice = static_cast<std::size_t>(dims_.i) * static_cast<std::size_t>(dims_.j);
    for (auto& of_slice : shared_) of_slice.assign(slice * kSharedPlaces, kNoId);
  }

  LabelComplex build() {
    for (int k = box_.begin.k; k < box_.end.k; ++k) {
      for (int j = box_.begin.j; j < box_.end.j; ++j) {
        for (int i = box_.begin.i; i < box_.end.i; ++i) add_voxel({i, j, k});
      }
      std::swap(shared_[0], shared_[1]);
      std::ranges::fill(shared_[1], VertexId(kNoId));
    }
    made_.sheets.free_facets = made_.sheets.facets.size();
    return std::move(made_);
  }

 private:
  // --- The voxel at hand ---

  void add_voxel(Index3 at) {
    voxel_ = at;
    for (int m = 0; m < 8; ++m) body_[m] = partition_.body_at(corner_of(at, m));
    const unsigned on_box = outer_faces(at, partition_.shape().voxels());
    const bool is_one = std::ranges::all_of(body_, [&](BodyId b) { return b == body_[0]; });
    if (is_one && on_box == 0) return;
    lo_ = partition_.shape().position(at);
    hi_ = partition_.shape().position(corner_of(at, 7));
    find_bodies();
    faces_.clear();
    arcs_.clear();
    for (int face = 0; face < 6; ++face) {
      faces_.emplace_back(bodies_of(face), diagonal_of(face), places_of(face));
      for (FaceArc arc : faces_.back().arcs()) {
        if (face % 2 == 0) std::swap(arc.from, arc.to);
        if (arc.left > arc.right) arc = {arc.to, arc.from, arc.right, arc.left};
        arcs_.push_back(arc);
      }
    }
    for (int face = 0; face < 6; ++face) {
      if ((on_box >> face & 1) != 0) add_caps(face);
    }
    if (is_one) return;
    if (is_simple()) {
      add_cone();
    } else {
      add_layers();
    }
  }

  // The bodies of the corners, and their fields there.
  void find_bodies() {
    names_.clear();
    for (const BodyId b : body_) {
      if (std::ranges::find(names_, b) == names_.end()) names_.push_back(b);
    }
    fields_.resize(names_.size());
    for (std::size_t n = 0; n < names_.size() && names_.size() > 1; ++n) {
      for (int m = 0; m < 8; ++m) {
        fields_[n][m] = partition_.value(names_[n], corner_of(voxel_, m));
      }
    }
  }
  const Corners& field(BodyId body) const {
    return fields_[static_cast<std::size_t>(std::ranges::find(names_, body) - names_.begin())];
  }

  // Returns the one of some bodies for which a value is the largest: of equal ones the least.
  template <class Value>
  static BodyId largest(std::span<const BodyId> bodies, Value&& value) {
    BodyId best = bodies[0];
    double most = value(best);
    for (const BodyId b : bodies.subspan(1)) {
      const double here = value(b);
      if (here > most || (here == most && b < best)) best = b, most = here;
    }
    return best;
  }

  std::array<BodyId, 4> bodies_of(int face) const {
    const std::array<int, 4> c = face_corners(face);
    return {body_[c[0]], body_[c[1]], body_[c[2]], body_[c[3]]};
  }
  int diagonal_of(int face) const {
    const std::array<int, 4> c = face_corners(face);
    const std::array<BodyId, 4> bodies = bodies_of(face);
    if (bodies[0] == bodies[2] && bodies[1] != bodies[3]) return 0;
    if (bodies[1] == bodies[3] && bodies[0] != bodies[2]) return 1;
    const BodyId middle = largest(bodies, [&](BodyId b) {
      const Corners& f = field(b);
      return sum_around(f[c[0]], f[c[1]], f[c[2]], f[c[3]]);
    });
    return bodies[0] == middle || bodies[2] == middle ? 0 : 1;
  }
  // A body that keeps others apart on the voxel's surface does so within, if there is one; else the
  // one with the largest mean.
  BodyId body_of_middle() const {
    std::vector<BodyId> bodies;
    for (const BodyId b : names_) {
      if (keeps_apart(b)) bodies.push_back(b);
    }
    if (bodies.empty()) bodies = names_;
    return largest(bodies, [&](BodyId b) {
      const Corners& f = field(b);
      return sum_around(f[0] + f[7], f[1] + f[6], f[3] + f[4], f[2] + f[5]);
    });
  }
  // Joins the corners that hold(a, b), where they are neighbors or meet in the middle of a face.
  template <class Hold>
  DisjointSets pieces_where(Hold&& hold) const {
    DisjointSets pieces(8);
    const auto join = [&](int a, int b) {
      if (hold(a, b)) pieces.unite(a, b);
    };
    for (int m = 0; m < 8; ++m) {
      for (int axis = 0; axis < 3; ++axis) join(m, m | 1 << axis);
    }
    for (int face = 0; face < 6; ++face) {
      const int d = faces_[face].diagonal();
      if (d >= 0) join(face_corners(face)[d], face_corners(face)[d + 2]);
    }
    return pieces;
  }
  // True if what others have of the surface is in pieces, not all with the same bodies.
  bool keeps_apart(BodyId body) const {
    DisjointSets pieces =
        pieces_where([&](int a, int b) { return body_[a] != body && body_[b] != body; });
    std::array<std::uint64_t, 8> bodies{};
    for (int m = 0; m < 8; ++m) {
      const auto name = std::ranges::find(names_, body_[m]) - names_.begin();
      if (body_[m] != body) bodies[pieces.find(m)] |= std::uint64_t{1} << name;
    }
    std::uint64_t first = 0;
    for (const std::uint64_t of : bodies) {
      if (of != 0 && first != 0 && of != first) return true;
      if (of != 0) first = of;
    }
    return false;
  }

  std::array<bool, kPoints> points_of_arcs() const {
    std::array<bool, kPoints> is_used{};
    for (const FaceArc& arc : arcs_) is_used[arc.from] = is_used[arc.to] = true;
    return is_used;
  }
  // True if each body has one piece on the voxel's surface, a disk.
  bool is_simple() const {
    DisjointSets pieces = pieces_where([&](int a, int b) { return body_[a] == body_[b]; });
    const auto points = static_cast<std::size_t>(std::ranges::count(points_of_arcs(), true));
    std::size_t regions = 0;
    for (int m = 0; m < 8; ++m) regions += pieces.find(m) == static_cast<std::uint32_t>(m);
    const std::size_t bodies = names_.size();
    return regions == bodies && points + regions == arcs_.size() + 2;
  }

  // --- Facets ---

  // Adds a facet that is counter-clockwise seen from one body.
  void add(Triangle v, BodyId seen_from, BodyId other) {
    const std::array<BodyId, 2> order = partition_.in_order(seen_from, other);
    if (order[0] != seen_from) std::swap(v[1], v[2]);
    made_.sheets.facets.push_back({v, order});
  }

  void add_caps(int face) {
    for (const FaceTriangle& t : triangles_outwards(face)) {
      made_.sheets.facets.push_back(
          {{point(t.v[0]), point(t.v[1]), point(t.v[2])}, {partition_.beyond(face), t.body}});
    }
  }
  // Counter-clockwise seen from outside the voxel.
  std::vector<FaceTriangle> triangles_outwards(int face) const {
    std::vector<FaceTriangle> triangles = faces_[face].triangles();
    if (face % 2 != 0) return triangles;
    for (FaceTriangle& t : triangles) std::swap(t.v[1], t.v[2]);
    return triangles;
  }

  // The cone over the arcs. Over a loop of three or four of them, the loop filled by itself.
  void add_cone() {
    if (names_.size() == 2 && arcs_.size() <= 4) {
      std::array<VertexId, 4> loop{};
      int at = arcs_[0].from;
      for (std::size_t n = 0; n < arcs_.size(); ++n) {
        loop[n] = point(at);
        at = std::ranges::find(arcs_, at, &FaceArc::from)->to;
      }
      const auto& [a, b, c, d] = loop;
      const BodyId left = arcs_[0].left, right = arcs_[0].right;
      const std::vector<Vec3>& p = made_.sheets.points;
      if (arcs_.size() == 3) {
        add({a, b, c}, left, right);
      } else if (distance2(p[a], p[c]) <= distance2(p[b], p[d])) {
        add({a, b, c}, left, right), add({a, c, d}, left, right);
      } else {
        add({a, b, d}, left, right), add({b, c, d}, left, right);
      }
      return;
    }
    // In the middle of the points where three bodies meet; if there are none, of all.
    Vec3 sum;
    int points = 0;
    const int first = names_.size() > 2 ? kMeetings : kEdges;
    const int last = names_.size() > 2 ? kMiddles : kMeetings;
    const std::array<bool, kPoints> is_used = points_of_arcs();
    for (int n = first; n < last; ++n) {
      if (!is_used[n]) continue;
      sum = sum + made_.sheets.points[point(n)];
      ++points;
    }
    const VertexId apex = add_point(kApexPlace, within(sum / points));
    for (const FaceArc& arc : arcs_)
      add({point(arc.from), point(arc.to), apex}, arc.left, arc.right);
  }
  Vec3 within(Vec3 p) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double margin = kFromEnds * (hi_[axis] - lo_[axis]);
      p[axis] = std::clamp(p[axis], lo_[axis] + margin, hi_[axis] - margin);
    }
    return p;
  }

  // The body of the middle has all but layers at the faces.
  void add_layers() {
    const BodyId m = body_of_middle();
    copy_.fill(kNoId);
    for (int corner = 0; corner < 8; ++corner) {
      if (body_[corner] != m && is_cut_off(corner, m)) cut_off(corner, m);
    }
    for (int face = 0; face < 6; ++face) add_sheets(face, m);
    for (const FaceArc& arc : arcs_) {
      if (arc.left == m || arc.right == m) continue;
      const VertexId p = point(arc.from), q = point(arc.to);
      if (is_at_contact_of(arc, m)) {
        add({p, q, copy(between_of(arc), m)}, arc.left, arc.right);
        continue;
      }
      const VertexId p_in = copy(arc.from, m), q_in = copy(arc.to, m);
      if (q_in != q) add({p, q, q_in}, arc.left, arc.right);
      if (p_in != p) add({p, q_in, p_in}, arc.left, arc.right);
    }
  }
  // True if all around a corner is m's: an arc each in three faces, so that a triangle does for its
  // sheet.
  bool is_cut_off(int corner, BodyId m) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (body_[corner ^ 1 << axis] != m) return false;
      const int face = 2 * axis + (corner >> axis & 1), d = faces_[face].diagonal();
      if (faces_[face].meetings() > 0) return false;
      if (d >= 0 && body_[face_corners(face)[d]] == body_[corner]) return false;
    }
    return true;
  }
  void cut_off(int corner, BodyId m) {
    const auto edge = [&](int axis) { return point(edge_of(axis, corner & ~(1 << axis))); };
    // From a corner at an even number of high ends, x, y and z are seen clockwise.
    Triangle v{edge(0), edge(1), edge(2)};
    if (std::popcount(static_cast<unsigned>(corner)) % 2 == 0) std::swap(v[1], v[2]);
    add(v, body_[corner], m);
  }
  // An arc between two other bodies, both ends of which m comes to.
  bool is_at_contact_of(const FaceArc& arc, BodyId m) const {
    return arc.left != m && arc.right != m && is_meeting(arc.from) && is_meeting(arc.to) &&
           holds(arc.from, m) && holds(arc.to, m);
  }
  static bool is_meeting(int point) { return point >= kMeetings && point < kMiddles; }
  static int between_of(const FaceArc& arc) { return kBetween + (arc.from - kMeetings) / 2; }

  void add_sheets(int face, BodyId m) {
    const FaceArc* contact = nullptr;
    for (const FaceArc& arc : faces_[face].arcs()) {
      if (is_at_contact_of(arc, m)) contact = &arc;
    }
    for (const FaceTriangle& t : triangles_outwards(face)) {
      const auto& [a, b, c] = t.v;
      if (t.body == m || (a < kEdges && is_cut_off(a, m))) continue;
      if (contact != nullptr && is_meeting(b) && is_meeting(c)) {
        const VertexId middle = copy(between_of(*contact), m);
        add({copy(a, m), copy(b, m), middle}, t.body, m);
        add({copy(a, m), middle, copy(c, m)}, t.body, m);
      } else {
        add({copy(a, m), copy(b, m), copy(c, m)}, t.body, m);
      }
    }
  }

  // --- Points ---

  VertexId add_point(std::uint64_t place, const Vec3& p) {
    const Index3 all = partition_.shape().dims();
    const std::uint64_t sample =
        voxel_.i + std::uint64_t(all.i) * (voxel_.j + std::uint64_t(all.j) * voxel_.k);
    return add_point_at(sample * LabelComplex::kPlaces + place, p);
  }
  VertexId add_point_at(std::uint64_t place, const Vec3& p) {
    made_.place.push_back(place);
    made_.sheets.points.push_back(p);
    return VertexId(made_.sheets.points.size() - 1);
  }

  // Returns the point of that number, on the voxel's surface.
  VertexId point(int n) {
    const auto [corner, place] = shared_place(n);
    const Index3 s = corner_of(voxel_, corner);
    VertexId& id =
        shared_[corner >> 2][kSharedPlaces * (static_cast<std::size_t>(s.i - box_.begin.i) +
                                              static_cast<std::size_t>(dims_.i) *
                                                  static_cast<std::size_t>(s.j - box_.begin.j)) +
                             static_cast<std::size_t>(place)];
    if (id == kNoId) {
      const Index3 all = partition_.shape().dims();
      const std::uint64_t sample = s.i + std::uint64_t(all.i) * (s.j + std::uint64_t(all.j) * s.k);
      id = add_point_at(sample * LabelComplex::kPlaces + place, position(n));
    }
    return id;
  }
  // Where it is. Points of corners and in the middle of regions are not made by that.
  Vec3 place_of(int n) {
    return n < kEdges || n >= kMiddles ? position(n) : made_.sheets.points[point(n)];
  }
  // Its least corner, and its place there.
  static std::pair<int, std::uint64_t> shared_place(int n) {
    if (n < kEdges) return {n, kSamplePlace};
    if (n < kMeetings) return {lower_end(n), kEdgePlace + static_cast<unsigned>(n - kEdges) / 4};
    if (n < kMiddles) {
      const int face = (n - kMeetings) / 2, axis = face / 2;
      return {(face % 2) << axis, kMeetingPlace + static_cast<unsigned>(2 * axis + (n & 1))};
    }
    const int face = n - kMiddles, axis = face / 2;
    return {(face % 2) << axis, kMiddlePlace + static_cast<unsigned>(axis)};
  }
  Vec3 corner(int m) const { return partition_.shape().position(corner_of(voxel_, m)); }

  Vec3 position(int n) {
    if (n < kEdges) return corner(n);
    if (n < kMeetings) return on_edge(n);
    if (n < kMiddles) return in_face((n - kMeetings) / 2, n & 1);
    Vec3 sum;
    const std::vector<int> around = faces_[n - kMiddles].around_middle();
    for (const int p : around) sum = sum + place_of(p) / static_cast<double>(around.size());
    const int axis = (n - kMiddles) / 2;
    sum[axis] = corner(face_corners(n - kMiddles)[0])[axis];
    return sum;
  }

  // Where the fields of the two bodies are equal.
  Vec3 on_edge(int n) const {
    const int a = lower_end(n), b = a | 1 << (n - kEdges) / 4;
    const Corners &f = field(body_[a]), &g = field(body_[b]);
    const double at_a = f[a] - g[a], at_b = g[b] - f[b], sum = at_a + at_b;
    const double x = sum > 0 ? std::clamp(at_a / sum, kFromEnds, 1 - kFromEnds) : 0.5;
    return between(corner(a), corner(b), x);
  }

  // Where the fields of three bodies are equal: bilinear ones in the face if three meet there;
  // linear ones between three corners if there are four, or two points.
  Vec3 in_face(int face, int which) const {
    const std::array<int, 4> c = face_corners(face);
    const int d = faces_[face].diagonal();
    if (d >= 0) {
      const int first = d + 2 * which;
      return tie_of_corners({c[first], c[(first + 1) % 4], c[(first + 2) % 4]});
    }
    int lone = 0;  // the corner between the edges that are between others than the twin corners
    while (body_[c[(lone + 1) % 4]] != body_[c[(lone + 2) % 4]]) ++lone;
    const BodyId a = body_[c[(lone + 1) % 4]], b = body_[c[(lone + 3) % 4]], e = body_[c[lone]];
    double u = 0.5, v = 0.5;
    for (int step = 0; step < 6; ++step) {
      const auto row = [&](BodyId other) {  // the difference, and its derivatives
        std::array<double, 4> f{};
        for (int n = 0; n < 4; ++n) f[n] = field(a)[c[n]] - field(other)[c[n]];
        const double bottom = f[0] + u * (f[1] - f[0]), top = f[3] + u * (f[2] - f[3]);
        return Vec3{(1 - v) * (f[1] - f[0]) + v * (f[2] - f[3]), top - bottom,
                    bottom + v * (top - bottom)};
      };
      const Vec3 p = row(b), q = row(e);
      const double det = p.x * q.y - p.y * q.x;
      if (!(std::fabs(det) > 1e-9)) break;
      u = std::clamp(u + (p.y * q.z - q.y * p.z) / det, kFromEnds, 1 - kFromEnds);
      v = std::clamp(v + (q.x * p.z - p.x * q.z) / det, kFromEnds, 1 - kFromEnds);
    }
    return between(corner(c[0]), corner(c[1]), u) +
           (between(corner(c[0]), corner(c[3]), v) - corner(c[0]));
  }

  Vec3 tie_of_corners(const std::array<int, 3>& n) const {
    Vec3 first, second;  // differences at the corners
    for (int m = 0; m < 3; ++m) {
      const double own = field(body_[n[0]])[n[m]];
      first[m] = own - field(body_[n[1]])[n[m]];
      second[m] = own - field(body_[n[2]])[n[m]];
    }
    Vec3 share = cross(first, second);
    double sum = share.x + share.y + share.z;
    if (!(std::fabs(sum) > 0)) share = {1, 1, 1}, sum = 3;
    double total = 0;
    for (int m = 0; m < 3; ++m) {
      share[m] = std::clamp(share[m] / sum, kFromEnds, 1.0);
      total += share[m];
    }
    return between(between(corner(n[0]), corner(n[1]), share[1] / (share[0] + share[1])),
                   corner(n[2]), share[2] / total);
  }

  // True if the body comes to the point.
  bool holds(int n, BodyId body) const {
    if (n < kEdges) return body_[n] == body;
    if (n < kMeetings) {
      const int a = lower_end(n);
      return body_[a] == body || body_[a | 1 << (n - kEdges) / 4] == body;
    }
    if (n >= kMiddles) return false;  // asked of regions of other bodies
    return std::ranges::any_of(arcs_, [&](const FaceArc& arc) {
      return (arc.from == n || arc.to == n) && (arc.left == body || arc.right == body);
    });
  }

  // The point itself if body m comes to it; else a copy of it towards the voxel's middle, where the
  // fields of its body and m are equal.
  VertexId copy(int n, BodyId m) {
    if (n < kBetween && holds(n, m)) return point(n);
    VertexId& id = copy_[n];
    if (id != kNoId) return id;
    const Vec3 middle = 0.5 * (lo_ + hi_);
    Vec3 p;
    if (n < kBetween) {
      p = place_of(n);
    } else {
      const int meeting = kMeetings + 2 * (n - kBetween);
      p = 0.5 * (made_.sheets.points[point(meeting)] + made_.sheets.points[point(meeting + 1)]);
    }
    const auto ahead = [&](const Vec3& at) {  // of m, the body that is ahead there
      double most = 0;
      for (const BodyId b : names_) most = std::max(most, value(b, at));
      return most - value(m, at);
    };
    const double here = ahead(p), there = value(m, middle) - second_best(m, middle);
    const double x = here + there > 0 ? here / (here + there) : 0;
    return id = add_point(kCopyPlace + static_cast<unsigned>(n),
                          p + std::clamp(x, kFromEnds, 1 - kFromEnds) * (middle - p));
  }
  double second_best(BodyId m, const Vec3& at) const {
    double most = 0;
    for (const BodyId b : names_) most = b == m ? most : std::max(most, value(b, at));
    return most;
  }
  double value(BodyId body, const Vec3& p) const {
    const Corners& f = field(body);
    Vec3 u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = (p[axis] - lo_[axis]) / (hi_[axis] - lo_[axis]);
    double sum = 0;
    for (int m = 0; m < 8; ++m) {
      double share = 1;
      for (int axis = 0; axis < 3; ++axis) share *= (m >> axis & 1) != 0 ? u[axis] : 1 - u[axis];
      sum += share * f[m];
    }
    return sum;
  }

  const Partition& partition_;
  SampleBox box_;
  Index3 dims_;
  // The points at two slices of samples; kNoId: none yet.
  std::array<std::vector<VertexId>, 2> shared_;
  LabelComplex made_;

  Index3 voxel_;
  Vec3 lo_, hi_;  // its ends
  std::array<BodyId, 8> body_{};
  std::vector<BodyId> names_;    // the different ones
  std::vector<Corners> fields_;  // of each name
  std::vector<FaceRegions> faces_;
  std::vector<FaceArc> arcs_;  // of all faces, as seen from outside, the lesser body to the left
  std::array<VertexId, kPoints> copy_;
};

}  // namespace

LabelComplex label_complex(const Partition& partition, const SampleBox& box) {
  return Complex(partition, box).build();
}

}  // namespace deliso
