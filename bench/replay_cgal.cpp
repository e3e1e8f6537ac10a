// SPDX-License-Identifier: MIT
// What does a point of Recover cost in a program of 2007? Replays the points that the published
// program inserts, from S_0 to S_1, by CGAL's Delaunay triangulation and a kd-tree as the paper
// tells of it: a leaf for each voxel, Havran's recursion, Schwarze's roots. No queues, no tests.
// Built only where CGAL is. By inexact and by exact constructions, with one step more in each run.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <ctime>
#include <memory>

#include "isosurface/voxel_ray.h"
#include "support/runs.h"

using namespace deliso;

namespace {

struct Node {
  std::array<int, 3> lo, hi;  // voxels lo .. hi-1
  double least, largest;
  std::size_t axis;
  std::unique_ptr<Node> below, above;  // null: a voxel
};

std::unique_ptr<Node> build(const Volume& f, std::array<int, 3> lo, std::array<int, 3> hi) {
  auto node = std::make_unique<Node>(Node{lo, hi, 0, 0, 0, {}, {}});
  for (const std::size_t axis : {1u, 2u}) {
    if (hi[axis] - lo[axis] > hi[node->axis] - lo[node->axis]) node->axis = axis;
  }
  if (hi[node->axis] - lo[node->axis] == 1) {
    const Corners g = f.corners({lo[0], lo[1], lo[2]}, 0);
    std::tie(node->least, node->largest) =
        std::minmax({g[0], g[1], g[2], g[3], g[4], g[5], g[6], g[7]});
    return node;
  }
  const int middle = (lo[node->axis] + hi[node->axis]) / 2;
  std::array<int, 3> end = hi, begin = lo;
  end[node->axis] = begin[node->axis] = middle;
  node->below = build(f, lo, end);
  node->above = build(f, begin, hi);
  node->least = std::min(node->below->least, node->above->least);
  node->largest = std::max(node->below->largest, node->above->largest);
  return node;
}

// Figure 12's CollectVoxels: the voxels along the line's `range` whose samples have kappa between
// them.
void collect(const Node& node, const LatticeLine& line, Range range, double kappa,
             std::vector<VoxelSpan>& spans) {
  if (!(node.least <= kappa && kappa <= node.largest)) return;
  if (!node.below) {
    spans.push_back(line.span({node.lo[0], node.lo[1], node.lo[2]}, range));
    return;
  }
  const double split = line.at_plane(node.axis, node.below->hi[node.axis]);
  const bool ahead = line.ahead(node.axis) != 0;
  const Node &first = ahead ? *node.below : *node.above,
             &second = ahead ? *node.above : *node.below;
  if (range.lo < split) collect(first, line, {range.lo, smaller(range.hi, split)}, kappa, spans);
  if (split < range.hi) collect(second, line, {greater(range.lo, split), range.hi}, kappa, spans);
}

// The sites of S_0, and the points that Recover inserts, in order.
class Recorder : public paper::Observer {
 public:
  void insertion_begins(const Vec3& p, const ConflictZone&) override { points.push_back(p); }
  std::vector<Vec3> points;
  std::size_t of_sample = 0;
};

Recorder recorded(const OpenedDataset& opened, double kappa) {
  const VoxelTree tree(opened.volume);
  paper::Options options = published_options(opened);
  paper::Sigma sigma(tree, kappa, options.solver);
  paper::Report report;
  report.r_min = options.r_min * opened.volume.box().smallest_side();
  Recorder recorder;
  options.observer = &recorder;
  paper::Recovery s = init_triangulation(sigma, options, report);
  const Triangulation& del = s.del().del();
  for (SiteId q = 1; q < del.vertex_capacity(); ++q) recorder.points.push_back(del.point(q));
  recorder.of_sample = recorder.points.size();
  s.recover();
  return recorder;
}

enum Steps { insert, identify, dual, traverse, solve, all_steps };
constexpr std::array kStepNames{"insert", "identify", "dual", "kd-tree", "cubics"};

// Returns microseconds of CPU time a point of Recover, with all steps up to `last`.
template <class Kernel>
double replay(const Recorder& run, const Volume& f, const Node& root, double kappa, Steps last) {
  using Del = CGAL::Delaunay_triangulation_3<Kernel>;
  using Point = typename Kernel::Point_3;
  const auto point = [](const Vec3& p) { return Point(p.x, p.y, p.z); };
  const auto vec = [](const auto& p) {
    return Vec3{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  };
  Del del;
  for (std::size_t n = 0; n < run.of_sample; ++n) del.insert(point(run.points[n]));
  const VoxelUnits units(f);
  std::vector<typename Del::Cell_handle> cells;
  std::vector<VoxelSpan> spans;
  std::size_t found = 0;
  const std::clock_t start = std::clock();
  for (std::size_t n = run.of_sample; n < run.points.size(); ++n) {
    const auto v = del.insert(point(run.points[n]));
    if (last < identify) continue;
    cells.clear();
    del.finite_incident_cells(v, std::back_inserter(cells));
    for (const auto& cell : cells) {
      for (int i = 0; i < 4; ++i) {
        const typename Del::Facet facet{cell, i};
        if (del.is_infinite(facet) || (cell->vertex(i) != v && cell->neighbor(i) < cell)) continue;
        if (last < dual) continue;
        const CGAL::Object voronoi = del.dual(facet);
        const auto* edge = CGAL::object_cast<typename Kernel::Segment_3>(&voronoi);
        if (!edge || last < traverse) continue;  // rays begin far outside the box
        const Vec3 a = vec(edge->source()), b = vec(edge->target());
        const LatticeLine line = units.line(a, b - a);
        const Range range = line.clip({0, 1});
        if (!(range.lo < range.hi)) continue;
        spans.clear();
        collect(root, line, range, kappa, spans);
        if (last < solve) continue;
        for (const VoxelSpan& span : spans) {
          found += static_cast<std::size_t>(
              find_intersections(f.corners(span.voxel, kappa), span, CubicMethod::schwarze).count);
        }
      }
    }
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (last == solve && found == 0) throw InputError("the replay found no point of the surface");
  return 1e6 * seconds / static_cast<double>(run.points.size() - run.of_sample);
}

int work(const BenchArguments& arguments) {
  Table table("A point of Recover by CGAL, microseconds",
              {"data set", "data", "constructions", kStepNames[0], kStepNames[1], kStepNames[2],
               kStepNames[3], kStepNames[4], "all", "searching"},
              3);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const Volume& f = opened.volume;
    const double kappa = geometric_isovalue(f.type(), opened.isovalue);
    const Recorder run = recorded(opened, kappa);
    const Index3 n = f.voxels();
    const auto root = build(f, {0, 0, 0}, {n.i, n.j, n.k});
    const auto add = [&](const char* name, auto by) {
      std::vector<std::string> row{dataset.name, opened.data, name};
      double before = 0, insertion = 0;
      for (int step = insert; step < all_steps; ++step) {
        const auto last = static_cast<Steps>(step);
        const double so_far = std::min({by(last), by(last), by(last)});
        row.push_back(fixed_cell(so_far - before, 1));
        before = so_far;
        if (step == insert) insertion = so_far;
      }
      row.push_back(fixed_cell(before, 1));
      row.push_back(percent_cell(1 - insertion / before));
      table.add(std::move(row));
    };
    add("inexact", [&](Steps last) {
      return replay<CGAL::Exact_predicates_inexact_constructions_kernel>(run, f, *root, kappa,
                                                                         last);
    });
    add("exact", [&](Steps last) {
      return replay<CGAL::Exact_predicates_exact_constructions_kernel>(run, f, *root, kappa, last);
    });
  }
  table.remark(
      "Each step is the difference of two runs, the quickest of three each. Searching is all but "
      "the insertion.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "Recover's points replayed by CGAL, as a program of 2007 might.",
                   work);
}
