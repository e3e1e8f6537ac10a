// SPDX-License-Identifier: MIT
// Random label volumes (label_volumes.h) through the mesh of their borders, and the counts of an
// oracle (label_oracle.h).
//   stress_labels [--first-seed N] [--count M] [--complex] [--list]
// The seed also says which options are on: caps, the side of a block (one block, 4, 8 or the
// usual), a number of vertices, the distance, r_min, Stage 1 alone. Each volume is meshed in one
// thread and in 2 and 3, and the topology of its mirror images is counted. It runs in a child
// process, and a crash or 120 s cost that one seed. With
// --complex T_L is looked at instead of the mesh. Exit status 1 when a body's surface is no
// manifold (closed, or open on the box), has another topology than the simplices of its samples
// say, or than is told; when facets cross, are flat or there twice; when a vertex has left the box;
// when a run is refused; when the mesh is another one in more threads; or when a mirror image has
// another topology.
//
//   cmake --build build --target stress_labels
//   build/tests/stress_labels --count 5000 --list
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "more/bodies/bodies.h"
#include "more/bodies/label_complex.h"
#include "stress/in_child.h"
#include "stress/label_mirrors.h"
#include "stress/label_oracle.h"
#include "stress/label_volumes.h"
#include "stress/see_seed.h"
#include "stress/seeds.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::string_view kProgram = "stress_labels";
constexpr unsigned kMostSeconds = 120;

// The options of a seed, and as words of a command line.
struct DrawnOptions {
  Options options;
  std::string words;
};

DrawnOptions draw_options(std::uint64_t seed) {
  Random random(seed * 104729);
  DrawnOptions drawn;
  Options& o = drawn.options;
  const auto say = [&](auto&&... words) { drawn.words += text(" --", words...); };
  o.cap = random.below(2) == 0;
  if (o.cap) say("cap");
  constexpr int kSides[] = {0, 4, 8, Options::kUsualSide};
  o.block_side = kSides[random.below(4)];
  if (o.block_side != Options::kUsualSide) say("block-side ", o.block_side);
  if (random.below(6) == 0) {
    o.target_vertices = 20 + random.below(400);
    say("vertices ", o.target_vertices);
  } else if (random.below(4) == 0) {
    const double voxels = random.below(2) == 0 ? 0.03 : 0.5;
    o.limits[Criterion::distance] = {voxels, Length::Unit::voxel};
    say("max-distance ", voxels, "vox");
  }
  if (random.below(4) == 0) {
    o.r_min = {random.below(2) == 0 ? 0.1 : 1, Length::Unit::voxel};
    say("rmin ", o.r_min.value, "vox");
  }
  o.stop_after_stage1 = random.below(10) == 0;
  if (o.stop_after_stage1) drawn.words += " (Stage 1 alone)";
  return drawn;
}

// POD, so that it can go through a pipe.
struct Verdict {
  char fault[300] = "";
  bool refused = false;
  bool differs = false;  // in more threads
  std::uint64_t facets = 0;
  double seconds = 0;
};

InterfaceMesh meshed(const Partition& partition, Options options, int threads) {
  options.threads = threads;
  Report report;
  return mesh_interfaces(partition, options, report);
}

// Writes the mesh, T_L and the facets that cross, and prints the commands that show them.
void see(std::uint64_t seed, const Partition& partition, const InterfaceMesh& mesh) {
  if (!test::folder_to_see()) return;
  const auto as_mesh = [](const std::vector<Vec3>& points, const auto& facets) {
    std::vector<Triangle> triangles;
    for (const auto& facet : facets) triangles.push_back(facet.v);
    return make_tri_mesh(points, triangles);
  };
  const LabelComplex complex = label_complex(partition, {{0, 0, 0}, partition.shape().voxels()});
  const TriMesh all = as_mesh(mesh.points, mesh.facets);
  const std::string name = text(kProgram, "-", seed);
  const std::string commands = test::see(
      name, {{"mesh", all}, {"contour", as_mesh(complex.sheets.points, complex.sheets.facets)}},
      {{"fault", test::facets_alone(all, test::facets_at_fault(all, {}))}});
  say(name, " is seen by", commands);
}

std::string fault_of_mesh(std::uint64_t seed, const Partition& partition, Verdict& verdict) {
  const Options options = draw_options(seed).options;
  const InterfaceMesh mesh = meshed(partition, options, 1);
  verdict.facets = mesh.facets.size();
  std::string fault = mesh_fault(partition, LabelOracle(partition), mesh, options.cap);
  for (const int threads : {2, 3}) {
    const InterfaceMesh again = meshed(partition, options, threads);
    if (again.points == mesh.points && again.facets == mesh.facets) continue;
    verdict.differs = true;
    fault += text(fault.empty() ? "" : "; ", "another mesh in ", threads, " threads");
  }
  if (!fault.empty()) see(seed, partition, mesh);
  return fault;
}

Verdict run(std::uint64_t seed, bool only_complex) {
  Verdict verdict;
  std::string fault;
  const Stopwatch watch;
  try {
    const LabelVolume labels = make_label_volume(seed);
    const Partition partition = partition_of(labels);
    if (only_complex) {
      const int axis = static_cast<int>(seed % 3);
      fault = complex_fault(partition, LabelOracle(partition), axis,
                            partition.shape().voxels()[axis] / 2);
    } else {
      fault = fault_of_mesh(seed, partition, verdict);
    }
    if (fault.empty()) fault = fault_of_mirrors(labels, partition);
  } catch (const InputError& error) {
    verdict.refused = true;
    fault = error.what();
  }
  verdict.seconds = watch.seconds();
  fault.copy(verdict.fault, sizeof verdict.fault - 1);
  return verdict;
}

void list(std::uint64_t seed, std::string_view what) {
  const LabelVolume labels = make_label_volume(seed);
  const Index3 n = labels.volume.dims();
  const Vec3 s = labels.volume.spacing();
  const std::string file = file_of_seed(kProgram, seed, labels.volume);
  say("seed ", seed, " ", name_of(label_kind_of(seed)), " ", n.i, "x", n.j, "x", n.k, " ", s.x, ":",
      s.y, ":", s.z, ": ", what, "\n  deliso ", file, " --label all --shared shared.ply",
      labels.words(), draw_options(seed).words);
}

constexpr std::array<std::string_view, 6> kColumns{"volumes",   "faulty", "refused",
                                                   "differing", "died",   "facets"};
constexpr std::size_t kFaulty = 1;

int run_all(const Seeds& seeds, bool only_complex) {
  using Row = stress::Row<kColumns.size()>;
  std::array<Row, kLabelKinds> rows;
  const auto row_of = [&](std::uint64_t seed) -> Row& { return rows[seed % kLabelKinds]; };
  const bool forked = run_in_children<Verdict>(
      seeds.first, seeds.first + seeds.count, kMostSeconds,
      [&](std::uint64_t seed) { return run(seed, only_complex); },
      [&](std::uint64_t seed, const Verdict& verdict) {
        const bool is_faulty = verdict.fault[0] != 0;
        row_of(seed) +=
            {{1, is_faulty, verdict.refused, verdict.differs, 0, verdict.facets}, verdict.seconds};
        if (is_faulty && seeds.list) list(seed, verdict.fault);
      },
      [&](std::uint64_t seed, bool hung) {
        row_of(seed) += {{1, 1, 0, 0, 1, 0}, 0};
        list(seed, hung ? "hung" : "crashed");
      });
  if (!forked) return 2;
  print_columns("kind", kColumns);
  Row all;
  for (std::uint64_t kind = 0; kind < kLabelKinds; ++kind) {
    rows[kind].print(name_of(static_cast<LabelKind>(kind)));
    all += rows[kind];
  }
  all.print("all");
  if (all[kFaulty] > 0) tell_next_step(kProgram);
  return all[kFaulty] > 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  const bool only_complex = std::erase_if(words, [](const char* word) {
                              return std::string_view(word) == "--complex";
                            }) > 0;
  const auto seeds =
      parse_seeds(static_cast<int>(words.size()), words.data(), "stress_labels", 100);
  return seeds ? run_all(*seeds, only_complex) : 2;
}
