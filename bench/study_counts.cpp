// SPDX-License-Identifier: MIT
// The paper's vertex counts do not follow from the criteria that it states: which reading of them
// comes closest? By the paper's way, one run each: half a minute on the paper's
// volumes.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/runs.h"

using namespace deliso;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Reading {
  std::string name;
  Options options;
  double log_ratios = 0;  // of vertices, ours over the paper's
  double log_errors = 0;  // their absolute values
  std::size_t count = 0;
};

std::vector<Reading> readings(const BenchArguments& arguments) {
  const Options stated = paper_options(arguments);
  std::vector<Reading> all;
  const auto add = [&](const char* name) -> Options& {
    all.push_back({name, stated});
    return all.back().options;
  };
  add("as stated");
  add("pole: the further one").pole_side = PoleSide::further;
  add("without r/h_sigma").epsilon2 = kInfinity;
  add("without h/r in Stage 2").epsilon1 = kInfinity;
  add("r_min half a voxel").r_min = {0.5, true};
  return all;
}

// The same samples a unit apart: the paper does not say that LEG's are not.
OpenedDataset with_unit_spacing(const OpenedDataset& opened) {
  const Volume& v = opened.volume;
  return opened.volume.visit([&](const auto* samples) {
    using T = std::remove_cvref_t<decltype(*samples)>;
    const std::vector<T> copy(samples, samples + v.sample_count());
    return OpenedDataset{Volume::from_samples(v.dims(), {1, 1, 1}, copy), opened.isovalue,
                         opened.is_analogue, opened.data + " at 1:1:1", opened.remarks};
  });
}

int work(const BenchArguments& arguments) {
  Table table("Readings of the criteria, paper's way",
              {"data set", "data", "reading", "paper n_RC", "n_RC", "ratio", "paper n_RF", "n_RF",
               "ratio", "vertices", "ratio"},
              3);
  std::vector<Reading> all = readings(arguments);
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    if (opened.is_analogue) continue;
    const PaperFigures& paper = dataset.paper;
    const double of_paper = paper.n_recover + paper.n_refine;
    const auto run = [&](const OpenedDataset& input, const Reading& reading) {
      const Report r = run_once(input, reading.options).last();
      const double n_rc = count(r.points_recovered), n_rf = count(r.points_refined);
      table.add({dataset.name, input.data, reading.name, count_cell(paper.n_recover),
                 count_cell(n_rc), ratio_cell(n_rc, paper.n_recover), count_cell(paper.n_refine),
                 count_cell(n_rf), ratio_cell(n_rf, paper.n_refine), count_cell(n_rc + n_rf),
                 ratio_cell(n_rc + n_rf, of_paper)});
      return (n_rc + n_rf) / of_paper;
    };
    for (Reading& reading : all) {
      const double ratio = run(opened, reading);
      reading.log_ratios += std::log(ratio);
      reading.log_errors += std::fabs(std::log(ratio));
      ++reading.count;
    }
    const Vec3 s = opened.volume.spacing();
    if (s.x == s.y && s.y == s.z) continue;
    const OpenedDataset unit = with_unit_spacing(opened);
    for (const Reading& reading : all) run(unit, reading);
  }
  Table summary("Readings, over the data sets", {"reading", "mean ratio", "mean factor off"}, 1);
  for (const Reading& reading : all) {
    const double n = count(reading.count);
    summary.add({reading.name, fixed_cell(std::exp(reading.log_ratios / n), 2),
                 fixed_cell(std::exp(reading.log_errors / n), 2)});
  }
  summary.remark(
      "Vertices, ours over the paper's: geometric mean, and the geometric mean of how far off, "
      "either way. LEG in its own spacing; data sets not at hand are left out.");
  print_table(table, arguments);
  print_table(summary, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "Which reading of the criteria gives the paper's vertex counts?",
                   work);
}
