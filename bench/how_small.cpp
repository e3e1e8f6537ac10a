// SPDX-License-Identifier: MIT
// How far is a mesh from the fewest vertices for D and lambda (docs/guide/how-small.md)? Tiny
// surfaces against all meshes of given points, others against a bound from curvature. Without data
// on built-in fields alone: half a minute.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "check/verify.h"
#include "contour/contour.h"
#include "support/runs.h"
#include "surface/surface_point.h"

using namespace deliso;
using std::numbers::pi;

namespace {

constexpr double kLambda = 2, kEquilateral = 0.578;

// All meshes of a closed surface around a center: vertices are among N candidates; facets are
// admissible and face away from the center. One that covers each direction once does not cross
// itself, so none is asked about crossings.
class Fewest {
 public:
  // `admits(a, b, c)`: counter-clockwise seen from outside.
  Fewest(const std::vector<Vec3>& candidates, const Vec3& center, const auto& admits)
      : n_(candidates.size()), at_edge_(n_ * n_), has_facet_(n_ * n_), facets_at_(n_) {
    constexpr Vec3 kSomewhere{0.5377, 0.2311, 0.8109};
    std::vector<Vec3> at;
    for (const Vec3& p : candidates) at.push_back((p - center) / distance(p, center));
    for (std::size_t n = 0; n < n_ * n_ * n_; ++n) {
      const std::size_t i = n / n_ / n_, j = n / n_ % n_, k = n % n_;
      const Vec3 &a = at[i], &b = at[j], &c = at[k], ab = cross(a, b), bc = cross(b, c),
                 ca = cross(c, a);
      if (j < i || k < i || dot(ab, c) < 1e-9 ||
          !admits(candidates[i], candidates[j], candidates[k]))
        continue;
      const double angle = 2 * std::atan2(dot(ab, c), 1 + dot(a, b) + dot(b, c) + dot(c, a));
      largest_ = std::max(largest_, angle);
      const Facet f{{i, j, k}, angle};
      for (std::size_t e = 0; e < 3; ++e) at_edge_[edge(f, e)].push_back(f);
      // One facet of a mesh holds that direction.
      if (std::min({dot(ab, kSomewhere), dot(bc, kSomewhere), dot(ca, kSomewhere)}) > 0)
        first_.push_back(f);
    }
  }
  // Sets `at_least`: no mesh has fewer vertices. Returns those of one; 0: none was found.
  std::size_t find(std::size_t most, std::size_t& at_least) {
    // n vertices have 2 n - 4 facets, and none covers more than the largest angle.
    at_least = static_cast<std::size_t>(std::max(4., std::ceil(2 * pi / largest_ - 1e-9) + 2));
    for (most_ = at_least; most_ <= most; ++most_) {
      steps_ = 1'000'000;
      if (std::ranges::any_of(first_, [&](const Facet& f) { return put(f); })) return most_;
      at_least += steps_ > 0 && at_least == most_;
    }
    return 0;
  }

 private:
  struct Facet {
    std::array<std::size_t, 3> v;
    double angle;  // as seen from the center
  };
  std::size_t edge(const Facet& f, std::size_t e) const { return f.v[e] * n_ + f.v[(e + 1) % 3]; }
  bool fits(const Facet& f) const {
    const double covered = covered_ + f.angle;
    const auto left = static_cast<double>(2 * most_ - 5) - static_cast<double>(facets_.size());
    std::size_t vertices = vertices_;
    for (std::size_t e = 0; e < 3; ++e) {
      if (has_facet_[edge(f, e)] != 0) return false;
      vertices += facets_at_[f.v[e]] == 0;
    }
    return vertices <= most_ && covered < 4 * pi + 1e-6 &&
           covered + left * largest_ > 4 * pi - 1e-6;
  }
  // Adds a facet and completes the mesh, or takes it out again.
  bool put(const Facet& f) {
    if (steps_ == 0 || !fits(f)) return false;
    --steps_;
    facets_.push_back(f);
    covered_ += f.angle;
    for (std::size_t e = 0; e < 3; ++e) {
      has_facet_[edge(f, e)] = 1;
      vertices_ += facets_at_[f.v[e]]++ == 0;
    }
    if (complete()) return true;
    for (std::size_t e = 0; e < 3; ++e) {
      has_facet_[edge(f, e)] = 0;
      vertices_ -= --facets_at_[f.v[e]] == 0;
    }
    covered_ -= f.angle;
    facets_.pop_back();
    return false;
  }
  // Tries all facets at the open edge with the fewest.
  bool complete() {
    std::vector<Facet> fewest, here;
    for (const Facet& f : facets_) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::size_t a = f.v[(e + 1) % 3], b = f.v[e];
        if (has_facet_[a * n_ + b] != 0) continue;
        here.clear();
        std::ranges::copy_if(at_edge_[a * n_ + b], std::back_inserter(here),
                             [&](const Facet& t) { return fits(t); });
        if (here.empty()) return false;
        if (fewest.empty() || here.size() < fewest.size()) fewest.swap(here);
      }
    }
    if (fewest.empty()) return covered_ > 4 * pi - 1e-6;
    return std::ranges::any_of(fewest, [&](const Facet& f) { return put(f); });
  }

  std::size_t n_, most_ = 0, steps_ = 0;
  std::vector<std::vector<Facet>> at_edge_;  // by directed edge
  std::vector<Facet> first_;
  double largest_ = 0;
  // The mesh so far.
  std::vector<Facet> facets_;
  std::vector<std::uint8_t> has_facet_;  // by directed edge
  std::vector<std::uint32_t> facets_at_;
  std::size_t vertices_ = 0;
  double covered_ = 0;
};

// A surface around the middle of `size`^3 samples f(offset from the middle).
template <class F>
void add_tiny(Table& table, const std::string& name, int size, double isovalue, double bound, F f) {
  std::vector<double> samples;
  const double m = 0.5 * (size - 1);
  for (int n = 0; n < size * size * size; ++n) {
    samples.push_back(f(n % size - m, n / size % size - m, n / size / size - m));
  }
  const Volume volume = Volume::from_samples(Index3{size, size, size}, Vec3{1, 1, 1}, samples);
  const Isosurface surface(volume, isovalue);
  SearchCounters counters;
  // Where lines from the middle to 98 points of a cube meet it.
  std::vector<Vec3> points;
  const Vec3 middle = volume.box().middle();
  for (int n = 0; n < 125; ++n) {
    const std::array offset{n % 5 - 2, n / 5 % 5 - 2, n / 25 - 2};
    if (std::ranges::all_of(offset, [](int x) { return std::abs(x) < 2; })) continue;
    const auto on = [&](std::size_t axis) { return std::tan(pi / 8 * offset[axis]); };
    const Vec3 p{on(0), on(1), on(2)};
    points.push_back(surface.nearest(middle, p / length(p), 1e9, counters).value().point);
  }
  Options options;
  options.limits[Criterion::distance] = {bound, Length::Unit::voxel};
  options.r_min = {0.05, Length::Unit::voxel};
  const TriMesh mesh = mesh_isosurface(volume, isovalue, options);
  points.insert(points.end(), mesh.points.begin(), mesh.points.end());
  SurfacePointFinder finder(surface);
  Fewest fewest(points, middle, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    if (radius_ratio2(a, b, c) > kLambda * kLambda) return false;
    const auto x = finder.find(a, b, c, counters);
    return x && measure(a, b, c, *x).h <= bound;
  });
  std::size_t at_least = 0;
  const std::size_t found = fewest.find(mesh.points.size(), at_least);
  table.add({name, fixed_cell(bound, 1), count_of(build_contour(volume, isovalue).points.size()),
             count_of(mesh.points.size()), found > 0 ? count_of(found) : "-", count_of(at_least)});
}

// A triangle with its corners on z = (x^2 + ratio y^2) / 2, ratio in [-1, 1], and r/l up to
// `lambda`: the largest area over its largest distance. By trying angles and directions.
double largest_area(double ratio, double lambda) {
  double largest = 0;
  for (int m = 1; m < 90; ++m) {
    for (int n = 1; n <= m && m + n < 90; ++n) {
      const double a = pi * m / 90, b = pi * n / 90, c = pi - a - b;
      const double shortest = std::sin(std::min({a, b, c}));  // of circumdiameter 1
      if (0.5 > lambda * shortest) continue;
      const double area = std::sin(a) * std::sin(b) * std::sin(c) / 2;
      for (int d = 0; d < 60; ++d) {
        const double to = pi * d / 60;
        const auto along = [&](double edge, double turned) {
          return edge * edge *
                 (std::pow(std::cos(turned), 2) + ratio * std::pow(std::sin(turned), 2));
        };
        std::array q{along(std::sin(c), to), along(std::sin(a), to - b),
                     along(std::sin(b), to + a)};
        double error = 0;
        for (const double x : q) error = std::max(error, std::fabs(x) / 8);
        std::ranges::sort(q);
        // Where it curves to one side and no edge is too long, the circumcenter is furthest.
        if (ratio > 0 && q[0] + q[1] > q[2])
          error = q[0] * q[1] * q[2] / (32 * ratio * area * area);
        largest = std::max(largest, area / error);
      }
    }
  }
  return largest;
}

// The principal curvatures of the level set of g at p, the larger one positive. Second differences
// over a voxel are those of a smoothed g, which has no creases.
std::array<double, 2> curvatures(const Volume& volume, const Vec3& p) {
  std::array<Vec3, 3> e{}, h{};
  for (int axis = 0; axis < 3; ++axis) e[axis][axis] = volume.spacing()[axis];
  const auto g = [&](const Vec3& offset) { return volume.value(p + offset); };
  Vec3 gradient{};
  for (int i = 0; i < 3; ++i) {
    gradient[i] = (g(e[i]) - g(-e[i])) / (2 * e[i][i]);
    for (int j = 0; j < 3; ++j) {
      h[i][j] = (g(e[i] + e[j]) - g(e[i] - e[j]) - g(e[j] - e[i]) + g(-e[i] - e[j])) /
                (4 * e[i][i] * e[j][j]);
    }
    h[i][i] = (g(e[i]) - 2 * g({}) + g(-e[i])) / (e[i][i] * e[i][i]);
  }
  const double size = length(gradient);
  const Vec3 n = gradient / size, hn{dot(h[0], n), dot(h[1], n), dot(h[2], n)};
  const double trace = (h[0].x + h[1].y + h[2].z - dot(n, hn)) / size;
  const double square = (dot(h[0], h[0]) + dot(h[1], h[1]) + dot(h[2], h[2]) - 2 * dot(hn, hn) +
                         dot(n, hn) * dot(n, hn)) /
                        (size * size);
  const double root = std::sqrt(std::max(0., 2 * square - trace * trace));
  return {(std::fabs(trace) + root) / 2, (std::fabs(trace) - root) / 2};
}

// Vertices, half as many as triangles, that no mesh is below as D goes to 0: of triangles of any
// shape, of r/l up to kLambda, and of equilateral ones.
std::array<double, 3> least_vertices(const Volume& volume, double kappa, double bound) {
  constexpr int kRatios = 20;
  std::array<std::vector<double>, 2> areas;
  for (int n = -kRatios; n <= kRatios; ++n) {
    areas[0].push_back(largest_area(1. * n / kRatios, kLambda));
    areas[1].push_back(largest_area(1. * n / kRatios, kEquilateral));
  }
  const ContourMesh contour = build_contour(volume, kappa);
  std::array<double, 3> vertices{};
  for (const ContourTriangle& t : contour.triangles) {
    const Vec3 &a = contour.points[t[0]], &b = contour.points[t[1]], &c = contour.points[t[2]];
    const auto [k1, k2] = curvatures(volume, (a + b + c) / 3);
    if (!(k1 > 0)) continue;
    const double any = k2 > 0 ? 1.5 * std::sqrt(3.) : 2 * std::sqrt(5.);
    const auto nearest = static_cast<std::size_t>(std::lround((k2 / k1 + 1) * kRatios));
    const double share = length(area_normal(a, b, c)) / (4 * bound);
    vertices[0] += share * std::sqrt(k1 * std::fabs(k2)) / any;
    for (std::size_t n = 0; n < 2; ++n) vertices[n + 1] += share * k1 / areas[n][nearest];
  }
  return vertices;
}

void add_bound(Table& table, const std::string& name, const OpenedDataset& of) {
  const double kappa = geometric_isovalue(of.volume.type(), of.isovalue);
  const TriMesh mesh = run_once(of, Options()).mesh;
  const auto least = least_vertices(of.volume, kappa, 0.1 * of.volume.voxel());
  // With vertices off Sigma: the fewest that keep the mesh's distance, to a 32nd of its vertices.
  const auto distance_999 = [&](const TriMesh& m) {
    const Verification found = verify(m, of.volume, kappa, {});
    return std::max(found.to_surface.quantile_999, found.from_surface.quantile_999);
  };
  const double distance = distance_999(mesh);
  std::size_t enough = mesh.points.size(), few = 0;
  for (int step = 0; step < 5; ++step) {
    Options options;
    options.target_vertices = (enough + few) / 2;
    options.free_vertices = {2, Length::Unit::voxel};
    const bool keeps = distance_999(run_once(of, options).mesh) <= distance;
    (keeps ? enough : few) = options.target_vertices;
  }
  const auto n = static_cast<double>(mesh.points.size());
  table.add({name, count_cell(n), count_cell(least[0]), count_cell(least[1]), count_cell(least[2]),
             ratio_cell(n, least[1]), count_of(enough)});
}

// A sphere by the bound of Fejes Tóth 1953, for any D; and the geodesic icosahedron within D.
void add_sphere(Table& table, int size) {
  const std::string name = "sphere:" + std::to_string(size);
  const double radius = 0.35 * (size - 1), height = 0.1 / radius;
  const double angle = 6 / pi * std::atan(1 / (std::sqrt(3.) * (1 - height)));
  int divided = 0;
  for (double highest = 1; highest > height;) {
    highest = 0;
    ++divided;
    const auto at = [&](int i, int j) {
      const double g = std::numbers::phi;
      const Vec3 p = i * Vec3{0, 1, g} + j * Vec3{1, g, 0} + (divided - i - j) * Vec3{-1, g, 0};
      return p / length(p);
    };
    for (int n = 0; n < 2 * divided * divided; ++n) {
      const int i = n / 2 / divided, j = n / 2 % divided, down = n % 2;
      if (i + j + down >= divided) continue;
      const Vec3 corner = at(i + down, j + down), next = at(i + 1, j), last = at(i, j + 1);
      highest = std::max(highest, 1 - length(circumcenter(corner, next, last)));
    }
  }
  const TriMesh mesh = run_once(open_builtin("builtin:" + name), Options()).mesh;
  table.add({name, fixed_cell(radius, 1), count_cell(std::ceil(2 * angle / (angle - 1))),
             count_of(10 * divided * divided + 2), count_of(mesh.points.size())});
}

int work(const BenchArguments& arguments) {
  Table tiny("All meshes of given points",
             {"surface", "D", "vertices of T", "default", "fewest found", "no fewer than"}, 1);
  const auto one = [](double x, double y, double z) {
    return x == 0 && y == 0 && z == 0 ? 1. : 0.;
  };
  const auto ball = [](double x, double y, double z) { return -std::sqrt(x * x + y * y + z * z); };
  const auto egg = [](double x, double y, double z) {
    return -std::sqrt(x * x + y * y + z * z / 2) - x / 8;
  };
  const auto box = [](double x, double y, double z) {
    return std::max({std::fabs(x), std::fabs(y), std::fabs(z)}) < 1 ? 1. : 0.;
  };
  for (const double level : {0.8, 0.7, 0.6}) {
    add_tiny(tiny, "one sample at " + fixed_cell(level, 1), 3, level, 0.1, one);
  }
  for (const double bound : {0.2, 0.3}) add_tiny(tiny, "8 samples", 4, 0.5, bound, box);
  for (const double bound : {0.3, 0.4}) add_tiny(tiny, "ball", 5, -1.3, bound, ball);
  for (const double bound : {0.3, 0.4}) add_tiny(tiny, "egg", 5, -1.2, bound, egg);
  print_table(tiny, arguments);
  Table spheres("Spheres", {"field", "radius", "no fewer than", "geodesic", "default"}, 1);
  for (const int size : {16, 32, 64}) add_sphere(spheres, size);
  print_table(spheres, arguments);
  Table bounds("Against curvature",
               {"surface", "default", "any shape", "r/l to 2", "equilateral", "ratio", "free"}, 1);
  for (const char* name : {"sphere:64", "torus:64", "gyroid:32"}) {
    add_bound(bounds, name, open_builtin(std::string("builtin:") + name));
  }
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset of = open_dataset(dataset, arguments.data);
    if (!of.is_analogue) add_bound(bounds, dataset.name, of);
  }
  print_table(bounds, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "How far from the fewest vertices?", work);
}
