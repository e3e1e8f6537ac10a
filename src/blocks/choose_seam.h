// SPDX-License-Identifier: MIT
// The boundary curves of T, and which points of a curve on an inner face become vertices of the
// mesh's seam. The block beyond must come to the same, so nothing is asked but the face's samples
// and the criteria: the points are crossings of grid edges, taken in an order of their own,
// whichever way the loop runs and wherever it begins.
//
// From one vertex on as many crossings are passed over as leave the chord near the curve and not
// too long, so crossings that lie next to each other, beside a sample, make no short edges. Then
// chords that come near another one, of any curve on the face, are halved until none do: the curves
// through all crossings never meet.
#pragma once

#include "contour/contour.h"
#include "surface/boundary.h"
#include "surface/parameters.h"

namespace deliso {

// The curves in which T ends on the box; of those on inner faces the points of seams are kept.
BoundaryCurves boundary_curves(const Isosurface& surface, const ContourMesh& contour,
                               const Parameters& parameters);

}  // namespace deliso
