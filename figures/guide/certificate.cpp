// SPDX-License-Identifier: MIT
// Labels on small surfaces, their patches and their duals, as docs/proof.md (Theorem 2) has them.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "guide/drawing.h"
#include "guide/figures.h"
#include "lesson/small_surfaces.h"

namespace deliso::guide {
namespace {

// One for each label, from 'a' on.
constexpr std::array kFills{"#fae0c4", "#dbe7f6", "#d8efd9", "#eadcf2", "#fbf3c0", "#f6d6da"};

using lesson::Labeled;

const char* fill_of(char label) {
  return kFills[static_cast<std::size_t>(label - 'a')];
}

class Sketch {
 public:
  Sketch(Drawing& drawing, const Panel& panel, const Labeled& t) : d_(drawing), p_(panel), t_(t) {}

  Vec2 at(int v) const { return place(static_cast<std::size_t>(v)); }
  Vec2 place(std::size_t v) const { return p_.at({t_.points[v].x, t_.points[v].y}); }

  // Every triangle cut by the labels of its corners.
  void patches() {
    for (const auto& t : t_.triangles) {
      const bool is_outside = t_.is_sphere && &t == &t_.triangles.back();
      fill_pieces(t, is_outside);
    }
    for (const auto& t : t_.triangles) cut(t, t_.is_sphere && &t == &t_.triangles.back());
  }

  void edges(const char* color = ink::kGray) {
    for (const auto& t : t_.triangles) {
      for (std::size_t i = 0; i < 3; ++i) d_.line(at(t[i]), at(t[(i + 1) % 3]), {color, 1});
    }
  }
  // `names`: each vertex with its label.
  void vertices(bool names) {
    for (std::size_t v = 0; v < t_.points.size(); ++v) {
      const Vec2 p = place(v);
      if (!names) {
        d_.dot(p, ink::kSigma, 2.5);
        continue;
      }
      d_.circle(p, 10, {ink::kSigma, 1.2, ink::kPaper});
      d_.text({p.x, p.y + 4.5}, t_.labels.substr(v, 1), Anchor::middle, 13);
    }
  }

 private:
  Vec2 middle(int v, int u) const { return 0.5 * (at(v) + at(u)); }
  char label(int v) const { return t_.labels[static_cast<std::size_t>(v)]; }
  // Beyond the window, seen from its middle.
  Vec2 far(const Vec2& p) const {
    const Vec2 center = p_.corner + 0.5 * p_.size;
    return center + 20.0 * (p - center);
  }
  void fill(const std::vector<Vec2>& piece, const char* color) {
    d_.polygon(piece, {color, 0.6, color});
  }
  void fill_pieces(const std::array<int, 3>& t, bool is_outside) {
    const Vec2 center = (1.0 / 3) * (at(t[0]) + at(t[1]) + at(t[2]));
    if (label(t[0]) == label(t[1]) && label(t[1]) == label(t[2])) {
      fill({at(t[0]), at(t[1]), at(t[2])}, fill_of(label(t[0])));
      return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const int v = t[i], u = t[(i + 1) % 3], w = t[(i + 2) % 3];
      const Vec2 to_u = middle(v, u), to_w = middle(v, w);
      if (label(u) == label(w)) {
        fill({at(v), to_u, to_w}, fill_of(label(v)));
        fill({to_u, at(u), at(w), to_w}, fill_of(label(u)));
        return;
      }
      if (label(v) == label(u) || label(v) == label(w)) continue;
      std::vector<Vec2> piece{at(v), to_u, center, to_w};
      if (is_outside) piece = {at(v), to_u, far(to_u), far(at(v)), far(to_w), to_w};
      fill(piece, fill_of(label(v)));
    }
  }
  void cut(const std::array<int, 3>& t, bool is_outside) {
    const Style style{ink::kRed, 1.8};
    const Vec2 center = (1.0 / 3) * (at(t[0]) + at(t[1]) + at(t[2]));
    const bool is_triple =
        label(t[0]) != label(t[1]) && label(t[1]) != label(t[2]) && label(t[2]) != label(t[0]);
    std::vector<Vec2> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const int u = t[(i + 1) % 3], w = t[(i + 2) % 3];
      if (label(u) != label(w)) ends.push_back(middle(u, w));
    }
    if (is_triple) {
      for (const Vec2& end : ends) d_.line(end, is_outside ? far(end) : center, style);
    } else if (ends.size() == 2) {
      d_.line(ends[0], ends[1], style);
    }
  }

  Drawing& d_;
  const Panel& p_;
  const Labeled& t_;
};

// A lattice of triangles in a hexagon, three rings around its middle, labeled by its nearest site.
Labeled hexagon(const std::vector<Vec3>& sites) {
  constexpr int kRings = 3;
  Labeled t;
  std::vector<std::array<int, 2>> place;
  for (int j = -kRings; j <= kRings; ++j) {
    for (int i = -kRings; i <= kRings; ++i) {
      if (std::abs(i + j) > kRings) continue;
      place.push_back({i, j});
      t.points.push_back({i + 0.5 * j, 0.8660254 * j, 0});
    }
  }
  const auto find = [&](int i, int j) {
    return static_cast<int>(std::find(place.begin(), place.end(), std::array{i, j}) -
                            place.begin());
  };
  const int none = static_cast<int>(place.size());
  for (const auto& [i, j] : place) {
    const int v = find(i, j), right = find(i + 1, j), up = find(i, j + 1),
              down = find(i + 1, j - 1);
    if (right != none && up != none) t.triangles.push_back({v, right, up});
    if (right != none && down != none) t.triangles.push_back({v, down, right});
  }
  for (const Vec3& p : t.points) {
    std::size_t nearest = 0;
    for (std::size_t s = 1; s < sites.size(); ++s) {
      if (distance2(p, sites[s]) < distance2(p, sites[nearest])) nearest = s;
    }
    t.labels += static_cast<char>('a' + nearest);
  }
  return t;
}

}  // namespace

void draw_patches(const std::string& folder) {
  const double h = 0.8660254;
  const std::vector<Vec3> sites{{0, 0, 0},      {3, 0, 0},     {1.5, 3 * h, 0},
                                {-2, 2 * h, 0}, {-2.5, -h, 0}, {0.5, -3 * h, 0}};
  const Labeled t = hexagon(sites);
  Labeled k{sites, "abcdef", {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}}};
  Drawing d(860, 300);
  const auto panel = [](double x) { return Panel{{-3.2, -2.95}, 42, {x, 35}, {270, 250}}; };
  const char* titles[] = {"T and its labels", "the patches", "K"};
  for (int n = 0; n < 3; ++n) {
    const Panel p = panel(10 + 285 * n);
    d.text({p.corner.x + p.size.x / 2, 22}, titles[n], Anchor::middle, 14);
    Sketch sketch(d, p, t), dual(d, p, k);
    if (n > 0) sketch.patches();
    if (n < 2) sketch.edges();
    if (n == 0) {
      for (std::size_t v = 0; v < t.points.size(); ++v) {
        d.circle(sketch.place(v), 6, {ink::kGray, 1, fill_of(t.labels[v])});
      }
    }
    if (n == 2) dual.edges(ink::kSigma);
    dual.vertices(true);
  }
  d.write(folder, "patches");
}

void draw_certificate(const std::string& folder) {
  Drawing d(1000, 500);
  double x = 10;
  for (const lesson::SmallSurface& e : lesson::small_surfaces()) {
    const Panel above{{-0.4, -0.35}, 45, {x, 50}, {218, 190}};
    const Panel below{{-0.4, -0.35}, 45, {x, 275}, {218, 190}};
    const double middle = x + above.size.x / 2;
    d.text({middle, 20}, e.title, Anchor::middle, 14, ink::kText, true);
    d.text({middle, 40}, e.above, Anchor::middle, 12.5);
    d.clip_to(above);
    Sketch t(d, above, e.t);
    t.patches();
    t.edges();
    t.vertices(true);
    d.clip_nowhere();
    Sketch k(d, below, e.k);
    for (const auto& f : e.k.triangles) {
      std::vector<Vec2> corners;
      for (const int v : f) corners.push_back(k.at(v));
      d.polygon(corners, {nullptr, 0, ink::kLight, false, 0.55});
    }
    k.edges(ink::kSigma);
    for (const auto& [a, b] : e.wrong) {
      const Vec2 p = k.at(a), q = k.at(b);
      d.line(p, q, {ink::kRed, 3});
      if (a == b) d.circle(p, 14, {ink::kRed, 3});
    }
    k.vertices(true);
    d.text({middle, 485}, e.below, Anchor::middle, 12.5);
    x += 245;
  }
  d.write(folder, "certificate");
}

}  // namespace deliso::guide
