// SPDX-License-Identifier: MIT
// The commands. Each reads, calls the library, writes, and returns the exit status. Faults are
// thrown.
#pragma once

#include <span>
#include <string>

#include "app/command_line.h"
#include "base/diagnostics.h"
#include "io/mesh/read_mesh.h"
#include "mesh/tri_mesh.h"

namespace deliso {

inline constexpr int kExitSuccess = 0;
inline constexpr int kFaultFound = 1;
inline constexpr int kBadUsage = 2;

int run_mesh(const CommandLine& line);
int run_part(const CommandLine& line);    // of mesh, with --part
int run_labels(const CommandLine& line);  // of mesh, with --label all
int run_info(const CommandLine& line);
int run_check(const CommandLine& line);
int run_compare(const CommandLine& line);  // of check, of two meshes
int run_render(const CommandLine& line);
// Draws the meshes, which the line's names are of, into its output. Returns a line about it. Adds
// to `told` what the reader of the line's volume tells.
std::string draw(std::span<const TriMesh> meshes, std::span<const MeshNotes> notes,
                 const CommandLine& line, Diagnostics& told);
int run_view(const CommandLine& line);
int run_trace(const CommandLine& line);
int run_join(const CommandLine& line);
int run_solid(const CommandLine& line);
int run_check_solid(const CommandLine& line);  // of check, of a solid

}  // namespace deliso
