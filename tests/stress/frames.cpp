// SPDX-License-Identifier: MIT
// A storm of frames: check reports the same of a volume that lies along the axes of the world and
// of one that lies turned, mirrored or sheared. Each random volume (option_volume.h) is meshed
// once, a third of them with caps; its vertices go to the world in each frame, as a file has them,
// and are verified there.
//   stress_frames [--first-seed N] [--count M] [--list]
// Seeds first-seed .. first-seed + count - 1 (1 .. 100), each in a child process. A seed is other
// where a kind of fault has another count, or a figure of the report differs by more than 1e-9 of
// itself. Exit status 1 when some are.
//
//   cmake --build build --target stress_frames
//   build/tests/stress_frames --count 1000 --list
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/bring_home.h"
#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "stress/in_child.h"
#include "stress/option_volume.h"
#include "stress/seeds.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::array<std::string_view, 4> kFrames{"as it is", "turned", "mirrored", "sheared"};

Vec3 direction(Random& random) {
  const Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  return length(p) > 0.1 ? p / length(p) : Vec3{0.6, 0, 0.8};
}

// Returns the frame of that number, about as far from the origin as scanners put it.
Frame frame_of(std::size_t n, double voxel, Random& random) {
  Frame frame;
  for (int axis = 0; axis < 3; ++axis) frame.origin[axis] = voxel * random.uniform(-200, 200);
  if (n == 0) return frame;
  const Vec3 u = direction(random), across = cross(u, Vec3{u.y, u.z, -u.x});
  const Vec3 v = across / length(across);
  frame.axes = {u, v, (n == 2 ? -1.0 : 1.0) * cross(u, v)};
  if (n < 3) return frame;
  for (Vec3& axis : frame.axes) {
    axis = axis + 0.3 * direction(random);
    axis = axis / length(axis);
  }
  return frame;
}

// The figures of a report, by name; those of faults by their kinds.
using Figures = std::vector<std::pair<std::string, double>>;

void add(Figures& all, std::string_view name, auto... values) {
  (all.emplace_back(name, static_cast<double>(values)), ...);
}

Figures figures_of(const Verification& v) {
  Figures all;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    add(all, name_of(kind), v.faults.count(kind));
  }
  const auto add_distances = [&](std::string_view name, const Distances& d) {
    add(all, name, d.points, d.max, d.mean, d.rms, d.quantile_999, d.not_found, d.beyond, d.too_far,
        d.given_up);
  };
  add(all, "mesh", v.mesh.components, v.mesh.euler, v.mesh.boundary_loops, v.equal_components,
      v.left_out);
  add(all, "off surface", v.max_off_surface);
  add(all, "delaunay", v.delaunay.delaunay, v.delaunay.restricted, v.delaunay.occupied,
      v.delaunay.without_ball);
  add_distances("to surface", v.to_surface);
  add_distances("from surface", v.from_surface);
  add(all, "quality", v.quality.min_angle, v.quality.max_angle, v.quality.mean_edge,
      v.quality.max_edge, v.quality.area);
  add(all, "over limits", v.over_a_limit);
  for (const std::size_t over : v.over.values) add(all, "over a limit", over);
  add(all, "above r_min", v.triangles_above_r_min, v.max_h_above_r_min, v.max_h_over_r_above_r_min);
  add(all, "boundary", v.boundary.edges, v.boundary.max_h, v.boundary.over_a_limit);
  const SolidSummary solid = v.solid.value_or(SolidSummary());
  add(all, "solid", solid.cap_triangles, solid.volume, solid.self_intersections, solid.close_places,
      solid.quality.area);
  return all;
}

// Returns what differs first, or an empty text. Lengths of rounding are as good as none.
std::string difference(const Figures& a, const Figures& b, double voxel) {
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double x = a[n].second, y = b[n].second;
    const double allowed = 1e-9 * std::max(std::fabs(x), std::fabs(y)) + 1e-11 * voxel;
    if (std::fabs(x - y) <= allowed) continue;
    return text(a[n].first, " ", x, ", not ", y);
  }
  return {};
}

// POD, so that it can go through a pipe.
struct Verdict {
  bool meshed = false;
  std::uint64_t faults = 0;  // of the volume as it is
  std::array<bool, kFrames.size()> other{};
  char what[300] = "";
};

Verdict run_seed(std::uint64_t seed) {
  Verdict verdict;
  const OptionVolume drawn = make_option_volume(seed);
  const Volume& volume = drawn.tiny.volume;
  Options options;
  options.cap = seed % 3 == 0;
  options.threads = 1;
  std::string words;
  try {
    Report report;
    const TriMesh mesh = mesh_isosurface(volume, drawn.tiny.isovalue, options, report);
    verdict.meshed = !mesh.faces.empty();
    Random random(seed);
    Figures first;
    for (std::size_t n = 0; n < kFrames.size() && verdict.meshed; ++n) {
      const Volume there = volume.with_frame(frame_of(n, volume.voxel(), random));
      TriMesh file = mesh;
      file.frame = there.frame();
      file.points = file.world_points();
      if (file.frame.left_handed()) {
        std::vector<Triangle> triangles = file.triangles();
        for (Triangle& t : triangles) std::swap(t[1], t[2]);
        file = make_tri_mesh(file.points, triangles);
      }
      VerifyOptions how;
      how.solid = options.cap && report.cap.failure.empty();
      how.limits = resolve(options, there).refinement;
      how.limits.shape_floor = 0;
      how.most_over_limit = 0.02;
      how.tolerance = bring_home(file, there);
      const Figures figures = figures_of(verify(file, there, report.kappa_effective, how));
      if (n == 0) {
        first = figures;
        for (std::size_t kind = 0; kind < kFaultKinds; ++kind) {
          verdict.faults += static_cast<std::uint64_t>(figures[kind].second);
        }
      }
      const std::string what = difference(first, figures, volume.voxel());
      verdict.other[n] = !what.empty();
      if (!what.empty()) words += text("; ", kFrames[n], ": ", what);
    }
  } catch (const InputError& error) {
    words = text("; refused: ", error.what());
  }
  words.copy(verdict.what, sizeof verdict.what - 1);
  return verdict;
}

int run_all(std::uint64_t first, std::uint64_t count, bool listed) {
  std::uint64_t meshed = 0, faults = 0, dead = 0, all = 0;
  std::array<std::uint64_t, kFrames.size()> other{};
  const bool forked = run_in_children<Verdict>(
      first, first + count, 60, run_seed,
      [&](std::uint64_t seed, const Verdict& verdict) {
        meshed += verdict.meshed;
        faults += verdict.faults;
        for (std::size_t n = 0; n < other.size(); ++n) other[n] += verdict.other[n];
        all += std::ranges::count(verdict.other, true) > 0;
        if (listed && verdict.what[0] != 0) say("seed ", seed, verdict.what);
      },
      [&](std::uint64_t seed, bool hung) {
        ++dead;
        say("seed ", seed, hung ? " hung" : " crashed");
      });
  if (!forked) return 2;
  std::string told = text(meshed, " meshes with ", faults, " faults; another report:");
  for (std::size_t n = 1; n < other.size(); ++n) told += text(" ", kFrames[n], " ", other[n]);
  say(told, "; crashed or hung ", dead);
  return all + dead > 0 || 2 * meshed < count;
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_frames", 100);
  if (!seeds) return 2;
  return run_all(seeds->first, seeds->count, seeds->list);
}
