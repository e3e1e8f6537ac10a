// SPDX-License-Identifier: MIT
// Random volumes (tiny_volume.h) divided into small blocks (blocks/mesh_in_blocks.h).
//   stress_division [--first-seed N] [--count M] [--list]
// The seed also says which of --cap, --largest, --vertices and a spacing of 1:4 are on, and the
// side of a block, 4 to 8 voxels. Each volume is meshed in one thread and in 2, 3, 8 or 16. Exit
// status 1 when the two differ in a byte, or check finds a fault other than a triangle over a
// limit: another topology than the surface, two triangles that cross, a solid that is open.
#include <string>
#include <string_view>

#include "base/text.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "mesh/meshes.h"
#include "stress/judge.h"
#include "stress/see_seed.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::string_view kProgram = "stress_division";
constexpr int kThreads[] = {2, 3, 8, 16};

Options options_for(std::uint64_t seed) {
  Options options;
  options.block_side = 4 + static_cast<int>(seed / kTinyKinds % 5);
  const std::uint64_t kind = seed / kTinyKinds % 12;
  options.cap = kind % 3 == 0;
  if (kind == 1 || kind == 3) options.components.largest = 2;
  if (kind == 2 || kind == 6) options.target_vertices = 60;
  options.threads = 1;
  return options;
}

Volume stretched(const Volume& volume) {
  return volume.visit([&](const auto* samples) {
    const std::vector copy(samples, samples + volume.sample_count());
    return Volume::from_samples(volume.dims(), {1, 1, 4}, copy);
  });
}

// The components of the surface that the mesh should have; those of a solid with chosen components
// are others.
std::optional<ComponentKinds> expected_kinds(const Volume& volume, const Options& options,
                                             const Report& report) {
  if (options.cap && !options.components.is_all()) return {};
  ContourSummary summary = summarize_contour(volume, report.kappa_effective);
  const std::vector<std::uint8_t> chosen = chosen_components(summary, options.components);
  ContourSummary kept;
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    if (chosen[n] != 0) kept.components.push_back(summary.components[n]);
  }
  return kinds_of(kept);
}

// Returns the first triangles: the surface without the caps.
TriMesh surface_of(const TriMesh& mesh, std::size_t triangles) {
  TriMesh surface = mesh;
  surface.faces.resize(triangles);
  for (Face& face : surface.faces) {
    for (FaceId& g : face.n) {
      if (g != kNoId && g >= triangles) g = kNoId;
    }
  }
  return surface;
}

// How far vertices may be moved off Sigma (refine/separate.cpp), in voxels.
constexpr double kMovedVoxels = 0.001;

// Returns what is wrong with the mesh; empty: nothing. Sets `faults`, and `is_close` where the mesh
// is nearly flat on itself: that is counted, not ruled out. Boxes around the seams of blocks so
// small do not reach over each other, so places at their ends stay.
std::string fault_of(const Volume& volume, const TriMesh& mesh, const Options& options,
                     const Report& report, Faults& faults, bool& is_close) {
  using enum FaultKind;
  if (options.cap && !report.cap.failure.empty()) return "open: " + report.cap.failure;
  const std::size_t triangles = options.cap ? report.cap.surface_triangles : mesh.faces.size();
  const auto expected = expected_kinds(volume, options, report);
  if (expected && kinds_of(surface_of(mesh, triangles)) != *expected) {
    return "another topology";
  }
  VerifyOptions how;
  how.components = options.components;
  how.solid = options.cap;
  const Verification found = verify(mesh, volume, report.kappa_effective, how);
  faults = found.faults;
  for (const FaultKind kind : {needle_triangles, folds, near_vertices}) {
    is_close |= found.faults.count(kind) > 0;
  }
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    if (found.faults.count(kind) == 0 || kind == over_limits) continue;
    // Components are matched by distance, which is no proof; they are as many and of these kinds.
    if (kind == missing_components || kind == extra_components || kind == different_components ||
        kind == stray_vertices) {
      continue;
    }
    // Vertices that were moved off such a place may stay off Sigma when it is gone.
    const bool is_apart = kind == vertices_off_surface &&
                          (is_close || found.max_off_surface <= kMovedVoxels * volume.voxel());
    if (kind == needle_triangles || kind == folds || kind == near_vertices || is_apart) {
      is_close |= is_apart;
      continue;
    }
    return text(name_of(kind), ": ", found.faults.count(kind));
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_division", 63);
  if (!seeds) return 2;
  const auto [first, count, list] = *seeds;
  std::uint64_t differing = 0, refused = 0, faulty = 0, close = 0, triangles = 0,
                again_coarsened = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    TinyVolume tiny = make_tiny_volume(seed, 8, 20);
    if (seed / kTinyKinds % 4 == 1) tiny.volume = stretched(tiny.volume);
    Options options = options_for(seed);
    std::string fault;
    bool is_close = false;
    Faults faults;
    try {
      Report report, same;
      const TriMesh mesh = mesh_isosurface(tiny.volume, tiny.isovalue, options, report);
      options.threads = kThreads[seed % std::size(kThreads)];
      const TriMesh again = mesh_isosurface(tiny.volume, tiny.isovalue, options, same);
      fault = fault_of(tiny.volume, mesh, options, report, faults, is_close);
      close += is_close;
      faulty += !fault.empty();
      triangles += mesh.faces.size();
      again_coarsened += report[Counter::coarsened_again];
      if (!test::same_mesh(mesh, again)) {
        ++differing;
        fault += " another mesh in other threads";
      }
      if (!fault.empty()) {
        see_seed(kProgram, seed, tiny.volume, report.kappa_effective, mesh, faults,
                 {{"again", again}});
      }
    } catch (const InputError& error) {
      ++refused;
      fault = error.what();
    }
    if (list && !fault.empty()) {
      const Index3 n = tiny.volume.dims();
      const std::string file = file_of_seed(kProgram, seed, tiny.volume);
      say("seed ", seed, " ", name_of(kind_of(seed)), " ", n.i, "x", n.j, "x", n.k, " ",
          name_of(tiny.volume.type()), ": ", fault, "\n  deliso ", file, " --iso ", tiny.isovalue,
          " --block-side ", options.block_side, options.cap ? " --cap" : "",
          options.components.largest > 0 ? " --largest 2" : "",
          options.has_target() ? " --vertices 60" : "", " --check");
    }
  }
  say(count, " volumes: ", faulty, " with a fault, ", close, " nearly flat on itself, ", refused,
      " refused, ", differing, " another mesh in other threads; ", again_coarsened,
      " coarsened again; ", triangles, " triangles");
  if (faulty + refused + differing > 0) tell_next_step(kProgram);
  return faulty + refused + differing > 0 || 2 * close > count;
}
