// SPDX-License-Identifier: MIT
// The kd-tree and the oracle on a volume: time and memory of the tree, time and voxel-ray
// computations per search (CPI of Table 4), and on request a check against plain walks.
//
// Usage: bench_search [--volume INPUT] [--iso K] [--count N] [--check N]
//   INPUT: a file, or builtin:NAME[:SIZE]. --check N: N random segments and N nearest-point
//   queries, against clipping every voxel in the box of the segment by itself.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "io/volume/read_volume.h"
#include "isosurface/isosurface.h"
#include "isosurface/voxel_ray.h"
#include "kdtree/voxel_tree.h"

using namespace deliso;

namespace {

// CPU seconds, so that other work on the machine does not count.
double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Arguments {
  std::string input = "builtin:fuel:128";
  std::optional<double> kappa;  // else the middle of the samples' range
  int count = 200'000, check = 0;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int n = 1; n < argc; n += 2) {
    const std::string_view name = argv[n];
    if (n + 1 == argc) throw InputError(std::string(name) + ": needs a value");
    const char* value = argv[n + 1];
    if (name == "--volume") {
      arguments.input = value;
    } else if (name == "--iso") {
      arguments.kappa = std::atof(value);
    } else if (name == "--count") {
      arguments.count = std::atoi(value);
    } else if (name == "--check") {
      arguments.check = std::atoi(value);
    } else {
      throw InputError(std::string(name) + ": unknown option");
    }
  }
  return arguments;
}

Vec3 random_point(Random& random, const Box3& box) {
  return {random.uniform(box.lo.x, box.hi.x), random.uniform(box.lo.y, box.hi.y),
          random.uniform(box.lo.z, box.hi.z)};
}

Vec3 random_direction(Random& random) {
  while (true) {
    const Vec3 d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (length2(d) > 1e-4 && length2(d) < 1) return d / length(d);
  }
}

struct Query {
  Vec3 center, direction;
};

// Lines as Stage 2 asks for them: from points within about a voxel of Sigma, along its normal give
// or take.
std::vector<Query> stage2_queries(const Isosurface& surface, int count, double offset) {
  Random random(5);
  std::vector<Query> queries;
  std::vector<Hit> hits;
  SearchCounters counters;
  for (int tries = 0; static_cast<int>(queries.size()) < count && tries < 100 * count; ++tries) {
    const Box3 box = surface.volume().box();
    surface.intersect({random_point(random, box), random_point(random, box)}, hits, counters);
    for (const Hit& hit : hits) {
      const Vec3 gradient = surface.gradient(hit.point);
      const double size = length(gradient);
      if (!(size > 0)) continue;
      const Vec3 direction = gradient / size + 0.3 * random_direction(random);
      const Vec3 n = direction / length(direction);
      queries.push_back({hit.point + random.uniform(-offset, offset) * n, n});
    }
  }
  return queries;
}

void report(const char* what, double time, const SearchCounters& c) {
  const double searches = static_cast<double>(c.searches);
  std::printf("%-34s %7.1f ns   hits %.3f   CPI %.2f   CPI* %.2f\n", what, 1e9 * time / searches,
              static_cast<double>(c.searches_with_hit) / searches,
              static_cast<double>(c.computations) / searches,
              static_cast<double>(c.computations_with_hit) /
                  static_cast<double>(std::max<std::uint64_t>(c.searches_with_hit, 1)));
}

void time_nearest(const char* what, const Isosurface& surface, const std::vector<Query>& queries,
                  double limit) {
  SearchCounters counters;
  double sum = 0;
  const double start = seconds();
  for (const Query& q : queries)
    if (const auto hit = surface.nearest(q.center, q.direction, limit, counters)) sum += hit->t;
  report(what, seconds() - start, counters);
  if (std::isnan(sum)) std::printf("NaN\n");
}

void time_intersect(const char* what, const Isosurface& surface, const std::vector<Segment>& all) {
  SearchCounters counters;
  std::vector<Hit> hits;
  const double start = seconds();
  for (const Segment& r : all) surface.intersect(r, hits, counters);
  report(what, seconds() - start, counters);
}

// All hits of the line, voxel by voxel over the bounding box of the range, without tree or walk.
std::vector<Hit> plain_hits(const Isosurface& surface, const LatticeLine& line, Range range,
                            const Vec3& from, const Vec3& to) {
  const Volume& volume = surface.volume();
  const Index3 a = volume.voxel_at(from), b = volume.voxel_at(to), n = volume.voxels();
  std::vector<Hit> hits;
  Index3 lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    // One more on each side: voxel_at rounds on its own.
    lo[axis] = std::max(std::min(a[axis], b[axis]) - 1, 0);
    hi[axis] = std::min(std::max(a[axis], b[axis]) + 2, n[axis]);
  }
  for (int k = lo.k; k < hi.k; ++k) {
    for (int j = lo.j; j < hi.j; ++j) {
      // Rows the line misses are passed over whole.
      if (std::max(line.enter(1, j), line.enter(2, k)) >=
          std::min(line.leave(1, j), line.leave(2, k)))
        continue;
      for (int i = lo.i; i < hi.i; ++i) {
        const VoxelSpan span = line.span({i, j, k}, range);
        if (span.empty()) continue;
        Corners corners = volume.corners({i, j, k});
        for (double& c : corners) c -= surface.kappa();
        for (const double s : find_intersections(corners, span, CubicMethod::isolation))
          hits.push_back({parameter_at(span, s), point_at(span, s, volume), false});
      }
    }
  }
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& p, const Hit& q) { return p.t < q.t; });
  return hits;
}

bool check(const Isosurface& surface, const VoxelTree& tree, int count) {
  SearchCounters counters;
  std::vector<Hit> hits;
  std::uint64_t found = 0, near = 0, wrong = 0;
  double worst = 0;
  for (int n = 0; n < count; ++n) {
    Random random(static_cast<std::uint64_t>(n));
    const Box3 box = surface.volume().box();
    const Segment r{random_point(random, box), random_point(random, box)};
    surface.intersect(r, hits, counters);
    std::vector<Hit> expected =
        plain_hits(surface, tree.lattice_line(r.a, r.direction()), {0, 1}, r.a, r.b);
    bool same = hits.size() == expected.size();
    for (std::size_t m = 0; same && m < hits.size(); ++m)
      same = hits[m].t == expected[m].t && hits[m].point == expected[m].point;
    found += hits.size();
    for (const Hit& hit : hits)
      worst = std::max(worst, std::abs(surface.volume().value(hit.point) - surface.kappa()));

    const double size = length(r.direction()), limit = random.uniform(0, 40);
    const Vec3 direction = r.direction() / size;
    const auto hit = surface.nearest(r.a, direction, limit, counters);
    expected = plain_hits(surface, tree.lattice_line(r.a, direction), {-limit, limit},
                          r.a - limit * direction, r.a + limit * direction);
    const auto best =
        std::min_element(expected.begin(), expected.end(), [](const Hit& p, const Hit& q) {
          return std::abs(p.t) < std::abs(q.t) || (std::abs(p.t) == std::abs(q.t) && p.t > q.t);
        });
    same = same && hit.has_value() == (best != expected.end()) &&
           (!hit || (hit->t == best->t && hit->point == best->point));
    near += hit.has_value();
    if (same) continue;
    if (wrong++ < 5) std::printf("differs: seed %d\n", n);
  }
  std::printf(
      "check: %d segments with %llu hits, %d nearest-point queries with %llu hits, "
      "%llu differ; largest |g - kappa| %.2g\n",
      count, static_cast<unsigned long long>(found), count, static_cast<unsigned long long>(near),
      static_cast<unsigned long long>(wrong), worst);
  return wrong == 0;
}

int run(const Arguments& arguments) {
  const Volume volume = read_volume(arguments.input);
  const ValueRange range = value_range(volume);

  const double start = seconds();
  const VoxelTree tree(volume);
  std::printf("kd-tree: %.1f ms, %zu bytes = %.2f %% of the samples, depth %d\n",
              1e3 * (seconds() - start), tree.bytes(),
              100.0 * static_cast<double>(tree.bytes()) /
                  static_cast<double>(volume.sample_count() * size_of(volume.type())),
              tree.depth());

  const double kappa =
      geometric_isovalue(volume.type(), arguments.kappa.value_or(0.5 * (range.min + range.max)));
  const Isosurface surface(volume, kappa);
  if (arguments.check > 0) return check(surface, tree, arguments.check) ? 0 : 1;

  // One and the same queries for both solvers.
  std::vector<Query> near = stage2_queries(surface, arguments.count, 0.1);
  std::vector<Query> far = stage2_queries(surface, arguments.count, 1), sorted = near, any = near;
  std::sort(sorted.begin(), sorted.end(), [&](const Query& a, const Query& b) {
    const Index3 p = volume.voxel_at(a.center), q = volume.voxel_at(b.center);
    return volume.index(p.i, p.j, p.k) < volume.index(q.i, q.j, q.k);
  });
  Random random(9);
  std::vector<Segment> across, around;
  for (Query& q : any) {
    q.direction = random_direction(random);
    across.push_back({random_point(random, volume.box()), random_point(random, volume.box())});
    around.push_back({q.center + 2 * random_direction(random), q.center + 2 * q.direction});
  }
  // So few that their voxels stay in the cache, over and over.
  std::vector<Query> few;
  for (std::size_t n = 0; n < near.size(); ++n) few.push_back(near[n % 2000]);

  for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
    const Isosurface by(volume, kappa, method);
    std::printf("%s\n", method == CubicMethod::isolation ? "isolation" : "schwarze");
    time_nearest("  nearest, +-0.1 voxel, in cache", by, few, 10);
    time_nearest("  nearest, +-0.1 voxel, in order", by, sorted, 10);
    time_nearest("  nearest, +-0.1 voxel, random order", by, near, 10);
    time_nearest("  nearest, +-1 voxel, random order", by, far, 10);
    time_nearest("  nearest, any direction, no limit", by, any, 1e9);
    time_intersect("  intersect, across the box", by, across);
    time_intersect("  intersect, 2 voxels round Sigma", by, around);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv));
  } catch (const InputError& error) {
    std::fprintf(stderr, "bench_search: %s\n", error.what());
    return 2;
  }
}
