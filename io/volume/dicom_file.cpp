// SPDX-License-Identifier: MIT
#include "io/volume/dicom_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/frame.h"
#include "base/text.h"
#include "io/files/field_reader.h"
#include "io/files/inflate.h"
#include "io/files/jpeg.h"
#include "io/files/packbits.h"
#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kPreamble = 128;
constexpr int kMaxDepth = 32;  // of nested sequences; real ones have about six

// Group and element.
constexpr std::uint32_t kTransferSyntax = 0x00020010, kDescription = 0x0008103e,
                        kSeries = 0x0020000e, kSeriesNumber = 0x00200011, kPosition = 0x00200032,
                        kOrientation = 0x00200037, kSamplesPerPixel = 0x00280002,
                        kPhotometric = 0x00280004, kFrames = 0x00280008, kRows = 0x00280010,
                        kColumns = 0x00280011, kPixelSpacing = 0x00280030,
                        kBitsAllocated = 0x00280100, kBitsStored = 0x00280101,
                        kHighBit = 0x00280102, kSigned = 0x00280103, kIntercept = 0x00281052,
                        kSlope = 0x00281053, kDistance = 0x00180088, kThickness = 0x00180050,
                        kLocation = 0x00201041, kInstance = 0x00080018, kImageType = 0x00080008,
                        kFrameOffsets = 0x3004000c, kDoseScaling = 0x3004000e,
                        kDetectors = 0x00540022, kSlices = 0x00540080, kSharedGroups = 0x52009229,
                        kFrameGroups = 0x52009230, kSegments = 0x00620002,
                        kSegmentNumber = 0x00620004, kSegmentLabel = 0x00620005,
                        kSegmentColor = 0x0062000d, kSegmentOfFrame = 0x0062000b,
                        kPixelData = 0x7fe00010, kItem = 0xfffee000, kItemEnd = 0xfffee00d,
                        kSequenceEnd = 0xfffee0dd;

// The sequences of a functional group that hold a plane: Plane Position, Plane Orientation, Pixel
// Measures, Pixel Value Transformation; and a moment: Frame Content, Temporal Position, MR Echo, MR
// Diffusion, Cardiac Synchronization. The first is Segment Identification.
constexpr std::uint32_t kPlaneSequences[] = {0x0062000a, 0x00209113, 0x00209116, 0x00289110,
                                             0x00289145, 0x00209111, 0x00209310, 0x00189114,
                                             0x00189117, 0x00189118};

// The elements of a moment, and their places in it. Files of several frames have their own.
constexpr std::pair<std::uint32_t, std::size_t> kMoments[] = {
    {0x00200100, 0}, {0x00209128, 0}, {0x00181060, 1}, {0x00209153, 1},
    {0x00180081, 2}, {0x00189082, 2}, {0x00189087, 3}, {0x00200012, 4},
    {0x00209156, 4}, {0x00080032, 5}, {0x00080033, 6}, {0x00200013, 7}};

// AcquisitionDate and ContentDate, which come before the times; their places in a moment.
constexpr std::array<std::uint32_t, 2> kDays = {0x00080022, 0x00080023};
constexpr std::size_t kTimes = 5;

// The elements of an image that are texts, and those that are numbers of 16 bits.
constexpr std::pair<std::uint32_t, std::string DicomFile::*> kStrings[] = {
    {kSeries, &DicomFile::series},           {kInstance, &DicomFile::instance},
    {kImageType, &DicomFile::image_type},    {0x00620001, &DicomFile::segmentation_type},
    {kDescription, &DicomFile::description}, {kPhotometric, &DicomFile::photometric},
    {0x00650010, &DicomFile::grid_owner},    {0x00651050, &DicomFile::grid_slices}};
constexpr std::pair<std::uint32_t, int DicomFile::*> kShorts[] = {
    {kSamplesPerPixel, &DicomFile::samples_per_pixel},
    {kRows, &DicomFile::rows},
    {kColumns, &DicomFile::columns},
    {kBitsAllocated, &DicomFile::bits_allocated},
    {kBitsStored, &DicomFile::bits_stored},
    {kHighBit, &DicomFile::high_bit},
    {kSigned, &DicomFile::is_signed},
    {0x00280120, &DicomFile::padding_value}};

constexpr std::string_view kExplicitLittle = "1.2.840.10008.1.2.1",
                           kImplicitLittle = "1.2.840.10008.1.2",
                           kExplicitBig = "1.2.840.10008.1.2.2",
                           kDeflated = "1.2.840.10008.1.2.1.99";

// Transfer syntaxes whose samples are compressed, all explicit and little-endian.
struct CodedSyntax {
  std::string_view uid;
  DicomCoding coding;
  const char* foreign = nullptr;  // its name, if it is not read
};
constexpr CodedSyntax kCodedSyntaxes[] = {
    {"1.2.840.10008.1.2.5", DicomCoding::rle},
    {"1.2.840.10008.1.2.4.57", DicomCoding::jpeg},
    {"1.2.840.10008.1.2.4.70", DicomCoding::jpeg},
    {"1.2.840.10008.1.2.4.80", DicomCoding::jpeg},
    {"1.2.840.10008.1.2.4.81", DicomCoding::jpeg},
    {"1.2.840.10008.1.2.4.50", DicomCoding::jpeg, "JPEG that loses detail"},
    {"1.2.840.10008.1.2.4.51", DicomCoding::jpeg, "JPEG that loses detail"},
    {"1.2.840.10008.1.2.4.90", DicomCoding::jpeg, "JPEG 2000"},
    {"1.2.840.10008.1.2.4.91", DicomCoding::jpeg, "JPEG 2000"}};

constexpr const char* kConvert =
    "convert it with 'gdcmconv --raw IN OUT', or the series with 'dcm2niix -o . FOLDER'";

bool is_upper(std::byte c) {
  return c >= std::byte{'A'} && c <= std::byte{'Z'};
}

// Reads the elements of a file from its beginning up to the pixel data.
class DicomParser {
 public:
  explicit DicomParser(const Bytes& bytes) : bytes_(bytes) { file_.bytes = bytes; }

  std::optional<DicomFile> run() {
    at_ = has_dicom_preamble(bytes_) ? kPreamble + 4 : 0;
    // The first group is explicit, little-endian, and tells how the others are.
    while (bytes_.size() - at_ >= 8 && number<std::uint16_t>(at_) == 2) {
      const Element element = next(bytes_.size());
      if (element.undefined) fail_damaged(element.at);
      if (element.tag == kTransferSyntax) syntax_ = string_at(element);
      at_ += element.length;
    }
    if (syntax_ == kDeflated) inflate_rest();
    choose_syntax();
    read_elements(bytes_.size(), &file_.common, 0);
    if (!has_pixels_) return std::nullopt;
    place_by_detectors();
    check_image();
    return std::move(file_);
  }

 private:
  struct Element {
    std::size_t at = 0;  // of the tag
    std::uint32_t tag = 0;
    std::string_view vr;
    std::size_t length = 0;
    bool undefined = false;  // the length
  };

  [[noreturn]] void fail_damaged(std::size_t at) const {
    fail(bytes_.name, "is damaged, or ends too early: the element at byte ", at);
  }

  template <class T>
  T number(std::size_t at) const {
    return FieldReader(bytes_.data, order_).get<T>(at);
  }

  // Reads the tag and the length of the element at at_, and moves to its value.
  Element next(std::size_t end) {
    Element element;
    element.at = at_;
    const auto advance = [&](std::size_t count) {
      if (end - at_ < count) fail_damaged(element.at);
      at_ += count;
      return at_ - count;
    };
    const std::size_t tag = advance(4);
    element.tag = std::uint32_t{number<std::uint16_t>(tag)} << 16 | number<std::uint16_t>(tag + 2);
    std::uint32_t length = 0;
    if (is_explicit_ && element.tag >> 16 != 0xfffe) {
      element.vr = bytes_.text().substr(advance(4), 2);
      constexpr std::string_view kShort =  // of lengths in 16 bits
          "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";
      const bool is_short = kShort.find(element.vr) != std::string_view::npos;
      length = is_short ? number<std::uint16_t>(at_ - 2) : number<std::uint32_t>(advance(4));
    } else {
      length = number<std::uint32_t>(advance(4));
    }
    element.undefined = length == 0xffffffff;
    element.length = element.undefined ? 0 : length;
    if (element.length > end - at_) fail_damaged(element.at);
    return element;
  }

  void choose_syntax() {
    if (syntax_.empty()) {  // without a first group
      const bool has_vr = bytes_.size() >= at_ + 6 && is_upper(bytes_.data[at_ + 4]) &&
                          is_upper(bytes_.data[at_ + 5]);
      // Of a group's two bytes the higher one.
      const bool is_big = has_vr && bytes_.data[at_] == std::byte{0};
      syntax_ = !has_vr ? kImplicitLittle : is_big ? kExplicitBig : kExplicitLittle;
    }
    is_explicit_ = syntax_ != kImplicitLittle;
    file_.is_big_endian = syntax_ == kExplicitBig;
    if (file_.is_big_endian) order_ = std::endian::big;
    const auto coded = std::ranges::find(kCodedSyntaxes, syntax_, &CodedSyntax::uid);
    if (coded != std::end(kCodedSyntaxes)) {
      file_.coding = coded->coding;
      if (coded->foreign) file_.fault = text("is compressed (", coded->foreign, "): ", kConvert);
    } else if (is_explicit_ && !file_.is_big_endian && syntax_ != kExplicitLittle) {
      file_.fault = text("has transfer syntax ", quote(syntax_), ": ", kConvert);
    }
  }

  // Replaces the rest of the file by what it inflates to (PS3.5, A.5).
  void inflate_rest() {
    const Bytes packed = bytes_.from(at_);
    for (std::size_t size = 8 * packed.size();; size *= 4) {
      Buffer buffer(size);
      const Inflated result = inflate(packed.data, Wrapping::none, buffer.span());
      if (result.fault) fail(packed.name, "its deflated data set is damaged: ", result.fault);
      if (!result.ended) continue;
      bytes_ = file_.bytes = bytes_of(std::move(buffer), packed.name).first(result.size);
      at_ = 0;
      syntax_ = kExplicitLittle;
      return;
    }
  }

  // Reads elements up to `end`, or to the end of an item of undefined length. `plane` gets what
  // they say of it, if it is given.
  void read_elements(std::size_t end, DicomPlane* plane, int depth) {
    while (at_ < end && !has_pixels_) {
      const Element element = next(end);
      if (element.tag == kItemEnd) return;
      if (depth == 0 && element.tag == kPixelData) {
        read_pixel_data(element);
        return;
      }
      const bool has_planes = depth == 0
                                  ? element.tag == kSharedGroups || element.tag == kFrameGroups ||
                                        element.tag == kDetectors || element.tag == kSegments
                                  : plane && std::ranges::count(kPlaneSequences, element.tag) > 0;
      if (element.undefined || has_planes) {
        read_items(element, end, has_planes ? plane : nullptr, depth);
        continue;
      }
      if (plane == &segment_) read_segment(element);
      if (plane) read_plane(element, *plane);
      if (depth == 0 && element.length > 0) read_image(element);
      at_ += element.length;
    }
  }

  void read_items(const Element& sequence, std::size_t parent_end, DicomPlane* plane, int depth) {
    if (depth == kMaxDepth) fail_damaged(sequence.at);
    const std::size_t end = sequence.undefined ? parent_end : at_ + sequence.length;
    // Data of unknown type and length are items in implicit VR (PS3.5, 6.2.2).
    const std::pair saved(is_explicit_, order_);
    if (sequence.vr == "UN") is_explicit_ = false, order_ = std::endian::little;
    while (at_ < end) {
      const Element item = next(end);
      if (item.tag == kSequenceEnd) break;
      if (item.tag != kItem) fail_damaged(item.at);
      const std::size_t item_end = item.undefined ? end : at_ + item.length;
      // The fragments of a compressed icon have no elements.
      if (sequence.vr.starts_with('O') || sequence.tag == kPixelData) {
        at_ = item_end;
        continue;
      }
      if (sequence.tag == kFrameGroups && plane) plane = &file_.planes.emplace_back();
      if (sequence.tag == kDetectors && plane) plane = &detectors_.emplace_back();
      if (sequence.tag == kSegments && plane) {
        file_.segments.emplace_back();
        plane = &segment_;
      }
      read_elements(item_end, plane, depth + 1);
      if (!item.undefined) at_ = item_end;
    }
    std::tie(is_explicit_, order_) = saved;
  }

  std::string_view string_at(const Element& element) const {
    std::string_view value = bytes_.text().substr(at_, element.length);
    while (value.ends_with('\0')) value.remove_suffix(1);
    return trimmed(value);
  }

  // Returns the decimal numbers of an element; nullopt if they are none, or out of range.
  std::optional<std::vector<double>> usable_numbers(const Element& element) const {
    std::string words(string_at(element));
    std::ranges::replace(words, '\\', ' ');
    std::optional<std::vector<double>> numbers = to_doubles(words);
    const auto is_usable = [](double x) { return std::abs(x) <= kLargestLength; };  // and no NaN
    if (numbers && !std::ranges::all_of(*numbers, is_usable)) numbers.reset();
    return numbers;
  }

  // Returns the one number of an element, if it is good.
  std::optional<double> number_if(const Element& element, bool (*is_good)(double)) const {
    const auto numbers = usable_numbers(element);
    if (!numbers || numbers->size() != 1 || !is_good((*numbers)[0])) return std::nullopt;
    return (*numbers)[0];
  }

  // Returns the decimal numbers of an element; `count` of them unless that is 0.
  std::vector<double> numbers_at(const Element& element, const char* name,
                                 std::size_t count) const {
    std::optional<std::vector<double>> numbers = usable_numbers(element);
    if (!numbers || (count > 0 && numbers->size() != count)) {
      fail(bytes_.name, "its ", name, " is ", quote(string_at(element)), ", not ",
           count == 0 ? "" : std::to_string(count) + " ", "numbers");
    }
    return *numbers;
  }

  void read_segment(const Element& element) {
    NamedSegment& segment = file_.segments.back();
    if (element.tag == kSegmentLabel) segment.name = string_at(element);
    if (element.tag == kSegmentNumber && element.length == 2) {
      segment.label = number<std::uint16_t>(at_);
    }
    if (element.tag == kSegmentColor && element.length == 6) {
      segment.color = srgb_of_cielab({number<std::uint16_t>(at_), number<std::uint16_t>(at_ + 2),
                                      number<std::uint16_t>(at_ + 4)});
    }
  }

  void read_plane(const Element& element, DicomPlane& plane) const {
    if (element.tag == kSegmentOfFrame && element.length == 2) {
      plane.segment = number<std::uint16_t>(at_);
      return;
    }
    if (string_at(element).empty()) return;
    if (element.tag == kPosition) {
      const auto n = numbers_at(element, "ImagePositionPatient", 3);
      plane.position = Vec3{n[0], n[1], n[2]};
    } else if (element.tag == kOrientation) {
      const auto n = numbers_at(element, "ImageOrientationPatient", 6);
      plane.directions = {Vec3{n[0], n[1], n[2]}, Vec3{n[3], n[4], n[5]}};
    } else if (element.tag == kPixelSpacing) {
      // One that is bad is as none: an option may replace it. The file has the distance of rows
      // first, which is along y.
      const auto n = usable_numbers(element).value_or(std::vector<double>());
      if (n.size() == 2 && n[0] > 0 && n[1] > 0) plane.spacing = {n[1], n[0]};
    } else if (element.tag == kDistance) {
      plane.distance = number_if(element, [](double x) { return x != 0; });
    } else if (element.tag == kThickness) {
      plane.thickness = number_if(element, [](double x) { return x > 0; });
    } else if (element.tag == kLocation) {
      plane.location = number_if(element, [](double) { return true; });
    } else if (element.tag == kSlope || element.tag == kDoseScaling) {
      plane.slope = numbers_at(element, "RescaleSlope", 1)[0];
      if (*plane.slope == 0) fail(bytes_.name, "its RescaleSlope is 0");
    } else if (element.tag == kIntercept) {
      plane.intercept = numbers_at(element, "RescaleIntercept", 1)[0];
    }
    for (std::size_t n = 0; n < kDays.size(); ++n) {
      if (element.tag == kDays[n]) plane.days[n] = moment_at(element).value_or(0);
    }
    for (const auto& [tag, n] : kMoments) {
      if (element.tag != tag) continue;
      plane.moment[n] = moment_at(element);
      constexpr double kDay = 1e6;  // behind HHMMSS
      if (plane.moment[n] && n >= kTimes && n < kTimes + kDays.size())
        *plane.moment[n] += kDay * plane.days[n - kTimes];
    }
  }

  // Returns a number that may be binary; nullopt if there is none.
  std::optional<double> moment_at(const Element& element) const {
    constexpr std::uint32_t kReals[] = {0x00189082, 0x00189087, 0x00209153};
    double value = std::numeric_limits<double>::quiet_NaN();
    if (element.tag == 0x00209128 && element.length == 4) {
      value = number<std::uint32_t>(at_);
    } else if (element.tag == 0x00209156 && element.length == 2) {
      value = number<std::uint16_t>(at_);
    } else if (std::ranges::count(kReals, element.tag) > 0 && element.length == 8) {
      value = number<double>(at_);
    } else if (const auto words = to_doubles(string_at(element)); words && words->size() == 1) {
      value = (*words)[0];  // a time is HHMMSS.FFFFFF
    }
    if (!std::isfinite(value)) return std::nullopt;
    return value;
  }

  void read_image(const Element& element) {
    for (const auto& [tag, member] : kStrings) {
      if (element.tag == tag) file_.*member = string_at(element);
    }
    for (const auto& [tag, member] : kShorts) {
      if (element.tag != tag) continue;
      if (element.length < 2) fail_damaged(element.at);
      file_.*member = number<std::uint16_t>(at_);
    }
    if (element.tag == kBitsAllocated) file_.bits_stored = file_.bits_allocated;
    if (element.tag == kBitsAllocated || element.tag == kBitsStored) {
      file_.high_bit = file_.bits_stored - 1;
    }
    if (element.tag == kSeriesNumber) {
      file_.series_number = to_int(string_at(element)).value_or(file_.series_number);
    } else if (element.tag == kFrames) {
      file_.frame_count = to_int(string_at(element)).value_or(0);
      if (file_.frame_count < 1 || file_.frame_count > std::numeric_limits<int>::max()) {
        fail(bytes_.name, "its NumberOfFrames is ", quote(string_at(element)));
      }
    } else if (element.tag == kSlices) {
      file_.frame_slices.clear();
      for (std::size_t n = 0; n + 1 < element.length; n += 2) {
        file_.frame_slices.push_back(number<std::uint16_t>(at_ + n));
      }
    } else if (element.tag == kFrameOffsets) {
      file_.frame_offsets = numbers_at(element, "GridFrameOffsetVector", 0);
    }
  }

  void read_pixel_data(const Element& element) {
    has_pixels_ = true;
    is_word_data_ = element.vr == "OW";
    const bool is_plain = file_.coding == DicomCoding::plain;
    if (is_plain == element.undefined && file_.fault.empty()) fail_damaged(element.at);
    if (!element.undefined) {
      file_.pixels = bytes_.data.subspan(at_, element.length);
      return;
    }
    for (bool is_table = true;; is_table = false) {  // the first item has the frames' offsets
      const Element item = next(bytes_.size());
      if (item.tag == kSequenceEnd) return;
      if (item.tag != kItem || item.undefined) fail_damaged(item.at);
      // No fragment of JPEG but a frame's first begins with its marker.
      const bool goes_on = file_.coding == DicomCoding::jpeg && !file_.fragments.empty() &&
                           !bytes_.text().substr(at_, item.length).starts_with("\xff\xd8");
      if (!is_table && !goes_on) file_.fragments.emplace_back();
      if (!is_table) file_.fragments.back().push_back(bytes_.data.subspan(at_, item.length));
      at_ += item.length;
    }
  }

  // Nuclear medicine has the place of its frames in that of the detector (PS3.3, C.8.4.11). Which
  // frame is of which detector is not read, so they must agree.
  void place_by_detectors() {
    const auto agree = [&](auto place) {
      return std::ranges::all_of(detectors_, [&](const DicomPlane& detector) {
        return detector.*place == detectors_[0].*place;
      });
    };
    if (detectors_.empty() || !agree(&DicomPlane::position) || !agree(&DicomPlane::directions)) {
      return;
    }
    DicomPlane& common = file_.common;
    if (!common.position) common.position = detectors_[0].position;
    if (!common.directions) common.directions = detectors_[0].directions;
  }

  void check_image() {
    const std::string& name = bytes_.name;
    const bool is_segmentation = file_.is_segmentation();
    if (!file_.is_gray() && !is_segmentation) {
      file_.fault =
          text("is in color (", quote(file_.photometric), "): only grayscale can be meshed");
    }
    // The private elements of United Imaging have a creator, and the number of slices in a picture.
    const bool is_grid =
        file_.grid_owner == "Image Private Header" && to_double(file_.grid_slices).value_or(0) > 1;
    if (is_grid || file_.image_type.find("MOSAIC") != std::string::npos) {
      file_.fault = text("is a mosaic, as ", is_grid ? "United Imaging" : "Siemens",
                         " writes it: all slices in one picture. Convert the series with "
                         "'dcm2niix -o . FOLDER'");
    }
    const int bits = file_.bits_allocated;
    if (bits == 0) {
      file_.fault = "does not tell the bits of its samples (BitsAllocated)";
    } else if (is_segmentation && bits == 1 && file_.coding == DicomCoding::plain) {
      file_.bits_stored = 1;
    } else if ((bits != 8 && bits != 16 && bits != 32) || file_.bits_stored < 1 ||
               file_.bits_stored > bits || file_.high_bit < file_.bits_stored - 1 ||
               file_.high_bit >= bits) {
      file_.fault = text("has samples of ", file_.bits_stored, " bits in ", bits, ", up to bit ",
                         file_.high_bit, ": only those in 8, 16 and 32 are read");
    }
    if (!file_.fault.empty()) return;
    if (file_.rows == 0 || file_.columns == 0) fail(name, "does not tell its Rows and Columns");
    file_.is_swapped_bytes = file_.is_big_endian && is_word_data_ && bits == 8;
    const std::size_t frames = static_cast<std::size_t>(file_.frame_count),
                      size = file_.frame_size();
    const auto fail_size = [&](std::size_t found) {
      fail(name, "has ", found, " bytes of samples: ", frames, " frames of ", file_.columns, " x ",
           file_.rows, " need ", size, " each");
    };
    if (file_.coding != DicomCoding::plain) {
      if (file_.fragments.size() != frames) {
        fail(name, "has ", file_.fragments.size(), " compressed frames in place of ", frames);
      }
      for (const auto& fragments : file_.fragments) {
        std::size_t packed = 0;
        for (const auto& fragment : fragments) packed += fragment.size();
        const bool is_rle = file_.coding == DicomCoding::rle;
        if (size > (is_rle ? largest_unpacked(packed) : 2 * largest_jpeg(packed)))
          fail_size(packed);
      }
    } else {
      // Bytes behind the samples are no fault (PS3.5, 8.1.1).
      const std::size_t found = file_.pixels.size() * (bits == 1 ? 8 : 1);
      if (frames > found / size) fail_size(found);
      if (file_.is_swapped_bytes && found % 2 != 0) fail_size(found);
    }
    if (!file_.planes.empty() && file_.planes.size() != frames) {
      fail(name, "has the places of ", file_.planes.size(), " frames, and ", frames, " frames");
    }
    for (const std::size_t count : {file_.frame_offsets.size(), file_.frame_slices.size()}) {
      if (count == 0 || count == frames) continue;
      fail(name, "has the offsets of ", count, " frames, and ", frames, " frames");
    }
  }

  Bytes bytes_;
  std::size_t at_ = 0;
  bool is_explicit_ = true;
  std::endian order_ = std::endian::little;
  bool has_pixels_ = false, is_word_data_ = false;
  std::string syntax_;
  std::vector<DicomPlane> detectors_;
  DicomPlane segment_;  // stands for the one that is read
  DicomFile file_;
};

// Unpacks a frame in RLE (PS3.5, annex G): a header with the places of the segments, and one
// segment per byte of a sample, the highest first.
void unpack_rle(const DicomFile& file, std::span<const std::byte> fragment,
                std::span<std::byte> out) {
  constexpr std::size_t kHeader = 64;
  const std::size_t planes = size_of(file.type()), count = out.size() / planes;
  const auto fail_damaged = [&] { fail(file.name(), "its run lengths are damaged"); };
  if (fragment.size() < kHeader) fail_damaged();
  const FieldReader header(fragment, std::endian::little);
  if (header.get<std::uint32_t>(0) != planes) fail_damaged();
  Buffer plane(count);
  for (std::size_t n = 0; n < planes; ++n) {
    const std::size_t begin = header.get<std::uint32_t>(4 + 4 * n);
    const std::size_t end = n + 1 < planes ? header.get<std::uint32_t>(8 + 4 * n) : fragment.size();
    if (begin > end || end > fragment.size()) fail_damaged();
    if (unpack_bits(fragment.subspan(begin, end - begin), plane.span()) != count) fail_damaged();
    const std::size_t byte = std::endian::native == std::endian::big ? n : planes - 1 - n;
    for (std::size_t k = 0; k < count; ++k) out[k * planes + byte] = plane.data[k];
  }
}

// Keeps the bits of each sample that are its value. The others may hold an overlay.
template <class T>
void extract_bits(std::span<std::byte> samples, int bits_stored, int high_bit) {
  const int width = 8 * static_cast<int>(sizeof(T));
  const int up = width - 1 - high_bit, down = width - bits_stored;
  for (std::size_t n = 0; n < samples.size(); n += sizeof(T)) {
    T value;
    std::memcpy(&value, &samples[n], sizeof value);
    // The shift to the right repeats the sign of a signed T.
    value = static_cast<T>(static_cast<T>(static_cast<unsigned>(value) << up) >> down);
    std::memcpy(&samples[n], &value, sizeof value);
  }
}

// Decodes a frame in JPEG or JPEG-LS. Returns the number of bits of its samples.
int unpack_jpeg(const DicomFile& file, std::size_t frame, std::span<std::byte> out) {
  std::span<const std::byte> packed = file.fragments[frame][0];
  std::vector<std::byte> joined;
  if (file.fragments[frame].size() > 1) {
    for (const auto& part : file.fragments[frame]) {
      joined.insert(joined.end(), part.begin(), part.end());
    }
    packed = joined;
  }
  std::vector<std::uint16_t> samples(out.size() / size_of(file.type()));
  const JpegPicture picture = decode_jpeg(packed, static_cast<std::size_t>(file.columns),
                                          static_cast<std::size_t>(file.rows), samples);
  const char* fault = picture.fault;
  if (!fault && picture.bits > file.bits_allocated) fault = "more bits than there is room for";
  if (fault) {
    fail(file.name(), "its JPEG of frame ", frame + 1, " is damaged, or not lossless: ", fault);
  }
  with_type(file.type(), [&]<class T>(T) {
    for (std::size_t n = 0; n < samples.size(); ++n) {
      const T value = static_cast<T>(samples[n]);
      std::memcpy(&out[n * sizeof value], &value, sizeof value);
    }
  });
  return picture.bits;
}

}  // namespace

SampleType DicomFile::type() const {
  if (bits_allocated <= 8) return is_signed ? SampleType::i8 : SampleType::u8;
  if (bits_allocated == 16) return is_signed ? SampleType::i16 : SampleType::u16;
  return is_signed ? SampleType::i32 : SampleType::u32;
}

DicomPlane DicomFile::plane(std::size_t frame) const {
  DicomPlane plane = common;
  if (planes.empty()) return plane;
  const DicomPlane& own = planes[frame];
  const auto prefer = [](auto& to, const auto& from) {
    if (from) to = from;
  };
  prefer(plane.position, own.position);
  prefer(plane.directions, own.directions);
  prefer(plane.spacing, own.spacing);
  prefer(plane.distance, own.distance);
  prefer(plane.thickness, own.thickness);
  prefer(plane.location, own.location);
  prefer(plane.slope, own.slope);
  prefer(plane.intercept, own.intercept);
  prefer(plane.segment, own.segment);
  for (std::size_t n = 0; n < own.moment.size(); ++n) prefer(plane.moment[n], own.moment[n]);
  return plane;
}

void DicomFile::write_frame(std::size_t frame, std::span<std::byte> out) const {
  const std::size_t first = frame * out.size();
  int stored = bits_stored, high = high_bit;
  if (bits_allocated == 1) {  // the lowest first, and no frame begins with a byte of its own
    for (std::size_t n = 0; n < out.size(); ++n) {
      out[n] = pixels[(first + n) / 8] >> (first + n) % 8 & std::byte{1};
    }
    return;
  }
  if (coding == DicomCoding::rle) {
    unpack_rle(*this, fragments[frame][0], out);
  } else if (coding == DicomCoding::jpeg) {
    // A negative sample is one by the highest bit of its code, even if others are said to be
    // stored.
    const int coded = unpack_jpeg(*this, frame, out);
    if (coded <= high) stored = std::min(stored, coded), high = coded - 1;
  } else if (is_swapped_bytes) {
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = pixels[(first + n) ^ 1];
  } else {
    std::memcpy(out.data(), &pixels[first], out.size());
    if (is_big_endian != (std::endian::native == std::endian::big)) {
      swap_bytes(out, size_of(type()));
    }
  }
  if (stored == bits_allocated) return;
  with_type(type(), [&]<class T>(T) {
    if constexpr (std::is_integral_v<T>) extract_bits<T>(out, stored, high);
  });
}

bool has_dicom_preamble(const Bytes& bytes) {
  return bytes.text().substr(std::min(kPreamble, bytes.size())).starts_with("DICM");
}

// Without a preamble: an element of the first groups, as every data set begins.
bool looks_like_dicom(const Bytes& bytes) {
  if (has_dicom_preamble(bytes)) return true;
  if (bytes.size() <= kPreamble) return false;
  const std::string_view tag = bytes.text().substr(0, 4);
  for (const std::string_view known :
       {"\2\0\0\0"sv, "\2\0\1\0"sv, "\2\0\2\0"sv, "\2\0\x10\0"sv, "\x8\0\0\0"sv, "\x8\0\5\0"sv,
        "\x8\0\x8\0"sv, "\x8\0\x16\0"sv, "\0\x8\0\0"sv, "\0\x8\0\5"sv, "\0\x8\0\x8"sv,
        "\0\x8\0\x16"sv}) {
    if (tag == known) return true;
  }
  return false;
}

std::optional<DicomFile> parse_dicom(const Bytes& bytes) {
  return DicomParser(bytes).run();
}

}  // namespace deliso
