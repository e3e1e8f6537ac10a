// SPDX-License-Identifier: MIT
// The trace command: volume and isovalue in, a page out that shows the mesher's work.
#include <filesystem>
#include <string>

#include "app/input.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/published.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/text.h"
#include "app/trace_page.h"
#include "base/check.h"
#include "base/text.h"
#include "check/check_mesh.h"
#include "deliso/mesh_isosurface.h"
#include "view/trace/record_paper.h"
#include "view/trace/recorder.h"

namespace deliso {
namespace {

// Meshes the volume, with the report, while the trace is filled.
TriMesh traced_mesh(const CommandLine& line, const Input& input, Progress& progress, Trace& trace,
                    Report& report) {
  const Volume& volume = input.volume();
  if (line.paper) {
    PublishedProgress shown(progress);
    PaperRecorder recorder(trace, &shown);
    paper::Report published;
    return mesh_as_published(volume, input.level(), line, recorder, published, report);
  }
  TraceRecorder recorder(trace, &progress);
  Options options = line.options;
  options.observer = &recorder;
  return mesh_isosurface(volume, input.level(), options, report);
}

}  // namespace

int run_trace(const CommandLine& line) {
  ProgressBar progress(mesh_stages(line), !line.quiet);
  progress.show("reading", 0);
  const Input input = read_input(line);
  Diagnostics notes = input.log.notes;
  progress.tell(notes);
  require_limits(line.options, input.grid());
  Trace trace(line.trace.limit, line.trace.times);
  Report report;
  const TriMesh mesh = traced_mesh(line, input, progress, trace, report);
  if (mesh.faces.empty()) {
    throw InputError(no_surface_text(*input.isovalue, *input.range));
  }

  progress.show("writing", 0);
  const TopologyCounts topology = mesh_topology(mesh).counts();
  PageData data;
  add_trace(trace, data);
  // The page finds samples by even steps.
  const bool is_small = input.grid().sample_count() <= kMostSamplesShown,
             has_samples = is_small && input.grid().is_even();
  if (has_samples) add_samples(input.volume(), *input.range, data);
  const std::string title = "deliso trace " + std::filesystem::path(input.name).filename().string();
  {
    const DeferSignals defer;
    write_page(line.output, title, trace_header(line, input, report, topology, trace), data);
  }
  progress.clear();
  if (trace.truncated()) {
    add_warning(notes, "trace-cut", "", "the page has the first ", line.trace.limit, " of ",
                trace.events_seen(), " events: --trace-limit N takes more");
  }
  if (!has_samples) {
    add_warning(notes, "trace-without-slices", "", "the page has no slices of the volume, ",
                is_small ? "whose steps are not even"
                         : "which has more than 2 million samples: --roi takes a part");
  }
  progress.tell(notes);
  if (!line.quiet && line.output != "-") {
    print(counted(trace.size(), "event") + ", " + counted(mesh.faces.size(), "triangle") +
          " in the end, in " + one_line(line.output) + "\n");
  }
  return kExitSuccess;
}

}  // namespace deliso
