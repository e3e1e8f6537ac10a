// SPDX-License-Identifier: MIT
// Parse option values. All of the text must be used: "1e" and "12abc" are no numbers. Each function
// throws an InputError of one line that names the option and the text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "base/vec3.h"
#include "run/options.h"

namespace deliso {

double parse_number(std::string_view option, std::string_view text);  // finite
double parse_positive(std::string_view option, std::string_view text);
std::uint64_t parse_count(std::string_view option, std::string_view text, std::uint64_t least = 0);
// 0.5vox, or a plain number in `unit`.
Length parse_length(std::string_view option, std::string_view text, Length::Unit unit,
                    bool may_be_zero = false);
PartChoice parse_part(std::string_view option, std::string_view text);  // 3/64, from 1/64 on
// Whole numbers of at most 2^53, each once, in order, and names of segments; 1,4 or Liver.
struct LabelList {
  std::vector<std::int64_t> numbers;
  std::vector<std::string> names;
};
LabelList parse_label_list(std::string_view option, std::string_view text);
Vec3 parse_spacing(std::string_view option, std::string_view text);              // 1,1,2.5
Vec3 parse_point(std::string_view option, std::string_view text);                // 1,-2,2.5
View parse_view(std::string_view option, std::string_view text);                 // 30,25
double parse_zoom(std::string_view option, std::string_view text);               // up to 64
double parse_angle_of_view(std::string_view option, std::string_view text);      // degrees
PictureSize parse_picture_size(std::string_view option, std::string_view text);  // 800x600
// -x:0.5 or a,b,c,d; several with a / between them; nothing for "off".
std::vector<std::optional<ClipChoice>> parse_clips(std::string_view option, std::string_view text);
// Printable characters of ASCII, with a / between one text and the next; either can be empty.
std::string parse_drawable(std::string_view option, std::string_view text);  // ASCII
std::vector<std::string> parse_labels(std::string_view option, std::string_view text);
Vec3 parse_color(std::string_view option, std::string_view text);  // white, black, #rrggbb: 0 to 1

}  // namespace deliso
