// SPDX-License-Identifier: MIT
#include "view/render/write_svg.h"

#include <span>
#include <string>
#include <tuple>

#include "base/text.h"
#include "io/files/append_format.h"
#include "io/files/atomic_file.h"
#include "io/files/base64.h"
#include "view/render/write_png.h"

namespace deliso {

void write_svg(const Image& image, const std::string& path) {
  const std::string png = encode_png(image);
  AtomicFile file(path);
  file.write(
      text("<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"",
           image.width, "\" height=\"", image.height, "\" viewBox=\"0 0 ", image.width, " ",
           image.height, "\">\n<image width=\"", image.width, "\" height=\"", image.height,
           "\" xlink:href=\"data:image/png;base64,"));
  file.write(encode_base64(std::as_bytes(std::span(png))));
  file.write("\"/>\n<g fill=\"none\" stroke-linecap=\"round\">\n");
  // One path for all strokes of one look that follow each other.
  const auto look = [](const Stroke& s) {
    return std::tuple(s.width, s.color.red, s.color.green, s.color.blue, s.strength);
  };
  const std::vector<Stroke>& strokes = image.strokes;
  for (std::size_t n = 0; n < strokes.size();) {
    const Stroke& s = strokes[n];
    std::string path_of_all;
    append_format(path_of_all,
                  R"(<path stroke="#%02x%02x%02x" stroke-width="%.2f" stroke-opacity="%.2f" d=")",
                  s.color.red, s.color.green, s.color.blue, s.width, s.strength);
    for (; n < strokes.size() && look(strokes[n]) == look(s); ++n) {
      append_format(path_of_all, "M%.2f %.2fL%.2f %.2f\n", strokes[n].from.x, strokes[n].from.y,
                    strokes[n].to.x, strokes[n].to.y);
    }
    file.write(path_of_all + "\"/>\n");
  }
  file.write("</g>\n</svg>\n");
  file.commit();
}

}  // namespace deliso
