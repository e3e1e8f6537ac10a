// SPDX-License-Identifier: MIT
// DelIso with a certificate in place of Recover's tests: an answer to the question that the paper
// leaves open (§6), when one may switch to Refine.
//
// Sites are vertices of the exact contour T. They are added until the labels of T have the
// topological ball property (certificate.h). Then the dual K of the labels is homeomorphic to T,
// and so to Sigma, component by component (docs/proof.md, Theorem 2). K is T_S, and the paper's
// Figure 9 refines it as published. No Voronoi edge is searched before. At worst every vertex of T
// is a site; then K is T.
//
// What the certificate does not say: K may cross itself and be far from Sigma, since a branch
// within one region is a disk. If `epsilon` is finite, ApproximateGeom follows: more vertices of T
// are sites where a facet of K breaks its criteria, and the certificate holds again.
#pragma once

#include "mesh/tri_mesh.h"
#include "paper/deliso.h"

namespace deliso {

// Returns the mesh, as paper::deliso() does. Of the options, `facet_cycles` means nothing here. S_0
// has all vertices of T on the box, which Refine does not add, and `lines` random vertices, at
// least one. Throws InputError as paper::deliso(), and for a T of 2^32 - 1 vertices.
TriMesh certified_deliso(const Volume& volume, double isovalue, const paper::Options& options,
                         paper::Report& report);

}  // namespace deliso
