// SPDX-License-Identifier: MIT
// Parts of a mesh, made and joined, from samples that are read box by box (blocks/block.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/field.h"
#include "app/input.h"
#include "app/mesh_run.h"
#include "app/progress.h"
#include "blocks/block.h"
#include "io/parts/part_file.h"
#include "io/volume/read_volume.h"
#include "mesh/tri_mesh.h"
#include "run/observer.h"
#include "run/report.h"
#include "volume/volume.h"

namespace deliso {

// Returns how the volume of a part is read: only the samples that the part needs, those of its
// blocks with some around them for the filters. All of them if it needs to know all labels or
// components, or if there is a region of interest. pre: `line` lives until the volume is read.
ReadOptions reading_of_part(const CommandLine& line);

// The field that is meshed, of which the samples may be read box by box; and the isovalue in it.
struct FieldSource {
  Field field;
  double isovalue = 0;
};

// Returns the field. Each box is filtered by itself, with the samples around it that the filters
// reach, so its samples are those of the whole field. Of labels all of the volume is read now.
// Reading throws InputError, with the volume's `name`, for a sample that value_range() refuses.
// `ids`: those of the samples (ReadLog).
FieldSource field_source(const VolumeSource& stored, const CommandLine& line,
                         const std::string& name, const std::vector<std::int64_t>& ids = {});

// Meshes the part that the line asks for. Throws InputError.
PartFile make_part(const VolumeSource& raw, const CommandLine& line, const std::string& name,
                   Observer* observer, const std::vector<std::int64_t>& ids = {});

// Returns the command line that the parts were made with, for the volume named `input`, and with
// `more` words. Throws InputError, with the part's name, if its words are no options of a mesh, or
// contradict its counts.
CommandLine line_of(const PartFile& part, const std::string& input,
                    std::span<const std::string> more = {});
// The same, with the join's own words: threads, checks, reports and files.
CommandLine line_of_join(const CommandLine& join, const PartFile& part);

// Throws InputError unless the parts, in order, were made of this field.
void require_field(std::span<const PartFile> parts, const FieldSource& field,
                   const Options& options, const std::string& volume);

// Returns the input of a join, of which `log` and `seconds` tell how the volume was opened. Reads
// all samples of the field if the line needs them: for a check, for caps, for attributes. What else
// the report tells needs the samples of few voxels.
Input input_of_join(const CommandLine& line, FieldSource field, ReadLog log = {},
                    double seconds = 0);

// Joins the parts, which are in order and of the run's field. Checks and measures the mesh as
// mesh_input() does, and fills in the run. Throws InputError.
TriMesh join_parts_of(std::vector<PartFile> parts, MeshRun& run, Progress& progress);

}  // namespace deliso
