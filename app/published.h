// SPDX-License-Identifier: MIT
// The published program (paper/deliso.h) behind --paper: its options, its run, its report.
#pragma once

#include <string>

#include "app/command_line.h"
#include "app/progress.h"
#include "app/report_writer.h"
#include "paper/deliso.h"
#include "paper/observer.h"
#include "run/report.h"

namespace deliso {

// Returns the options with r_min as a share of the volume's smallest side.
paper::Options published_options(const CommandLine& line, const Volume& volume);

// Meshes the volume as published, or with the certified Stage 1. In `report` it fills in what every
// run tells: the isovalue used, r_min, seconds, sizes, and the exact topology, which the published
// program does not know.
TriMesh mesh_as_published(const Volume& volume, double isovalue, const CommandLine& line,
                          paper::Observer& observer, paper::Report& published, Report& report);

// Shows the stages of a run.
class PublishedProgress : public paper::Observer {
 public:
  explicit PublishedProgress(Progress& progress) : progress_(progress) {}
  void stage_begins(const char* stage) override { progress_.stage_begins(stage); }
  void steps_done(std::size_t done, std::size_t queued) override {
    progress_.steps_done(done, queued);
  }

 private:
  Progress& progress_;
};

// Returns the counts that are not 0, of what was refused or left.
std::string published_counts(const paper::Report& report);
void add_published(ReportWriter& out, const CommandLine& line, const paper::Report& report);

}  // namespace deliso
