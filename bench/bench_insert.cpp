// SPDX-License-Identifier: MIT
// Delaunay insertion rate over point sets and sizes.
//   bench_insert [--points cube|sphere|grid|cospherical|plane|clusters] [--n N] [--xyz FILE]
//                [--repeat R]
// --xyz reads raw native doubles x y z, to compare with another program on the same points.
// Without --points and --xyz, all kinds in turn. Prints the best of R runs of build(), in points
// per second of processor time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

#include "base/random.h"
#include "delaunay/triangulation.h"

using namespace deliso;

namespace {

std::vector<Vec3> read_xyz(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be opened");
  std::vector<Vec3> points;
  for (double xyz[3]; in.read(reinterpret_cast<char*>(xyz), sizeof xyz);)
    points.push_back({xyz[0], xyz[1], xyz[2]});
  return points;
}

std::vector<Vec3> make_points(const std::string& kind, std::size_t n) {
  Random random(1);
  const auto cube = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
  const auto ball = [&] {
    while (true) {
      const Vec3 p = 2 * cube() - Vec3{1, 1, 1};
      if (length2(p) < 1 && length2(p) > 1e-4) return p;
    }
  };
  // Integer points with one and the same squared length.
  const auto rational_sphere = [&] {
    const double u = random.below(2001) - 1000., v = random.below(2001) - 1000.;
    const double s = u * u + v * v + 1e6;
    return Vec3{2e3 * u / s, 2e3 * v / s, (u * u + v * v - 1e6) / s};
  };
  const auto side = static_cast<std::size_t>(std::cbrt(static_cast<double>(n)) + 0.5);
  std::vector<Vec3> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (kind == "cube")
      points.push_back(cube());
    else if (kind == "sphere") {
      const Vec3 p = ball();
      points.push_back(p / length(p));
    } else if (kind == "grid") {
      points.push_back({double(i % side), double(i / side % side), double(i / (side * side))});
    } else if (kind == "cospherical") {
      points.push_back(rational_sphere());
    } else if (kind == "plane") {
      const Vec3 p = cube();
      points.push_back({p.x, p.y, i < 4 ? p.z : 0.5});
    } else if (kind == "clusters") {
      const Vec3 center = i % 100 == 0 || points.empty() ? cube() : points[i - i % 100];
      points.push_back(center + 1e-4 * ball());
    } else {
      throw InputError("--points " + kind + ": unknown");
    }
  }
  return points;
}

constexpr const char* kKinds[] = {"cube", "sphere", "grid", "cospherical", "plane", "clusters"};

void measure(const std::string& name, const std::vector<Vec3>& points, int repeat) {
  double best = 1e300;
  Triangulation t;
  std::vector<SiteId> ids;
  for (int run = 0; run < repeat; ++run) {
    const std::clock_t start = std::clock();
    t.build(points, ids);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("%-12s %8zu points %8zu vertices %9zu cells %8.3f s %8.0f points/s\n", name.c_str(),
              points.size(), t.vertex_capacity() - 1, t.cell_capacity(), best,
              static_cast<double>(points.size()) / best);
}

}  // namespace

int main(int argc, char** argv) try {
  std::string kind, file;
  std::size_t n = 100000;
  int repeat = 3;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i], value = argv[i + 1];
    if (option == "--points")
      kind = value;
    else if (option == "--n")
      n = std::stoul(value);
    else if (option == "--xyz")
      file = value;
    else if (option == "--repeat")
      repeat = std::stoi(value);
    else
      throw InputError(option + ": unknown option");
  }
  if (!file.empty()) {
    measure(file, read_xyz(file), repeat);
  } else if (!kind.empty()) {
    measure(kind, make_points(kind, n), repeat);
  } else {
    for (const char* each : kKinds) measure(each, make_points(each, n), repeat);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_insert: %s\n", error.what());
  return 2;
}
