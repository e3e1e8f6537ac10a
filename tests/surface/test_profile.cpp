// SPDX-License-Identifier: MIT
// The profile and the readings of the paper's criteria, which only benchmarks use. They must not
// change the mesh, and must add up.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "deliso/deliso.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"
#include "mesh/check_mesh.h"
#include "view/trace/profile.h"

using namespace deliso;

namespace {

struct Run {
  TriMesh mesh;
  Report report;
};

Run mesh_builtin(const std::string& input, const Options& options) {
  Run run;
  run.mesh =
      mesh_isosurface(read_volume(input), find_builtin_field(input)->isovalue, options, run.report);
  return run;
}

template <class Bins>
std::uint64_t total(const Bins& bins) {
  return std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
}

bool same(const TriMesh& a, const TriMesh& b) {
  if (a.points != b.points || a.faces.size() != b.faces.size()) return false;
  for (FaceId f = 0; f < a.faces.size(); ++f) {
    if (a.faces[f].v != b.faces[f].v) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a profile counts every insertion, stays within the stage's time and changes nothing") {
  for (const std::string input : {"builtin:fuel:48", "builtin:linked_tori:48"}) {
    CAPTURE(input);
    Profile profile;
    Options options = Options::paper();
    const Run plain = mesh_builtin(input, options);
    options.observer = &profile;
    const Run run = mesh_builtin(input, options);
    CHECK(same(plain.mesh, run.mesh));
    const Report& r = run.report;
    const std::uint64_t by_recover = r.points_recovered - r.points_initial;
    CHECK(total(profile.recover.searches) == by_recover);
    CHECK(total(profile.recover.nanoseconds) == by_recover);
    CHECK(r.insertions_refine > 0);
    CHECK(total(profile.refine.nanoseconds) == r.insertions_refine);
    CHECK(profile.recover.searches[0] == 0);
    CHECK(profile.refine.searches[0] == 0);
    CHECK(profile.seconds(Activity::search) > 0);
    CHECK(profile.seconds(Activity::triangulation) > 0);
    CHECK(profile.seconds(Activity::disk_test) > 0);
    CHECK(profile.seconds(Activity::search) + profile.seconds(Activity::triangulation) +
              profile.seconds(Activity::disk_test) <
          r.seconds_recover);
  }
}

TEST_CASE("insertions are counted in the right bins of the histograms") {
  InsertionHistograms h;
  h.add(0, 3);
  h.add(1, 3);
  h.add(2, 1000);
  h.add(1e30, 0);
  CHECK(h.nanoseconds[0] == 2);
  CHECK(h.nanoseconds[InsertionHistograms::kPerOctave] == 1);
  CHECK(h.nanoseconds.back() == 1);
  CHECK(h.searches[3] == 2);
  CHECK(h.searches.back() == 1);
  CHECK(h.searches[0] == 1);
}

TEST_CASE("without ApproximateGeom Stage 1 hands over fewer points") {
  Options options = Options::paper();
  const Run stated = mesh_builtin("builtin:orbital:64", options);
  options.epsilon = std::numeric_limits<double>::infinity();
  const Run none = mesh_builtin("builtin:orbital:64", options);
  CHECK(none.report.points_recovered < stated.report.points_recovered);
  CHECK(check_mesh(none.mesh).empty());
}
