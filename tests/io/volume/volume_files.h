// SPDX-License-Identifier: MIT
// Volumes written in every format and encoding of the readers, byte by byte by the formats'
// descriptions. Tests compare the volume that is read with the written one.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"
#include "io/files/deflate_writer.h"
#include "io/files/jpeg_writer.h"
#include "io/files/temporary_folder.h"
#include "io/files/vtk_array.h"
#include "io/volume/read_volume.h"

namespace deliso::test {

inline std::string bytes_of_samples(const Volume& volume) {
  return volume.visit([&](const auto* samples) {
    return std::string(reinterpret_cast<const char*>(samples),
                       volume.sample_count() * sizeof *samples);
  });
}

struct NamedFile {
  std::string name, content;
};

// What a volume is, independent of any format.
struct Truth {
  Index3 dims;
  SampleType type;
  Vec3 spacing{1, 1, 1};
  Vec3 origin{0, 0, 0};
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  std::string bytes{};   // native order
  bool is_wide = false;  // the words of type float64 are integers of 64 bits, signed
  std::uint64_t seed = 0;
  // Of NRRD, MetaImage and NIfTI: `bytes` has them all, in the order of the format.
  int channels = 1, times = 1;
  bool is_alone() const { return channels == 1 && times == 1; }

  std::size_t count() const { return bytes.size() / size_of(type); }
  std::size_t type_index() const { return is_wide ? 8 : static_cast<std::size_t>(type); }
  bool is_real() const { return !is_wide && (type == SampleType::f32 || type == SampleType::f64); }
  Vec3 step(std::size_t axis) const { return spacing[static_cast<int>(axis)] * axes[axis]; }
  std::string in_order(std::endian order) const {
    std::string result = bytes;
    if (order != std::endian::native)
      for (std::size_t n = 0; n < result.size(); n += size_of(type))
        std::reverse(result.begin() + static_cast<std::ptrdiff_t>(n),
                     result.begin() + static_cast<std::ptrdiff_t>(n + size_of(type)));
    return result;
  }
};

// Calls f with a zero of the type.
template <class F>
void visit_type(SampleType type, F f) {
  auto left = static_cast<int>(type);
  const auto visit = [&](auto... zeros) { ((left-- == 0 ? f(zeros) : void()), ...); };
  visit(std::uint8_t{}, std::int8_t{}, std::uint16_t{}, std::int16_t{}, std::uint32_t{},
        std::int32_t{}, float{}, double{});
}
constexpr SampleType kAllTypes[] = {SampleType::u8,  SampleType::i8,  SampleType::u16,
                                    SampleType::i16, SampleType::u32, SampleType::i32,
                                    SampleType::f32, SampleType::f64};

// Random samples over the whole range of the type.
inline Truth random_truth(SampleType type, Index3 dims, std::uint64_t seed) {
  Truth truth{dims, type};
  truth.seed = seed;
  Random random(seed);
  const int count = dims.i * dims.j * dims.k;
  visit_type(type, [&]<class T>(T) {
    for (int n = 0; n < count; ++n) {
      T value;
      if constexpr (std::is_floating_point_v<T>) {
        value = static_cast<T>(random.uniform(-1, 1) * static_cast<double>(1u << random.below(30)));
      } else {
        value = static_cast<T>(random.next());
      }
      char raw[sizeof(T)];
      std::memcpy(raw, &value, sizeof(T));
      truth.bytes.append(raw, sizeof(T));
    }
  });
  return truth;
}

template <class T>
std::string to_text(T value) {
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}
inline std::string join(const Vec3& v, const char* separator = " ") {
  return to_text(v.x) + separator + to_text(v.y) + separator + to_text(v.z);
}
inline std::string join(const Index3& n) {
  return to_text(n.i) + " " + to_text(n.j) + " " + to_text(n.k);
}
inline std::string ascii_samples(const Truth& truth) {
  std::string text;
  const auto append = [&]<class T>(T value) {
    for (std::size_t n = 0; n < truth.count(); ++n) {
      std::memcpy(&value, &truth.bytes[n * sizeof(T)], sizeof(T));
      text += to_text(value) + (n % 7 == 6 ? "\n" : " ");
    }
  };
  truth.is_wide ? append(std::int64_t{}) : visit_type(truth.type, append);
  return text;
}
// ---- NRRD

enum class NrrdForm { attached, detached, detached_skips, detached_at_end };

inline std::vector<NamedFile> nrrd(const Truth& t, std::endian order, const std::string& encoding,
                                   NrrdForm form) {
  const char* const types[] = {"uchar",      "int8",  "unsigned short", "int16_t",      "uint",
                               "signed int", "float", "double",         "long long int"};
  std::string header = "NRRD0005\n# a comment: with colon\ntype: ";
  header += types[t.type_index()];
  const bool alone = t.is_alone();
  const std::string sizes =
      alone ? join(t.dims) : to_text(t.channels) + " " + join(t.dims) + " " + to_text(t.times);
  header += std::string("\ndimension: ") + (alone ? "3" : "5") +
            "\nspace: left-posterior-superior\nsizes: " + sizes +
            "\nspace directions: " + (alone ? "" : "none ");
  for (std::size_t a = 0; a < 3; ++a) header.append("(").append(join(t.step(a), ",")).append(") ");
  if (!alone) header += "none";
  header += "\nspace origin: (" + join(t.origin, ", ") + ")\nencoding: " + encoding + "\n";
  if (encoding != "ascii" && size_of(t.type) > 1)
    header += order == std::endian::little ? "endian: little\n" : "endian: big\n";
  header += std::string("My key:=my value: with colon\nkinds: ") +
            (alone ? "domain domain domain\n" : "list domain domain domain time\n");
  std::string data = encoding == "ascii" ? ascii_samples(t) : t.in_order(order);
  std::string front;
  if (form == NrrdForm::detached_skips) {
    header += "line skip: 2\nbyte skip: 5\n";
    front = "one line\nanother line\n";
    data = (encoding == "ascii" ? "   \n " : "12345") + data;
  }
  if (form == NrrdForm::detached_at_end) {
    header += "byteskip: -1\n";
    front = "something in front";
  }
  if (encoding == "gzip") data = gzipped(data, t.seed);
  if (form == NrrdForm::attached) return {{"v.nrrd", header + "\n" + data}};
  return {{"v.nhdr", header + "data file: v.data\n"}, {"v.data", front + data}};
}

// ---- MetaImage

enum class MetaForm { local, detached, detached_header, detached_at_end };

inline std::vector<NamedFile> metaimage(const Truth& t, std::endian order,
                                        const std::string& encoding, MetaForm form) {
  const char* const types[] = {"MET_UCHAR", "MET_CHAR",  "MET_USHORT", "MET_SHORT",    "MET_UINT",
                               "MET_INT",   "MET_FLOAT", "MET_DOUBLE", "MET_LONG_LONG"};
  const bool has_times = t.times > 1;
  const std::string zero = has_times ? " 0" : "", one = has_times ? " 1" : "";
  std::string header =
      std::string("ObjectType = Image\nNDims = ") + (has_times ? "4" : "3") + "\nBinaryData = ";
  header += encoding == "ascii" ? "False\n" : "True\n";
  header += std::string("BinaryDataByteOrderMSB = ") +
            (order == std::endian::big ? "True\n" : "False\n") +
            "CompressedData = " + (encoding == "zlib" ? "True\n" : "False\n");
  header += "TransformMatrix =";
  for (const Vec3& axis : t.axes) header += " " + join(axis) + zero;
  header += (has_times ? " 0 0 0 1" : "") + ("\nOffset = " + join(t.origin)) + zero +
            "\nCenterOfRotation = 0 0 0" + zero;
  header += "\nElementSpacing = " + join(t.spacing) + one + "\nDimSize = " + join(t.dims) +
            (has_times ? " " + to_text(t.times) : "") + "\n";
  if (t.channels > 1) header += "ElementNumberOfChannels = " + to_text(t.channels) + "\n";
  std::string front;
  if (form == MetaForm::detached_header) {
    header += "HeaderSize = 7\n";
    front = "7 bytes";
  }
  if (form == MetaForm::detached_at_end) {
    header += "HeaderSize = -1\n";
    front = "any number of bytes";
  }
  header += std::string("ElementType = ") + types[t.type_index()] + "\nElementDataFile = ";
  std::string data = encoding == "ascii" ? ascii_samples(t) : t.in_order(order);
  if (encoding == "zlib") data = zlibbed(data, t.seed);
  if (form == MetaForm::local) return {{"v.mha", header + "LOCAL\n" + data}};
  return {{"v.mhd", header + "v.data\n"}, {"v.data", front + data}};
}

// ---- NIfTI

struct NiftiForm {
  int version = 1;
  std::endian order = std::endian::little;
  bool pair = false;
  bool compressed = false;
  double slope = 0, intercept = 0;
  enum class Placement { none, qform, sform } placement = Placement::sform;
};

inline std::string nifti_header(const Truth& t, const NiftiForm& form) {
  const bool two = form.version == 2;
  std::string h(two ? 540 : 348, '\0');
  const auto put = [&](std::size_t at, std::uint64_t value, int bytes) {
    h.replace(at, static_cast<std::size_t>(bytes), ordered(value, bytes, form.order));
  };
  const auto put_real = [&](std::size_t at, double value) {
    if (two) return put(at, std::bit_cast<std::uint64_t>(value), 8);
    put(at, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  };
  const std::size_t real = two ? 8 : 4;
  constexpr int codes[] = {2, 256, 512, 4, 768, 8, 16, 64, 1024};
  put(0, h.size(), 4);
  const std::int64_t dim[] = {t.is_alone() ? 4 : 5, t.dims.i, t.dims.j, t.dims.k, t.times,
                              t.channels,           1,        1};
  for (std::size_t n = 0; n < 8; ++n)
    put(two ? 16 + 8 * n : 40 + 2 * n, static_cast<std::uint64_t>(dim[n]), two ? 8 : 2);
  put(two ? 12 : 70, static_cast<std::uint64_t>(codes[t.type_index()]), 2);
  put(two ? 14 : 72, 8 * size_of(t.type), 2);
  const bool left = dot(cross(t.axes[0], t.axes[1]), t.axes[2]) < 0;
  put_real(two ? 104 : 76, left ? -1 : 1);
  for (std::size_t n = 1; n <= 3; ++n)
    put_real((two ? 104 : 76) + real * n, t.spacing[static_cast<int>(n) - 1]);
  const std::size_t offset = form.pair ? 0 : two ? 560 : 368;  // 16 bytes of extension in between
  if (two) {
    put(168, offset, 8);
  } else {
    put_real(108, static_cast<double>(offset));
  }
  put_real(two ? 176 : 112, form.slope);
  put_real(two ? 184 : 116, form.intercept);
  const bool q = form.placement == NiftiForm::Placement::qform;
  const bool s = form.placement == NiftiForm::Placement::sform;
  put(two ? 344 : 252, q ? 1 : 0, two ? 4 : 2);
  put(two ? 348 : 254, s ? 2 : 0, two ? 4 : 2);
  if (q) {  // the quaternion of the rotation (the third axis turned round if left-handed)
    const Vec3 x = t.axes[0], y = t.axes[1], z = left ? -t.axes[2] : t.axes[2];
    const double a = 0.5 * std::sqrt(std::max(0.0, 1 + x.x + y.y + z.z));
    double b, c, d;
    if (a > 0.1) {
      b = (y.z - z.y) / (4 * a), c = (z.x - x.z) / (4 * a), d = (x.y - y.x) / (4 * a);
    } else {  // a half turn; the axis of rotation is the eigenvector
      b = std::sqrt(std::max(0.0, (1 + x.x) / 2));
      c = std::copysign(std::sqrt(std::max(0.0, (1 + y.y) / 2)), x.y);
      d = std::copysign(std::sqrt(std::max(0.0, (1 + z.z) / 2)), x.z);
    }
    const double values[] = {b, c, d, t.origin.x, t.origin.y, t.origin.z};
    for (std::size_t n = 0; n < 6; ++n) put_real((two ? 352 : 256) + real * n, values[n]);
  }
  if (s) {
    for (std::size_t row = 0; row < 3; ++row) {
      const int r = static_cast<int>(row);
      const double values[] = {t.step(0)[r], t.step(1)[r], t.step(2)[r], t.origin[r]};
      for (std::size_t n = 0; n < 4; ++n)
        put_real((two ? 400 : 280) + real * (4 * row + n), values[n]);
    }
  }
  const std::string magic = std::string(form.pair ? "ni" : "n+") + (two ? '2' : '1');
  h.replace(two ? 4 : 344, 3, magic);
  if (two) h.replace(8, 4, std::string("\r\n\x1a\n", 4));
  return h;
}

inline std::vector<NamedFile> nifti(const Truth& t, const NiftiForm& form) {
  const std::string header = nifti_header(t, form), data = t.in_order(form.order);
  if (form.pair) {
    if (form.compressed) return {{"v.hdr", header}, {"v.img.gz", gzipped(data, t.seed)}};
    return {{"v.hdr", header}, {"v.img", data}};
  }
  std::string file = header + std::string(20, '\0') + data;
  if (form.compressed) return {{"v.nii.gz", gzipped(file, t.seed)}};
  return {{"v.nii", file}};
}

// ---- MRC

inline bool is_mrc_type(const Truth& t) {
  return !t.is_wide && t.type != SampleType::u32 && t.type != SampleType::i32 &&
         t.type != SampleType::f64;
}

// Returns the world's axis, from 0 on, that each axis of the file is along; its own, if one of them
// is along none.
inline std::array<std::size_t, 3> mrc_axes(const Truth& t) {
  std::array<std::size_t, 3> along{};
  for (std::size_t n = 0; n < 3; ++n) {
    while (along[n] < 3 && t.axes[n][static_cast<int>(along[n])] != 1) ++along[n];
    if (along[n] == 3) return {0, 1, 2};
  }
  return along;
}

// The cell has one interval more than there are samples along its axis.
inline std::string mrc_header(const Truth& t, std::endian order, std::size_t extended) {
  std::string h(1024, '\0');
  const auto put = [&](std::size_t at, std::uint64_t value) {
    h.replace(at, 4, ordered(value, 4, order));
  };
  const auto put_real = [&](std::size_t at, double value) {
    put(at, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  };
  const auto along = mrc_axes(t);
  for (std::size_t n = 0; n < 3; ++n) {
    const int axis = static_cast<int>(n), intervals = t.dims[axis] + 1;
    put(4 * n, static_cast<std::uint64_t>(t.dims[axis]));
    if (t.origin != Vec3{0, 0, 0}) put(16 + 4 * n, 7);  // of no effect beside an origin
    put(28 + 4 * along[n], static_cast<std::uint64_t>(intervals));
    put_real(40 + 4 * along[n], intervals * t.spacing[axis]);
    put_real(52 + 4 * n, 90);
    put(64 + 4 * n, along[n] + 1);
    put_real(196 + 4 * n, t.origin[axis]);
  }
  const int modes[] = {0, 0, 6, 1, -1, -1, 2};
  put(12, static_cast<std::uint64_t>(modes[t.type_index()]));
  put(88, 1);
  put(92, extended);
  if (t.type == SampleType::u8) put(152, 1146047817);  // IMOD's stamp: bytes have no sign
  h.replace(208, 4, "MAP ");
  if (extended == 0) h.replace(212, 2, order == std::endian::little ? "\x44\x44" : "\x11\x11");
  return h;
}

inline std::string mrc(const Truth& t, std::endian order, std::size_t extended = 0) {
  return mrc_header(t, order, extended) + std::string(extended, 'x') + t.in_order(order);
}

// ---- INRIMAGE (no axes)

inline std::string inr(const Truth& t, std::endian order, int blocks = 1) {
  const std::string kind = t.is_real() ? "float"
                           : t.is_wide || t.type == SampleType::i8 || t.type == SampleType::i16 ||
                                   t.type == SampleType::i32
                               ? "signed fixed"
                               : "unsigned fixed";
  std::string h = "#INRIMAGE-4#{\nXDIM=" + to_text(t.dims.i) + "\nYDIM=" + to_text(t.dims.j) +
                  "\nZDIM=" + to_text(t.dims.k) + "\nVDIM=" + to_text(t.channels) +
                  "\nTYPE=" + kind + "\nPIXSIZE=" + to_text(8 * size_of(t.type)) +
                  " bits\nSCALE=2**0\nCPU=";
  h += order == std::endian::little ? (blocks == 1 ? "decm" : "pc") : (blocks == 1 ? "sun" : "sgi");
  h += "\nVX=" + to_text(t.spacing.x) + "\nVY=" + to_text(t.spacing.y) +
       "\nVZ=" + to_text(t.spacing.z);
  h +=
      "\nTX=" + to_text(t.origin.x) + "\nTY=" + to_text(t.origin.y) + "\nTZ=" + to_text(t.origin.z);
  h += "\n#GEOMETRY=CARTESIAN";
  h.resize(256 * static_cast<std::size_t>(blocks) - 4, '\n');
  return h + "##}\n" + t.in_order(order);
}

// ---- VTK legacy (no axes)

inline std::vector<NamedFile> vtk(const Truth& t, bool binary, bool field) {
  const char* const types[] = {"unsigned_char", "char",         "unsigned_short",
                               "short",         "unsigned_int", "int",
                               "float",         "double",       "vtktypeint64"};
  const std::string type = types[t.type_index()];
  std::string file = "# vtk DataFile Version 3.0\nany title\n";
  file += binary ? "BINARY\n" : "ASCII\n";
  file += "DATASET STRUCTURED_POINTS\nDIMENSIONS " + join(t.dims) + "\nSPACING " + join(t.spacing) +
          "\nORIGIN " + join(t.origin) + "\nPOINT_DATA " + to_text(t.count()) + "\n";
  if (field) {
    file += "FIELD FieldData 1\nvalues 1 " + to_text(t.count()) + " " + type + "\n";
  } else {
    file += "SCALARS values " + type + " 1\nLOOKUP_TABLE default\n";
  }
  file += binary ? t.in_order(std::endian::big) : ascii_samples(t);
  return {{"v.vtk", file + "\nMETADATA\nINFORMATION 0\n"}};
}

// Big-endian values, or words.
inline std::string vtk_values(bool binary, int count, int bytes, int from) {
  std::string all;
  for (int n = 0; n < count; ++n) {
    all += binary ? big(static_cast<std::uint64_t>(from + n), bytes) : to_text(from + n) + " ";
  }
  return all + "\n";
}

// Returns a legacy file with all kinds of sections. Last are two scalar arrays of 2 x 3 x 4 points:
// density (10 to 33) and pressure (1000 to 1023).
inline std::string vtk_of_many(bool binary, const std::string& end = "") {
  constexpr int points = 24;
  const auto v = [&](int count, int bytes, int from = 0) {
    return vtk_values(binary, count, bytes, from);
  };
  const std::string metadata =
      "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n";
  return "# vtk DataFile Version 4.2\ntitle\n" + std::string(binary ? "BINARY" : "ASCII") +
         "\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 3 4\nSPACING 1 1 1\nORIGIN 0 0 0\n" +
         "FIELD FieldData 1\nTIME 1 1 double\n" + v(1, 8) + metadata +
         "CELL_DATA 6\nSCALARS of_cells int 1\nLOOKUP_TABLE default\n" + v(6, 4) +
         "POINT_DATA 24\nVECTORS velocity float\n" + v(3 * points, 4) + metadata +
         "NORMALS normals double\n" + v(3 * points, 8) + "TENSORS stress float\n" +
         v(9 * points, 4) + "TEXTURE_COORDINATES uv 2 float\n" + v(2 * points, 4) +
         "LOOKUP_TABLE colors 3\n" + v(4 * 3, 1) + "SCALARS wide unsigned_short 2\n" +
         "LOOKUP_TABLE colors\n" + v(2 * points, 2) + "SCALARS ids vtktypeint64\n" +
         "LOOKUP_TABLE default\n" + v(points, 8) + "SCALARS density unsigned_char\n" +
         "LOOKUP_TABLE default\n" + v(points, 1, 10) + metadata +
         "FIELD FieldData 3\nNULL_ARRAY\nshort 1 5 int\n" + v(5, 4) + metadata +
         "pressure 1 24 int\n" + v(points, 4, 1000) + end;
}

// ---- VTK XML

inline std::vector<NamedFile> vti(const Truth& t, const VtkForm& form) {
  const char* const types[] = {"UInt8", "Int8",    "UInt16",  "Int16", "UInt32",
                               "Int32", "Float32", "Float64", "Int64"};
  const std::string block = vtk_array(t.in_order(form.order), form, t.seed);
  // The extent starts at (2,-1,0), so the file's origin lies before the first sample.
  const Vec3 origin = t.origin - 2 * t.step(0) + t.step(1);
  std::string direction;
  for (int row = 0; row < 3; ++row)
    direction += join(Vec3{t.axes[0][row], t.axes[1][row], t.axes[2][row]}) + " ";
  const std::string extent =
      "2 " + to_text(t.dims.i + 1) + " -1 " + to_text(t.dims.j - 2) + " 0 " + to_text(t.dims.k - 1);
  std::string file =
      "<?xml version=\"1.0\"?>\n<!-- <Piece> -->\n<VTKFile type=\"ImageData\" version=\"1.0\" "
      "byte_order=\"";
  file += form.order == std::endian::little ? "LittleEndian\"" : "BigEndian\"";
  if (form.header_size == 8) file += " header_type=\"UInt64\"";
  if (form.block > 0) file += " compressor=\"vtkZLibDataCompressor\"";
  file += ">\n<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + join(origin) +
          "\" Spacing=\"" + join(t.spacing) + "\" Direction=\"" + direction +
          "\">\n<Piece Extent=\"" + extent +
          "\">\n<PointData Scalars=\"values\">\n<DataArray type=\"Float32\" Name=\"other\" "
          "NumberOfComponents=\"3\" format=\"ascii\">1 2 3</DataArray>\n<DataArray type=\"" +
          std::string(types[t.type_index()]) + "\" Name='values' format=\"" + form.format + "\"";
  if (form.format == "appended") file += " offset=\"4\"/>\n";
  if (form.format == "binary") file += ">\n   " + block + "\n</DataArray>\n";
  if (form.format == "ascii") file += ">\n" + ascii_samples(t) + "\n</DataArray>\n";
  file += "</PointData>\n<CellData>\n</CellData>\n</Piece>\n</ImageData>\n";
  if (form.format == "appended")
    file += "<AppendedData encoding=\"" + form.encoding + "\">\n   _AAAA" + block +
            "\n</AppendedData>\n";
  return {{"v.vti", file + "</VTKFile>\n"}};
}

// ---- NumPy

// A .npy file of these samples, as numpy.lib.format describes it: `shape` is in Python's order.
inline std::string npy(const std::string& descr, bool fortran, const std::string& shape,
                       const std::string& samples, int version = 1) {
  std::string header = "{'descr': '" + descr +
                       "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" +
                       shape + "), }";
  const std::size_t length_size = version == 1 ? 2 : 4;
  while ((8 + length_size + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string file = "\x93NUMPY";
  file += static_cast<char>(version);
  file += '\0';
  return file + little(header.size(), static_cast<int>(length_size)) + header + samples;
}

inline std::string npy(const Truth& t, std::endian order, int version) {
  const char* const kinds[] = {"u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8", "i8"};
  const char mark = size_of(t.type) == 1 ? '|' : order == std::endian::big ? '>' : '<';
  const std::string descr = mark + std::string(kinds[t.type_index()]);
  const std::string shape = to_text(t.dims.k) + ", " + to_text(t.dims.j) + ", " + to_text(t.dims.i);
  return npy(descr, false, shape, t.in_order(order), version);
}

// ---- DICOM

struct DicomForm {
  bool is_explicit = true;
  std::endian order = std::endian::little;
  enum class Coding { plain, rle, jpeg, jpeg_ls, deflated } coding = Coding::plain;
  bool has_preamble = true;
  bool has_lengths = true;  // of sequences and their items
  enum class Place { stack, offsets, shared, each } place = Place::shared;  // of several frames

  bool is_packed() const { return coding != Coding::plain && coding != Coding::deflated; }
};

// Runs of equal bytes, and stretches of others.
inline std::string pack_bits(const std::string& bytes) {
  std::string out;
  for (std::size_t at = 0, end = 0; at < bytes.size(); at = end) {
    end = at + 1;
    const auto repeats = [&] { return end < bytes.size() && bytes[end] == bytes[end - 1]; };
    if (repeats()) {
      while (repeats() && end - at < 128) ++end;
      out += static_cast<char>(257 - (end - at));
      out += bytes[at];
      continue;
    }
    while (end < bytes.size() && !repeats() && end - at < 128) ++end;
    if (repeats() && end - at > 1) --end;
    out += static_cast<char>(end - at - 1);
    out += bytes.substr(at, end - at);
  }
  return out;
}

struct DicomElement {
  std::string vr, value;
};
using DicomElements = std::map<std::uint32_t, DicomElement>;  // by group and element

inline DicomElement dicom_numbers(const std::vector<double>& numbers) {
  std::string words;
  for (const double number : numbers) {
    if (!words.empty()) words += '\\';
    words += to_text(number);
  }
  return {"DS", words};
}
inline DicomElement dicom_vector(const Vec3& v) {
  return dicom_numbers({v.x, v.y, v.z});
}

inline std::string dicom_element(const DicomForm& form, std::uint32_t tag, DicomElement element) {
  const auto number = [&](std::uint64_t n, int bytes) { return ordered(n, bytes, form.order); };
  const bool is_fragments = element.vr == "OB" && form.is_packed();
  const bool has_length = !is_fragments && (form.has_lengths || element.vr != "SQ");
  if (element.value.size() % 2 != 0) element.value += element.vr == "DS" ? ' ' : '\0';
  std::string out = number(tag >> 16, 2) + number(tag & 0xffff, 2);
  const bool is_long = element.vr == "OB" || element.vr == "OW" || element.vr == "SQ";
  if (form.is_explicit) out += element.vr;
  if (form.is_explicit && is_long) out.append(2, '\0');
  out +=
      number(has_length ? element.value.size() : 0xffffffff, form.is_explicit && !is_long ? 2 : 4);
  out += element.value;
  if (!has_length) out += number(0xfffe, 2) + number(0xe0dd, 2) + number(0, 4);
  return out;
}

inline std::string dicom_elements(const DicomForm& form, const DicomElements& elements) {
  std::string out;
  for (const auto& [tag, element] : elements) out += dicom_element(form, tag, element);
  return out;
}

inline DicomElement dicom_sequence(const DicomForm& form, const std::vector<DicomElements>& items) {
  std::string out;
  for (const DicomElements& item : items) {
    const std::string content = dicom_elements(form, item);
    const auto number = [&](std::uint64_t n, int bytes) { return ordered(n, bytes, form.order); };
    out += number(0xfffe, 2) + number(0xe000, 2) +
           number(form.has_lengths ? content.size() : 0xffffffff, 4) + content;
    if (!form.has_lengths) out += number(0xfffe, 2) + number(0xe00d, 2) + number(0, 4);
  }
  return {"SQ", out};
}

inline std::string dicom_file(const DicomForm& form, const DicomElements& elements) {
  std::string file;
  if (form.has_preamble) {
    using enum DicomForm::Coding;
    const char* syntax = form.coding == rle                  ? "1.2.840.10008.1.2.5"
                         : form.coding == jpeg               ? "1.2.840.10008.1.2.4.57"
                         : form.coding == jpeg_ls            ? "1.2.840.10008.1.2.4.80"
                         : form.coding == deflated           ? "1.2.840.10008.1.2.1.99"
                         : !form.is_explicit                 ? "1.2.840.10008.1.2"
                         : form.order == std::endian::little ? "1.2.840.10008.1.2.1"
                                                             : "1.2.840.10008.1.2.2";
    file = std::string(128, '\0') + "DICM" + dicom_elements({}, {{0x00020010, {"UI", syntax}}});
  }
  const std::string data = dicom_elements(form, elements);
  return file + (form.coding == DicomForm::Coding::deflated ? deflated(data, data.size()) : data);
}

// A frame of 8 or 16 bits as lossless JPEG or JPEG-LS. The form depends on the samples.
inline std::string dicom_jpeg(const std::string& frame, const Truth& t, bool is_ls) {
  const std::size_t sample = size_of(t.type);
  JpegImage image{t.dims.i, t.dims.j, static_cast<int>(8 * sample)};
  for (std::size_t n = 0; n < frame.size(); n += sample) {
    std::uint16_t value = static_cast<unsigned char>(frame[n]);
    if (sample == 2) std::memcpy(&value, &frame[n], 2);
    image.samples.push_back(value);
  }
  JpegForm form{.is_ls = is_ls, .predictor = 1 + image.samples[0] % 7};
  form.restart_rows = image.samples[0] % 3;
  return jpeg_stream(image, form);
}

// The elements of `count` frames from `first` on. One frame is a slice of a series.
inline DicomElements dicom_image(const Truth& t, const DicomForm& form, int first, int count) {
  const auto number = [&](std::uint64_t n) {
    return DicomElement{"US", ordered(n, 2, form.order)};
  };
  const std::size_t sample = size_of(t.type);
  const std::size_t frame = sample * static_cast<std::size_t>(t.dims.i * t.dims.j);
  const bool is_signed =
      t.type == SampleType::i8 || t.type == SampleType::i16 || t.type == SampleType::i32;
  const DicomElement position = dicom_vector(t.origin + first * t.step(2));
  const DicomElement directions =
      dicom_numbers({t.axes[0].x, t.axes[0].y, t.axes[0].z, t.axes[1].x, t.axes[1].y, t.axes[1].z});
  const DicomElement spacing = dicom_numbers({t.spacing.y, t.spacing.x});
  DicomElements all{{0x00080008, {"CS", "ORIGINAL"}},
                    {0x00081140, dicom_sequence(form, {{{0x00280010, number(9)}}, {}})},
                    {0x0020000e, {"UI", "1.2.3"}},
                    {0x00280002, number(1)},
                    {0x00280004, {"CS", "MONOCHROME2"}},
                    {0x00280010, number(static_cast<std::uint64_t>(t.dims.j))},
                    {0x00280011, number(static_cast<std::uint64_t>(t.dims.i))},
                    {0x00280100, number(8 * sample)},
                    {0x00280101, number(8 * sample)},
                    {0x00280102, number(8 * sample - 1)},
                    {0x00280103, number(is_signed)}};
  const auto place = form.place;
  using Place = DicomForm::Place;
  if (count > 1) all[0x00280008] = {"IS", to_text(count)};
  if (count == 1 || place == Place::stack || place == Place::offsets) {
    all[0x00200032] = position;
    all[0x00200037] = directions;
    all[0x00280030] = spacing;
    std::vector<double> offsets;
    for (int n = 0; n < count; ++n) offsets.push_back(n * t.spacing.z);
    if (place == Place::offsets) {
      all[0x3004000c] = dicom_numbers(offsets);
    } else if (count > 1) {
      all[0x00180088] = dicom_numbers({t.spacing.z});
    }
  } else {
    const DicomElements common{{0x00209116, dicom_sequence(form, {{{0x00200037, directions}}})},
                               {0x00289110, dicom_sequence(form, {{{0x00280030, spacing}}})}};
    std::vector<DicomElements> groups;
    for (int n = 0; n < count; ++n) {
      groups.push_back(place == Place::each ? common : DicomElements{});
      groups.back()[0x00209113] =
          dicom_sequence(form, {{{0x00200032, dicom_vector(t.origin + (first + n) * t.step(2))}}});
    }
    all[0x52009229] = dicom_sequence(form, {place == Place::each ? DicomElements{} : common});
    all[0x52009230] = dicom_sequence(form, groups);
  }

  const std::string bytes =
      t.in_order(form.order)
          .substr(static_cast<std::size_t>(first) * frame, static_cast<std::size_t>(count) * frame);
  all[0x7fe00010] = {sample > 1 || !form.is_explicit ? "OW" : "OB", bytes};
  if (form.is_packed()) {
    std::string items = little(0xe000fffe, 4) + little(0, 4);
    const auto add = [&](std::string item) {
      if (item.size() % 2 != 0) item += '\0';
      items += little(0xe000fffe, 4) + little(item.size(), 4) + item;
    };
    for (std::size_t at = 0; at < bytes.size(); at += frame) {
      if (form.coding != DicomForm::Coding::rle) {
        // In two fragments.
        const bool is_ls = form.coding == DicomForm::Coding::jpeg_ls;
        const std::string stream = dicom_jpeg(bytes.substr(at, frame), t, is_ls);
        add(stream.substr(0, 20));
        add(stream.substr(20));
        continue;
      }
      std::string header = little(sample, 4), segments;
      for (std::size_t byte = sample; byte-- > 0;) {  // the highest first
        std::string plane;
        for (std::size_t n = at + byte; n < at + frame; n += sample) plane += bytes[n];
        header += little(64 + segments.size(), 4);
        segments += pack_bits(plane);
      }
      header.resize(64);
      add(header + segments);
    }
    all[0x7fe00010] = {"OB", items};
  }
  return all;
}

// ---- TIFF

// TIFF's LZW: codes of 9 to 12 bits, the highest bit first.
inline std::string lzw(const std::string& bytes) {
  std::string out;
  std::uint32_t bits = 0;
  int pending = 0, width = 9;
  const auto put = [&](int code) {
    bits = bits << width | static_cast<std::uint32_t>(code);
    for (pending += width; pending >= 8; pending -= 8) {
      out += static_cast<char>(bits >> (pending - 8) & 255);
    }
  };
  std::map<std::string, int> table;
  const auto clear = [&] {
    put(256);
    table.clear();
    for (int n = 0; n < 258; ++n) {
      table[n < 256 ? std::string(1, static_cast<char>(n)) : "code" + to_text(n)] = n;
    }
    width = 9;
  };
  clear();
  std::string string;
  for (const char c : bytes) {
    if (table.count(string + c) > 0) {
      string += c;
      continue;
    }
    put(table[string]);
    const int next = static_cast<int>(table.size());
    table[string + c] = next;
    if (next == 511 || next == 1023 || next == 2047) ++width;
    if (next == 4094) clear();
    string = c;
  }
  if (!string.empty()) put(table[string]);
  // The decoder has one more string now.
  if (table.size() == 511 || table.size() == 1023 || table.size() == 2047) ++width;
  put(257);
  if (pending > 0) out += static_cast<char>(bits << (8 - pending) & 255);
  return out;
}

struct TiffForm {
  std::endian order = std::endian::little;
  bool is_big = false;
  int tile = 0;            // side of the tiles; 0: strips
  int rows_per_strip = 3;  // else
  int compression = 1, predictor = 1;
};

struct TiffPage {
  struct Values {
    int type = 3;  // 2: text, 3: short, 4: long, 5: rational, 16: long8
    std::uint64_t count = 1;
    std::string bytes;
  };
  std::map<int, Values> tags;
  std::vector<std::string> blocks;
};

inline TiffPage::Values tiff_value(const TiffForm& form, std::uint64_t value, int type = 4) {
  return {type, 1, ordered(value, type == 3 ? 2 : type == 16 ? 8 : 4, form.order)};
}
inline TiffPage::Values tiff_ratio(const TiffForm& form, std::uint64_t up, std::uint64_t down) {
  return {5, 1, ordered(up, 4, form.order) + ordered(down, 4, form.order)};
}
inline TiffPage::Values tiff_text(const std::string& text) {
  return {2, text.size() + 1, text + '\0'};
}

// Rows of differences, as the predictors write them. `rows` has samples in native order.
inline std::string tiff_differences(const TiffForm& form, const Truth& t, std::string row) {
  const std::size_t size = size_of(t.type), count = row.size() / size;
  if (form.predictor == 2) {
    std::uint64_t last = 0;
    for (std::size_t n = 0; n < count; ++n) {
      std::uint64_t word = 0;
      std::memcpy(&word, &row[n * size], size);  // little-endian machines
      const std::uint64_t difference = word - last;
      std::memcpy(&row[n * size], &difference, size);
      last = word;
    }
  }
  if (form.predictor == 3) {  // the highest bytes of all samples, then the next ones
    std::string bytes(row.size(), '\0');
    for (std::size_t n = 0; n < row.size(); ++n) {
      bytes[(size - 1 - n % size) * count + n / size] = row[n];
    }
    for (std::size_t n = bytes.size(); n-- > 1;) {
      bytes[n] = static_cast<char>(bytes[n] - bytes[n - 1]);
    }
    return bytes;
  }
  if (form.order != std::endian::native) {
    for (std::size_t n = 0; n < row.size(); n += size) {
      std::reverse(row.begin() + static_cast<std::ptrdiff_t>(n),
                   row.begin() + static_cast<std::ptrdiff_t>(n + size));
    }
  }
  return row;
}

inline TiffPage tiff_page(const Truth& t, const TiffForm& form, int k) {
  TiffPage page;
  const auto tag = [&](int id, std::size_t value, int type = 4) {
    page.tags[id] = tiff_value(form, value, type);
  };
  const std::size_t size = size_of(t.type);
  const bool is_signed = t.is_wide || t.type == SampleType::i8 || t.type == SampleType::i16 ||
                         t.type == SampleType::i32;
  tag(256, static_cast<std::size_t>(t.dims.i));
  tag(257, static_cast<std::size_t>(t.dims.j));
  tag(258, 8 * size, 3);
  tag(259, static_cast<std::size_t>(form.compression), 3);
  tag(262, 1, 3);
  if (form.predictor != 1) tag(317, static_cast<std::size_t>(form.predictor), 3);
  if (t.is_real() || is_signed) tag(339, t.is_real() ? 3 : 2, 3);
  if (form.tile > 0) {
    tag(322, static_cast<std::size_t>(form.tile));
    tag(323, static_cast<std::size_t>(form.tile));
  } else {
    tag(278, static_cast<std::size_t>(form.rows_per_strip));
  }
  const int height = form.tile > 0 ? form.tile : form.rows_per_strip;
  const int width = form.tile > 0 ? form.tile : t.dims.i;
  for (int y0 = 0; y0 < t.dims.j; y0 += height) {
    for (int x0 = 0; x0 < t.dims.i; x0 += width) {
      std::string block;
      for (int y = y0; y < y0 + height && (form.tile > 0 || y < t.dims.j); ++y) {
        std::string row;
        for (int x = x0; x < x0 + width; ++x) {
          const bool inside = x < t.dims.i && y < t.dims.j;
          const int n = inside ? x + t.dims.i * (y + t.dims.j * k) : 0;
          row += t.bytes.substr(size * static_cast<std::size_t>(n), size);
        }
        block += tiff_differences(form, t, row);
      }
      if (form.compression == 5) block = lzw(block);
      if (form.compression == 8 || form.compression == 32946) block = zlibbed(block, t.seed);
      if (form.compression == 32773) block = pack_bits(block);
      page.blocks.push_back(block);
    }
  }
  return page;
}

// The samples of all pages, the values of tags that do not fit into them, and the tags.
inline std::string tiff_file(const TiffForm& form, std::vector<TiffPage> pages) {
  const std::size_t word = form.is_big ? 8 : 4;
  const auto number = [&](std::uint64_t n, std::size_t bytes) {
    return ordered(n, static_cast<int>(bytes), form.order);
  };
  std::string file = form.order == std::endian::little ? "II" : "MM";
  file += number(form.is_big ? 43 : 42, 2);
  if (form.is_big) file += number(8, 2) + number(0, 2);
  std::size_t link = file.size();  // where the place of the next page stands
  file += number(0, word);
  for (TiffPage& page : pages) {
    const int type = form.is_big ? 16 : 4;
    TiffPage::Values offsets{type, 0, ""}, sizes = offsets;
    for (const std::string& block : page.blocks) {
      offsets.bytes += number(file.size(), word);
      sizes.bytes += number(block.size(), word);
      offsets.count = ++sizes.count;
      file += block;
    }
    const bool is_tiled = page.tags.count(322) > 0;
    page.tags.try_emplace(is_tiled ? 324 : 273, offsets);
    page.tags.try_emplace(is_tiled ? 325 : 279, sizes);
  }
  for (TiffPage& page : pages) {
    for (auto& [id, values] : page.tags) {
      if (values.bytes.size() <= word) continue;
      const std::string at = number(file.size(), word);
      file += values.bytes;
      values.bytes = at;
    }
  }
  for (const TiffPage& page : pages) {
    file.replace(link, word, number(file.size(), word));
    file += number(page.tags.size(), form.is_big ? 8 : 2);
    for (auto [id, values] : page.tags) {
      values.bytes.resize(word);
      file += number(static_cast<std::uint64_t>(id), 2) +
              number(static_cast<std::uint64_t>(values.type), 2) + number(values.count, word) +
              values.bytes;
    }
    link = file.size();
    file += number(0, word);
  }
  return file;
}

inline std::vector<TiffPage> tiff_pages(const Truth& t, const TiffForm& form = {}) {
  std::vector<TiffPage> pages;
  for (int k = 0; k < t.dims.k; ++k) pages.push_back(tiff_page(t, form, k));
  return pages;
}
inline std::string tiff(const Truth& t, const TiffForm& form) {
  return tiff_file(form, tiff_pages(t, form));
}

// ---- all of them

struct StoredVolume {
  std::string label;
  std::vector<NamedFile> files;  // the first is the one to read
  bool has_axes = true;
  ReadOptions options{};

  // Returns the path to read.
  std::string write(const TemporaryFolder& folder) const {
    for (const char* old : {"v.img", "v.img.gz"}) std::filesystem::remove(folder.path(old));
    for (const NamedFile& file : files) folder.write(file.name, file.content);
    return folder.path(files[0].name);
  }
};

inline std::vector<StoredVolume> all_forms(const Truth& t) {
  std::vector<StoredVolume> all;
  const auto name = [](std::endian order) { return order == std::endian::little ? " le" : " be"; };
  // Formats without a place, which take their spacing from the options.
  const auto add_bare = [&](const std::string& label, const NamedFile& file,
                            ReadOptions options = {}) {
    options.spacing = t.spacing;
    all.push_back({label, {file}, false, options});
  };
  for (std::endian order : {std::endian::little, std::endian::big}) {
    for (const char* encoding : {"raw", "gzip", "ascii"}) {
      for (NrrdForm form : {NrrdForm::attached, NrrdForm::detached, NrrdForm::detached_skips})
        all.push_back(
            {std::string("nrrd ") + encoding + name(order), nrrd(t, order, encoding, form)});
    }
    all.push_back({std::string("nrrd at end") + name(order),
                   nrrd(t, order, "raw", NrrdForm::detached_at_end)});
    for (const char* encoding : {"raw", "zlib", "ascii"})
      for (MetaForm form : {MetaForm::local, MetaForm::detached, MetaForm::detached_header})
        all.push_back({std::string("metaimage ") + encoding + name(order),
                       metaimage(t, order, encoding, form)});
    all.push_back({std::string("metaimage at end") + name(order),
                   metaimage(t, order, "raw", MetaForm::detached_at_end)});
    for (int version : {1, 2}) {
      for (bool pair : {false, true}) {
        for (bool compressed : {false, true}) {
          for (auto placement : {NiftiForm::Placement::qform, NiftiForm::Placement::sform}) {
            NiftiForm form{version, order, pair, compressed};
            form.placement = placement;
            const char* way = placement == NiftiForm::Placement::qform ? " qform" : " sform";
            all.push_back({"nifti " + to_text(version) + name(order) + way, nifti(t, form)});
          }
        }
      }
    }
    for (int header : {4, 8}) {
      for (std::size_t block : {0, 64, 1000}) {
        for (const char* encoding : {"raw", "base64"})
          all.push_back({std::string("vti appended ") + encoding + name(order),
                         vti(t, {"appended", encoding, order, header, block})});
        all.push_back({std::string("vti binary") + name(order),
                       vti(t, {"binary", "", order, header, block})});
      }
    }
    for (const std::size_t extended : {0, 160}) {
      if (!is_mrc_type(t)) continue;
      const std::string file = mrc(t, order, extended);
      const bool has_axes = mrc_axes(t) != std::array<std::size_t, 3>{0, 1, 2} ||
                            t.axes == std::array{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
      all.push_back({"mrc" + std::string(name(order)), {{"v.mrc", file}}, has_axes});
      all.push_back({"mrc gzip", {{"v.map.gz", gzipped(file, t.seed)}}, has_axes});
    }
    for (const int blocks : {1, 2}) {
      const std::string file = inr(t, order, blocks);
      const bool has_axes = t.axes == std::array{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
      all.push_back({"inr" + std::string(name(order)), {{"v.inr", file}}, has_axes});
      all.push_back({"inr gzip", {{"v.inr.gz", gzipped(file, t.seed)}}, has_axes});
    }
    ReadOptions raw;
    raw.raw = RawLayout{t.dims, t.type, order, 4};
    if (t.is_wide) raw.raw->type = StoredType::Wide::i64;
    add_bare(std::string("raw") + name(order), {"v.raw", "skip" + t.in_order(order)}, raw);
    for (const bool is_big : {false, true}) {
      for (const int compression : {1, 5, 8, 32946, 32773}) {
        const bool has_predictor = compression == 5 || compression == 8;
        for (const int predictor : {1, t.is_real() ? 3 : 2}) {
          for (const int tile : {0, 4}) {
            if (predictor != 1 && !has_predictor) continue;
            const TiffForm form{order, is_big, tile, 3, compression, predictor};
            add_bare("tiff " + to_text(compression) + " " + to_text(predictor) + name(order),
                     {"v.tif", tiff(t, form)});
          }
        }
      }
    }
    for (int version : {1, 2, 3}) {
      add_bare("npy " + to_text(version) + name(order), {"v.npy", npy(t, order, version)});
    }
  }
  // DICOM has no left-handed axes.
  if (t.type != SampleType::f32 && t.type != SampleType::f64 &&
      !(dot(cross(t.axes[0], t.axes[1]), t.axes[2]) < 0)) {
    using Coding = DicomForm::Coding;
    std::vector<std::pair<std::string, DicomForm>> forms{
        {"dicom explicit", {}},
        {"dicom implicit", {.is_explicit = false}},
        {"dicom be", {.order = std::endian::big}},
        {"dicom rle", {.coding = Coding::rle}},
        {"dicom deflated", {.coding = Coding::deflated}}};
    if (size_of(t.type) <= 2) {
      forms.push_back({"dicom jpeg", {.coding = Coding::jpeg}});
      forms.push_back({"dicom jpeg-ls", {.coding = Coding::jpeg_ls}});
    }
    for (const auto& [label, plain] : forms) {
      for (const auto place : {DicomForm::Place::stack, DicomForm::Place::offsets,
                               DicomForm::Place::shared, DicomForm::Place::each}) {
        DicomForm form = plain;
        form.place = place;
        form.has_lengths = place != DicomForm::Place::each;
        form.has_preamble = place != DicomForm::Place::stack || form.coding != Coding::plain ||
                            form.order == std::endian::big;
        all.push_back({label, {{"v.dcm", dicom_file(form, dicom_image(t, form, 0, t.dims.k))}}});
      }
    }
  }
  all.push_back({"vti ascii", vti(t, {"ascii", "", std::endian::little, 4, 0})});
  for (bool binary : {false, true})
    for (bool field : {false, true}) all.push_back({"vtk", vtk(t, binary, field), false, {}});
  return all;
}

}  // namespace deliso::test
