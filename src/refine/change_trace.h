// SPDX-License-Identifier: MIT
// What Stage 2 tells a trace (trace/trace.h): which facet asks and why, and every try with the disk
// E, the cone D, and the gate that refused it. Nothing is told when the trace does not follow the
// mesh, as when it is capped.
#pragma once

#include <optional>

#include "refine/change.h"
#include "surface/criteria.h"
#include "trace/trace.h"

namespace deliso {

// Facet f asks for what follows.
void trace_facet(Trace& trace, const SurfaceMesh& s, FaceId f, std::uint8_t reason, double value);
// For the worst of its criteria.
void trace_criteria(Trace& trace, const SurfaceMesh& s, FaceId f, const FacetShape& shape,
                    const Criteria& criteria);
// Or for not being Delaunay, or a boundary edge of it for leaving its curve.
void trace_not_delaunay(Trace& trace, const SurfaceMesh& s, FaceId f);
void trace_off_curve(Trace& trace, const SurfaceMesh& s, FaceId f, int side);

// change.was is to be replaced.
void trace_disk(Trace& trace, const Change& change);
// It was, or could not be.
void trace_replacement(Trace& trace, const Change& change, bool is_done);
// Ends the event.
void trace_try(Trace& trace, Rung rung, const Change& change, std::optional<Refusal> refusal,
               const Report& report);

}  // namespace deliso
