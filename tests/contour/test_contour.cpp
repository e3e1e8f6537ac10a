// SPDX-License-Identifier: MIT
// T as a mesh: a manifold with boundary on the box, on Sigma, with its summary and its chains, for
// random volumes and for fields of known topology.
#include "contour/contour.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/random.h"
#include "io/volume/builtin_volume.h"
#include "mesh_checks.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// Checks T and returns its summary.
ContourSummary checked_summary(const Volume& volume, double kappa) {
  const ContourMesh mesh = build_contour(volume, kappa);
  CHECK(check_contour(mesh, volume, kappa) == "");
  CHECK(summarize_contour(volume, kappa) == mesh.summary);
  return mesh.summary;
}

double torus_field(double x, double y, double z, double big, double small) {
  const double d = std::sqrt(x * x + y * y) - big;
  return small - std::sqrt(d * d + z * z);
}

}  // namespace

TEST_CASE("random volumes of every sample type give a valid contour") {
  Random random(7);
  std::size_t with_boundary = 0, with_tubes = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    CAPTURE(trial);
    const Index3 dims{2 + static_cast<int>(random.below(7)), 2 + static_cast<int>(random.below(7)),
                      2 + static_cast<int>(random.below(7))};
    const Vec3 spacing{random.uniform(0.2, 3), random.uniform(0.2, 3), random.uniform(0.2, 3)};
    const auto check = [&]<class T>(T, std::uint32_t levels, double kappa) {
      std::vector<T> samples;
      for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
        samples.push_back(static_cast<T>(random.below(levels)));
      }
      const Volume volume = Volume::from_samples(dims, spacing, samples);
      const ContourSummary summary =
          checked_summary(volume, geometric_isovalue(volume.type(), kappa));
      with_boundary += summary.boundary_loops() > 0;
      for (const auto& component : summary.components) with_tubes += component.tubes > 0;
    };
    switch (trial % 5) {
      case 0:
        check(std::uint8_t{}, 256, random.uniform(20, 230));
        break;
      case 1:
        check(std::int16_t{}, 5, 2);  // many ties
        break;
      case 2:
        check(std::uint32_t{}, 1000000, 400000.5);
        break;
      case 3:
        check(float{}, 100, 50);
        break;
      default:
        check(double{}, 1 << 20, 1 << 19);
    }
  }
  CHECK(with_boundary > 1000);
  CHECK(with_tubes > 50);
}

TEST_CASE("with samples equal to kappa the contour is valid") {
  Random random(8);
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    std::vector<std::uint8_t> samples;
    for (int n = 0; n < 5 * 5 * 5; ++n) {
      samples.push_back(static_cast<std::uint8_t>(random.below(3)));
    }
    const Volume volume = Volume::from_samples({5, 5, 5}, {1, 1, 1}, samples);
    checked_summary(volume, 1);
  }
}

// Halfway between integers saddles are at the isovalue, which is lowered a little, or not at all
// for doubles. Points inside two voxels, each near such a saddle of the face between them, were
// once 1e-9 apart.
TEST_CASE("vertices keep a thousandth of a voxel where saddles are at kappa") {
  Random random(17);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const Index3 dims{4 + static_cast<int>(random.below(4)), 4 + static_cast<int>(random.below(4)),
                      4 + static_cast<int>(random.below(4))};
    const std::uint32_t levels = trial % 2 != 0 ? 2 : 2 + random.below(30);
    std::vector<std::uint8_t> samples;
    for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
      samples.push_back(static_cast<std::uint8_t>(random.below(levels)));
    }
    const std::vector<double> doubles(samples.begin(), samples.end());
    const Volume volume = trial % 3 == 0 ? Volume::from_samples(dims, {1, 1, 1}, doubles)
                                         : Volume::from_samples(dims, {1, 1, 1}, samples);
    const double kappa = geometric_isovalue(volume.type(), random.below(levels - 1) + 0.5);
    const ContourMesh mesh = build_contour(volume, kappa);
    CHECK(check_contour(mesh, volume, kappa) == "");
    double nearest2 = 1;
    for (ContourId v = 0; v < mesh.points.size(); ++v) {
      for (ContourId w = 0; w < v; ++w) {
        nearest2 = std::min(nearest2, distance2(mesh.points[v], mesh.points[w]));
      }
    }
    CHECK(nearest2 >= 1e-6);
  }
}

TEST_CASE("fields of known topology have a contour of that topology") {
  const auto distance_to = [](double x, double y, double z) {
    return std::sqrt(x * x + y * y + z * z);
  };
  SUBCASE("sphere") {
    const Volume volume =
        sampled<float>({33, 33, 33}, {1, 1, 1}, [&](double x, double y, double z) {
          return 10.3 - distance_to(x - 16.1, y - 15.9, z - 16.2);
        });
    const ContourSummary s = checked_summary(volume, 0);
    REQUIRE(s.components.size() == 1);
    CHECK(s.euler() == 2);
    CHECK(s.boundary_loops() == 0);
    CHECK(s.components[0].lo == Index3{5, 5, 5});
    CHECK(s.components[0].hi == Index3{26, 26, 26});
  }
  SUBCASE("half a sphere, cut by the box") {
    const Volume volume =
        sampled<float>({33, 33, 33}, {1, 1, 1}, [&](double x, double y, double z) {
          return 10.3 - distance_to(x - 16.1, y - 15.9, z + 0.2);
        });
    const ContourSummary s = checked_summary(volume, 0);
    REQUIRE(s.components.size() == 1);
    CHECK(s.euler() == 1);
    CHECK(s.boundary_loops() == 1);
  }
  SUBCASE("torus") {
    const Volume volume = sampled<float>({40, 40, 40}, {1, 1, 1}, [](double x, double y, double z) {
      return torus_field(x - 19.6, y - 19.4, z - 19.7, 12, 4);
    });
    const ContourSummary s = checked_summary(volume, 0);
    REQUIRE(s.components.size() == 1);
    CHECK(s.euler() == 0);
  }
  SUBCASE("two linked tori") {
    const Volume volume = sampled<float>({48, 40, 40}, {1, 1, 1}, [](double x, double y, double z) {
      return std::max(torus_field(x - 16.6, y - 19.4, z - 19.7, 10, 3),
                      torus_field(x - 27.1, z - 19.4, y - 19.7, 10, 3));
    });
    const ContourSummary s = checked_summary(volume, 0);
    REQUIRE(s.components.size() == 2);
    for (const auto& component : s.components) CHECK(component.euler == 0);
  }
  SUBCASE("five spheres, in scan order") {
    const Vec3 centers[5] = {{9, 9, 7}, {29, 9, 8}, {9, 29, 9}, {29, 29, 10}, {19, 19, 30}};
    const Volume volume =
        sampled<float>({40, 40, 40}, {1, 1, 1}, [&](double x, double y, double z) {
          double best = -1e9;
          for (const Vec3& c : centers) {
            best = std::max(best, 5.2 - distance_to(x - c.x - 0.1, y - c.y + 0.2, z - c.z));
          }
          return best;
        });
    const ContourSummary s = checked_summary(volume, 0);
    REQUIRE(s.components.size() == 5);
    for (std::size_t n = 0; n < 5; ++n) {
      CHECK(s.components[n].euler == 2);
      CHECK(s.components[n].lo.i <= centers[n].x);
      CHECK(s.components[n].hi.i >= centers[n].x);
      CHECK(s.components[n].lo.k <= centers[n].z);
      CHECK(s.components[n].hi.k >= centers[n].z);
    }
  }
}

TEST_CASE("rows of every length around a machine word have all their crossings") {
  Random random(9);
  for (const int nx : {2, 62, 63, 64, 65, 66, 127, 128, 129, 200}) {
    CAPTURE(nx);
    std::vector<std::uint16_t> samples;
    for (int n = 0; n < nx * 4 * 3; ++n) {
      samples.push_back(static_cast<std::uint16_t>(random.below(60000)));
    }
    const Volume volume = Volume::from_samples({nx, 4, 3}, {1, 1, 1}, samples);
    std::size_t crossings = 0;
    for_each_index({nx, 4, 3}, [&](int i, int j, int k) {
      const bool inside = volume.sample(i, j, k) >= 30000.5;
      if (i + 1 < nx) crossings += inside != (volume.sample(i + 1, j, k) >= 30000.5);
      if (j + 1 < 4) crossings += inside != (volume.sample(i, j + 1, k) >= 30000.5);
      if (k + 1 < 3) crossings += inside != (volume.sample(i, j, k + 1) >= 30000.5);
    });
    const ContourSummary s = checked_summary(volume, 30000.5);
    std::size_t found = 0;
    for (const auto& component : s.components) found += component.crossings;
    CHECK(found == crossings);
  }
}

TEST_CASE("the samples' own type decides inside as double does") {
  Random random(10);
  const auto check = []<class T>(T low, T high, double kappa) {
    const bool differ = (static_cast<double>(low) >= kappa) != (static_cast<double>(high) >= kappa);
    const Volume volume = Volume::from_samples<T>({2, 2, 2}, {1, 1, 1},
                                                  {low, high, high, high, high, high, high, high});
    CHECK(summarize_contour(volume, kappa).components.size() == (differ ? 1 : 0));
  };
  for (int trial = 0; trial < 2000; ++trial) {
    CAPTURE(trial);
    const double kappa = std::floor(random.uniform(-140, 140)) + 0.25 * random.below(4);
    const auto low = static_cast<std::int8_t>(random.below(256) - 128);
    check(low, static_cast<std::int8_t>(low < 127 ? low + 1 : low), kappa);
    const float f = static_cast<float>(random.uniform(-1, 1));
    check(f, std::nextafter(f, 2.0f), f + 0.3 * random.below(5) * (std::nextafter(f, 2.0f) - f));
    const auto u = static_cast<std::uint32_t>(random.next() >> 32);
    check(u, u + 1, u + 0.5 * random.below(4));
    const double d = random.uniform(-1, 1);
    check(d, std::nextafter(d, 2.0), random.below(2) != 0 ? d : std::nextafter(d, 2.0));
  }
}

TEST_CASE("a volume without voxels, or without an inside or outside, has no contour") {
  const Volume flat = Volume::from_samples<std::uint8_t>({3, 2, 1}, {1, 1, 1}, {0, 9, 0, 9, 0, 9});
  CHECK(build_contour(flat, 4.5).points.empty());
  const Volume cube =
      Volume::from_samples<std::uint8_t>({2, 2, 2}, {1, 1, 1}, {0, 9, 0, 9, 0, 9, 0, 255});
  for (const double kappa : {-1.0, 255.5, 1e300, -1e300}) {
    const ContourMesh mesh = build_contour(cube, kappa);
    CHECK(mesh.triangles.empty());
    CHECK(mesh.summary.components.empty());
    CHECK(mesh.boundary.size() == 0);
  }
}

TEST_CASE("chosen components are large enough, and no other crosses more grid edges") {
  const Volume volume = make_builtin_volume("builtin:noise:24");
  const ContourSummary summary =
      summarize_contour(volume, geometric_isovalue(volume.type(), 127.5));
  const std::vector<ContourComponent>& all = summary.components;
  REQUIRE(all.size() > 8);
  for (const std::size_t largest :
       {std::size_t{0}, std::size_t{1}, std::size_t{5}, all.size() + 1}) {
    for (const double min_voxels : {0.0, 4.0}) {
      CAPTURE(largest);
      CAPTURE(min_voxels);
      const auto chosen = chosen_components(summary, {min_voxels, largest});
      REQUIRE(chosen.size() == all.size());
      std::size_t count = 0;
      for (std::size_t c = 0; c < all.size(); ++c) {
        std::size_t larger = 0;
        for (std::size_t d = 0; d < all.size(); ++d) {
          larger += all[d].crossings > all[c].crossings ||
                    (all[d].crossings == all[c].crossings && d < c);
        }
        CHECK(chosen[c] == ((largest == 0 || larger < largest) && all[c].side() >= min_voxels));
        count += chosen[c];
      }
      if (min_voxels == 0 && largest > 0) CHECK(count == std::min(largest, all.size()));
    }
  }
}
