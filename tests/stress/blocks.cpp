// SPDX-License-Identifier: MIT
// Random volumes (tiny_volume.h, 8 to 20 samples along each axis) meshed in blocks, joined, and
// checked as a whole.
//   stress_blocks [--first-seed N] [--count M] [--list]
// The seed also says into how many blocks: 2x1x1, 1x2x2, 2x2x2, 3x3x3 or blocks of one voxel along
// an axis. Exit status 1 when parts do not join, or the whole is invalid, has another topology than
// the surface, or crosses itself.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/check.h"
#include "contour/contour.h"
#include "io/parts/in_blocks.h"
#include "stress/judge.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

Index3 blocks_for(std::uint64_t seed, Index3 dims) {
  constexpr Index3 kOf[] = {{2, 1, 1}, {1, 2, 2}, {2, 2, 2}, {3, 3, 3}, {2, 3, 1}};
  const std::uint64_t n = seed / kTinyKinds % 6;
  if (n < 5) return kOf[n];
  Index3 of{1, 1, 1};
  const int thin = static_cast<int>(seed % 3);
  of[thin] = dims[thin] - 1;
  return of;
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_blocks", 42);
  if (!seeds) return 2;
  const auto [first, count, list] = *seeds;
  std::uint64_t refused = 0, invalid = 0, inexact = 0, crossing = 0, other = 0, triangles = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const TinyVolume tiny = make_tiny_volume(seed, 8, 20);
    const Index3 of = blocks_for(seed, tiny.volume.dims());
    Report report;
    std::string fault;
    try {
      const TriMesh mesh = test::mesh_in_blocks(tiny.volume, of, tiny.isovalue, {}, report);
      report.kappa_effective = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
      const Verdict verdict = judge(tiny.volume, mesh, {}, report);
      triangles += verdict.triangles;
      invalid += verdict.invalid;
      inexact += !verdict.topology_exact;
      crossing += verdict.intersections > 0;
      fault = verdict.fault;
      other += !fault.empty() && !verdict.invalid && verdict.topology_exact &&
               verdict.intersections == 0;
    } catch (const InputError& error) {
      ++refused;
      fault = error.what();
    }
    if (list && !fault.empty()) {
      const Index3 n = tiny.volume.dims();
      std::printf("seed %llu %s %dx%dx%d %s in %dx%dx%d at %.17g: %s\n",
                  static_cast<unsigned long long>(seed),
                  std::string(name_of(kind_of(seed))).c_str(), n.i, n.j, n.k,
                  std::string(name_of(tiny.volume.type())).c_str(), of.i, of.j, of.k, tiny.isovalue,
                  fault.c_str());
      std::fflush(stdout);
    }
  }
  std::printf(
      "%llu volumes: %llu refused, %llu invalid, %llu of another topology, %llu crossing, %llu "
      "with other faults; %llu triangles\n",
      static_cast<unsigned long long>(count), static_cast<unsigned long long>(refused),
      static_cast<unsigned long long>(invalid), static_cast<unsigned long long>(inexact),
      static_cast<unsigned long long>(crossing), static_cast<unsigned long long>(other),
      static_cast<unsigned long long>(triangles));
  return refused + invalid + inexact + crossing > 0;
}
