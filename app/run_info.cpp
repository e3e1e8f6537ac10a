// SPDX-License-Identifier: MIT
// The info command: a volume's properties, the distribution of its samples, and the surface at an
// isovalue, also as a picture of slices.
#include <algorithm>
#include <array>

#include "app/info.h"
#include "app/output.h"
#include "app/run.h"
#include "app/signals.h"
#include "view/gray/slices.h"
#include "view/render/write_png.h"

namespace deliso {
namespace {

// Returns the middle of the volume or, where there is a surface, of its largest component.
Vec3 middle_of(const Info& info) {
  const Volume& volume = info.input.volume();
  Box3 box = volume.box();
  if (const auto& components = info.contour.components; !components.empty()) {
    const ContourComponent& largest =
        *std::ranges::max_element(components, {}, &ContourComponent::crossings);
    box = {volume.position(largest.lo), volume.position(corner_of(largest.hi, 7))};
  }
  return box.middle();
}

void write_slices(const Info& info, const CommandLine& line) {
  const Volume volume = info.input.samples();
  const RenderOptions& picture = line.picture.render;
  SliceOptions options{.size = picture.size,
                       .through = picture.aim.look_at
                                      ? volume.frame().from_world(*picture.aim.look_at)
                                      : middle_of(info),
                       .window = gray_window(volume, info.histogram.range)};
  if (info.isovalue) options.kappa = info.effective;
  // Patients are measured in millimeters.
  const bool of_patient = volume.frame().space != AnatomicalSpace::unknown;
  options.unit = picture.scale_bar.value_or(of_patient ? "mm" : "");
  options.threads = line.options.threads;
  const Image image = draw_slices(volume, options);
  const DeferSignals defer;
  write_png(image, line.output);
}

}  // namespace

int run_info(const CommandLine& line) try {
  ProgressBar progress(info_stages(line), !line.quiet);
  progress.show("reading", 0);
  const Input input = read_to_inform(line);
  progress.tell(input.log.notes);
  const Info info = find_info(input, line, progress);
  if (!line.output.empty()) {
    progress.show("slices", 0);
    write_slices(info, line);
  }
  progress.clear();
  if (!line.json.empty()) write_text(line.json, info_json(info));
  if (!line.quiet && line.json != "-") print_report(info_text(info), line.output == "-");
  return kExitSuccess;
} catch (const SeveralSeries& several) {
  if (line.read.series || !line.output.empty()) throw;
  require_outputs(std::array{line.json}, several.paths);
  print_warnings(several.notes);
  if (!line.json.empty()) write_text(line.json, series_json(line.input, several.series));
  if (!line.quiet && line.json != "-") print(series_text(line.input, several.series));
  return kExitSuccess;
}

}  // namespace deliso
