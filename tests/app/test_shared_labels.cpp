// SPDX-License-Identifier: MIT
// --label all --shared: the files of random labels, read as another program would.
#include "app/shared_labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "app/parsed_line.h"
#include "app/run.h"
#include "base/random.h"
#include "base/text.h"
#include "cases.h"
#include "check/quality.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/read_mesh.h"
#include "stress/shared_file.h"
#include "volume/sampled.h"

using namespace deliso;
using namespace deliso::stress;
using namespace deliso::test;

namespace {

// Labels from 0 to `most`, in spacing 1: cells of a Voronoi diagram, the same in a ball, runs of
// samples in rows, or single voxels in background.
struct RandomLabels {
  explicit RandomLabels(std::uint64_t seed) {
    Random random(seed);
    for (int axis = 0; axis < 3; ++axis) dims[axis] = 3 + static_cast<int>(random.below(5));
    most = 2 + static_cast<int>(random.below(5));
    std::vector<Vec3> centers;
    for (int n = 0; n < 9; ++n) {
      centers.push_back(
          {dims.i * random.uniform(), dims.j * random.uniform(), dims.k * random.uniform()});
    }
    const auto kind = random.below(4);
    int run = 0;
    for_each_index(dims, [&](int i, int j, int k) {
      const Vec3 p{double(i), double(j), double(k)};
      const auto nearest =
          std::ranges::min_element(centers, {}, [&](const Vec3& c) { return distance2(c, p); });
      const int cell = static_cast<int>(nearest - centers.begin()) % (most + 1);
      const int drawn = static_cast<int>(random.below(static_cast<std::uint32_t>(most + 1)));
      if (random.below(3) == 0) run = drawn;
      const bool outside = distance(p, {dims.i / 2., dims.j / 2., dims.k / 2.}) > dims.i / 2.;
      samples.push_back(static_cast<std::uint8_t>(kind == 0   ? cell
                                                  : kind == 1 ? (outside ? 0 : 1 + cell % most)
                                                  : kind == 2 ? run
                                                  : random.below(12) == 0 ? drawn
                                                                          : 0));
    });
    samples[samples.size() / 2] = 1;  // not all is background
  }
  int at(int i, int j, int k) const {
    const bool in = i >= 0 && j >= 0 && k >= 0 && i < dims.i && j < dims.j && k < dims.k;
    return in ? samples[static_cast<std::size_t>((k * dims.j + j) * dims.i + i)] : 0;
  }

  // True if a sample within two voxels of p has the label.
  bool is_near(const Vec3& p, int label) const {
    const auto x = std::lround(p.x), y = std::lround(p.y), z = std::lround(p.z);
    for (int n = 0; n < 125; ++n) {
      if (at(static_cast<int>(x) + n % 5 - 2, static_cast<int>(y) + n / 5 % 5 - 2,
             static_cast<int>(z) + n / 25 - 2) == label) {
        return true;
      }
    }
    return false;
  }

  Index3 dims;
  int most = 0;
  std::vector<std::uint8_t> samples;
};

// How often the triangles go around p.
double winding(const SharedFile& file, std::span<const Triangle> triangles, const Vec3& p) {
  double angles = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = file.points[t[0].number()] - p, b = file.points[t[1].number()] - p,
               c = file.points[t[2].number()] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    angles += 2 * std::atan2(dot(a, cross(b, c)),
                             la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angles / (4 * std::numbers::pi);
}

using Corners3 = std::array<std::array<double, 3>, 3>;
// The triangle's corners, from the least one.
Corners3 corners_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Corners3 all{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  std::rotate(all.begin(), std::min_element(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

TEST_CASE("random labels fill space once, between common triangles that never cross") {
  const TemporaryFolder folder;
  const std::uint64_t kVolumes = test::cases(120u);
  int sound = 0, facets = 0, far = 0, samples = 0, uncertain = 0, twice = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < kVolumes; ++seed) {
    CAPTURE(seed);
    const RandomLabels labels(seed);
    folder.write("labels.raw", {labels.samples.begin(), labels.samples.end()});
    const bool is_sharp = seed % 2 == 0;
    const Index3 n = labels.dims;
    const std::string dims = text(n.i, "x", n.j, "x", n.k);
    const int status = run_mesh(
        parsed(text(folder / "labels.raw", " --dims ", dims, " --type uint8 --label all --shared ",
                    folder / "all.ply", " -o ", folder / "%d.ply",
                    " -q --ply-ascii --double --smooth ", is_sharp ? "0.3vox" : "1vox")));
    CHECK((status == kExitSuccess || status == kFaultFound));
    sound += status == kExitSuccess ? 1 : 0;
    const SharedFile all = read_shared(folder / "all.ply");
    CHECK(shared_fault(all, status == kExitSuccess) == "");

    for (std::size_t f = 0; f < all.triangles.size(); ++f) {
      const Vec3& p = all.points[all.triangles[f][0].number()];
      for (const int side : all.sides[f]) far += labels.is_near(p, side) ? 0 : 1;
      ++facets;
    }

    // Each label's own file has the same triangles, to the bit.
    std::vector<std::vector<Triangle>> of{all.of(0)};
    double sum = 0;
    for (int label = 1; label <= labels.most; ++label) {
      of.push_back(all.of(label));
      std::vector<Corners3> here, own;
      for (const Triangle& t : of.back()) {
        here.push_back(corners_of(all.points[t[0].number()], all.points[t[1].number()],
                                  all.points[t[2].number()]));
      }
      if (here.empty()) continue;
      const TriMesh mesh = read_mesh(folder / text(label, ".ply"));
      for (const Face& face : mesh.faces) {
        own.push_back(
            corners_of(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]));
      }
      std::ranges::sort(here);
      std::ranges::sort(own);
      CHECK(here == own);
      sum += enclosed_volume(mesh);
    }
    double background = 0;
    for (const Triangle& t : of[0]) {
      background += dot(all.points[t[0].number()],
                        cross(all.points[t[1].number()], all.points[t[2].number()])) /
                    6;
    }
    CHECK(sum == doctest::Approx(-background).epsilon(1e-9));

    // A sample is inside one label: its own, if smoothing is slight.
    for (int k = 1; k < n.k; k += 2) {
      for (int j = k % 2; j < n.j; ++j) {
        const int i = (j * 5 + k * 3) % n.i;
        std::vector<int> inside;
        for (int label = 1; label <= labels.most; ++label) {
          const double turns =
              winding(all, of[static_cast<std::size_t>(label)], {i + 1e-3, j + 2e-3, k - 1.7e-3});
          uncertain += std::fabs(turns - std::round(turns)) > 1e-6 ? 1 : 0;
          if (std::lround(turns) != 0) inside.push_back(label);
        }
        twice += inside.size() > 1 ? 1 : 0;
        if (!is_sharp) continue;
        ++samples;
        kept += (inside.empty() ? 0 : inside[0]) == labels.at(i, j, k) ? 1 : 0;
      }
    }
  }
  CHECK(sound > test::cases(60));
  CHECK(facets > test::cases(30000));
  CHECK(far == 0);
  CHECK(uncertain == 0);
  CHECK(twice == 0);
  CHECK(samples > test::cases(300));
  CHECK(kept == samples);
}
