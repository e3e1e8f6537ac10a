// SPDX-License-Identifier: MIT
// Times insertions of Stage 2 (refine/operations.h) on a sphere. Points are inserted at the centers
// of surface balls, in the order of a queue, as RefineGeom does it. In a second pass the facets are
// random, so that the mesh around a point is not in the cache. Last, every edge is tested for a
// flip.
//   bench_mesh [POINTS ...]
// Prints nanoseconds of processor time per insertion and what was refused, and per edge.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <deque>
#include <numbers>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/triangle.h"
#include "check/check_mesh.h"
#include "contour/contour.h"
#include "io/volume/builtin_volume.h"
#include "refine/operations.h"
#include "run/options.h"
#include "support/coarsened_contour.h"

using namespace deliso;

namespace {

constexpr const char* kField = "builtin:sphere:64";

double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// r_min an eighth of the edges' length when `count` vertices are spread over the sphere: the gates
// are then those of Stage 2, and the grid's cells about as large as the facets.
Parameters parameters_for(std::size_t count, double area, const Volume& volume) {
  Options options;
  const double of_each = area / static_cast<double>(count);
  options.r_min = {0.125 * std::sqrt(of_each * 2 / std::numbers::sqrt3)};
  return resolve(options, volume);
}

// Inserts until the mesh has `count` vertices, then that many again at random facets.
class Insertion {
 public:
  Insertion(const Isosurface& surface, double area, std::size_t count)
      : parameters_(parameters_for(count, area, surface.volume())),
        coarsened_(coarsened_contour(surface, parameters_)),
        curves_(surface, coarsened_.loops),
        mesh_(coarsened_.mesh.mesh),
        refinement_(coarsened_.mesh, {surface, curves_, parameters_, report_}),
        count_(count) {}

  void run() {
    std::deque<FaceId> queue;
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) queue.push_back(f);
    measure("facet after facet", [&] {
      if (queue.empty() || mesh_.points.size() >= count_) return false;
      const FaceId f = queue.front();
      queue.pop_front();
      if (!insert(f)) return true;
      queue.insert(queue.end(), refinement_.created().begin(), refinement_.created().end());
      return true;
    });
    Random random(1);
    const std::size_t wanted = 2 * mesh_.points.size();
    std::size_t left = 4 * count_;
    measure("at random facets", [&] {
      if (mesh_.points.size() >= wanted || left-- == 0) return false;
      insert(FaceId(random.below(static_cast<std::uint32_t>(mesh_.faces.size()))));
      return true;
    });
    flip();
    remove_dead(coarsened_.mesh);
    const std::string fault = check_mesh(mesh_);
    if (!fault.empty()) throw InputError("the mesh broke: " + fault);
  }

 private:
  bool insert(FaceId f) {
    if (is_dead(mesh_.faces[f]) || !coarsened_.mesh.duals[f].on_surface) return false;
    const Vec3 p = coarsened_.mesh.duals[f].center;
    return !insert_point(refinement_, Operation::surface_point, f, p);
  }

  // step() is run until it says that it is done.
  template <class F>
  void measure(const char* order, F step) {
    const OperationCounts before = report_[Operation::surface_point];
    const SearchCounters searched = report_.searches_refine;
    const double start = seconds();
    while (step()) {
    }
    const double spent = seconds() - start;
    const OperationCounts& after = report_[Operation::surface_point];
    const auto done = static_cast<double>(after.done - before.done);
    std::uint64_t refused = 0;
    for (std::size_t r = 0; r < kRefusals; ++r) refused += after.refused[r] - before.refused[r];
    std::printf("%-18s %9.0f insertions  %7.0f ns each  %5.2f searches  %llu refused\n", order,
                done, 1e9 * spent / done,
                static_cast<double>(report_.searches_refine.searches - searched.searches) / done,
                static_cast<unsigned long long>(refused));
  }

  void flip() {
    std::size_t asked = 0;
    const double start = seconds();
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      for (int i = 0; i < 3 && !is_dead(mesh_.faces[f]); ++i) {
        flip_if_not_delaunay(refinement_, f, i);
        ++asked;
      }
    }
    std::printf("%-18s %9zu edges       %7.0f ns each  %llu flips\n", "every edge", asked,
                1e9 * (seconds() - start) / static_cast<double>(asked),
                static_cast<unsigned long long>(report_[Operation::flip].done));
  }

  Report report_;
  Parameters parameters_;
  Block coarsened_;
  BoundaryCurves curves_;
  const TriMesh& mesh_;
  Refinement refinement_;
  std::size_t count_;
};

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::size_t> counts{10'000, 100'000, 1'000'000};
  if (argc > 1) counts.clear();
  for (int n = 1; n < argc; ++n) counts.push_back(std::stoul(argv[n]));
  const Volume volume = make_builtin_volume(kField);
  const double kappa = geometric_isovalue(volume.type(), find_builtin_field(kField)->isovalue);
  const ContourMesh contour = build_contour(volume, kappa);
  double area = 0;
  for (const auto& t : contour.triangles) {
    area +=
        0.5 * length(area_normal(contour.points[t[0]], contour.points[t[1]], contour.points[t[2]]));
  }
  const Isosurface surface(volume, kappa);
  for (const std::size_t count : counts) {
    if (count < 1000) throw InputError("POINTS: at least 1000");
    Insertion(surface, area, count).run();
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_mesh: %s\n", error.what());
  return 2;
}
