// SPDX-License-Identifier: MIT
// Table 1: the data sets, and what stands behind each name here: dimensions, samples, and the exact
// topology of the surface. Runs in seconds.
#include <cstdio>

#include "contour/contour.h"
#include "support/runs.h"

using namespace deliso;

namespace {

int work(const BenchArguments& arguments) {
  Table table("Table 1: data sets",
              {"data set", "data", "paper's isovalue", "paper's dims", "isovalue", "dims", "type",
               "samples", "components", "Euler number", "boundary loops", "boundary points",
               "active voxels"},
              2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const Volume& volume = opened.volume;
    const ValueRange range = value_range(volume);
    const ContourMesh mesh =
        build_contour(volume, geometric_isovalue(volume.type(), opened.isovalue));
    const ContourSummary& contour = mesh.summary;
    std::size_t boundary_vertices = 0;
    for (const BoundaryLoop& loop : mesh.boundary.loops) boundary_vertices += loop.size();
    table.add({dataset.name, opened.data, fixed_cell(dataset.isovalue, 1), dims_text(dataset.dims),
               fixed_cell(opened.isovalue, 1), dims_text(volume.dims()),
               std::string(name_of(volume.type())),
               fixed_cell(range.min, 0) + ".." + fixed_cell(range.max, 0),
               count_cell(static_cast<double>(contour.components.size())),
               fixed_cell(static_cast<double>(contour.euler()), 0),
               count_cell(static_cast<double>(contour.boundary_loops())),
               count_cell(static_cast<double>(boundary_vertices)),
               count_cell(static_cast<double>(contour.active_voxels))});
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "Components, Euler number and boundary loops are those of the trilinear surface; boundary "
      "points are the crossings of grid edges on the box, the vertices of marching squares.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "Table 1: the data sets, and what stands behind them here.", work);
}
