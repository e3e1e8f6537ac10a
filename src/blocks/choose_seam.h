// SPDX-License-Identifier: MIT
// Which points of a curve on an inner face become vertices of the mesh's seam. The block beyond
// must come to the same, so nothing is asked but the face's samples and the criteria: the points
// are crossings of grid edges, taken in an order of their own, whichever way the loop runs and
// wherever it begins.
//
// From one vertex on as many crossings are passed over as leave the chord near the curve and not
// too long, so crossings that lie next to each other, beside a sample, make no short edges. Then
// chords that come near another one, of any curve on the face, are halved until none do: the curves
// through all crossings never meet.
#pragma once

#include <vector>

#include "surface/boundary.h"
#include "surface/parameters.h"
#include "volume/volume.h"

namespace deliso {

// Marks these as kept, and nothing else on inner faces.
void choose_seams(const Volume& volume, const Parameters& parameters,
                  std::vector<BoundaryLoop>& loops);

}  // namespace deliso
