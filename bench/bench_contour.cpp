// SPDX-License-Identifier: MIT
// Compares the topology of the exact contour with the ground truth, and times it. It does so for
// the built-in fields and the eight (volume, isovalue) pairs of the paper's Table 1.
//   bench_contour [FOLDER] [--repeat R]
// FOLDER holds fuel.nhdr, atom.nhdr, ... Prints the best of R runs (5) in processor time: T, and
// the summary alone. Exit status 1 when a topology differs from the truth.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "contour/contour.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"

using namespace deliso;

namespace {

// (Euler number, boundary loops) of a component and how many components have them.
using Kinds = std::map<std::pair<std::int64_t, std::uint64_t>, std::size_t>;

// Found by two other programs before this one was written.
struct Truth {
  const char* volume;
  double isovalue;
  Kinds kinds;
};

const std::vector<Truth> kTruths{
    {"fuel", 70.1, {{{-7, 1}, 1}}},
    {"atom", 20.1, {{{0, 0}, 1}, {{2, 0}, 3}}},
    {"engine", 40.1, {{{-42, 0}, 1}, {{2, 0}, 7}}},
    {"leg", 22.1, {{{-11, 1}, 1}, {{-10, 2}, 1}, {{1, 1}, 2}, {{2, 0}, 11}}},
    {"tooth", 146.9, {{{-52, 0}, 1}, {{2, 0}, 46}}},
    {"baby", 35.8, {{{-30, 6}, 1}, {{-4, 4}, 1}, {{1, 1}, 4}, {{2, 0}, 165}}},
    {"baby", 131.6, {{{-274, 2}, 1}, {{-21, 1}, 1}, {{0, 0}, 1}, {{1, 1}, 2}, {{2, 0}, 117}}},
    {"aneurism", 124.6, {{{-78, 0}, 1}, {{0, 0}, 2}, {{2, 0}, 708}}},
};

template <class F>
double best_milliseconds(int repeat, F f) {
  double best = 1e300;
  for (int n = 0; n < repeat; ++n) {
    const std::clock_t start = std::clock();
    f();
    best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

// FNV-1a over the bytes of T, to compare builds and machines.
template <class T>
void hash_bytes(std::uint64_t& hash, const std::vector<T>& values) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  for (std::size_t n = 0; n < values.size() * sizeof(T); ++n) {
    hash = (hash ^ bytes[n]) * 0x100000001b3u;
  }
}

ContourSummary run(const std::string& name, const Volume& volume, double isovalue, int repeat) {
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  ContourMesh mesh;
  const double t_mesh = best_milliseconds(repeat, [&] {
    mesh = {};
    mesh = build_contour(volume, kappa);
  });
  const double t_summary = best_milliseconds(repeat, [&] { summarize_contour(volume, kappa); });
  std::uint64_t hash = 0xcbf29ce484222325u, tubes = 0;
  hash_bytes(hash, mesh.points);
  hash_bytes(hash, mesh.triangles);
  for (const auto& vertices : mesh.boundary.vertices) hash_bytes(hash, vertices);
  const ContourSummary& s = mesh.summary;
  for (const auto& component : s.components) tubes += component.tubes;
  std::printf("%-18s %6g %8llu %8zu %9zu %5zu %6lld %5llu %5llu %8.1f %8.1f  %016llx", name.c_str(),
              isovalue, static_cast<unsigned long long>(s.active_voxels), mesh.points.size(),
              mesh.triangles.size(), s.components.size(), static_cast<long long>(s.euler()),
              static_cast<unsigned long long>(s.boundary_loops()),
              static_cast<unsigned long long>(tubes), t_mesh, t_summary,
              static_cast<unsigned long long>(hash));
  return mesh.summary;
}

bool report(bool right) {
  std::printf("  %s\n", right ? "as it should be" : "WRONG");
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int repeat = 5;
  for (int n = 1; n < argc; ++n) {
    if (std::string(argv[n]) == "--repeat" && n + 1 < argc) {
      repeat = std::max(1, std::atoi(argv[++n]));
    } else {
      folder = argv[n];
    }
  }
  std::printf("%-18s %6s %8s %8s %9s %5s %6s %5s %5s %8s %8s  %-16s  topology\n", "volume", "kappa",
              "voxels", "vertices", "triangles", "comp", "euler", "loops", "tubes", "T ms",
              "sum ms", "hash of T");
  bool all_right = true;
  try {
    for (const BuiltinField& field : builtin_fields()) {
      const Volume volume = read_volume("builtin:" + std::string(field.name));
      const ContourSummary s = run(std::string(field.name), volume, field.isovalue, repeat);
      if (!field.topology) {
        std::printf("  unknown\n");
        continue;
      }
      all_right &= report(static_cast<int>(s.components.size()) == field.topology->components &&
                          s.euler() == field.topology->euler &&
                          static_cast<int>(s.boundary_loops()) == field.topology->boundary_loops);
    }
    if (folder.empty()) return all_right ? 0 : 1;
    for (const Truth& truth : kTruths) {
      const Volume volume = read_volume(folder + "/" + truth.volume + ".nhdr");
      Kinds kinds;
      for (const auto& c : run(truth.volume, volume, truth.isovalue, repeat).components) {
        ++kinds[{c.euler, c.boundary_loops}];
      }
      all_right &= report(kinds == truth.kinds);
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "bench_contour: %s\n", error.what());
    return 2;
  }
  return all_right ? 0 : 1;
}
