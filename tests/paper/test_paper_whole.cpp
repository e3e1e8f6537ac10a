// SPDX-License-Identifier: MIT
// The published program as a whole, against the exact contour and the balls of its facets.
#include <doctest/doctest.h>

#include <set>

#include "base/check.h"
#include "check/check_mesh.h"
#include "check/delaunay_share.h"
#include "contour/contour.h"
#include "mesh/meshes.h"
#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::Options;
using paper::Report;

namespace {

// Returns the mesh's restricted Delaunay facets, measured, after a look at all that is exact.
DelaunayShare check_whole(const Field& field, const TriMesh& mesh, const Report& report) {
  const Volume& volume = field.volume;
  const ContourMesh contour = build_contour(volume, report.kappa);
  CHECK(mesh_topology(mesh).counts() == contour.summary.topology());
  CHECK(check_mesh(mesh) == "");
  CHECK(check_boundary_on_box(mesh, volume.box()) == "");
  CHECK(mesh.points.size() + report.vertices_alone ==
        report.points_initial() + report.insertions_recover + report.insertions_refine);
  Faults faults;
  const CleanMesh clean = check_validity(mesh, volume.box(), MayEnd::on_box, faults);
  std::vector<double> heights;
  const DelaunayShare share = measure_delaunay_share(
      clean, VertexGrids(clean.points, clean.triangles), Isosurface(volume, report.kappa), heights);
  REQUIRE(share.measured);
  CHECK(share.share() >= 0.999);
  return share;
}

// A ball around a point, in a box of side 16.
Field ball(const Vec3& center, double radius) {
  return {sampled<float>({17, 17, 17}, {1, 1, 1},
                         [&](int i, int j, int k) {
                           return radius - distance({1.0 * i, 1.0 * j, 1.0 * k}, center);
                         }),
          0};
}

Report ran(const Field& field, const Options& options, TriMesh& mesh) {
  Report report;
  mesh = run(field, options, report);
  return report;
}

struct Case {
  std::string name;
  Field field;
  std::size_t lines;
  double r_min = 0.001;
};

// What a run says of itself, as it says it.
class Notes : public paper::Observer {
 public:
  std::vector<std::string> stages;
  std::size_t asked = 0, added = 0, refused_in_recover = 0, refused_in_refine = 0;
  bool is_recovered = false;

  void stage_begins(const char* stage) override { stages.emplace_back(stage); }
  void site_added(SiteId) override { ++added; }
  void refused(paper::Refusal) override {
    ++(is_recovered ? refused_in_refine : refused_in_recover);
  }
  void recovered() override { is_recovered = true; }
};

}  // namespace

TEST_CASE("closed surfaces: exact topology, restricted Delaunay facets") {
  const Case cases[] = {{"sphere", builtin("sphere", 24), 50},
                        {"torus", builtin("torus", 24), 50},
                        {"linked tori", builtin("linked_tori", 32), 50},
                        {"five spheres", builtin("five_spheres", 32), 500},
                        {"orbital", builtin("orbital", 48), 50},
                        {"machine", builtin("machine", 24), 50, 0.02}};
  for (const Case& of : cases) {
    CAPTURE(of.name);
    double least = 1;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(seed);
      Options options = few_vertices(40'000);
      options.lines = of.lines;
      options.r_min = of.r_min;
      options.seed = seed;
      TriMesh mesh;
      const Report report = ran(of.field, options, mesh);
      const DelaunayShare share = check_whole(of.field, mesh, report);
      CHECK(report.facets_left + report.vertices_left + report.vertices_alone == 0);
      CHECK(report.points_on_curves + report.curve_splits + report.curve_refusals == 0);
      CHECK(mesh_topology(mesh).boundary_edges == 0);
      least = std::min(least, share.share());
    }
    MESSAGE(of.name << ": at least " << 100 * least << " % of the triangles");
  }
}

TEST_CASE("open surfaces: their boundary is the curves on the box, refined") {
  const Case cases[] = {{"fuel", builtin("fuel", 24), 500},
                        {"gyroid", builtin("gyroid", 24), 50},
                        {"ball at a corner of the box", ball({0.3, 15.6, 0.2}, 9.3), 50},
                        {"ball at an edge of the box", ball({0.1, 15.7, 8.2}, 6.3), 50},
                        {"ball through the edges", ball({7.7, 8.1, 8.2}, 12.2), 50},
                        {"ball through the faces", ball({7.7, 8.1, 8.2}, 9.2), 50}};
  int with_gaps = 0;
  for (const Case& of : cases) {
    CAPTURE(of.name);
    double least = 1;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(seed);
      Options options = few_vertices(20'000);
      options.lines = of.lines;
      options.seed = seed;
      TriMesh mesh;
      const Report report = ran(of.field, options, mesh);
      CHECK(report.facets_left + report.vertices_alone == 0);
      // A vertex beside an edge of the curves that is too short to be split.
      if (report.vertices_left > 0) {
        CHECK(report.curve_refusals > 0);
        ++with_gaps;
        continue;
      }
      const DelaunayShare share = check_whole(of.field, mesh, report);
      std::set<VertexId> ends;
      std::size_t edges = 0;
      for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (face.n[i] != kNoId) continue;
          ends.insert(face.v[(i + 1) % 3]);
          ends.insert(face.v[(i + 2) % 3]);
          ++edges;
        }
      }
      CHECK(edges == ends.size());
      CHECK(edges == report.points_on_curves + report.curve_splits);
      for (const VertexId v : ends) {
        CHECK(std::fabs(of.field.volume.value(mesh.points[v]) - report.kappa) < 1e-6);
      }
      least = std::min(least, share.share());
    }
    MESSAGE(of.name << ": at least " << 100 * least << " % of the triangles");
  }
  CHECK(with_gaps <= 2);
}

TEST_CASE("one seed gives one mesh, to the last bit; another seed another") {
  const Field field = builtin("torus", 24);
  Options options = few_vertices();
  TriMesh first, again, other;
  const Report one = ran(field, options, first), two = ran(field, options, again);
  CHECK(same_mesh(first, again));
  CHECK(one.searches_recover.computations == two.searches_recover.computations);
  options.seed = 2;
  ran(field, options, other);
  CHECK(first.points != other.points);
}

TEST_CASE("a run stops after Recover; its stages are named, its steps told") {
  const Field field = builtin("fuel", 24);
  Options options = few_vertices();
  Notes notes;
  options.observer = &notes;
  options.lines = 500;
  TriMesh whole, recovered;
  const Report report = ran(field, options, whole);
  CHECK(notes.stages == std::vector<std::string>{"initial", "recover", "poles", "refine"});
  CHECK(notes.added == report.insertions_recover);
  CHECK(notes.refused_in_refine == report.not_a_disk + report.too_near + report.curve_refusals);
  CHECK(notes.refused_in_recover == report.curve_splits);
  options.observer = nullptr;
  options.stop_after_recover = true;
  const Report first = ran(field, options, recovered);
  CHECK(check_whole(field, recovered, first).share() == 1);
  CHECK(first.insertions_recover == report.insertions_recover);
  CHECK(first.insertions_refine == 0);
  CHECK(std::equal(recovered.points.begin(), recovered.points.end(), whole.points.begin()));
}

TEST_CASE("more vertices than asked for are an error, in either stage and in S_0") {
  const Field field = builtin("torus", 24);
  TriMesh mesh;
  Options options;
  options.stop_after_recover = true;
  const std::size_t in_stage1 = (ran(field, options, mesh), mesh.points.size());
  options.max_vertices = in_stage1;
  CHECK_NOTHROW(ran(field, options, mesh));
  options.max_vertices = in_stage1 - 1;
  CHECK_THROWS_WITH_AS(
      ran(field, options, mesh),
      ("more than --max-vertices " + std::to_string(in_stage1 - 1) + " vertices needed").c_str(),
      InputError);
  options.stop_after_recover = false;
  options.max_vertices = Options().max_vertices;
  const std::size_t in_stage2 = (ran(field, options, mesh), mesh.points.size());
  options.max_vertices = in_stage2;
  CHECK_NOTHROW(ran(field, options, mesh));
  options.max_vertices = in_stage2 - 1;
  CHECK_THROWS_AS(ran(field, options, mesh), InputError);
  options.max_vertices = 5;
  options.epsilon = options.epsilon1 = options.epsilon2 = options.lambda = 1e9;
  options.lines = 500;
  CHECK_THROWS_AS(ran(field, options, mesh), InputError);
}

TEST_CASE("random lines go through all of the box, and each hit is a point of S_0") {
  // A line meets a closed surface an even number of times.
  const Field field = builtin("torus", 24);
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Options options = few_vertices();
    options.lines = 1;
    options.seed = seed;
    Program program(field, options);
    CHECK(program.report.points_on_lines % 2 == 0);
    const Triangulation& t = program.del().del();
    CHECK(t.vertex_capacity() == 1 + program.report.points_on_lines + kAuxiliaryVertices);
    for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
      if (program.del().is_auxiliary(q)) continue;
      CHECK(std::fabs(field.volume.value(t.point(q)) - program.report.kappa) < 1e-6);
    }
    found += program.report.points_on_lines;
  }
  CHECK(found > 10);
}

TEST_CASE("a surface that no line meets is an error; no surface is no mesh") {
  const Field field = ball({8, 8, 8}, 0.5);
  Options options = few_vertices();
  options.lines = 3;
  TriMesh mesh;
  CHECK_THROWS_WITH_AS(ran(field, options, mesh),
                       "none of the 3 random lines meets the surface: --lines N draws more",
                       InputError);
  options.lines = 5000;
  CHECK(ran(field, options, mesh).points_on_lines > 0);
  CHECK(mesh_topology(mesh).components.size() == 1);
  const Field empty{field.volume, 1000};
  CHECK(ran(empty, options, mesh).points_initial() == 0);
  CHECK(mesh.faces.size() == 0);
  const Field flat{sampled<float>({4, 4, 1}, {1, 1, 1}, [](int i, int, int) { return i; }), 1.5};
  CHECK_THROWS_WITH_AS(ran(flat, options, mesh),
                       "a volume needs two or more samples along each axis", InputError);
}

TEST_CASE("the mesh has the volume's frame") {
  const Field field = builtin("sphere", 24);
  const Frame frame{.origin = {1, 2, 3}};
  const Field moved{field.volume.with_frame(frame), field.isovalue};
  TriMesh mesh, in_place;
  ran(moved, few_vertices(), mesh);
  ran(field, few_vertices(), in_place);
  CHECK(mesh.points == in_place.points);
  CHECK(mesh.frame.origin == frame.origin);
}
