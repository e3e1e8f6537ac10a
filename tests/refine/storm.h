// SPDX-License-Identifier: MIT
// One operation of Stage 2, tried at random places of all scenes. After each that was done the mesh
// must be valid; a refused one must have left every byte as it was.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <functional>
#include <optional>

#include "refine/operations.h"
#include "refine/stage.h"

namespace deliso::test {

struct StormTally {
  std::size_t done = 0, refused = 0;
  std::array<std::size_t, kRefusals> refusals{};

  std::size_t operator[](Refusal refusal) const {
    return refusals[static_cast<std::size_t>(refusal)];
  }
};

// A try: where it is and what was there before.
struct Try {
  FaceId f;    // at random, alive
  int number;  // within the scene
  Stage::Snapshot before;
};

// A row: an operation, and what must hold when it is done.
struct Storm {
  std::uint64_t seed;  // of scene n: seed + n
  int tries;           // in each scene
  std::function<Options(int n)> options;
  // May change the mesh first. False: nothing is tried.
  std::function<bool(Stage&, Try&, Random&)> prepare;
  std::function<std::optional<Refusal>(Stage&, const Try&)> attempt;
  std::function<void(Stage&, const Try&)> after;
  bool refined = false;  // Stage 2 done, too
};

inline void run_storm(const Storm& storm, StormTally& tally) {
  for (int n = 0; n < kScenes; ++n) {
    CAPTURE(n);
    const Scene scene = some_scene(n);
    Stage stage(scene, storm.options(n), storm.refined);
    REQUIRE(stage.fault() == "");
    Random random(storm.seed + static_cast<std::uint64_t>(n));
    for (int k = 0; k < storm.tries; ++k) {
      CAPTURE(k);
      Try now{stage.random_facet(random), k, {}};
      if (!storm.prepare(stage, now, random)) continue;
      now.before = stage.snapshot();
      if (const auto refusal = storm.attempt(stage, now)) {
        ++tally.refused;
        ++tally.refusals[static_cast<std::size_t>(*refusal)];
        REQUIRE(stage.snapshot() == now.before);
        continue;
      }
      ++tally.done;
      REQUIRE(stage.fault() == "");
      REQUIRE(stage.fault_of(stage.r.created()) == "");
      storm.after(stage, now);
    }
  }
}

inline StormTally run_storm(const Storm& storm) {
  StormTally tally;
  run_storm(storm, tally);
  return tally;
}

// A point of Sigma near f is inserted where it can be: work for the operation.
inline void insert_near(Stage& stage, FaceId f, Random& random) {
  if (const auto p = stage.point_near(f, random)) insert_point(stage.r, Operation::foot, f, *p);
}

inline Options with_r_min(double voxels) {
  Options options;
  options.r_min = {voxels, Length::Unit::voxel};
  return options;
}

// A bound on the distance so much coarser than Stage 2's that thinning has work.
inline void allow_coarser(Stage& stage) {
  stage.r.parameters.refinement[Criterion::distance] *= 3;
}

// The one vertex of the cavity that the new facets do not have.
inline VertexId removed_vertex(const Replacement& c) {
  VertexId gone = kNoId;
  for (const Triangle& was : c.cavity.disk.facets) {
    for (const VertexId v : was) {
      const auto has_v = [&](const Triangle& t) { return has_corner(t, v); };
      if (v == gone || std::ranges::any_of(c.in().facets, has_v)) continue;
      REQUIRE(gone == kNoId);
      gone = v;
    }
  }
  REQUIRE(gone != kNoId);
  return gone;
}

}  // namespace deliso::test
