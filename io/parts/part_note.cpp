// SPDX-License-Identifier: MIT
#include "io/parts/part_note.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "base/check.h"
#include "base/text.h"
#include "io/files/checksum.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

constexpr std::string_view kVolume = "volume=", kFrame = "frame=";
constexpr std::string_view kBlock = "block=", kSamples = "samples=";
constexpr std::size_t kFrameNumbers = 12;  // origin and three axes; a space may follow
constexpr std::string_view kHolds = "holds=", kChecksum = "checksum=";

std::string digits_of(std::uint32_t checksum) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%08x", static_cast<unsigned>(checksum));
  return digits;
}

// Returns the checksum of the samples on a face of the box as doubles; every machine has the same.
std::string face_checksum(const Volume& volume, int face) {
  const int across = face / 2, u = (across + 1) % 3, v = (across + 2) % 3;
  const Index3 dims = volume.dims();
  std::vector<double> samples;
  Index3 at;
  at[across] = face % 2 == 0 ? 0 : dims[across] - 1;
  for (at[v] = 0; at[v] < dims[v]; ++at[v]) {
    for (at[u] = 0; at[u] < dims[u]; ++at[u]) samples.push_back(volume.sample(at.i, at.j, at.k));
  }
  return digits_of(crc32(std::as_bytes(std::span(samples))));
}

// Returns the words after `comment`.
std::string last_words(std::string_view comment, const PartMesh& part) {
  std::uint32_t sum = crc32(std::as_bytes(std::span(comment)));
  sum = crc32(std::as_bytes(std::span(part.points)), sum);
  sum = crc32(std::as_bytes(std::span(part.triangles)), sum);
  for (const SeamVertex& s : part.seam) {
    const auto& [i, j, k] = s.at.low;
    const std::int64_t row[] = {s.vertex, s.at.axis, i, j, k};
    sum = crc32(std::as_bytes(std::span(row)), sum);
  }
  return text(" ", kHolds, part.points.size(), ",", part.triangles.size(), ",", part.seam.size(),
              " ", kChecksum, digits_of(sum));
}

std::string listed(Index3 n, const char* between) {
  return text(n.i, between, n.j, between, n.k);
}

std::string listed(const Vec3& p) {
  return text(p.x, ",", p.y, ",", p.z);
}

std::vector<std::string> words_of(std::string_view line, char separator) {
  std::vector<std::string> words;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(separator));
    if (!word.empty()) words.emplace_back(word);
    line.remove_prefix(std::min(word.size() + 1, line.size()));
  }
  return words;
}

std::optional<PartNote> note_in(const std::string& comment) {
  PartNote note;
  note.comment = comment;
  bool has_block = false, has_samples = false;
  for (const std::string& word : words_of(comment, ' ')) {
    const std::string_view value = std::string_view(word).substr(word.find('=') + 1);
    if (word.starts_with(kBlock)) {
      note.block = parse_block(value);
      has_block = true;
    } else if (word.starts_with(kSamples)) {
      const std::vector<std::string> sums = words_of(value, ',');
      if (sums.size() != note.samples.size()) return std::nullopt;
      std::copy(sums.begin(), sums.end(), note.samples.begin());
      has_samples = true;
    } else if (!word.starts_with(kHolds) && !word.starts_with(kChecksum)) {
      if (word.starts_with(kFrame)) {
        const std::vector<std::string> frame = words_of(value, ',');
        if (frame.size() > kFrameNumbers) note.space = frame.back();
      }
      if (word.starts_with(kVolume)) note.dims = parse_dims(value.substr(0, value.find(',')));
      note.words.push_back(word);
    }
  }
  if (!has_block || !has_samples) return std::nullopt;
  region_of(note.block, note.dims);
  return note;
}

}  // namespace

std::string part_comment(std::string comment, const Volume& volume, const BlockChoice& block,
                         double isovalue, const PartMesh& part) {
  const Frame& at = volume.frame();
  comment += text(" ", kVolume, listed(volume.whole_dims(), "x"), ",", name_of(volume.type()), ",",
                  listed(volume.spacing()), " ", kFrame, listed(at.origin));
  for (const Vec3& axis : at.axes) comment += text(",", listed(axis));
  if (at.space != AnatomicalSpace::unknown) comment += text(",", short_name_of(at.space));
  comment +=
      text(" isovalue=", isovalue, " ", kBlock, listed(block.at, ","), "/", listed(block.of, ","));
  for (int face = 0; face < 6; ++face) {
    comment += face == 0 ? text(" ", kSamples) : ",";
    comment += (volume.inner_faces() >> face & 1) != 0 ? face_checksum(volume, face) : "-";
  }
  return comment + last_words(comment, part);
}

void require_as_noted(const PartNote& note, const PartMesh& part, const std::string& path) {
  const std::size_t end = note.comment.rfind(text(" ", kHolds));
  if (end == std::string::npos) {
    throw InputError(text(quote(path),
                          " has no checksum in its note, as an older version made it: "
                          "make it again"));
  }
  const std::string noted = note.comment.substr(end);
  const std::string is = last_words(std::string_view(note.comment).substr(0, end), part);
  if (is != noted) {
    throw InputError(
        text(quote(path), " is not as it was made: it has", is, ", its note says", noted));
  }
}

std::optional<PartNote> part_note(std::span<const std::string> comments) {
  for (const std::string& comment : comments) {
    try {
      if (auto note = note_in(comment)) return note;
    } catch (const InputError&) {
      // Another program's line with words like ours.
    }
  }
  return std::nullopt;
}

}  // namespace deliso
