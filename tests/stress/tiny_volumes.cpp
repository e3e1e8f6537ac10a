// SPDX-License-Identifier: MIT
// Many random tiny volumes (tiny_volume.h) through mesh and check, and a table of what came out.
//   tiny_volumes [--first-seed N] [--count M] [--paper] [--rmin SHARE] [--embedded] [--matched]
//                [--list]
//   tiny_volumes --write SEED FILE.nrrd      one of them as a file, and its command line
// Seeds first-seed .. first-seed + count - 1 (1 .. 210), r_min a quarter of the largest spacing, or
// SHARE of it. They run in a child process. A crash or more than 60 s of processor time costs that
// one volume, and the rest goes on.
// --list names every seed with a fault, and those that took more than 2 s to mesh.
//
// Columns: volumes; of these crashed; hung; meshed in more than 2 s; with an invalid mesh
// (check_mesh, boundary off the box); with components of other topology than the exact contour's;
// with equal ones that verify() cannot match; with vertices at one
// position; with triangles that intersect; pairs of such triangles; volumes with vertices off the
// surface; triangles. Exit status 1 when a mesh is invalid, a run crashed or hung, or a topology is
// not exact. With --embedded it is 1 also when triangles intersect, with --matched when verify()
// disputes a component. With --paper the published program makes the meshes: none where 5,000
// vertices are not enough. Invalid are then only those of which it says that all vertices have a
// disk, and all topologies will do.
//
//   cmake --build build --target tiny_volumes
//   build/tests/tiny_volumes --count 20000 --list
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <string_view>

#include "base/check.h"
#include "base/text.h"
#include "paper/deliso.h"
#include "stress/in_child.h"
#include "stress/judge.h"
#include "stress/see_seed.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::string_view kProgram = "tiny_volumes";

// With --paper, which need not end by itself. Beyond it there is no mesh.
constexpr std::size_t kMostVertices = 5000;

struct Arguments {
  std::uint64_t first_seed = 1, count = 210;
  double r_min = 0.25;  // of the largest spacing
  bool paper = false, list = false, embedded = false, matched = false;
};

enum Column : std::size_t {
  volumes,
  crashes,
  hangs,
  slow,
  invalid,
  inexact,
  disputed,
  coincident,
  crossing,
  pairs,
  off_surface,
  triangles,
};
constexpr std::array<std::string_view, 12> kColumns{"volumes",  "crashes", "hangs",    "slow",
                                                    "invalid",  "inexact", "disputed", "coincid.",
                                                    "crossing", "pairs",   "off",      "triangles"};
using Counts = Row<kColumns.size()>;

// Returns the mesh of the volume by either program. Sets what judge() asks of the report.
TriMesh make_mesh(const TinyVolume& tiny, const Arguments& arguments, Report& report,
                  std::size_t& vertices_left) {
  const Vec3 spacing = tiny.volume.spacing();
  const double r_min = arguments.r_min * std::max({spacing.x, spacing.y, spacing.z});
  if (!arguments.paper) {
    Options options;
    options.r_min = {r_min};
    return mesh_isosurface(tiny.volume, tiny.isovalue, options, report);
  }
  paper::Options options;
  options.r_min = r_min / tiny.volume.box().smallest_side();
  options.max_vertices = kMostVertices;
  paper::Report counts;
  TriMesh mesh;
  try {
    mesh = paper::deliso(tiny.volume, tiny.isovalue, options, counts);
  } catch (const InputError&) {
  }
  report.kappa_effective = counts.kappa;
  vertices_left = counts.vertices_left;
  return mesh;
}

bool is_faulty(const Verdict& verdict, const Arguments& arguments) {
  return arguments.paper ? verdict.invalid : verdict.fault[0] != 0;
}

Verdict run(std::uint64_t seed, const Arguments& arguments) {
  const TinyVolume tiny = make_tiny_volume(seed);
  Report report;
  std::size_t vertices_left = 0;
  const std::clock_t start = std::clock();
  const TriMesh mesh = make_mesh(tiny, arguments, report, vertices_left);
  const std::clock_t meshed = std::clock();
  Faults faults;
  Verdict verdict = judge(tiny.volume, mesh, {}, report, faults);
  verdict.invalid &= vertices_left == 0;
  verdict.seconds_mesh = static_cast<double>(meshed - start) / CLOCKS_PER_SEC;
  verdict.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (is_faulty(verdict, arguments)) {
    see_seed(kProgram, seed, tiny.volume, report.kappa_effective, mesh, faults);
  }
  return verdict;
}

// What a tiny volume may take, in seconds of processor time.
bool is_slow(const Verdict& verdict) {
  return verdict.seconds_mesh > 2;
}

void add(Counts& row, const Verdict& verdict) {
  row += {{1, 0, 0, is_slow(verdict), verdict.invalid, !verdict.topology_exact, verdict.disputed,
           verdict.coincident > 0, verdict.intersections > 0, verdict.intersections,
           verdict.off_surface > 0, verdict.triangles},
          verdict.seconds};
}

std::string command_of(const TinyVolume& tiny, const std::string& file) {
  const Vec3 spacing = tiny.volume.spacing();
  const double r_min = 0.25 * std::max({spacing.x, spacing.y, spacing.z}) /
                       std::min({spacing.x, spacing.y, spacing.z});
  return text("deliso ", file, " --iso ", tiny.isovalue, " --rmin ", r_min, "vox --check");
}

void list(std::uint64_t seed, const char* what) {
  const TinyVolume tiny = make_tiny_volume(seed);
  const Index3 n = tiny.volume.dims();
  const std::string command = command_of(tiny, file_of_seed(kProgram, seed, tiny.volume));
  say("seed ", seed, " ", name_of(kind_of(seed)), " ", n.i, "x", n.j, "x", n.k, ": ", what, "\n  ",
      command);
}

int run_all(const Arguments& arguments) {
  Counts rows[kTinyKinds];
  const auto row_of = [&](std::uint64_t seed) -> Counts& {
    return rows[static_cast<std::size_t>(kind_of(seed))];
  };
  const bool forked = run_in_children<Verdict>(
      arguments.first_seed, arguments.first_seed + arguments.count, 60,
      [&](std::uint64_t seed) { return run(seed, arguments); },
      [&](std::uint64_t seed, const Verdict& verdict) {
        add(row_of(seed), verdict);
        if (arguments.list && is_faulty(verdict, arguments)) list(seed, verdict.fault);
        if (arguments.list && is_slow(verdict)) list(seed, "slow");
      },
      [&](std::uint64_t seed, bool hang) {
        ++row_of(seed)[volumes];
        ++row_of(seed)[hang ? hangs : crashes];
        list(seed, hang ? "hang" : "crash");
      });
  if (!forked) return 2;

  print_columns("kind", kColumns);
  Counts all;
  for (std::uint64_t n = 0; n < kTinyKinds; ++n) {
    rows[n].print(name_of(static_cast<TinyKind>(n)));
    all += rows[n];
  }
  all.print("all");
  const bool exact = arguments.paper || all[inexact] == 0;
  const bool embedded = !arguments.embedded || all[pairs] == 0;
  const bool matched = !arguments.matched || all[disputed] == 0;
  if (all[crashes] + all[hangs] + all[invalid] == 0 && exact && embedded && matched) return 0;
  tell_next_step(kProgram);
  return 1;
}

int write_one(std::uint64_t seed, const std::string& path) {
  const TinyVolume tiny = make_tiny_volume(seed);
  write_nrrd(tiny.volume, path);
  say(command_of(tiny, path));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  for (int n = 1; n < argc; ++n) {
    const std::string_view option = argv[n];
    const auto value = [&]() -> const char* { return n + 1 < argc ? argv[++n] : ""; };
    if (option == "--first-seed") {
      arguments.first_seed = std::strtoull(value(), nullptr, 10);
    } else if (option == "--count") {
      arguments.count = std::strtoull(value(), nullptr, 10);
    } else if (option == "--paper") {
      arguments.paper = true;
    } else if (option == "--rmin") {
      arguments.r_min = std::strtod(value(), nullptr);
    } else if (option == "--embedded") {
      arguments.embedded = true;
    } else if (option == "--matched") {
      arguments.matched = true;
    } else if (option == "--list") {
      arguments.list = true;
    } else if (option == "--write" && n + 2 < argc) {
      return write_one(std::strtoull(argv[n + 1], nullptr, 10), argv[n + 2]);
    } else {
      std::fprintf(stderr, "tiny_volumes: what is '%s'? (its source's head says)\n", argv[n]);
      return 2;
    }
  }
  return run_all(arguments);
}
