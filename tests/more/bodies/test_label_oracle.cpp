// SPDX-License-Identifier: MIT
// T_L and the mesh against counts of the simplices of labels (stress/label_oracle.h), on volumes of
// the storm of labels.
#include "stress/label_oracle.h"

#include <doctest/doctest.h>

#include <cstdint>

#include "stress/label_mirrors.h"
#include "stress/label_volumes.h"

using namespace deliso;
using namespace deliso::stress;

TEST_CASE("T_L bounds each label by a manifold with the topology of its subcomplex") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const LabelVolume labels = make_label_volume(seed, 6);
    const Partition partition = partition_of(labels);
    if (labels.median == 0) {
      const std::vector<LabelSamples> found = find_labels(labels.volume, "labels");
      for_each_index(labels.volume.dims(), [&](int i, int j, int k) {
        CHECK(static_cast<double>(found[partition.body_at({i, j, k})].label) ==
              labels.volume.sample(i, j, k));
      });
    }
    const int axis = static_cast<int>(seed % 3);
    const int cut = partition.shape().voxels()[axis] / 2;
    CHECK(complex_fault(partition, LabelOracle(partition), axis, cut) == "");
  }
}

TEST_CASE("a mirrored volume has the mirrored topology") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const LabelVolume labels = make_label_volume(seed, 6);
    CHECK(fault_of_mirrors(labels, partition_of(labels)) == "");
  }
}

TEST_CASE("the mesh has the topology of T_L for each label and each sheet, in any threads") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Partition partition = partition_of(make_label_volume(seed, 6));
    Options options;
    options.cap = seed % 2 == 0;
    if (seed % 3 == 0) options.block_side = 4;
    const auto meshed = [&](int threads) {
      options.threads = threads;
      Report report;
      return mesh_interfaces(partition, options, report);
    };
    const InterfaceMesh mesh = meshed(1), again = meshed(3);
    CHECK(mesh_fault(partition, LabelOracle(partition), mesh, options.cap) == "");
    CHECK(again.points == mesh.points);
    CHECK(again.facets == mesh.facets);
  }
}

TEST_CASE("sheets that would cross are coarsened again, with their vertices near the crossing") {
  for (const std::uint64_t seed : {11, 34, 46, 84, 110, 139}) {
    CAPTURE(seed);
    const Partition partition = partition_of(make_label_volume(seed, 8));
    Options options;
    options.block_side = 4;
    options.limits[Criterion::distance] = {0.5, Length::Unit::voxel};
    options.r_min = {1, Length::Unit::voxel};
    Report report;
    const InterfaceMesh mesh = mesh_interfaces(partition, options, report);
    CHECK(report[Counter::coarsened_again] > 0);
    CHECK(mesh_fault(partition, LabelOracle(partition), mesh, options.cap) == "");
  }
}
