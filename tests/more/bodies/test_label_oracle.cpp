// SPDX-License-Identifier: MIT
// T_L and the mesh against counts of the simplices of labels (stress/label_oracle.h), on volumes of
// the storm of labels.
#include "stress/label_oracle.h"

#include <doctest/doctest.h>

#include <cstdint>

#include "stress/label_volumes.h"

using namespace deliso;
using namespace deliso::stress;

TEST_CASE("T_L bounds each label by a manifold with the topology of its subcomplex") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    const Partition partition = partition_of(make_label_volume(seed, 6));
    const int axis = static_cast<int>(seed % 3);
    const int cut = partition.shape().voxels()[axis] / 2;
    CHECK(complex_fault(partition, LabelOracle(partition), axis, cut) == "");
  }
}
