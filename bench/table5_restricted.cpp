// SPDX-License-Identifier: MIT
// Table 5, which the paper does not have: its claim that Stage 2, without Del S, ends with
// Del S_2|Sigma. A fresh triangulation of the mesh's vertices tells (check/mesh_triangulation.h).
// Beside it stand the topology and the crossings of the mesh, and the same of a single stage, which
// has Del S until the end. Two minutes on the paper's volumes.
#include <algorithm>
#include <string>
#include <vector>

#include "check/mesh_triangulation.h"
#include "check/self_intersections.h"
#include "check/triangle_tree.h"
#include "check/validity.h"
#include "contour/contour.h"
#include "support/runs.h"
#include "support/single_stage.h"

using namespace deliso;

namespace {

std::vector<std::string> cells_of(const PublishedRuns& runs, const Volume& volume,
                                  const ContourMesh& contour) {
  Faults faults;
  const CleanMesh mesh = check_validity(runs.mesh, volume.box(), MayEnd::on_box, faults);
  const Isosurface surface(volume, runs.last().kappa);
  const VoronoiEdges edges = count_voronoi_edges(mesh, surface);
  const std::size_t triangles = mesh.triangles.size();
  const auto shown = [&](std::size_t n) { return edges.measured ? count_of(n) : "-"; };
  const double share = static_cast<double>(edges.restricted) /
                       static_cast<double>(std::max<std::size_t>(1, triangles));
  const TriangleTree tree(mesh.points, mesh.triangles);
  const Crossings crossings = find_crossings(mesh.points, mesh.triangles, tree);
  const TopologyCounts found = mesh.topology.counts(), exact = contour.summary.topology();
  const auto signed_cell = [](std::int64_t n) { return fixed_cell(static_cast<double>(n), 0); };
  return {count_of(triangles),
          shown(triangles - edges.delaunay),
          shown(triangles - edges.restricted),
          edges.measured ? fixed_cell(100 * share, 3) : "-",
          shown(edges.missing),
          shown(edges.multiple),
          count_of(found.components),
          count_of(exact.components),
          signed_cell(found.euler),
          signed_cell(exact.euler),
          count_of(crossings.pairs.size()) + (crossings.given_up.empty() ? "" : "+")};
}

int work(const BenchArguments& arguments) {
  Table table("Table 5: triangles that are restricted Delaunay, as published",
              {"data set", "stages", "data", "lines", "triangles", "not Delaunay", "not restricted",
               "restricted, %", "missing", "edges met twice", "components", "exact", "Euler number",
               "exact", "crossings"},
              3);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const Volume& volume = opened.volume;
    const ContourMesh contour =
        build_contour(volume, geometric_isovalue(volume.type(), opened.isovalue));
    const paper::Options options = published_options(opened);
    for (const bool single_stage : {false, true}) {
      const PublishedProgram program = single_stage ? single_stage_deliso : paper::deliso;
      std::vector<std::string> row{dataset.name, single_stage ? "one" : "two", opened.data,
                                   count_of(opened.lines)};
      for (std::string& cell : cells_of(run_once(opened, options, program), volume, contour)) {
        row.push_back(std::move(cell));
      }
      table.add(std::move(row));
    }
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "Of a triangulation made anew from the mesh's vertices: triangles that are no facets of it, "
      "or whose Voronoi edge misses Sigma; facets whose Voronoi edge meets Sigma but which the "
      "mesh "
      "lacks; Voronoi edges that meet Sigma several times. Crossings: pairs of triangles.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "Table 5, as published: the share of restricted Delaunay facets.",
                   work);
}
