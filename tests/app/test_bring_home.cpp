// SPDX-License-Identifier: MIT
// What rounding does to the coordinates of a file is no fault, in any frame (the storm
// stress_frames has the whole law).
#include "app/bring_home.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/text.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "io/files/text_scan.h"
#include "io/mesh/to_float.h"
#include "io/volume/builtin_volume.h"

using namespace deliso;

namespace {

// Turned, sheared and left-handed: as a scanner may have it.
Frame oblique_frame() {
  Frame frame;
  frame.origin = {-90.3, 120.7, -40.1};
  frame.axes = {Vec3{0.6, 0, 0.8}, Vec3{0, 0.96, -0.28}, Vec3{0.8, 0.36, -0.48}};
  return frame;
}

std::string first_fault(const Verification& v) {
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    if (v.faults.count(kind) > 0) return text(name_of(kind), ": ", v.faults.count(kind));
  }
  return {};
}

double with_digits(double x, int digits) {
  char words[40];
  std::snprintf(words, sizeof words, "%.*g", digits, x);
  return to_double(words).value();
}

}  // namespace

TEST_CASE("a mesh that rounding moved has no fault, and where it lies changes no figure") {
  const Volume upright = make_builtin_volume("builtin:gyroid:16");
  struct Change {
    const char* name;
    std::function<double(double, Random&)> of;
  };
  const std::vector<Change> changes{
      {"none", [](double x, Random&) { return x; }},
      {"1e-7 voxel", [](double x, Random& random) { return x + random.uniform(-1e-7, 1e-7); }},
      {"six digits", [](double x, Random&) { return with_digits(x, 6); }},
      {"nine digits of a float", [](double x, Random&) { return with_digits(to_float(x), 9); }},
      {"float", [](double x, Random&) { return to_float(x); }}};
  for (const bool cap : {false, true}) {
    Options options;
    options.cap = cap;
    Report report;
    const TriMesh mesh = mesh_isosurface(upright, 0.1, options, report);
    REQUIRE(mesh.faces.size() > 500);
    for (const Change& change : changes) {
      CAPTURE(cap);
      CAPTURE(change.name);
      double max = 0, mean = 0;
      for (const Frame& frame : {Frame{}, oblique_frame()}) {
        const Volume volume = upright.with_frame(frame);
        TriMesh file = mesh;
        file.frame = frame;
        file.points = file.world_points();
        Random random(1);
        for (Vec3& p : file.points) {
          for (int axis = 0; axis < 3; ++axis) p[axis] = change.of(p[axis], random);
        }
        std::vector<Triangle> triangles = file.triangles();
        for (Triangle& t : triangles) {
          if (frame.left_handed()) std::swap(t[1], t[2]);
        }
        file = make_tri_mesh(file.points, triangles);
        VerifyOptions how;
        how.solid = cap;
        how.tolerance = bring_home(file, volume);
        const Verification v = verify(file, volume, report.kappa_effective, how);
        CHECK(first_fault(v) == "");
        if (frame == Frame{}) {
          max = v.to_surface.max, mean = v.to_surface.mean;
        } else if (std::string(change.name) == "none") {
          CHECK(std::fabs(v.to_surface.max - max) < 1e-9 * max);
          CHECK(std::fabs(v.to_surface.mean - mean) < 1e-9 * mean);
        }
      }
    }
  }
}

// A pyramid in the corner of the box, and its base: the apex is slightly off the box. A facet of
// the surface with all corners within the tolerance of a face was once taken for a cap, and
// reported as reversed.
TEST_CASE("a vertex slightly off the box stays off it if the others are on it but for rounding") {
  const std::vector<float> samples(8, 0);
  const Volume volume = Volume::from_samples({2, 2, 2}, {1, 1, 1}, samples);
  for (const double apex : {1e-12, 0.5}) {
    for (const double moved : {0.0, 1e-16, 1e-9}) {
      CAPTURE(apex);
      CAPTURE(moved);
      TriMesh mesh = make_tri_mesh(
          {{0.2, 0.2, moved}, {0.8, 0.2, 2 * moved}, {0.5, 0.8, -3 * moved}, {0.5, 0.4, apex}},
          std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
      bring_home(mesh, volume);
      for (VertexId v = 0; v < 3; ++v) CHECK(mesh.points[v].z == 0);
      // Where all are off it, nothing distinguishes an offset from a rounding.
      CHECK((mesh.points[3].z == 0) == (apex < 0.1 && moved > 1e-12));
    }
  }
}

TEST_CASE("the error of coordinates follows from their digits") {
  const auto error_of = [](const char* format, double scale) {
    Random random(1);
    std::vector<Vec3> points(100);
    for (Vec3& p : points) {
      for (int axis = 0; axis < 3; ++axis) {
        char words[40];
        std::snprintf(words, sizeof words, format, random.uniform(0, scale));
        p[axis] = to_double(words).value();
      }
    }
    return digits_of(points).error;
  };
  CHECK(error_of("%.17g", 90) == 0);
  CHECK(error_of("%.6g", 90) == doctest::Approx(5e-5));
  CHECK(error_of("%.6f", 90) == doctest::Approx(5e-7));
  CHECK(error_of("%.3f", 900) == doctest::Approx(5e-4));
  // As exact as they are simple.
  CHECK(digits_of({{0, 0.5, 10}}).error == doctest::Approx(5e-4));
  const float third = 1.0F / 3;
  CHECK(digits_of({{third, third, 1}}).is_single);
  CHECK_FALSE(digits_of({{third, third, 1.0 / 3}}).is_single);
}
