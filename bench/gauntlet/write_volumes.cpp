// SPDX-License-Identifier: MIT
// Writes the volumes of the gauntlet: those of the storm of options (tests/stress/option_volume.h)
// that have a surface, and crops of the paper's volumes that are in the folder DATA: the cubes of
// 16 samples around the points at a fifth, two, three and four fifths of each side. Every other one
// gets a layer of its least sample all around, so that its surface does not meet the box.
//   gauntlet_volumes FIRST_SEED COUNT FOLDER [DATA]
// Prints a line for each: seed, or data set and first sample; kind, isovalue, and `closed` or
// `open` as its surface is.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.h"
#include "contour/contour.h"
#include "stress/option_volume.h"
#include "support/datasets.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr int kCrop = 16;

Volume with_layer(const Volume& volume) {
  return volume.visit([&]<class T>(const T* samples) {
    const Index3 n = volume.dims(), padded{n.i + 2, n.j + 2, n.k + 2};
    const T least = *std::min_element(samples, samples + volume.sample_count());
    std::vector<T> values;
    for_each_index(padded, [&](int i, int j, int k) {
      const bool inner = std::min({i, j, k}) > 0 && i <= n.i && j <= n.j && k <= n.k;
      values.push_back(inner ? samples[volume.index(i - 1, j - 1, k - 1)] : least);
    });
    return Volume::from_samples(padded, volume.spacing(), values);
  });
}

// Writes a volume unless it has no surface. `n`: the number of those before.
bool write_volume(Volume volume, double isovalue, const std::string& name, std::string_view kind,
                  long n, const std::string& folder) {
  if (n % 2 == 0) volume = with_layer(volume);
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  const TopologyCounts truth = summarize_contour(volume, kappa).topology();
  if (truth.components == 0) return false;
  write_nrrd(volume, text(folder, "/", name, ".nrrd"));
  std::printf("%s %s %.17g %s\n", name.c_str(), std::string(kind).c_str(), isovalue,
              truth.boundary_loops == 0 ? "closed" : "open");
  return true;
}

void write_crops(const Dataset& dataset, const std::string& data, const std::string& folder) {
  const OpenedDataset opened = open_dataset(dataset, data);
  if (opened.is_analogue) return;
  const Volume& whole = opened.volume;
  const Index3 n = whole.dims(), side{kCrop, kCrop, kCrop};
  long written = 0;
  for_each_index({4, 4, 4}, [&](int i, int j, int k) {
    const Index3 at{n.i * (i + 1) / 5 - kCrop / 2, n.j * (j + 1) / 5 - kCrop / 2,
                    n.k * (k + 1) / 5 - kCrop / 2};
    Volume crop = whole.visit([&]<class T>(const T* samples) {
      std::vector<T> values;
      for_each_index(side, [&](int di, int dj, int dk) {
        values.push_back(samples[whole.index(at.i + di, at.j + dj, at.k + dk)]);
      });
      return Volume::from_samples(side, whole.spacing(), values);
    });
    written +=
        write_volume(std::move(crop), opened.isovalue,
                     text(dataset.name, "-", at.i, "-", at.j, "-", at.k), "real", written, folder);
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fputs("usage: gauntlet_volumes FIRST_SEED COUNT FOLDER [DATA]\n", stderr);
    return 2;
  }
  std::uint64_t seed = std::strtoull(argv[1], nullptr, 10);
  for (long left = std::atol(argv[2]); left > 0; ++seed) {
    auto [kind, tiny, labels, coordinates] = make_option_volume(seed);
    left -= write_volume(std::move(tiny.volume), tiny.isovalue, text(seed), kind, left, argv[3]);
  }
  if (argc == 4) return 0;
  for (const Dataset& dataset : read_datasets(DELISO_DATASETS)) {
    write_crops(dataset, argv[4], argv[3]);
  }
  return 0;
}
