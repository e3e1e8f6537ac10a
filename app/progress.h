// SPDX-License-Identifier: MIT
// One progress bar on standard error for the whole of a run: only where that is a terminal, and
// gone again when done.
//
// Every stage has a share of the bar: the typical share of its time, as measured on ENGINE, BABY
// and LEG, by default and by the paper's way (docs/results.md has the data sets). A volume on which
// stages take other shares makes the bar run unevenly, but
//   B1  it never goes back, whatever it is told, and a stage that it does not know changes nothing;
//   B2  it is at 100 % in the last stage at most;
//   B3  no line is as wide as the terminal, so that none wraps.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "surface/observer.h"

namespace deliso {

struct StageCost {
  std::string_view stage;
  double cost;  // in some unit
};

// The stages of the mesh command, in order: reading, those that a run tells of, check, writing.
std::vector<StageCost> mesh_stages(const CommandLine& line);

// How much of the whole is done: B1 and B2.
class ProgressModel {
 public:
  explicit ProgressModel(std::vector<StageCost> stages);
  // The share of all, in [0, 1]. `share` of the stage is done.
  double at(std::string_view stage, double share);

 private:
  std::vector<StageCost> stages_;
  double total_ = 0, reached_ = 0;
};

// "meshing  [####......]  42 %  recover  0:07", without an end of line, at most columns - 1 wide;
// a narrow terminal has a shorter bar, or none.
std::string progress_line(std::string_view stage, double share, double seconds, int columns,
                          bool colored);

class Progress : public Observer {
 public:
  // Shows nothing when `wanted` is false, or standard error is no terminal that can redraw a line.
  Progress(std::vector<StageCost> stages, bool wanted);
  ~Progress() override { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void stage_begins(const char* stage) override { show(stage, 0); }
  // A queue grows while it is worked on, and others may follow: a guess.
  void steps_done(std::size_t done, std::size_t queued) override {
    const auto steps = static_cast<double>(done);
    show(std::string(stage_), steps / (steps + static_cast<double>(queued)));
  }

  // `share` of the stage is done, in [0, 1]. Cheap to call often: draws when a stage begins, and
  // ten times a second.
  void show(std::string_view stage, double share);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  ProgressModel model_;
  bool visible_;
  bool colored_;
  bool drawn_ = false;
  std::string stage_;
  Clock::time_point start_, last_;
};

}  // namespace deliso
