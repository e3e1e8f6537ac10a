// SPDX-License-Identifier: MIT
// The checker finds no fault in sound meshes, and after one fault is made, it finds that fault by
// its number.
#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <set>
#include <string>

#include "check/check_mesh.h"
#include "mesh/meshes.h"
#include "mesh/star.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::string rule(const TriMesh& mesh) {
  return check_mesh(mesh).substr(0, 2);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("sound meshes have no fault and their known topology") {
  struct Case {
    const char* name;
    Triangles triangles;
    std::size_t components, loops, closed;
    std::ptrdiff_t euler;
  };
  const Case cases[] = {
      {"nothing", {}, 0, 0, 0, 0},
      {"one triangle", {{0, 1, 2}}, 1, 1, 0, 1},
      {"tetrahedron", tetrahedron(), 1, 0, 1, 2},
      {"octahedron", octahedron(), 1, 0, 1, 2},
      {"smallest torus grid", torus_grid(3, 3), 1, 0, 1, 0},
      {"torus grid", torus_grid(6, 5), 1, 0, 1, 0},
      {"one ring", one_ring(6), 1, 1, 0, 1},
      {"fan", fan(5), 1, 1, 0, 1},
      {"L shape", l_shape(), 1, 1, 0, 1},
      {"open cone", one_ring(3), 1, 1, 0, 1},
      {"annulus", annulus(), 1, 2, 0, 0},
      {"two spheres", two_spheres(), 2, 0, 2, 4},
  };
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    const TriMesh mesh = mesh_of(c.triangles);
    CHECK(check_mesh(mesh) == "");
    const MeshTopology topology = mesh_topology(mesh);
    CHECK(topology.components.size() == c.components);
    CHECK(topology.boundary_loops == c.loops);
    CHECK(std::ranges::count_if(topology.components, &ComponentTopology::closed) ==
          static_cast<std::ptrdiff_t>(c.closed));
    CHECK(topology.euler() == c.euler);
    CHECK(topology.faces == c.triangles.size());
    CHECK(topology.vertices_used == mesh.points.size());
    std::ptrdiff_t euler = 0;
    for (const ComponentTopology& component : topology.components) euler += component.euler();
    CHECK(euler == c.euler);
  }
}

TEST_CASE("each fault is reported with its number, its ids and its coordinates") {
  struct Case {
    const char* name;
    Triangles triangles;
    const char* says;
  };
  const Case cases[] = {
      {"a vertex twice", {{0, 1, 1}}, "I1: facet 0 (0, 1, 1) has vertex 1 (1, 1, 1) twice"},
      {"flipped facet", flipped_facet(),
       "I3: facet 3 (0, 3, 4) and facet 7 (0, 3, 5) run the same way along the edge from vertex 0 "
       "(0, 0, 0) to vertex 3 (3, 9, 27)"},
      {"Moebius strip", moebius_strip(), "I3: "},
      {"fan of three on an edge", fan_of_three_on_an_edge(),
       "I4: 3 facets share the edge from vertex 0 (0, 0, 0) to vertex 1 (1, 1, 1): 0 1 2"},
      {"duplicated facet", duplicated_facet(), "I4: 3 facets share the edge from vertex 0"},
      {"hourglass", hourglass(),
       "I5: at vertex 0 (0, 0, 0) the facets 0 1 3 4 5 7 form 2 separate fans"},
      {"bow tie", bow_tie(), "I5: at vertex 0 (0, 0, 0) the facets 0 1 form 2 separate fans"},
      {"pillow", pillow(), "I5: at vertex 0 (0, 0, 0) the facets 0 1 cover each other"},
  };
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    const std::string text = check_mesh(mesh_of(c.triangles));
    CHECK_MESSAGE(text.starts_with(c.says), text);
    CHECK(text.find('\n') == std::string::npos);
  }
}

TEST_CASE("one fault made in a random sound mesh is found by its number") {
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    CAPTURE(seed);
    RandomMesh source(seed % 2 ? octahedron() : torus_grid(4, 4), seed);
    for (int i = 0; i < 30; ++i) source.change();
    const TriMesh& sound = source.mesh();
    REQUIRE(check_mesh(sound) == "");
    Random& random = source.random();
    const FaceId f(random.below(static_cast<std::uint32_t>(sound.faces.size())));
    const int i = static_cast<int>(random.below(3));
    const FaceId g = sound.faces[f].n[i];
    const int j = neighbor_index(sound.faces[g], f);

    TriMesh mesh = sound;
    mesh.faces[f].v[i] = VertexId(mesh.points.size());
    CHECK(rule(mesh) == "I1");
    mesh = sound;
    mesh.faces[f].v[i] = mesh.faces[f].v[(i + 1) % 3];
    CHECK(rule(mesh) == "I1");

    mesh = sound;
    mesh.faces[f].n[i] = kNoId;
    CHECK(rule(mesh) == "I2");
    CHECK(contains(check_mesh(mesh), "facet " + std::to_string(g) + " "));
    mesh = sound;
    mesh.faces[f].n[i] = FaceId(mesh.faces.size());
    CHECK(rule(mesh) == "I2");
    mesh = sound;
    mesh.faces[f].n[i] = f;
    CHECK(rule(mesh) == "I2");
    mesh = sound;
    std::swap(mesh.faces[f].n[i], mesh.faces[f].n[(i + 1) % 3]);
    CHECK(rule(mesh) == "I2");

    Triangles triangles = source.triangles();
    std::swap(triangles[f][0], triangles[f][1]);
    CHECK(rule(mesh_of(triangles)) == "I3");

    mesh = sound;  // both sides deny the edge
    mesh.faces[f].n[i] = mesh.faces[g].n[j] = kNoId;
    CHECK(rule(mesh) == "I2");
    triangles = source.triangles();
    triangles.push_back(triangles[f]);
    CHECK(rule(mesh_of(triangles)) == "I4");
    triangles = source.triangles();  // a fin on an inner edge
    triangles.push_back({sound.faces[f].v[0], sound.faces[f].v[1], VertexId(sound.points.size())});
    CHECK(rule(mesh_of(triangles)) == "I4");

    mesh = sound;
    mesh.points[sound.faces[f].v[i]].y = std::numeric_limits<double>::quiet_NaN();
    CHECK(rule(mesh) == "I6");
    mesh = sound;
    mesh.points[sound.faces[f].v[i]].x = std::numeric_limits<double>::infinity();
    CHECK(rule(mesh) == "I6");

    // A tetrahedron hung on one vertex.
    triangles = source.triangles();
    const VertexId q = sound.faces[f].v[i], n(sound.points.size()), m(n + 1), k(n + 2);
    for (const Triangle& t : Triangles{{q, m, n}, {q, n, k}, {n, m, k}, {m, q, k}}) {
      triangles.push_back(t);
    }
    CHECK(rule(mesh_of(triangles)) == "I5");
    CHECK(contains(check_mesh(mesh_of(triangles)), "vertex " + std::to_string(q) + " "));

    // A removed facet leaves a sound mesh with one hole and one facet less.
    triangles = source.triangles();
    triangles.erase(triangles.begin() + f);
    mesh = make_tri_mesh(sound.points, triangles);
    CHECK(check_mesh(mesh) == "");
    const MeshTopology before = mesh_topology(sound), after = mesh_topology(mesh);
    CHECK(after.euler() == before.euler() - 1);
    CHECK(after.boundary_edges == 3);
    CHECK(after.boundary_loops == 1);
    CHECK(!after.components[0].closed());
    CHECK(after.vertices_used == mesh.points.size());
  }
}

TEST_CASE("a triangle soup is sound exactly if its edges and stars are") {
  std::size_t sound = 0, faulty = 0;
  for (std::uint64_t seed = 1; seed <= 40000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::uint32_t vertices = 4 + random.below(4);
    Triangles triangles(1 + random.below(seed % 2 ? 4 : 9));
    for (Triangle& t : triangles) {
      for (VertexId& v : t) v = VertexId(random.below(vertices));
    }
    // Half of the soups are parts of a sound mesh, else hardly one would be sound.
    if (seed % 2 == 0) {
      triangles = seed % 4 ? octahedron() : torus_grid(3, 3);
      for (std::uint32_t out = random.below(10); out > 0 && triangles.size() > 1; --out) {
        triangles.erase(triangles.begin() +
                        random.below(static_cast<std::uint32_t>(triangles.size())));
      }
      if (random.below(3) == 0) {
        std::swap(triangles[0][0], triangles[0][1]);
      }
    }
    bool fine = true;
    std::map<std::pair<VertexId, VertexId>, int> directed;
    std::map<VertexId, Triangles> around;
    for (const Triangle& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        fine &= t[i] != t[(i + 1) % 3];
        fine &= ++directed[{t[i], t[(i + 1) % 3]}] == 1;
        around[t[i]].push_back(t);
      }
    }
    for (const auto& [q, star] : around) {
      const Star kind = classify_star(q, star);
      fine = fine && (kind == Star::disk || kind == Star::half_disk);
    }
    const std::string fault = check_mesh(mesh_of(triangles));
    REQUIRE_MESSAGE(fault.empty() == fine, fault);
    ++(fine ? sound : faulty);
  }
  CHECK(sound > 5000);
  CHECK(faulty > 5000);
}

TEST_CASE("the topology of a triangle soup is that counted by sets and flood fills") {
  for (std::uint64_t seed = 1; seed <= 5000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::uint32_t vertices = 5 + random.below(15);
    Triangles triangles(1 + random.below(12));
    for (Triangle& t : triangles) {
      const VertexId a(random.below(vertices));
      const VertexId b((a + 1 + random.below(vertices - 1)) % vertices);
      VertexId c = a;
      while (c == a || c == b) c = VertexId(random.below(vertices));
      t = {a, b, c};
    }
    const TriMesh mesh = make_tri_mesh(some_points(vertices), triangles);
    const MeshTopology topology = mesh_topology(mesh);

    std::map<std::set<VertexId>, int> edges;
    std::map<VertexId, std::set<VertexId>> surface, rim;
    for (const Triangle& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        ++edges[{t[i], t[(i + 1) % 3]}];
        surface[t[i]].insert({t[(i + 1) % 3], t[(i + 2) % 3]});
      }
    }
    std::size_t boundary = 0;
    for (const auto& [edge, count] : edges) {
      if (count > 1) continue;
      ++boundary;
      rim[*edge.begin()].insert(*edge.rbegin());
      rim[*edge.rbegin()].insert(*edge.begin());
    }
    // The connected pieces of a graph, each as its set of vertices.
    const auto parts = [](const std::map<VertexId, std::set<VertexId>>& graph) {
      std::set<std::set<VertexId>> all;
      for (const auto& [start, unused] : graph) {
        std::set<VertexId> part{start};
        std::vector<VertexId> open{start};
        while (!open.empty()) {
          const VertexId v = open.back();
          open.pop_back();
          for (const VertexId w : graph.at(v)) {
            if (part.insert(w).second) open.push_back(w);
          }
        }
        all.insert(part);
      }
      return all;
    };
    const auto components = parts(surface);
    REQUIRE(topology.vertices_used == surface.size());
    REQUIRE(topology.edges == edges.size());
    REQUIRE(topology.faces == triangles.size());
    REQUIRE(topology.boundary_edges == boundary);
    REQUIRE(topology.boundary_loops == parts(rim).size());
    REQUIRE(topology.components.size() == components.size());
    std::size_t at = 0;
    for (const std::set<VertexId>& component : components) {  // in the order of the smallest vertex
      const ComponentTopology& c = topology.components[at++];
      const auto inside = [&](const auto& entry) {
        return component.count(*entry.first.begin()) == 1;
      };
      REQUIRE(c.vertices == component.size());
      REQUIRE(c.edges ==
              static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), inside)));
      const auto own = [&](const Triangle& t) { return component.count(t[0]) == 1; };
      REQUIRE(c.faces ==
              static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), own)));
      // some_points() rise with their id in every coordinate.
      REQUIRE(c.box.lo == mesh.points[*component.begin()]);
      REQUIRE(c.box.hi == mesh.points[*component.rbegin()]);
      const auto on_rim = [&](VertexId v) { return rim.contains(v); };
      REQUIRE(c.closed() == std::ranges::none_of(component, on_rim));
    }
  }
}

TEST_CASE("components are listed by their smallest vertex, with their boxes") {
  TriMesh mesh;
  mesh.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {5, 5, 5}, {6, 5, 5}, {5, 6, 7}};
  mesh = make_tri_mesh(mesh.points, Triangles{{4, 5, 6}, {1, 2, 3}});
  const MeshTopology topology = mesh_topology(mesh);
  CHECK(topology.vertices_used == 6);
  CHECK(topology.edges == 6);
  REQUIRE(topology.components.size() == 2);
  CHECK(topology.components[0].box.hi == Vec3{1, 2, 0});
  CHECK(topology.components[1].box.lo == Vec3{5, 5, 5});
  CHECK(topology.components[1].box.hi == Vec3{6, 6, 7});
  CHECK(topology.components[1].vertices == 3);
  CHECK(topology.components[1].boundary_edges == 3);
}

TEST_CASE("a boundary edge off the box is reported, and no other") {
  const Box3 box{{0, 0, 0}, {4, 4, 4}};
  const Triangles triangle{{0, 1, 2}};
  // All three edges on the face z = 4.
  TriMesh mesh = make_tri_mesh({{0, 0, 4}, {3, 1, 4}, {1, 2, 4}}, triangle);
  CHECK(check_boundary_on_box(mesh, box) == "");
  // An edge of the box lies on two faces; the third vertex shares one with each of its ends.
  mesh = make_tri_mesh({{0, 0, 1}, {0, 0, 3}, {0, 2, 2}}, triangle);
  CHECK(check_boundary_on_box(mesh, box) == "");
  // On the box, but on no common face.
  mesh = make_tri_mesh({{0, 1, 1}, {1, 0, 1}, {1, 1, 0}}, triangle);
  CHECK(contains(check_boundary_on_box(mesh, box),
                 "facet 0 (0, 1, 2) ends inside the box at the edge from vertex 0 (0, 1, 1)"));
  // One floating-point step off the face.
  mesh = make_tri_mesh({{0, 0, 4}, {3, 1, std::nextafter(4.0, 0.0)}, {1, 2, 4}}, triangle);
  CHECK(check_boundary_on_box(mesh, box) != "");
  // Closed meshes have no boundary.
  CHECK(check_boundary_on_box(mesh_of(octahedron()), box) == "");
}
