// SPDX-License-Identifier: MIT
// The check command: a mesh file and a volume in, a proof or a list of faults out.
#include <string>
#include <utility>

#include "app/bring_home.h"
#include "app/check_report.h"
#include "app/input.h"
#include "app/output.h"
#include "app/run.h"
#include "base/check.h"
#include "base/text.h"
#include "check/verify.h"
#include "contour/contour.h"
#include "io/mesh/read_mesh.h"

namespace deliso {

Verification verify_in_world(TriMesh mesh, const MeshNotes& notes, const CommandLine& line,
                             const Input& input, std::function<void(double)> progress) {
  const Volume& volume = input.volume();
  VerifyOptions options = verify_options(line, volume, noted_criteria(notes.comments));
  options.progress = std::move(progress);
  options.tolerance = bring_home(mesh, volume, notes.rounding, line.verify.tolerance.in(volume));
  return verify(mesh, volume, geometric_isovalue(volume.type(), input.level()), options);
}

CheckRun check_mesh_in_world(TriMesh mesh, const MeshNotes& notes, const CommandLine& line,
                             const Input& input, std::function<void(double)> progress) {
  CheckRun run;
  run.by_comments = !line.paper && noted_criteria(notes.comments);
  run.is_single = notes.rounding > 0 || digits_of(mesh.points).is_single;
  run.verification = verify_in_world(std::move(mesh), notes, line, input, std::move(progress));

  ReportWriter out("check");
  add_check(out, line.meshes.front(), run.by_comments, input, run.verification);
  run.json = out.finish();
  return run;
}

int run_check(const CommandLine& line) {
  if (has_solid_ending(line.meshes.front())) return run_check_solid(line);
  if (line.meshes.size() > 1) return run_compare(line);
  MeshNotes notes;
  TriMesh mesh = read_mesh(line.meshes.front(), &notes);
  Input input = read_input(line, line.meshes);
  turn_to(mesh.frame.space, line, input);
  const std::string asked = field_note(line.field, input.grid());
  const auto made = noted_field(notes.comments);
  if (made && *made != asked) {
    add_warning(input.log.notes, "field-differs", line.meshes.front(),
                "is of another field: its file says", made->empty() ? " no filter" : *made,
                ", this check", asked.empty() ? " has no filter" : " says" + asked);
  }
  print_warnings(input.log.notes);
  const CheckRun run = check_mesh_in_world(std::move(mesh), notes, line, input);
  const Verification& result = run.verification;
  if (!line.json.empty()) write_text(line.json, run.json);
  if (!line.quiet && line.json != "-") {
    const char* judged = run.by_comments ? ", judged by the criteria in its comment\n" : "\n";
    std::string text = "mesh      " + one_line(line.meshes.front()) + judged + input_text(input) +
                       verification_text(result, input.grid());
    if (run.is_single && result.faults.count(FaultKind::self_intersections) > 0) {
      text += std::string(
                  "          coordinates are in single precision, which may be why "
                  "triangles cross: ") +
              kKeepDoubles + "\n";
    }
    print(text);
  }
  return result.faults.any() ? kFaultFound : kExitSuccess;
}

}  // namespace deliso
