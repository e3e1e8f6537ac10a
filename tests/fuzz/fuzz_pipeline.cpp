// SPDX-License-Identifier: MIT
// The whole way from samples to a checked mesh, on volumes of up to 12 x 12 x 12. The first bytes
// say size, sample type, spacing, isovalue and options, the rest are samples: taken as they are, or
// as the parameters of smooth noise. Whatever they say, the mesh is a manifold that ends on the box
// only, and its topology is exact unless a counter says otherwise. A third of the inputs goes to
// the published program. It ends, and its mesh is such a manifold unless it left vertices without a
// disk.
//
// With DELISO_SEE=folder in the environment (tests/see.h) the volume is written there too, and the
// command line that does the same is printed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fuzz/reader_target.h"
#include "paper/deliso.h"
#include "stress/judge.h"
#include "stress/see_seed.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::fuzz;

namespace {

// Bytes one by one, and zeros when they are used up.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), left_(size) {}
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *bytes_++;
  }
  std::uint32_t below(std::uint32_t n) { return next() % n; }
  double share() { return next() / 255.0; }
  template <class T>
  T raw() {
    std::uint8_t bytes[sizeof(T)];
    for (std::uint8_t& byte : bytes) byte = next();
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* bytes_;
  std::size_t left_;
};

template <class T>
T sample_of(ByteSource& source, std::uint32_t content, double scale) {
  if (content == 1) return static_cast<T>(source.below(3));
  if (content == 2) return static_cast<T>(source.next());
  if constexpr (std::is_floating_point_v<T>) {
    // One exponent for all: where samples differ by more than 1e15, crossings round to samples.
    return static_cast<T>(source.raw<std::int16_t>() * scale);
  }
  return source.raw<T>();
}

template <class T>
Volume make_volume(ByteSource& source, Index3 dims, Vec3 spacing) {
  const std::uint32_t content = source.below(4);
  constexpr double scales[] = {1, 1e26, 1e-26, 1e-41};
  const double scale = scales[source.below(4)];
  const std::size_t count = static_cast<std::size_t>(dims.i * dims.j * dims.k);
  std::vector<T> samples;
  if (content == 3) {
    Vec3 waves[3];
    for (Vec3& wave : waves) {
      wave = Vec3{source.share(), source.share(), source.share()} * 4 - Vec3{2, 2, 2};
    }
    for (std::size_t n = 0; n < count; ++n) {
      const auto x = static_cast<int>(n) % dims.i, y = static_cast<int>(n) / dims.i % dims.j,
                 z = static_cast<int>(n) / dims.i / dims.j;
      double sum = 60;
      for (const Vec3& w : waves) sum += 20 * std::sin(dot(w, Vec3{1.0 * x, 1.0 * y, 1.0 * z}));
      samples.push_back(static_cast<T>(sum));
    }
  } else {
    for (std::size_t n = 0; n < count; ++n) samples.push_back(sample_of<T>(source, content, scale));
  }
  return Volume::from_samples(dims, spacing, samples);
}

Volume make_volume(ByteSource& source) {
  Index3 dims;
  Vec3 spacing;
  constexpr double lengths[] = {1, 1, 1, 0.3, 3, 20, 1e-6, 1e6};
  for (int axis = 0; axis < 3; ++axis) {
    dims[axis] = 1 + static_cast<int>(source.below(12));
    spacing[axis] = lengths[source.below(6)];
  }
  const double scale = lengths[source.below(8)];
  spacing = spacing * scale;
  switch (source.below(8)) {
    case 0:
      return make_volume<std::int8_t>(source, dims, spacing);
    case 1:
      return make_volume<std::uint16_t>(source, dims, spacing);
    case 2:
      return make_volume<std::int16_t>(source, dims, spacing);
    case 3:
      return make_volume<std::int32_t>(source, dims, spacing);
    case 4:
      return make_volume<float>(source, dims, spacing);
    case 5:
      return make_volume<double>(source, dims, spacing);
    default:
      return make_volume<std::uint8_t>(source, dims, spacing);
  }
}

double make_isovalue(ByteSource& source, const Volume& volume, const ValueRange& range) {
  const auto any = [&] {
    const Index3 n = volume.dims();
    const auto at = [&](int size) { return static_cast<int>(source.below(256)) % size; };
    const int i = at(n.i), j = at(n.j);
    return volume.sample(i, j, at(n.k));
  };
  switch (source.below(4)) {
    case 0:
      return any();
    case 1:
      return 0.5 * any() + 0.5 * any();
    case 2:
      return range.min + (range.max - range.min) * source.share();
    default:
      return std::floor(range.min + (range.max - range.min) * source.share()) + 0.5;
  }
}

// Small triangles are left alone from a tenth of a voxel on, so that every input is done soon.
Options make_options(ByteSource& source, const Vec3& spacing) {
  Options options;
  const std::uint8_t flags = source.next();
  const double ratio =
      std::max({spacing.x, spacing.y, spacing.z}) / std::min({spacing.x, spacing.y, spacing.z});
  options.r_min = {(0.1 + source.share()) * ratio, Length::Unit::voxel};
  if ((flags & 1) != 0) options.components.min_voxels = 4 * source.share();
  if ((flags & 2) != 0) options.limits[Criterion::r_over_l].value = 1 + 2 * source.share();
  if ((flags & 4) != 0) options.max_vertices = 4 + 8 * source.below(256);
  if ((flags & 8) != 0) options.block_side = static_cast<int>(2 + source.below(8));
  if ((flags & 16) != 0) {
    const std::uint32_t rare = source.below(4);
    options.stop_after_stage1 = rare == 0;
    if (rare == 1) options.limits[Criterion::distance] = {spacing.x * (0.01 + source.share())};
    if (rare == 2) options.limits[Criterion::radius] = {spacing.x * (0.2 + source.share())};
    if (rare == 3) options.limits[Criterion::h_over_r].value = 0.05 + source.share();
  }
  return options;
}

// The same for the published program, with an end.
paper::Options make_paper_options(ByteSource& source, const Volume& volume) {
  paper::Options options;
  const std::uint8_t flags = source.next();
  const Vec3 spacing = volume.spacing();
  const double r_min = (0.1 + source.share()) * std::max({spacing.x, spacing.y, spacing.z});
  options.r_min = r_min / volume.box().smallest_side();
  options.max_vertices = (flags & 1) != 0 ? 4 + 8 * source.below(256) : 2000;
  if ((flags & 2) != 0) options.lines = source.next();
  if ((flags & 4) != 0) options.seed = source.next();
  if ((flags & 8) != 0) options.lambda = 1 + 2 * source.share();
  options.facet_cycles = (flags & 16) != 0;
  if ((flags & 32) != 0) options.solver = CubicMethod::isolation;
  if ((flags & 128) != 0) {
    const std::uint32_t rare = source.below(4);
    options.stop_after_recover = rare == 0;
    if (rare == 1) options.epsilon = 0.05 + source.share();
    if (rare == 2) options.epsilon1 = 0.05 + source.share();
    if (rare == 3) options.epsilon2 = 0.05 + source.share();
  }
  return options;
}

void write_case(const Volume& volume, double isovalue, const Options& o, const std::string& path) {
  stress::write_nrrd(volume, path);
  std::printf(
      "deliso %s --iso %.17g --rmin %.17gvox --min-component %g --lambda %.17g --max-vertices %zu"
      " --block-side %d%s"
      " --max-distance %.17g%s --max-radius %.17g --eps1 %.17g --check\n",
      path.c_str(), isovalue, o.r_min.value, o.components.min_voxels,
      o.limits[Criterion::r_over_l].value, o.max_vertices, o.block_side,
      o.stop_after_stage1 ? " --stop-after stage1" : "", o.limits[Criterion::distance].value,
      o.limits[Criterion::distance].unit == Length::Unit::voxel ? "vox" : "",
      o.limits[Criterion::radius].value, o.limits[Criterion::h_over_r].value);
  std::fflush(stdout);
}

void write_case(const Volume& volume, double isovalue, const paper::Options& o,
                const std::string& path) {
  stress::write_nrrd(volume, path);
  std::printf(
      "deliso %s --iso %.17g --paper --rmin %.17g --eps %.17g --eps1 %.17g --eps2 %.17g "
      "--lambda %.17g --lines %zu --seed %llu --max-vertices %zu%s%s%s --check\n",
      path.c_str(), isovalue, o.r_min, o.epsilon, o.epsilon1, o.epsilon2, o.lambda, o.lines,
      static_cast<unsigned long long>(o.seed), o.max_vertices,
      o.facet_cycles ? " --facet-cycles" : "", o.stop_after_recover ? " --stop-after stage1" : "",
      o.solver == CubicMethod::isolation ? " --solver isolation" : "");
  std::fflush(stdout);
}

// Stops the run where is_fault(verdict).
template <class IsFault>
void judge_and_see(const Volume& volume, const TriMesh& mesh, const Options& options,
                   const Report& report, const IsFault& is_fault) {
  Faults faults;
  const stress::Verdict verdict = stress::judge(volume, mesh, options, report, faults);
  if (!is_fault(verdict)) return;
  stress::see_seed("pipeline", 0, volume, report.kappa_effective, mesh, faults);
  found(verdict.fault);
}

void try_exact(const Volume& volume, double isovalue, const Options& options) {
  Report report;
  TriMesh mesh;
  try {
    mesh = mesh_isosurface(volume, isovalue, options, report);
  } catch (const InputError& error) {
    check(error);
    const bool has_voxel = volume.box().smallest_side() > 0;
    require(!has_voxel || options.max_vertices < 1u << 20, "refused without --max-vertices");
    return;
  }
  judge_and_see(volume, mesh, options, report, [&](const stress::Verdict& verdict) {
    return verdict.invalid || (options.components.is_all() && !verdict.topology_exact);
  });
}

void try_published(const Volume& volume, double isovalue, const paper::Options& options) {
  paper::Report counts;
  TriMesh mesh;
  try {
    mesh = paper::deliso(volume, isovalue, options, counts);
  } catch (const InputError& error) {
    check(error);
    return;
  }
  Report report;
  report.kappa_effective = counts.kappa;
  judge_and_see(volume, mesh, {}, report, [&](const stress::Verdict& verdict) {
    return verdict.invalid && counts.vertices_left == 0;
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  ByteSource source(bytes, size);
  // The few bytes of options come first: what follows them may be cut.
  std::uint8_t front[24];
  for (std::uint8_t& byte : front) byte = source.next();
  const Volume volume = make_volume(source);
  ByteSource choices(front, sizeof front);
  const auto folder = test::folder_to_see();
  const auto go = [&](const auto& options, auto& attempt) {
    const double isovalue = make_isovalue(choices, volume, value_range(volume));
    if (folder) write_case(volume, isovalue, options, (*folder / "pipeline.nrrd").string());
    attempt(volume, isovalue, options);
  };
  if (choices.below(3) == 0) {
    go(make_paper_options(choices, volume), try_published);
  } else {
    go(make_options(choices, volume.spacing()), try_exact);
  }
  return 0;
}
