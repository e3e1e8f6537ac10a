// SPDX-License-Identifier: MIT
// A verification as text and as JSON, and its options from the command line.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/criteria_note.h"
#include "app/input.h"
#include "app/report_writer.h"
#include "check/check_solid.h"
#include "check/compare_meshes.h"
#include "check/verify.h"
#include "io/mesh/read_mesh.h"

namespace deliso {

// Advice about crossings that rounding to float made.
inline constexpr const char* kKeepDoubles =
    ".ply, .off, .obj, .vtp, .3mf, .smesh and .poly keep doubles, without --float";

// Returns the options of a verification, with lengths in the scaled frame and tolerance 0.
// Both the check command and --check judge by `noted`, the criteria in the mesh's file, and require
// that few triangles are over a limit if there are any. Limits given to the check command go before
// these, and it requires a distance given.
VerifyOptions verify_options(const CommandLine& line, const Grid& volume,
                             const std::optional<Criteria>& noted);

// Verifies a mesh in the world, given what its file says. The check command and --check do this.
Verification verify_in_world(TriMesh mesh, const MeshNotes& notes, const CommandLine& line,
                             const Input& input, std::function<void(double)> progress = {});

// The check command without its files.
struct CheckRun {
  Verification verification;
  bool by_comments = false;  // the criteria come from the comments
  bool is_single = false;    // coordinates are floats, about some point
  std::string json;
};
CheckRun check_mesh_in_world(TriMesh mesh, const MeshNotes& notes, const CommandLine& line,
                             const Input& input, std::function<void(double)> progress = {});

// Give how distances are spread, in this unit: aligned lines, with the points beyond the bound if
// there is one, and members.
std::string distances_text(const char* name, const Distances& d, double bound, double unit,
                           std::string_view unit_name, const Frame& frame);
void add_spread(ReportWriter& out, const Distances& d, double unit, std::string_view unit_words);
inline constexpr const char* kGivenUpWords =
    "points left out since too many triangles lie across each other there";

// Give the faults, whose places are in this frame: aligned lines, and an object "faults". Of a mesh
// and of a solid.
template <class Kind>
std::string faults_text(const FaultList<Kind>& faults, const Frame& frame);
template <class Kind>
void add_faults(ReportWriter& out, const FaultList<Kind>& faults, const Frame& frame);
std::string place_text(const Vec3& p);  // "(x y z)"

// Returns aligned lines. Lengths are in voxels, places of faults in the
// world.
std::string verification_text(const Verification& v, const Grid& volume);

// Adds an object "check".
void add_verification(ReportWriter& out, const Verification& v, const Grid& volume);
// Adds the members of the report on two meshes.
void add_comparison(ReportWriter& out, const std::array<std::string, 2>& names,
                    const MeshComparison& c);
// Adds the members of the check command's report.
void add_check(ReportWriter& out, std::string_view mesh, bool by_comments, const Input& input,
               const Verification& v);

}  // namespace deliso
