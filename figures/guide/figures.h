// SPDX-License-Identifier: MIT
// The pictures of docs/guide, each named as its file, drawn into a folder.
#pragma once

#include <string>

namespace deliso::guide {

// six_pictures.cpp
void draw_six_pictures(const std::string& folder);
// numbers.cpp
void draw_roots(const std::string& folder);
void draw_predicates(const std::string& folder);
// plane.cpp
void draw_delaunay(const std::string& folder);
void draw_recover_paper(const std::string& folder);
// search.cpp
void draw_kdtree(const std::string& folder);
void draw_oracle(const std::string& folder);
// voxels.cpp
void draw_contour(const std::string& folder);
void draw_stars(const std::string& folder);
// stages.cpp
void draw_insert(const std::string& folder);
void draw_operations(const std::string& folder);
void draw_boundary(const std::string& folder);
void draw_checking(const std::string& folder);
// coarsen.cpp
void draw_coarsen(const std::string& folder);
// gates.cpp
void draw_gates(const std::string& folder);
// certificate.cpp
void draw_patches(const std::string& folder);
void draw_certificate(const std::string& folder);
// cells.cpp
void draw_cells(const std::string& folder);
void draw_torus(const std::string& folder);
// meshes.cpp
void draw_fineness(const std::string& folder);
void draw_certified(const std::string& folder);

}  // namespace deliso::guide
