// SPDX-License-Identifier: MIT
#include "more/bodies/bodies.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/sorted_list.h"
#include "check/check_mesh.h"
#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"
#include "embedding/box_grid.h"

namespace deliso {
namespace {

constexpr int kMostRounds = 40;
// Least distances between seeds, in their spacing, where four, three and two bodies meet.
constexpr double kAtCorner = 0.35, kAtCurve = 0.55, kAtSheet = 0.62;
// Least distance of a point added from others: of its distance to the facet's corners, and in
// voxels. With 0.2 voxels some facets stay 3 D from their interface.
constexpr double kApart = 0.5, kApartVoxels = 0.01;

// Barycentric coordinates of the points of a facet whose distance is measured.
constexpr std::array<std::array<double, 3>, 7> kLooks{{{1. / 3, 1. / 3, 1. / 3},
                                                       {0.5, 0.5, 0},
                                                       {0, 0.5, 0.5},
                                                       {0.5, 0, 0.5},
                                                       {0.6, 0.2, 0.2},
                                                       {0.2, 0.6, 0.2},
                                                       {0.2, 0.2, 0.6}}};

constexpr double kFaulty = 1e9;
struct Candidate {
  double urgency;  // its facet's distance; or its radius and kFaulty, which is more
  Vec3 p;
  double apart;
};

// Returns a mesh of the triangles, with the points that they use, in the same order. Sets `used` to
// the numbers of these.
TriMesh mesh_of_used(const std::vector<Vec3>& points, std::vector<Triangle> triangles,
                     std::vector<VertexId>& used) {
  used.clear();
  for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
  sort_unique(used);
  std::vector<Vec3> kept;
  kept.reserve(used.size());
  for (const VertexId v : used) kept.push_back(points[v]);
  for (Triangle& t : triangles) {
    for (VertexId& v : t) {
      v = VertexId(static_cast<std::uint32_t>(std::ranges::lower_bound(used, v) - used.begin()));
    }
  }
  return make_tri_mesh(std::move(kept), triangles);
}

std::vector<Triangle> triangles_of(std::span<const InterfaceFacet> facets, BodyId body) {
  std::vector<Triangle> triangles;
  for (const auto& [v, bodies] : facets) {
    if (bodies[1] == body) triangles.push_back(v);
    if (bodies[0] == body) triangles.push_back({v[0], v[2], v[1]});
  }
  return triangles;
}

class Builder {
 public:
  Builder(const Partition& partition, double max_distance)
      : partition_(partition),
        max_distance_(max_distance),
        voxel_(partition.volume().voxel()),
        grid_(partition.volume().box(), voxel_) {}

  InterfaceMesh run(std::span<const InterfaceSeed> seeds) {
    sample_ties(seeds);
    for (int round = 0; round < kMostRounds; ++round) {
      label_cells();
      find_facets();
      const std::vector<std::uint8_t> is_faulty = measure_bodies();
      const std::vector<double> away = distances();
      mesh_.largest_distance = away.empty() ? 0 : *std::ranges::max_element(away);
      if (add_points(candidates(is_faulty, away)) == 0) break;
    }
    return take_mesh();
  }

 private:
  // Adds p unless a point is nearer than `apart`. Returns whether it did.
  bool add_point(const Vec3& p, double apart) {
    const auto is_near = [&](VertexId v, const BoxGrid::Box&) {
      return distance2(points_[v], p) < apart * apart;
    };
    if (grid_.any<VertexId>(grid_.box_around(p, apart), is_near)) return false;
    grid_.add(static_cast<BoxGrid::Id>(points_.size()), grid_.box_of(p));
    points_.push_back(p);
    return true;
  }

  // Samples where four, three and two bodies meet near seeds, in this order.
  void sample_ties(std::span<const InterfaceSeed> seeds) {
    for (std::size_t ties = 4; ties >= 2; --ties) {
      const double apart = ties == 4 ? kAtCorner : ties == 3 ? kAtCurve : kAtSheet;
      for (const InterfaceSeed& seed : seeds) {
        Partition::Ranking best = partition_.rank(seed.p);
        std::optional<Vec3> p = seed.p;
        // From two bodies to three and four, so that the others are those at the curve.
        for (std::size_t n = 2; n <= ties && p; ++n) {
          if (best.count < n) p.reset();
          if (p) p = partition_.tie(*p, std::span(best.body).first(n), 1.5 * seed.spacing);
          if (p) best = partition_.rank(*p);
        }
        if (p && best.count >= ties && best.value[0] - best.value[ties - 1] < 1e-3) {
          add_point(*p, apart * seed.spacing);
        }
      }
    }
    std::vector<Vec3> sites = points_;
    const Box3 box = partition_.volume().box().grown(length(partition_.volume().box().hi));
    for (int m = 0; m < 8; ++m) {
      sites.push_back(
          {m & 1 ? box.hi.x : box.lo.x, m & 2 ? box.hi.y : box.lo.y, m & 4 ? box.hi.z : box.lo.z});
    }
    std::vector<SiteId> ids;
    cells_.build(sites, ids);
  }

  // A cell keeps its body from the last round if it has the same center.
  void label_cells() {
    body_.resize(cells_.cell_capacity());
    center_.resize(cells_.cell_capacity());
    for (CellId c(0); c < cells_.cell_capacity(); ++c) {
      if (!cells_.is_live(c)) continue;
      const bool is_infinite = cells_.is_infinite(c);
      const Vec3 center = is_infinite ? Vec3() : circumsphere(cells_, c).center;
      if (!is_infinite && center == center_[c]) continue;
      center_[c] = center;
      body_[c] = !is_infinite && is_finite(center) ? partition_.body_at(center) : 0;
    }
  }

  // Sets the facets, each once, and for each the cells in front and behind.
  void find_facets() {
    facets_.clear();
    between_.clear();
    sites_.assign(1, {});
    for (SiteId v(1); v < cells_.vertex_capacity(); ++v) sites_.push_back(cells_.point(v));
    for (CellId c(0); c < cells_.cell_capacity(); ++c) {
      if (!cells_.is_live(c)) continue;
      for (int i = 0; i < 4; ++i) {
        const CellId front = cells_.neighbor(c, i);
        const BodyId a = body_[front], b = body_[c];
        if (a == b || b == 0 || (a != 0 && a < b)) continue;
        facets_.push_back({as_mesh_triangle(facet_vertices(cells_, {c, i})), {a, b}});
        between_.push_back({front, c});
      }
    }
  }

  // Returns where the Voronoi edge of facet f passes from one body to another.
  Vec3 surface_center(std::size_t f) const {
    Vec3 a = center_[between_[f][1]], b = center_[between_[f][0]];
    for (int n = 0; n < 40; ++n) {
      const Vec3 middle = 0.5 * (a + b);
      (partition_.body_at(middle) == facets_[f].bodies[1] ? a : b) = middle;
    }
    return b;
  }

  // Sets the topology of each body, and whether it is a manifold. Returns per vertex whether a body
  // is no manifold there.
  std::vector<std::uint8_t> measure_bodies() {
    std::vector<std::uint8_t> faulty(cells_.vertex_capacity());
    mesh_.topology.assign(partition_.size(), {});
    mesh_.is_manifold.assign(partition_.size(), 1);
    for (BodyId body = 0; body < partition_.size(); ++body) {
      std::vector<VertexId> number;
      const TriMesh mesh = mesh_of_used(sites_, triangles_of(facets_, body), number);
      std::vector<std::uint32_t> facets(mesh.points.size());
      std::vector<FaceId> any(mesh.points.size()), star;
      const auto mark = [&](VertexId v) {
        faulty[number[v]] = 1;
        mesh_.is_manifold[body] = 0;
      };
      for (FaceId f(0); f < mesh.faces.size(); ++f) {
        const Face& face = mesh.faces[f];
        for (int i = 0; i < 3; ++i) {
          ++facets[face.v[i]];
          any[face.v[i]] = f;
          if (face.n[i] != kNoId) continue;
          mark(face.v[(i + 1) % 3]);
          mark(face.v[(i + 2) % 3]);
        }
      }
      for (VertexId v(0); v < mesh.points.size(); ++v) {
        facets_around(mesh, any[v], v, star);
        if (star.size() != facets[v]) mark(v);
      }
      mesh_.topology[body] = mesh_topology(mesh).counts();
    }
    return faulty;
  }

  // Returns the distance of each facet from its interface.
  std::vector<double> distances() const {
    std::vector<double> away;
    for (const auto& [v, bodies] : facets_) {
      double& largest = away.emplace_back(0);
      for (const auto& [x, y, z] : kLooks) {
        const Vec3 p = x * sites_[v[0]] + y * sites_[v[1]] + z * sites_[v[2]];
        largest = std::max(largest, partition_.distance_to_tie(p, bodies[0], bodies[1]));
      }
    }
    return away;
  }

  // Returns the surface centers of facets that are too far `away` from their interface, or at a
  // faulty vertex. No point is nearer to such a center than the facet's corners.
  std::vector<Candidate> candidates(const std::vector<std::uint8_t>& is_faulty,
                                    const std::vector<double>& away) const {
    std::vector<Candidate> found;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const Triangle& v = facets_[f].v;
      const bool at_fault = is_faulty[v[0]] || is_faulty[v[1]] || is_faulty[v[2]];
      if (!at_fault && away[f] <= max_distance_) continue;
      const Vec3 p = surface_center(f);
      const double radius = distance(p, sites_[v[0]]);
      found.push_back({at_fault ? kFaulty + radius : away[f], p,
                       std::max(kApart * radius, kApartVoxels * voxel_)});
    }
    return found;
  }

  // Adds the candidates that are not too near others, the most urgent first. Returns how many.
  std::size_t add_points(std::vector<Candidate> candidates) {
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::urgency);
    std::size_t added = 0;
    for (const Candidate& c : candidates) {
      if (!add_point(c.p, c.apart)) continue;
      cells_.insert(c.p);
      ++added;
    }
    return added;
  }

  // Moves the mesh out, without the points that no facet uses.
  InterfaceMesh take_mesh() {
    std::vector<Triangle> all;
    for (const InterfaceFacet& f : facets_) all.push_back(f.v);
    std::vector<VertexId> used;
    const TriMesh mesh = mesh_of_used(sites_, std::move(all), used);
    mesh_.points = mesh.points;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      mesh_.facets.push_back({mesh.faces[FaceId(f)].v, facets_[f].bodies});
    }
    return std::move(mesh_);
  }

  const Partition& partition_;
  double max_distance_, voxel_;
  BoxGrid grid_;
  std::vector<Vec3> points_;
  Triangulation cells_;
  std::vector<Vec3> sites_;                     // its points
  IdArray<CellId, BodyId> body_;                // of each cell
  IdArray<CellId, Vec3> center_;                // of its circumsphere
  std::vector<InterfaceFacet> facets_;          // of sites
  std::vector<std::array<CellId, 2>> between_;  // in front and behind, of each facet
  InterfaceMesh mesh_;
};

}  // namespace

TriMesh InterfaceMesh::mesh_of(BodyId body) const {
  std::vector<VertexId> used;
  return mesh_of_used(points, triangles_of(facets, body), used);
}

InterfaceMesh mesh_interfaces(const Partition& partition, std::span<const InterfaceSeed> seeds,
                              double max_distance) {
  return Builder(partition, max_distance).run(seeds);
}

}  // namespace deliso
