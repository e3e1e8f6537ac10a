// SPDX-License-Identifier: MIT
// The solid of a mesh: made by the solid command's function with drawn options, of the mesh turned
// and mirrored at random, and checked by exact signs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/parsed_line.h"
#include "app/solid_run.h"
#include "base/check.h"
#include "base/random.h"
#include "io/mesh/write_mesh.h"

namespace deliso::stress {

// Returns the mesh as its file has it, with its axes permuted, and some of them reversed.
inline TriMesh turned_at_random(const TriMesh& mesh, Random& random) {
  WrittenMesh world = written_mesh(mesh, {.format = MeshFormat::ply});
  std::array<int, 3> axis{0, 1, 2};
  bool is_mirrored = false;
  for (const int n : {0, 1}) {
    const int other = n + static_cast<int>(random.below(static_cast<std::uint32_t>(3 - n)));
    is_mirrored ^= other != n;
    std::swap(axis[static_cast<std::size_t>(n)], axis[static_cast<std::size_t>(other)]);
  }
  std::array<double, 3> sign{};
  for (double& s : sign) {
    s = random.below(2) > 0 ? 1 : -1;
    is_mirrored ^= s < 0;
  }
  for (Vec3& p : world.points) {
    p = {sign[0] * p[axis[0]], sign[1] * p[axis[1]], sign[2] * p[axis[2]]};
  }
  for (Triangle& t : world.triangles) {
    if (is_mirrored) std::swap(t[1], t[2]);
  }
  return make_tri_mesh(std::move(world.points), world.triangles);
}

// Returns what is wrong with the solid; empty if nothing is. `is_closed`: the surface is, without
// crossings, so that it must not be refused.
inline std::string solid_fault(const TriMesh& mesh,
                               const std::vector<std::array<std::int64_t, 2>>& sides,
                               bool is_closed, Random& random) {
  std::vector<std::string> words{"solid", "mesh"};
  if (random.below(3) == 0) words.push_back(text("--growth=", random.uniform(.1, 2)));
  if (random.below(3) == 0) words.push_back(text("--max-cell=", random.uniform(.5, 8)));
  if (random.below(4) == 0) words.emplace_back("--no-fill");
  const CommandLine line = test::parse_words(words);
  SolidRun run{line};
  ProgressBar none(solid_stages(), false);
  MeshNotes notes;
  notes.sides = sides;
  const auto told = [&](const std::string& what) {
    std::string all = what;
    for (const std::string& word : words) all += " " + word;
    return all;
  };
  try {
    make_solid_of(turned_at_random(mesh, random), notes, run, none);
  } catch (const InputError& error) {
    return is_closed ? told(error.what()) : std::string();
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(SolidFaultKind::count_); ++n) {
    const auto kind = static_cast<SolidFaultKind>(n);
    if (run.check.result.faults.count(kind) == 0) continue;
    return told(text(name_of(kind), ": ", run.check.result.faults.first(kind).front().what));
  }
  return {};
}

}  // namespace deliso::stress
