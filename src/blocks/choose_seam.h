// SPDX-License-Identifier: MIT
// The boundary curves of T, and the choice of seam vertices among the points of a curve on an inner
// face. The neighboring block must choose the same. So the choice depends only on the face's
// samples and the criteria. The candidates are crossings of grid edges, in an order that does not
// depend on the loop's direction or start.
//
// From one vertex on, crossings are skipped while the chord stays near the curve and not too long.
// So adjacent crossings, beside a sample, make no short edges. Then chords that come near another
// one, of any curve on the face, are halved until none do. That terminates, since the curves
// through all crossings never meet.
#pragma once

#include "contour/contour.h"
#include "surface/boundary.h"
#include "surface/parameters.h"

namespace deliso {

// Returns the curves in which T ends on the box. On inner faces, the points of seams are marked as
// kept.
BoundaryCurves boundary_curves(const Isosurface& surface, const ContourMesh& contour,
                               const Parameters& parameters);

}  // namespace deliso
