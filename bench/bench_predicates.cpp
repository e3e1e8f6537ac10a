// SPDX-License-Identifier: MIT
// Nanoseconds per orient3d and insphere, by how hard the points are, and the share of calls that
// the inline filter cannot settle.
//   bench_predicates [CALLS]
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "exact/predicates.h"

using namespace deliso;

namespace {

using Five = std::array<Vec3, 5>;

struct Family {
  const char* name;
  std::function<Vec3(Random&)> point;
};

Vec3 in_cube(Random& random) {
  return {random.uniform(), random.uniform(), random.uniform()};
}

Vec3 on_sphere(Random& random) {
  while (true) {
    const Vec3 p = 2 * in_cube(random) - Vec3{1, 1, 1};
    if (length2(p) < 1 && length2(p) > 0.01) return p / length(p);
  }
}

const Family kFamilies[] = {
    {"random", in_cube},
    {"small integers",
     [](Random& r) {
       return Vec3{double(r.below(4)), double(r.below(4)), double(r.below(4))};
     }},
    {"rounded sphere", on_sphere},
    {"integers on a sphere",
     [](Random& r) {
       Vec3 p{16000, 13000, 5000};
       for (int k = 0; k < 3; ++k) {
         std::swap(p[k], p[static_cast<int>(r.below(3))]);
         if (r.below(2)) p[k] = -p[k];
       }
       return p;
     }},
    {"rounded tilted plane",
     [](Random& r) {
       const double u = r.uniform(), v = r.uniform();
       return Vec3{u, v, 1 - u / 3 - v / 7};
     }},
};

template <class Predicate>
double nanoseconds(const std::vector<Five>& inputs, std::size_t calls, const Predicate& predicate) {
  int sum = 0;
  const std::clock_t start = std::clock();
  for (std::size_t i = 0; i < calls; ++i) sum += predicate(inputs[i % inputs.size()]);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (sum == 0x7fffffff) std::puts("");  // keeps the calls
  return 1e9 * seconds / static_cast<double>(calls);
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t calls = argc > 1 ? std::stoul(argv[1]) : 1'000'000;
  std::printf("%-22s %14s %8s %14s %8s\n", "points", "orient3d ns", "beyond", "insphere ns",
              "beyond");
  for (const Family& family : kFamilies) {
    Random random(1);
    std::vector<Five> inputs(4096);
    for (Five& five : inputs)
      for (Vec3& p : five) p = family.point(random);
    double beyond_orient = 0, beyond_sphere = 0;
    for (const auto& [a, b, c, d, e] : inputs) {
      const Vec3 u = b - a, v = c - a, w = d - a;
      beyond_orient += std::fabs(predicates::orient3d_determinant(u, v, w)) <=
                       predicates::kOrient3dFilter * predicates::orient3d_scale(u, v, w);
      const Vec3 p = a - e, q = b - e, r = c - e, s = d - e;
      beyond_sphere += std::fabs(predicates::insphere_determinant(p, q, r, s)) <=
                       predicates::kInsphereFilter * predicates::insphere_scale(p, q, r, s);
    }
    const double orient =
        nanoseconds(inputs, calls, [](const Five& p) { return orient3d(p[0], p[1], p[2], p[3]); });
    const double sphere = nanoseconds(
        inputs, calls, [](const Five& p) { return insphere(p[0], p[1], p[2], p[3], p[4]); });
    const double n = static_cast<double>(inputs.size()) / 100;
    std::printf("%-22s %14.1f %7.1f%% %14.1f %7.1f%%\n", family.name, orient, beyond_orient / n,
                sphere, beyond_sphere / n);
  }
  return 0;
}
