// SPDX-License-Identifier: MIT
// What the functions of c/deliso.h have in common: handles, statuses, options, progress.
#pragma once

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line.h"
#include "app/mesh_run.h"
#include "app/progress.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/diagnostics.h"
#include "blocks/block.h"
#include "c/deliso.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "io/volume/sample_grid.h"
#include "mesh/tri_mesh.h"
#include "more/solids/solid.h"
#include "volume/volume.h"

struct deliso_volume {
  std::string name;  // in messages and reports
  deliso::Volume volume;
  deliso::ReadLog log{};
  bool is_file = false;
};

struct deliso_mesh {
  deliso::WrittenMesh mesh;  // in the world
  std::vector<deliso::Vec3> normals;
  deliso::MeshWriteOptions write;
  deliso::AnatomicalSpace space{};
  deliso::MeshNotes notes;  // of a mesh that was read
  std::string names;        // of labels' segments in a mesh of all labels: lines "label name"
  std::string report;
};

namespace deliso::c {

inline constexpr char kName[] = "array";  // of a volume that is no file

// Keeps the message, and what is said after it, for deliso_last_error(). Returns the status.
deliso_status failed(deliso_status status, const char* message, const char* more = "") noexcept;

// Keeps the list for deliso_notes().
void tell(Diagnostics notes);

// Calls f, which returns whether a mesh is without faults, with the watch's flag in force.
template <class F>
deliso_status guarded(const deliso_watch* watch, F f) noexcept {
  try {
    tell({});
    const CancelScope scope(watch ? watch->cancel : nullptr);
    return f() ? DELISO_OK : failed(DELISO_FAULT, "the mesh has faults, which the report names");
  } catch (const InputError& error) {
    return failed(DELISO_BAD_INPUT, error.what());
  } catch (const Canceled& canceled) {
    return failed(DELISO_CANCELED, canceled.what());
  } catch (const std::bad_alloc&) {
    return failed(DELISO_FAILED, "out of memory");
  } catch (const InternalError& error) {
    return failed(DELISO_FAILED, error.what(), "; it may be that samples changed during the call");
  } catch (const std::exception& error) {
    return failed(DELISO_FAILED, error.what());
  } catch (...) {
    return failed(DELISO_FAILED, "an unknown error");
  }
}

// Throws InputError if the pointer, of the argument with this name, is null.
void require(const void* pointer, const char* name);

// Returns the grid of an array, as deliso_volume_create() has the arguments. Throws InputError.
SampleGrid grid_of(int type, const size_t shape[3], int order, const deliso_place* place);

// Returns the space with that short name; null or empty is unknown. Throws InputError.
AnatomicalSpace space_of(const char* name);

// Whether a call reads its volumes. A volume that is read may name its segments.
enum class Reads : std::uint8_t { nothing, read_before, now };

// Parses the options as the command's. `words`: what the command line has before them. Options
// about files that are written, or not read now, are refused. Throws InputError.
CommandLine parse(std::vector<std::string> words, const char* const* options,
                  Reads reads = Reads::nothing);
// The same of a command with a volume and an isovalue; NaN stands for none.
CommandLine parse(std::vector<std::string> words, double isovalue, const char* const* options,
                  Reads reads = Reads::nothing);

class WatchedProgress : public Progress {
 public:
  // `begin` and `end`: the run's share of the call.
  WatchedProgress(std::vector<StageCost> stages, const deliso_watch* watch, double begin = 0,
                  double end = 1)
      : Progress(std::move(stages)), watch_(watch), begin_(begin), end_(end) {}

 private:
  void draw(const std::string& stage, double share_of_run) override {
    if (!watch_ || !watch_->progress) return;
    watch_->progress(watch_->context, stage.c_str(), begin_ + (end_ - begin_) * share_of_run);
  }

  const deliso_watch* watch_;
  double begin_, end_;
};

// Fills in what `made` has of the surface, which the run has examined.
void take(const TriMesh& surface, MeshRun& run, double seconds, deliso_mesh& made);

// Returns the mesh, and what its file says beside it.
TriMesh tri_mesh_of(const deliso_mesh* mesh);
MeshNotes notes_of(const deliso_mesh& mesh);

// Returns what a handle stands for; of a null one, an empty one.
template <class Handle>
const Handle& or_empty(const Handle* handle) {
  static const Handle empty;
  return handle ? *handle : empty;
}

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t) &&
              sizeof(Tetrahedron) == 4 * sizeof(std::uint32_t));
template <class Number, class Values>
const Number* numbers_of(const Values& values, size_t* count) {
  if (count) *count = values.size();
  return reinterpret_cast<const Number*>(values.data());
}

// Returns a copy on the heap of C, for deliso_text_free(), with a zero byte behind it.
char* copied(const std::string& text);

}  // namespace deliso::c
