// SPDX-License-Identifier: MIT
// Meshes a volume by CGAL's Mesh_3, for the gauntlet: the surface of a gray-level image with
// DelIso's default bounds, 14.4 degrees and a tenth of a voxel. Its initialization looks at all
// samples, as the default one, a few rays, misses components. Points are on the surface to 1e-5 of
// the box.
//   gauntlet_cgal INPUT ISOVALUE OUT.off [any]    any: not held to a manifold
//   gauntlet_cgal --version
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_3/initialize_triangulation_from_gray_image.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/refine_mesh_3.h>
#include <CGAL/version.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace {

namespace cp = CGAL::parameters;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

CGAL::Image_3 image_of(const deliso::Volume& volume) {
  const deliso::Index3 n = volume.dims();
  const deliso::Vec3 spacing = volume.spacing();
  _image* image = _createImage(static_cast<std::size_t>(n.i), static_cast<std::size_t>(n.j),
                               static_cast<std::size_t>(n.k), 1, spacing.x, spacing.y, spacing.z,
                               sizeof(double), WK_FLOAT, SGN_SIGNED);
  volume.visit([&](const auto* samples) {
    std::copy(samples, samples + volume.sample_count(), static_cast<double*>(image->data));
  });
  return CGAL::Image_3(image);
}

// Facets are counter-clockwise seen from where the values are smaller.
void write_off(const Complex& complex, const std::string& path) {
  std::map<Triangulation::Vertex_handle, std::size_t> ids;
  std::vector<Triangulation::Vertex_handle> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;
  for (auto it = complex.facets_in_complex_begin(); it != complex.facets_in_complex_end(); ++it) {
    Triangulation::Facet facet = *it;
    if (complex.subdomain_index(facet.first) != Complex::Subdomain_index())
      facet = complex.triangulation().mirror_facet(facet);
    auto& triangle = triangles.emplace_back();
    for (int n = 0; n < 3; ++n) {
      const auto v = facet.first->vertex(Triangulation::vertex_triple_index(facet.second, n));
      const auto [place, is_new] = ids.try_emplace(v, vertices.size());
      if (is_new) vertices.push_back(v);
      triangle[static_cast<std::size_t>(n)] = place->second;
    }
  }
  std::ofstream out(path);
  out.precision(17);
  out << "OFF\n" << vertices.size() << ' ' << triangles.size() << " 0\n";
  for (const auto& v : vertices) {
    out << v->point().x() << ' ' << v->point().y() << ' ' << v->point().z() << '\n';
  }
  for (const auto& [a, b, c] : triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
}

void mesh(const std::string& input, double isovalue, const std::string& path, bool manifold) {
  const deliso::Volume volume = deliso::read_volume(input, {}, nullptr);
  const deliso::Vec3 spacing = volume.spacing();
  const CGAL::Image_3 image = image_of(volume);
  const Domain domain = Domain::create_gray_image_mesh_domain(image, cp::iso_value = isovalue,
                                                              cp::value_outside = isovalue - 1,
                                                              cp::relative_error_bound = 1e-5);
  const Criteria criteria(cp::facet_angle = 14.4,
                          cp::facet_distance = 0.1 * std::min({spacing.x, spacing.y, spacing.z}));
  Complex complex;
  initialize_triangulation_from_gray_image(complex, domain, image, criteria, isovalue, double());
  const auto refine = [&](auto topology) {
    CGAL::refine_mesh_3(complex, domain, criteria, cp::no_perturb(), cp::no_exude(), topology);
  };
  manifold ? refine(cp::manifold()) : refine(cp::non_manifold());
  write_off(complex, path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--version") {
    std::puts(CGAL_VERSION_STR);
    return 0;
  }
  if (argc != 4 && argc != 5) {
    std::fputs("usage: gauntlet_cgal INPUT ISOVALUE OUT.off [any]\n", stderr);
    return 2;
  }
  try {
    std::cout.setstate(std::ios::failbit);  // the initialization prints
    mesh(argv[1], std::strtod(argv[2], nullptr), argv[3], argc == 4);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gauntlet_cgal: %s\n", error.what());
    return 2;
  }
  return 0;
}
