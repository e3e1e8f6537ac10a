// SPDX-License-Identifier: MIT
// An oracle from outside for the topology. The exact topology is that of contour/, which the mesher
// and `deliso check` share. Here it stands beside counts without anything of contour/: by the signs
// of g at points n times as dense as the samples (support/oversampled_topology.h). n grows until
// both rules for faces with alternating corners give the same components, and to 15 at least. Three
// minutes on the paper's volumes, most of them for BABY2 at n = 63.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "contour/contour.h"
#include "support/oversampled_topology.h"
#include "support/runs.h"

using namespace deliso;

namespace {

// At 7 cells and fewer both rules agreed on components that Sigma does not have, for up to 51 of
// 5,000 tiny random volumes (tests/stress/tiny_volume.h, 2 to 6 samples a side); at 15 for none.
constexpr std::array kFactors{1, 2, 3, 5, 7, 15, 31, 63};
constexpr int kLeastLastFactor = 15;

// By the first of kFactors.
std::vector<OversampledTopology> oversample(const Volume& volume, double kappa) {
  std::vector<OversampledTopology> found;
  for (const int n : kFactors) {
    found.push_back(oversampled_topology(volume, kappa, n));
    if (n >= kLeastLastFactor && found.back().rules_agree()) break;
  }
  return found;
}

// The exact components as the oracle lists its own.
OversampledComponents listed(const ContourSummary& exact) {
  OversampledComponents components;
  for (const ContourComponent& component : exact.components) {
    components.push_back({component.euler, component.boundary_loops});
  }
  std::sort(components.begin(), components.end());
  return components;
}

std::string counts_cell(const TopologyCounts& counts) {
  return std::to_string(counts.components) + ", " + std::to_string(counts.euler) + ", " +
         std::to_string(counts.boundary_loops);
}

int work(const BenchArguments& arguments) {
  std::vector<std::string> header{"data set", "data", "inside"};
  for (const int n : kFactors) header.push_back("n = " + std::to_string(n));
  header.insert(header.end(), {"exact", "exact from n"});
  Table table("Components, Euler number, boundary loops: by signs on samples n times as fine",
              header, 3);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const double kappa = geometric_isovalue(opened.volume.type(), opened.isovalue);
    const ContourSummary exact = summarize_contour(opened.volume, kappa);
    const OversampledComponents expected = listed(exact);
    const std::vector<OversampledTopology> found = oversample(opened.volume, kappa);
    for (const bool apart : {true, false}) {
      const auto components = [&](std::size_t f) -> const OversampledComponents& {
        return apart ? found[f].inside_apart : found[f].inside_joined;
      };
      std::vector<std::string> row{dataset.name, opened.data, apart ? "apart" : "joined"};
      for (std::size_t f = 0; f < kFactors.size(); ++f) {
        row.push_back(f < found.size() ? counts_cell(counts_of(components(f))) : "");
      }
      row.push_back(counts_cell(exact.topology()));
      std::size_t from = found.size();
      while (from > 0 && components(from - 1) == expected) --from;
      row.push_back(from < found.size() ? std::to_string(kFactors[from]) : "-");
      table.add(row);
    }
    if (!found.back().rules_agree()) table.remark(dataset.name + ": the rules never agreed.");
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "Inside: where the corners of a cell's face are inside and outside in turn, the inside ones "
      "are kept apart or joined. n = 1 with these apart is Marching Cubes on the samples.");
  table.remark(
      "n grows until both give the same components. Exact from n: from there on the components "
      "have, one by one, the Euler numbers and boundary loops of the contour's.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "The topology by signs on finer samples, beside the exact one.",
                   work);
}
