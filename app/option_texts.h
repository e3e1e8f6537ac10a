// SPDX-License-Identifier: MIT
// What the program says of itself to other programs: texts from its tables.
#pragma once

#include <string>
#include <string_view>

namespace deliso {

inline constexpr std::string_view kPurpose =
    "Turns volumes (CT, MRI, simulation) into Delaunay surface meshes of their isosurfaces, with "
    "the "
    "exact topology, bounded triangle shapes and adaptive size.";
inline constexpr std::string_view kVolumeFiles =
    "INPUT: .nrrd .nhdr .mhd .mha .nii .nii.gz .hdr .mrc .map .inr .vtk .vti .npy .tif .dcm, a "
    "folder of slices (DICOM, TIFF), raw data with --dims and --type, builtin:NAME[:SIZE], or - "
    "for standard input.";
inline constexpr std::string_view kMeshFiles =
    "MESH: .ply .off .obj .stl .vtp .glb .3mf, or - for standard input.";
inline constexpr std::string_view kExitStatus =
    "0 fine, 1 a fault was found, 2 bad usage or input.";
inline constexpr std::string_view kExamples =
    "  deliso info scan.nrrd                      what is in it, and which isovalues to try\n"
    "  deliso scan.nrrd --iso 40 -o scan.ply      a mesh of 0.1 voxel\n"
    "  deliso scan.nrrd --iso 40 --max-distance 0.3vox -o coarse.ply\n"
    "  deliso scan.nrrd --iso 40 --vertices 20000 --cap -o solid.stl\n"
    "  deliso scan.nrrd --iso 40 --smooth 0.7vox -o scan.ply   where there is noise\n"
    "  deliso organs.nrrd --label all -o organ-%d.ply          a mesh for each label\n"
    "  deliso solid scan.ply -o scan.vtu          a closed surface, filled with tetrahedra\n"
    "  deliso check scan.ply scan.nrrd --iso 40   is it right?\n"
    "  deliso render scan.ply -o scan.png         a picture\n"
    "  deliso view scan.ply -o scan.html          a page to turn it in, and to look into it\n";

std::string man_page();
std::string bash_completion();
std::string zsh_completion();
std::string markdown_page();   // docs/guide/options.md
std::string report_schema();   // of what mesh, check and info write with --json (report_json.cpp)
std::string python_options();  // python/deliso/_options.py

struct HelpText {
  std::string_view topic;  // of deliso help
  std::string (*write)();
};
inline constexpr HelpText kTextTable[] = {{"man", man_page},          {"bash", bash_completion},
                                          {"zsh", zsh_completion},    {"markdown", markdown_page},
                                          {"python", python_options}, {"schema", report_schema}};

}  // namespace deliso
