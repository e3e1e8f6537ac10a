// SPDX-License-Identifier: MIT
// Stage 2's insertion, without a surface: find_encroached_disk and replace_disk on the unit sphere,
// where the surface point of a facet is known in closed form. Points are inserted at the centers of
// surface balls, facet after facet in the order of a queue, as RefineGeom does it; in a second pass
// at random facets, so that no insertion finds the mesh around it in the cache.
//   bench_mesh [POINTS ...]
// Prints nanoseconds of processor time per insertion, and how many facets each one replaced.
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <deque>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/triangle.h"
#include "mesh/check_mesh.h"
#include "mesh/encroach.h"
#include "mesh/tri_mesh.h"

using namespace deliso;

namespace {

double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Where the dual line of a facet with corners on the unit sphere meets it.
Vec3 surface_point(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = area_normal(a, b, c);
  return n / length(n);
}

TriMesh octahedron() {
  const std::vector<Vec3> points{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                 {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  const std::vector<Triangle> triangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  TriMesh mesh = make_tri_mesh(points, triangles);
  for (const Triangle& v : triangles) {
    mesh.surface_points.push_back(surface_point(points[v[0]], points[v[1]], points[v[2]]));
  }
  return mesh;
}

// Inserts until the mesh has `count` vertices, then that many again at random facets.
class Insertion {
 public:
  explicit Insertion(std::size_t count) : mesh_(octahedron()), count_(count) {
    mesh_.points.reserve(2 * count);
    mesh_.faces.reserve(4 * count);
    mesh_.surface_points.reserve(4 * count);
  }

  void run() {
    std::deque<FaceId> queue;
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) queue.push_back(f);
    report("facet after facet", count_ - mesh_.points.size(), [&] {
      const FaceId f = queue.front();
      queue.pop_front();
      insert(f);
      for (const FaceId created : created_) queue.push_back(created);
    });
    Random random(1);
    report("at random facets", count_,
           [&] { insert(random.below(static_cast<std::uint32_t>(mesh_.faces.size()))); });
    const std::string fault = check_mesh(mesh_);
    if (!fault.empty()) throw InputError("the mesh broke: " + fault);
  }

 private:
  void insert(FaceId f) {
    const Vec3 p = mesh_.surface_points[f];
    marks_.resize(mesh_.faces.size(), 0);
    if (!find_encroached_disk(mesh_, f, p, marks_, ++stamp_, disk_)) {
      created_.clear();
      return;
    }
    points_.clear();
    for (const RimEdge& edge : disk_.rim) {
      points_.push_back(surface_point(mesh_.points[edge.from], mesh_.points[edge.to], p));
    }
    encroached_ += disk_.faces.size();
    ++inserted_;
    replace_disk(mesh_, disk_, p, points_, std::nullopt, created_);
  }

  template <class F>
  void report(const char* order, std::size_t times, F step) {
    encroached_ = inserted_ = 0;
    const double start = seconds();
    for (std::size_t n = 0; n < times; ++n) step();
    const double spent = seconds() - start;
    std::printf("%-18s %9zu insertions  %7.0f ns each  %5.2f facets replaced\n", order, inserted_,
                1e9 * spent / static_cast<double>(times),
                static_cast<double>(encroached_) / static_cast<double>(inserted_));
  }

  TriMesh mesh_;
  std::size_t count_;
  std::vector<std::uint32_t> marks_;
  std::uint32_t stamp_ = 0;
  EncroachedDisk disk_;
  std::vector<Vec3> points_;
  std::vector<FaceId> created_;
  std::size_t encroached_ = 0, inserted_ = 0;
};

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::size_t> counts{10'000, 100'000, 1'000'000};
  if (argc > 1) counts.clear();
  for (int n = 1; n < argc; ++n) counts.push_back(std::stoul(argv[n]));
  for (const std::size_t count : counts) {
    if (count < 10) throw InputError("POINTS: at least 10");
    Insertion(count).run();
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_mesh: %s\n", error.what());
  return 2;
}
