// SPDX-License-Identifier: MIT
// The contour's topology of many random volumes against an oracle in exact arithmetic
// (tests/contour/exact_voxel.h).
//   exact_topology [--first-seed N] [--count M]
//   exact_topology VOLUME ISOVALUE
// Seeds first-seed .. first-seed + count - 1 (1 .. 600), each a volume of 2 to 5 samples along each
// axis: a third with samples of 10^-12 to 10^12 or with saddles at kappa to the last bits
// (tests/contour/wide_values.h), the others the tiny volumes (stress/tiny_volume.h). Prints each
// seed that differs, by how many components and how, and a table. Exit status 1 when one does.
// Or the volume of a file, whose topology is printed; it takes seconds.
//
//   cmake --build build --target exact_topology
//   build/tests/exact_topology --count 30000
//   build/tests/exact_topology engine.nhdr 40.1
#include <cstdio>
#include <string_view>

#include "contour/glued_topology.h"
#include "contour/wide_values.h"
#include "io/volume/read_volume.h"
#include "stress/see_seed.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::string_view kProgram = "exact_topology";
constexpr int kSmallest = 2, kLargest = 5;

struct Counts {
  std::uint64_t volumes = 0, different = 0, undecided = 0, components = 0;
};

TinyVolume make_volume(std::uint64_t seed, WideKind& kind, bool& is_wide) {
  is_wide = seed % 3 == 0;
  if (!is_wide) return make_tiny_volume(seed, kSmallest, kLargest);
  Random random(seed);
  // Half of them over magnitudes.
  kind = seed % 2 == 0 ? WideKind::magnitudes : static_cast<WideKind>(1 + random.below(2));
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) {
    dims[axis] = kSmallest + static_cast<int>(random.below(kLargest - kSmallest + 1));
  }
  const WideValues wide =
      make_wide_values(random, kind, static_cast<std::size_t>(dims.i * dims.j * dims.k));
  return {Volume::from_samples(dims, {1, 1, 1}, wide.samples), wide.kappa};
}

// Compares the topology of a file's volume. Returns the exit status.
int compare_file(const char* path, double isovalue) try {
  const Volume volume = read_volume(path);
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  const auto expected = glue_voxels(volume, kappa);
  const bool is_exact = expected && kinds_of(summarize_contour(volume, kappa)) == *expected;
  std::int64_t euler = 0;
  std::uint64_t loops = 0;
  for (const auto& [euler_of_component, loops_of_component] : expected.value_or(ComponentKinds{})) {
    euler += euler_of_component;
    loops += loops_of_component;
  }
  say(path, ": exactly ", expected ? expected->size() : 0, " components, Euler number ", euler,
      ", ", loops, " boundary loops; the contour ",
      is_exact ? "has the same, one by one" : "differs");
  return is_exact ? 0 : 1;
} catch (const InputError& error) {
  say(error.what());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && argv[1][0] != '-') return compare_file(argv[1], std::atof(argv[2]));
  const auto seeds = parse_seeds(argc, argv, "exact_topology", 600);
  if (!seeds) return 2;
  const std::uint64_t first_seed = seeds->first, count = seeds->count;
  constexpr const char* kNames[] = {"magnitudes", "half-way", "near ties", "tiny volumes"};
  Counts counts[kWideKinds + 1];
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    WideKind kind{};
    bool is_wide = false;
    const TinyVolume tiny = make_volume(seed, kind, is_wide);
    Counts& row = counts[is_wide ? static_cast<std::size_t>(kind) : kWideKinds];
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    const auto expected = glue_voxels(tiny.volume, kappa);
    ++row.volumes;
    if (!expected) {
      ++row.undecided;
      continue;
    }
    row.components += expected->size();
    const ComponentKinds found = kinds_of(summarize_contour(tiny.volume, kappa));
    if (found == *expected) continue;
    ++row.different;
    const TriMesh contour = test::contour_mesh(build_contour(tiny.volume, kappa), {});
    say("seed ", seed, " (", kNames[is_wide ? static_cast<int>(kind) : kWideKinds], ", ",
        file_of_seed(kProgram, seed, tiny.volume), "): ", found.size(), " components, exactly ",
        expected->size(), test::see(text(kProgram, "-", seed), {{"contour", contour}}, {}));
  }
  std::printf("%-14s %10s %10s %10s %10s\n", "kind", "volumes", "different", "undecided",
              "components");
  std::uint64_t faults = 0;
  for (int n = 0; n <= kWideKinds; ++n) {
    const Counts& row = counts[n];
    faults += row.different + row.undecided;
    std::printf("%-14s %10llu %10llu %10llu %10llu\n", kNames[n],
                static_cast<unsigned long long>(row.volumes),
                static_cast<unsigned long long>(row.different),
                static_cast<unsigned long long>(row.undecided),
                static_cast<unsigned long long>(row.components));
  }
  return faults == 0 ? 0 : 1;
}
