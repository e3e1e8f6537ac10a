// SPDX-License-Identifier: MIT
// A part of a mesh, edited, with a checksum that fits, and joined to the other part as the program
// does it. The input is a list of edits: two bytes for the place, one for the number of bytes, then
// these. Whatever they say, the join ends with an InputError of one line or with a mesh.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/parts.h"
#include "app/progress.h"
#include "fuzz/reader_target.h"
#include "io/files/checksum.h"
#include "io/parts/part_file.h"
#include "volume/sampled.h"

using namespace deliso;
using namespace deliso::fuzz;

namespace {

constexpr const char* kVolume = "volume";

const VolumeSource& source() {
  static const VolumeSource made =
      source_of(sampled<float>({12, 12, 12}, {1, 1, 1}, [](int i, int j, int k) {
        return std::sin(0.9 * i) + std::cos(0.8 * j + 0.3) + std::sin(0.7 * k + 0.1 * i);
      }));
  return made;
}

std::string part(int number) {
  const CommandLine line =
      test::parse_words({kVolume, "--iso=0.1", "--block-side=4", "--max-distance=0.4vox",
                         "--threads=1", text("--part=", number, "/2"), "--output=x.part"});
  return part_bytes(make_part(source(), line, kVolume, nullptr));
}

void edit(std::string& part, const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kSum = sizeof(std::uint32_t);
  part.resize(part.size() - kSum);
  for (std::size_t at = 0; at + 3 < size;) {
    const std::size_t place = (bytes[at] + 256u * bytes[at + 1]) % part.size();
    const std::size_t count = std::min<std::size_t>(bytes[at + 2] % 9, size - at - 3);
    at += 3;
    std::copy_n(bytes + at, std::min(count, part.size() - place),
                part.begin() + static_cast<std::ptrdiff_t>(place));
    at += count;
  }
  const std::uint32_t sum = crc32(std::as_bytes(std::span(part)));
  char of_sum[kSum];
  std::memcpy(of_sum, &sum, kSum);
  part.append(of_sum, kSum);
}

void join(const std::string& first, const std::string& second) {
  std::vector<PartFile> parts;
  for (const std::string* bytes : {&first, &second}) {
    parts.push_back(part_in(std::as_bytes(std::span(*bytes)), text("part", parts.size())));
  }
  sort_parts(parts);
  CommandLine line = line_of(parts.front(), kVolume);
  line.options.threads = 1;
  const FieldSource field = field_source(source(), line, kVolume);
  require_field(parts, field, line.options, kVolume);
  const Input input = input_of_join(line, field);
  MeshRun run(line, input);
  ProgressBar none(mesh_stages(line), false);
  join_parts_of(std::move(parts), run, none);
  report_json(run);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const std::string whole[] = {part(1), part(2)};
  if (size == 0) return 0;
  std::string edited = whole[bytes[0] % 2];
  edit(edited, bytes + 1, size - 1);
  try {
    join(edited, whole[1 - bytes[0] % 2]);
  } catch (const InputError& error) {
    check(error);
  }
  return 0;
}
