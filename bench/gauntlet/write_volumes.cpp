// SPDX-License-Identifier: MIT
// Writes the volumes of the gauntlet: those of the storm of options (tests/stress/option_volume.h)
// that have a surface. Every other one gets a layer of its least sample all around, so that its
// surface does not meet the box.
//   gauntlet_volumes FIRST_SEED COUNT FOLDER
// Prints a line for each: seed, kind, isovalue, and `closed` or `open` as its surface is.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "base/text.h"
#include "contour/contour.h"
#include "stress/option_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: gauntlet_volumes FIRST_SEED COUNT FOLDER\n", stderr);
    return 2;
  }
  std::uint64_t seed = std::strtoull(argv[1], nullptr, 10);
  for (long left = std::atol(argv[2]); left > 0; ++seed) {
    auto [kind, tiny, labels, coordinates] = make_option_volume(seed);
    if (left % 2 == 0) tiny.volume = with_layer(tiny.volume);
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    const TopologyCounts truth = summarize_contour(tiny.volume, kappa).topology();
    if (truth.components == 0) continue;
    --left;
    write_nrrd(tiny.volume, text(argv[3], "/", seed, ".nrrd"));
    std::printf("%llu %s %.17g %s\n", static_cast<unsigned long long>(seed),
                std::string(kind).c_str(), tiny.isovalue,
                truth.boundary_loops == 0 ? "closed" : "open");
  }
  return 0;
}
