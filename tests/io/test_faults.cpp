// SPDX-License-Identifier: MIT
// What a user reads when a volume or a mesh cannot be used: one line with the file, the place and
// the fault. The table has a file that is sound, edits of it, and the message of each.
#include <doctest/doctest.h>

#include <bit>
#include <charconv>
#include <map>
#include <string>
#include <string_view>

#include "base/check.h"
#include "io/files/text_scan.h"
#include "io/mesh/containers.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "io/volume/volume_files.h"
#include "mesh/meshes.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// "[FILE]" names the sound file that the rows below it edit. A row is "EDIT | MESSAGE", the message
// without the file's name; "..." stands for the rest of it, before or behind; "ok": there is none.
// An edit is one of
//   OLD -> NEW      the first OLD replaced
//   EDIT && EDIT    one after the other
//   set FIELD: VALUE  of NRRD, replaced or added; without a value, removed
//   at N: T VALUE   bytes replaced by a little-endian number: u2, u4, f4
//   + TEXT          appended
//   first N, but N  the first N bytes, or all but the last N
//   = TEXT          another file altogether
// with \n and \xHH for bytes.
constexpr std::string_view kTable = R"([nrrd]
first 9999 | ok
but 1 | data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 23
+ x | data is too long: 2 x 3 x 4 uint8 samples need 24 bytes, found 25
set sizes: 200 300 400 | data is too short: 200 x 300 x 400 uint8 samples need 24000000 bytes, found 24
set sizes: 2 3 0 | 0 samples along z: dimensions must be positive
set sizes: 2 -3 4 | -3 samples along y: dimensions must be positive
set sizes: 1 6 4 | 1 samples along x: a volume needs two or more along each axis
set sizes: 2147483647 2147483647 2147483647 | 2147483647 x 2147483647 x 2147483647 uint8 samples are too many
set sizes: 4294967298 3 4 | 4294967298 samples along x are too many
set sizes: 2 3 99999999999999999999 | field 'sizes' is '2 3 99999999999999999999': not a list of integers
set sizes: 2 3 x | field 'sizes' is '2 3 x': not a list of integers
set encoding: gzip | compressed data is damaged: no gzip header after 0 of 24 bytes
set type: | the header has no field 'type'
set sizes: | the header has no field 'sizes'
set encoding: | the header has no field 'encoding'
set dimension: | the header has no field 'dimension'
set type: short | the header has no field 'endian'
set type: int64 | the header has no field 'endian'
set type: block | sample type 'block' is not supported...
set encoding: bzip2 | field 'encoding' is 'bzip2': only raw, gzip and ascii are supported: convert it with 'unu save -f nrrd -e gzip -i FILE -o volume.nrrd' (of Teem; Debian has teem-unu)
set encoding: hex | field 'encoding' is 'hex': only raw, gzip and ascii are supported: convert it with 'unu save -f nrrd -e gzip -i FILE -o volume.nrrd' (of Teem; Debian has teem-unu)
set dimension: 4 | field 'sizes' is '2 3 4': not 4 numbers as 'dimension' says
dimension: 3 -> dimension: 4 && 2 3 4 -> 3 2 2 2 | has 2 times: --time N chooses one, counted from 1
dimension: 3 -> dimension: 5 && 2 3 4 -> 3 2 2 2 2 | sizes '3 2 2 2 2' are 5-dimensional: only three-dimensional scalar volumes can be meshed
dimension: 3 -> dimension: 4\nkinds: list domain domain domain && 2 3 4 -> 9 2 3 4 | has 9 channels: --channel N chooses one, counted from 1
dimension: 3 -> dimension: 4\nkinds: list domain domain domain && 2 3 4 -> 0 2 3 4 | has 0 channels: --channel N chooses one, counted from 1
set spacings: 1 1 0 | spacing along z is not positive: --spacing SX,SY,SZ gives it
set spacings: 1 -1 1 | spacing along y is not positive: --spacing SX,SY,SZ gives it
set spacings: nan 1 1 | spacing along x is not positive: --spacing SX,SY,SZ gives it
set spacings: 1 inf 1 | spacing along y is infinite: --spacing SX,SY,SZ gives it
set spacings: 1 1e40 1 | spacing 1e+40 along y is out of range (from 1e-20, ...
set spacings: 1 1e-40 1 | spacing 1e-40 along y is out of range (from 1e-20, ...
set spacings: 1 1 | field 'spacings' is '1 1': not 3 numbers
set space directions: (1,0,0) (0,1,0) | field 'spacedirections' is '(1,0,0) (0,1,0)': not 3 vectors of three numbers
set space directions: (1,0,0) (0,1,0) none | field 'spacedirections' is '(1,0,0) (0,1,0) none': an axis is not spatial
set space directions: (1,0,0) (0,1,0) (0,0) | ...not 3 vectors...
set space directions: (1,0,0) (0,1,0) (0,0,0) | spacing along z is not positive: --spacing SX,SY,SZ gives it
set space directions: (1,0,0) (1,1,0) (0,0,1) | ok
set space directions: (1,0,0) (1,0.09,0) (0,0,1) | sheared grid: its axes are too near to one plane (x and y enclose 5.1428 degrees): resample it
set space directions: (1,0,0) (0,1,0) (0,0.00009,1) | ok
set data file: none.raw | its data file none.raw: cannot open: No such file or directory
set data file: slice%03d.raw 1 10 1 | ...several files is not supported...
set data file: LIST\na.raw\nb.raw | field 'datafile' is 'LIST': data spread over several files is not supported
set line skip: -1 | field 'lineskip' is '-1': negative
set line skip: 9 | has fewer than 9 lines to skip
set byte skip: -2 | field 'byteskip' is '-2': cannot be followed
set byte skip: 25 | has 24 bytes, fewer than the 25 to skip
set byte skip: x | field 'byteskip' is 'x': not an integer
= NRRD0004\nwhat is this\n\n | header line 'what is this' is no 'field: value'
= | is empty
= some text\n | is in no known format (NRRD, MetaImage, NIfTI, MRC, INRIMAGE, VTK, NumPy, DICOM, TIFF; raw data needs dimensions and type)
[nrrd ascii]
x -> 1 2 3 4 5 6 7 +8\n | ok
x -> 1 2 3 4 5 6 7            | data is too short: 2 x 2 x 2 uint8 samples need 8 numbers, found 7
x -> 1 2 3 | data is too short: 2 x 2 x 2 uint8 samples do not fit in 5 characters
x -> 1 2 3 4 5 6 7 8 9 | data is too long: more than the 8 numbers of 2 x 2 x 2 uint8 samples
x -> 1 2 3 4 5 6 7 256 | sample 7 is '256', not a number of type uint8
x -> 1 2 x3 4 5 6 7 8 | sample 2 is 'x3', not a number of type uint8
[mha]
first 9999 | ok
NDims = 3\n ->  | the header has no key 'NDims'
DimSize = 2 3 4\n ->  | the header has no key 'DimSize'
MET_SHORT -> MET_LONG_LONG | data is too short: 2 x 3 x 4 int64 samples need 192 bytes, found 48
NDims = 3 -> NDims = 2 | key 'DimSize' is '2 3 4': not 2 integers as NDims says
NDims = 3 -> NDims = 4 && DimSize = 2 3 4 -> DimSize = 2 3 2 2 | has 2 times: --time N chooses one, counted from 1
DimSize = 2 3 4 -> DimSize = 2 3 5 | data is too short: 2 x 3 x 5 int16 samples need 60 bytes, found 48
NDims = 3 -> ElementNumberOfChannels = 3\nNDims = 3 | has 3 channels: --channel N chooses one, counted from 1
NDims = 3 -> NDims = 5 && DimSize = 2 3 4 -> DimSize = 2 3 2 2 2 | ...only three-dimensional volumes, at one time or several, can be meshed
ElementSpacing = 1 1 1 -> ElementSpacing = 1 0 1 | spacing along y is not positive: --spacing SX,SY,SZ gives it
ElementSpacing = 1 1 1 -> ElementSpacing = 1 1 | key 'ElementSpacing' is '1 1': not 3 numbers
1 0 0 0 1 0 0 0 1 -> 1 0 0 99 1 0 0 0 1 | ...sheared grid: its axes are too near...
CompressedData = False -> CompressedData = True | compressed data is damaged: no zlib header after 0 of 48 bytes
LOCAL -> LIST | ...several files is not supported...
LOCAL -> gone.raw | its data file gone.raw: cannot open: No such file or directory
NDims = 3 -> HeaderSize = 9999\nNDims = 3 | has 48 bytes, fewer than the 9999 of its header
= ObjectType = Image\nnonsense\n | header line 'nonsense' is no 'Key = Value'
[nii]
at 0: u4 348 | ok
at 70: u2 128 | is in color (RGB): only grayscale can be meshed
at 70: u2 2304 | is in color (RGBA): only grayscale can be meshed
at 70: u2 1536 | NIfTI datatype 1536 is not supported (integers of 8 to 64 bits, float32, float64 are)
at 40: u2 2 | has 2 dimensions: only three-dimensional volumes can be meshed
at 40: u2 65535 | has -1 dimensions: only three-dimensional volumes can be meshed
at 48: u2 5 | has 5 times: --time N chooses one, counted from 1
at 40: u2 5 && at 50: u2 3 | has 3 channels: --channel N chooses one, counted from 1
at 40: u2 6 && at 52: u2 3 | dimension 6 has size 3: only channels (5) and times (4) can be told apart
at 42: u2 0 | 0 samples along x: dimensions must be positive
at 46: u2 32767 | data is too short: 2 x 3 x 32767 int16 samples need 393204 bytes, found 48
at 108: f4 100 | vox_offset 100.000000 is not valid
at 108: f4 nan | vox_offset...
at 108: f4 1e6 | has 416 bytes, its samples begin at 1000000
at 280: f4 0 | spacing along x is not positive: --spacing SX,SY,SZ gives it
at 284: f4 99 | ...sheared grid...
at 292: f4 nan | its origin is further than 1e+30 away: --origin X,Y,Z gives it
[hdr]
first 348 | ...its data file...
[vtk]
first 9999 | ok
BINARY -> BOTH | is neither ASCII nor BINARY but 'both'
STRUCTURED_POINTS -> UNSTRUCTURED_GRID | holds a data set of kind 'unstructured_grid', not STRUCTURED_POINTS: convert it with python3 -c...
DIMENSIONS 2 3 4 -> DIMENSIONS 2 3 5 | POINT_DATA is 24, but DIMENSIONS give 30 points
DIMENSIONS 2 3 4 -> DIMENSIONS 2 3 four | DIMENSIONS is 'four', not an integer
SPACING 1 1 1 -> SPACING 1 -1 1 | spacing along y is not positive: --spacing SX,SY,SZ gives it
POINT_DATA -> CELL_DATA | has data of cells, not of points: convert it with python3 -c...
STRUCTURED_POINTS -> RECTILINEAR_GRID | holds a data set of kind 'rectilinear_grid', not STRUCTURED_POINTS: convert it with python3 -c "import vtk; r = vtk.vtkGenericDataObjectReader(); r.SetFileName('FILE'); f = vtk.vtkResampleToImage(); f.SetSamplingDimensions(NX, NY, NZ); f.SetInputConnection(r.GetOutputPort()); w = vtk.vtkXMLImageDataWriter(); w.SetInputConnection(f.GetOutputPort()); w.SetFileName('volume.vti'); w.Write...
SCALARS -> SCALES | keyword 'scales' is not supported
unsigned_char 1 -> unsigned_char 3 | array 'values' has 3 components per point: only scalar volumes can be meshed
unsigned_char -> bit | sample type 'bit' is not supported...
SCALARS -> VECTORS | array 'values' has 3 components per point: only scalar volumes can be meshed
LOOKUP_TABLE -> LOOKUP | has 'lookup' where 'lookup_table' is expected
first 100 | ends before the samples
[vti raw]
first 9999 | ok
"ImageData" -> "PolyData" | is a VTK file of type 'PolyData': only ImageData can be meshed
"Int16" -> "Int128" | sample type 'Int128' is not supported...
"values" -> "other" | ok
Extent="2 3 -1 1 0 3" -> Extent="2 3 -1 1" | WholeExtent is '2 3 -1 1', not six integers
</Piece> -> </Piece><Piece Extent="2 3 -1 1 4 6"> | has several pieces: convert it with python3 -c "import vtk; r = vtk.vtkXMLGenericDataObjectReader(); r.SetFileName('FILE'); f = r; w = vtk.vtkXMLImageDataWriter(); w.SetInputConnection(f.GetOutputPort()); w.SetFileName('volume.vti'); w.Write...
PointData -> CellData && PointData -> CellData | has data of cells, not of points: convert it with python3 -c "import vtk; r = vtk.vtkXMLGenericDataObjectReader(); r.SetFileName('FILE'); f = vtk.vtkCellDataToPointData(); f.Set...
type="ImageData" -> type="StructuredGrid" | is a VTK file of type 'StructuredGrid': convert it with python3 -c...
type="ImageData" -> type="PImageData" | lists pieces: convert it with python3 -c...
offset="4" -> offset="x" | attribute offset is 'x'
offset="4" -> offset="4000" | ends before its array at offset 4000
offset="4" -> offset="5" | ...2 x 3 x 4 int16 samples need 48 bytes, the array holds...
<AppendedData -> <Nothing | has no AppendedData
   _ ->    - | has no '_' before its appended data
encoding="raw" -> encoding="hex" | encoding 'hex' is not supported
format="appended" -> format="none" | a DataArray has format 'none': only ascii, binary and appended are supported
PointData -> Points | has no array of point data
Direction="1 0 0 -> Direction="1 0 30 | ...sheared grid...
[vti binary]
MAAA -> MQAA | 2 x 3 x 4 int16 samples need 48 bytes, the array holds 49
[vti blocks]
vtkZLibDataCompressor -> vtkLZ4DataCompressor | is compressed by 'vtkLZ4DataCompressor': convert it with python3 -c...
\x03\x00\x00\x00\x14\x00\x00\x00\x08 -> \x03\x00\x00\x00\x14\x00\x00\x00\x09 | ...3 blocks of 20 bytes and a rest of 9 do not give that...
\x03\x00\x00\x00\x14 -> \xff\xff\xff\xff\x14 | ends before 2 x 3 x 4 int16 samples
[mrc]
first 9999 | ok
but 1 | data is too short: 2 x 3 x 4 int16 samples need 48 bytes, found 47
+ x | data is too long: 2 x 3 x 4 int16 samples need 48 bytes, found 49
first 1023 | ends within its header
at 0: u4 0 | 0 samples along x: dimensions must be positive
at 4: u4 4294967295 | -1 samples along y: dimensions must be positive
at 12: u4 12 | MRC mode 12 is not supported (0, 1, 2 and 6 are): convert 16-bit floats with python3 -c...
at 12: u4 4294967295 | MRC mode -1 is not supported...
at 28: u4 0 | spacing along x is not positive: --spacing SX,SY,SZ gives it
at 28: u4 0 && at 40: f4 0 | spacing along x is not positive: --spacing SX,SY,SZ gives it
at 44: f4 nan | spacing along y is not positive: --spacing SX,SY,SZ gives it
at 64: u4 2 | sheared grid: its axes are too near to one plane (x and y enclose 0 degrees): resample it
at 68: u4 4 | axis 2 of it is 4, not X, Y or Z
at 68: u4 0 | axis 2 of it is 0, not X, Y or Z
at 60: f4 3 | sheared grid: its axes are too near to one plane...
at 52: f4 3 | sheared grid: its axes are too near to one plane...
at 92: u4 16 | data is too short: 2 x 3 x 4 int16 samples need 48 bytes, found 32
at 92: u4 4000 | has 1072 bytes, its samples begin at 5024
at 92: u4 4294967295 | has an extended header of -1 bytes
at 196: f4 nan | its origin is further than 1e+30 away: --origin X,Y,Z gives it
at 88: u4 401 && at 36: u4 2 | has 2 times: --time N chooses one, counted from 1
[inr]
first 9999 | ok
but 1 | data is too short: 2 x 3 x 4 int16 samples need 48 bytes, found 47
+ x | data is too long: 2 x 3 x 4 int16 samples need 48 bytes, found 49
##} -> ### | its header has no end, '##}'
XDIM=2 -> XDIM=-2 | -2 samples along x: dimensions must be positive
XDIM=2 -> XDIM=two | key 'XDIM' is 'two': not an integer
XDIM=2\n ->  | the header has no key 'XDIM'
VDIM=1 -> VDIM=3 | has 3 channels: --channel N chooses one, counted from 1
signed fixed -> packed | sample type 'packed16' is not supported...
signed fixed -> float | sample type 'float16' is not supported...
16 bits -> 12 bits | sample type 'int12' is not supported...
2**0 -> 2**-8 | key 'SCALE' is '2**-8': only 2**0 is supported
decm -> vax | key 'CPU' is 'vax': not decm, alpha, pc, sun or sgi
VY= -> VY=x | key 'VY' is 'x1': not 1 numbers
VY= -> VY=- | spacing along y is not positive: --spacing SX,SY,SZ gives it
TZ= -> TZ=nan\n | its origin is further than 1e+30 away: --origin X,Y,Z gives it
[npy]
first 9999 | ok
|u1 -> <f4 | ...need 32 bytes, found 8
|u1 -> <i8 | ...need 64 bytes, found 8
|u1 -> <f2 | ...'<f2' are not supported...
|u1 -> <c8 | ...'<c8' are not supported...
2, 2, 2 -> 2,    4 | ...of 2 dimensions...
2, 2, 2), }    -> 2, 2, 2, 2), } | ...of 4 dimensions...
2, 2, 2 -> 2, x, 2 | ...not of integers...
NUMPY\x01 -> NUMPY\x04 | ...version 4...
first 30 | ...ends in the header...
'shape' -> 'shade' | ...no key 'shape'...
[npy many]
1, 2, 2, 2), } -> 2, 2, 2), }    | ok
first 9999 | ...of 65 dimensions...
[ply]
first 9999 | ok
= | line 0: does not open with 'ply'
= plx\n | line 1: does not open with 'ply'
= ply\nelement vertex 0\n | line 2: the header has no end
= ply\nend_header\n | line 2: the header names no format
= ply\nformat binary_middle_endian 1.0\n | line 2: unknown format 'binary_middle_endian'
vertex 3 -> vertex many | line 3: the number of 'vertex' is 'many'
element vertex 3\n ->  | line 3: a property before the first element
property float x -> property half x | line 4: unknown type 'half'
property float x -> property list float int x | line 4: a list's length is no integer type
element vertex -> hello\nelement vertex | line 3: unknown header line 'hello'
= ply\nformat ascii 1.0\nend_header\n | line 3: there is no element 'vertex'
vertex 3 -> vertex 4294967295 && element face 1\nproperty list uchar int vertex_indices\n ->  | line 7: 4294967295 vertices are too many
3 0 1 2\n ->  | line 12: the file ends too early
1 0 0 -> 1 zero 0 | line 11: there is 'zero' in place of a number
3 0 1 2 -> 3 0 1 3 | line 13: corner 2 of facet 0 is 3, not one of 3 vertices
3 0 1 2 -> 3 0 1 -1 | line 13: corner 2 of facet 0 is -1, not one of 3 vertices
3 0 1 2 -> 3 0 1 1.5 | line 13: there is '1.5' in place of a number
3 0 1 2 -> 2 0 1 | line 13: facet 0 has 2 corners
3 0 1 2 -> -3 0 1 | line 13: a list of length -3
+ 4\n | line 14: something follows the last element
property float z\n ->  | line 8: vertices have no coordinate z
[off]
= OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n | ok
= | line 0: the file is empty
= \n# OFF\n | line 2: the file is empty
= 4OFF\n | line 1: opens with '4OFF' instead of OFF, COFF, NOFF or STOFF
= OFF BINARY\n | line 1: binary OFF is not supported
= OFF\n | line 1: the file ends before the counts
= OFF\n3 -1 0\n | line 2: the number of facets is '-1'
= OFF\n99999999999 1 0\n | line 2: 99999999999 vertices are too many
= OFF\n2 0 0\n0 0 0\n | line 3: the file ends after 1 of 2 vertices
= OFF\n1 0 0\n0 0\n | line 3: coordinate 2 of vertex 0 is ''
= OFF\n1 0 0\n0 1e999 0\n | line 3: coordinate 1 of vertex 0 is '1e999'
= OFF\n1 1 0\n0 0 0\n | line 3: the file ends after 0 of 1 facets
= OFF\n1 1 0\n0 0 0\n3 0 0 1\n | line 4: corner 2 of facet 0 is '1', not one of 1 vertices
= OFF\n1 1 0\n0 0 0\n2 0 0\n | line 4: facet 0 has 2 corners
= OFF\n0 0 0\n5\n | line 3: something follows the last of 0 facets
= OFF\n2 0 0\n1e30 -1e30 0\n4e-320 0 0\n | ok
[obj]
= | line 0: the file is empty
= \n \x0d\n | line 2: the file is empty
= v 0 0\n | line 1: coordinate 2 of vertex 1 is ''
= v 0 0 0\nf 1 1\n | line 2: a facet of 2 corners
= v 0 0 0\nf 1 1 0\n | line 2: a facet's corner is '0'
= v 0 0 0\nf 1 1 -2\n | line 2: corner '-2' lies before the first of 1 vertices
= f 1 2 3\nf 9 1 1\nf 4 1 1\nv 0 0 0\n | line 2: a facet names vertex 9 of 1
= f 1 1 9223372036854775807\n | line 1: a facet's corner is '9223372036854775807'
= v 0 0 0\nf 1 1 -9223372036854775808\n | line 2: corner '-9223372036854775808' lies before the first of 1 vertices
= f 1//1 1/2/ /3\n | line 1: a facet's corner is '/3'
= curv 0 1\n | line 1: unknown statement 'curv'
= \x7fELF\x01\x02xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx | line 1: unknown statement '?ELF??xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'
[vtp text]
first 9999 | ok
= | is no VTK XML file
PolyData -> ImageData | is a VTK file of type 'ImageData': only PolyData holds a mesh
</Piece> -> </Piece><Piece> | has several pieces: only one is supported
Strips="0" -> Strips="2" | has triangle strips, which are not supported
Points="5" -> Points="x" | attribute NumberOfPoints is 'x'
Points="5" -> Points="4294967295" | 4294967295 points are too many
Points="5" -> Points="6" | data is too short: the coordinates of 6 points need 18 numbers
Points="5" -> Points="4" | more than 12 numbers for the coordinates of 4 points
Polys="2" -> Polys="3" | data is too short: the offsets of 3 polygons need 3 numbers
\n4 7  -> \n4 6  | polygon 1 ends at corner 6, the one before at 4
\n4 7  -> \n4 -7  | polygon 1 ends at corner -7, the one before at 4
\n4 7  -> \n4 8  | data is too short: the corners of 2 polygons need 8 numbers
2 4 3  -> 2 5 3  | a corner of polygon 1 is 5, not one of 5 points
2 4 3  -> 2 four 3  | there is 'four' in place of a number
"offsets" NumberOfComponents="1" format="ascii">\n4 -> "onsets" NumberOfComponents="1" format="ascii">\n4 | has no array for the offsets of 2 polygons
</PolyData> ->  | ends before </PolyData>
[vtp raw]
NumberOfPoints="5" -> NumberOfPoints="6" | the coordinates of 6 points need 144 bytes, the array holds 120
type="Float64" Name="Points" -> type="String" Name="Points" | type 'String' of the coordinates of 5 points is not supported
<AppendedData -> <Nothing | has no AppendedData
but 60 | data is too short: the corners of 2 polygons need 56 bytes...
[glb]
first 9999 | ok
= | is no binary glTF
at 4: u4 1 | is not of glTF 2
first 900 | is cut short
\x00\x00\x01\x00\x02\x00\x00 -> \x08\x00\x01\x00\x02\x00\x00 | a triangle names vertex 8 of 8
[glb json]
"scene":0 -> "scene":7 | names number 7 of 1 scenes
"scene":0 -> "scene":-1 | scene is no whole number
"scene":0 -> "scene":0,"x":[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[ | its JSON is damaged at byte 175: it nests too deeply
"nodes":[1] -> "nodes":[1,1] | node 1 is below itself or two others
[0,2] -> [0,1] | node 1 is below itself or two others
[0,2] -> [0,3] | names number 3 of 3 nodes
[0,2] -> [0,"2"] | a node is no whole number
[2,2,2] -> [2,2] | a node has no 3 numbers in its scale
"count":8 -> "count":9 | accessor 0 reaches beyond the data
"count":8 -> "count":9007199254740991 | accessor 0 reaches beyond the data
"count":8 -> "count":1e300 | count is no whole number
"byteStride":24 -> "byteStride":4 | accessor 0 reaches beyond the data
"byteLength":192 -> "byteLength":999 | accessor 0 reaches beyond the data
"count":12 -> "count":12,"sparse":{} | accessor 2 is sparse, which is not supported
5123 -> 5122 | accessor 2: indices are no unsigned numbers
5123 -> 5121 | ok
5126 -> 5123 | accessor 0: positions are no floats
VEC3 -> VEC2 | accessor 0 is not of type VEC3
"mode":1 -> "mode":5 | has triangle strips or fans, which are not supported
"byteLength":216 -> "byteLength":216,"uri":"a.bin" | has data in another file, which is not supported
"scene":0 -> "scene":0,"extensionsRequired":["KHR_draco_mesh_compression"] | needs the extension 'KHR_draco_mesh_compression', which is not supported
"scene":0 -> "scene":0,"extensionsRequired":["KHR_materials_unlit"] | ok
"POSITION":0, ->  | POSITION is no whole number
[3mf model]
centimeter -> parsec | unit 'parsec' is not known
x="1" -> x="one" | attribute x of a vertex is 'one'
 z="1" ->  | attribute z of a vertex is ''
z="1" -> z="1e31" | coordinate z of vertex 3 is 9.999999999999999e+31, not a number up to 1e+30 in size
v3="3" -> v3="4" | corner v3 of a triangle is '4', not one of 4 vertices
v3="3" -> v3="-1" | corner v3 of a triangle is '-1', not one of 4 vertices
id="two" -> id="7" | has two objects of one id
objectid="two" -> objectid="3" | has no object '3'
objectid="7"/> -> objectid="two"/> | object 'two' is a component of itself
30"/> -> "/> | transform '-1 0 0 0 1 0 0 0 1 10 20 ' is not 12 numbers
<item  -> <item p:path="/a.model"  | has objects in further parts of the archive, which is not supported
</model> ->  | its model ends before </model>
[stl]
first 83 | is no STL file: it ends within the header
= | is no STL file: it ends within the header
first 200 | binary STL of 4 facets needs 200 bytes behind its header, found 116
+ x | binary STL of 4 facets needs 200 bytes behind its header, found 201
at 80: u4 4294967295 | 4294967295 facets are too many
at 80: u4 1342177279 | binary STL of 1342177279 facets needs...
at 96: f4 inf | coordinate x of vertex 0 is inf, not a number up to 1e+30 in size
[stl text]
facet -> face | line 2: there is 'face' in place of 'facet'
vertex -> vertax | line 4: there is 'vertax' in place of 'vertex'
vertex 0 -> vertex zero | line 4: there is 'zero' in place of a number
vertex 0 -> vertex 1e39 | coordinate x of vertex 0 is inf, not a number up to 1e+30 in size
endsolid made by hand ->  | line 30: the file ends before 'endsolid'
+ more | line 31: there is 'more' behind 'endsolid'
)";

std::map<std::string, std::string> sound_files() {
  const auto truth = [](SampleType type) { return random_truth(type, {2, 3, 4}, 1); };
  const auto vti_of = [&](const VtkForm& form) {
    return vti(truth(SampleType::i16), form)[0].content;
  };
  const TemporaryFolder folder;
  write_mesh(mesh_of(tetrahedron()), folder / "a.stl", {});
  NiftiForm pair;
  pair.pair = true;
  // As many axes as NumPy has and one more; half a million of them once took 11 s.
  std::string ones;
  for (int n = 0; n < 62; ++n) ones += "1, ";
  const auto [json, data] = rich_gltf();
  return {
      {"nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n\n" +
                   std::string(24, 'x')},
      {"nrrd ascii", "NRRD0004\ntype: uchar\ndimension: 3\nencoding: ascii\nsizes: 2 2 2\n\nx"},
      {"mha",
       metaimage(truth(SampleType::i16), std::endian::little, "raw", MetaForm::local)[0].content},
      {"nii", nifti(truth(SampleType::i16), {})[0].content},
      {"hdr", nifti(truth(SampleType::u8), pair)[0].content},
      {"vtk", vtk(truth(SampleType::u8), true, false)[0].content},
      {"vti raw", vti_of({})},
      {"vti binary", vti_of({"binary", "", std::endian::little, 4, 0})},
      {"vti blocks", vti_of({"appended", "raw", std::endian::little, 4, 20})},
      {"mrc", mrc(truth(SampleType::i16), std::endian::little)},
      {"inr", inr(truth(SampleType::i16), std::endian::little)},
      {"npy", npy("|u1", false, "2, 2, 2", std::string(8, 'x'))},
      {"npy many", npy("|u1", false, ones + "2, 2, 2", std::string(8, 'x'))},
      {"ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"off", ""},
      {"obj", ""},
      {"vtp text", vtp(kRichPoints, kRichPolygons, {.format = "ascii"}, true)},
      {"vtp raw", vtp(kRichPoints, kRichPolygons, {}, true)},
      {"glb", glb_file(json, data)},
      {"glb json", json},
      {"3mf model", rich_model()},
      {"stl", file_bytes(folder / "a.stl")},
      {"stl text", stl_text(mesh_of(tetrahedron()))}};
}

std::string with_bytes(std::string_view text_of) {
  std::string bytes;
  for (std::size_t at = 0; at < text_of.size(); ++at) {
    if (text_of[at] != '\\') {
      bytes += text_of[at];
    } else if (text_of[++at] == 'n') {
      bytes += '\n';
    } else {
      int code = 0;
      std::from_chars(&text_of[at + 1], &text_of[at + 1] + 2, code, 16);
      bytes += static_cast<char>(code);
      at += 2;
    }
  }
  return bytes;
}

// Cuts what is before `mark` from the front of `rest`.
std::string_view cut_before(std::string_view& rest, std::string_view mark) {
  const std::size_t at = std::min(rest.find(mark), rest.size());
  const std::string_view front = rest.substr(0, at);
  rest.remove_prefix(std::min(at + mark.size(), rest.size()));
  return front;
}

void replace_first(std::string& file, const std::string& old, const std::string& now) {
  const std::size_t at = file.find(old);
  REQUIRE(at != std::string::npos);
  file.replace(at, old.size(), now);
}

std::string edited(std::string file, std::string_view edit) {
  if (edit.starts_with("=")) return with_bytes(edit.substr(std::min<std::size_t>(2, edit.size())));
  if (edit.starts_with("+ ")) return file + with_bytes(edit.substr(2));
  if (edit.starts_with("but ")) {
    return file.substr(0, file.size() - static_cast<std::size_t>(*to_int(edit.substr(4))));
  }
  if (edit.starts_with("first ")) {
    return file.substr(0, static_cast<std::size_t>(*to_int(edit.substr(6))));
  }
  if (edit.starts_with("at ")) {
    edit.remove_prefix(3);
    const auto at = static_cast<std::size_t>(*to_int(cut_before(edit, ": ")));
    const std::string_view type = cut_before(edit, " ");
    const double value = *to_double(edit);
    const int size = type == "u2" ? 2 : 4;
    const auto bits = type == "f4" ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                                   : static_cast<std::uint32_t>(value);
    return file.replace(at, static_cast<std::size_t>(size), little(bits, size));
  }
  if (edit.starts_with("set ")) {
    edit.remove_prefix(4);
    const std::string field(cut_before(edit, ":"));
    const std::string line = edit.empty() ? "" : field + ":" + with_bytes(edit) + "\n";
    const std::size_t at = file.find("\n" + field + ": ") + 1;
    if (at == 0) return file.insert(file.find("\n\n") + 1, line);
    return file.replace(at, file.find('\n', at) + 1 - at, line);
  }
  const std::string old = with_bytes(cut_before(edit, " -> "));
  replace_first(file, old, with_bytes(edit));
  return file;
}

std::string all_edited(std::string file, std::string_view edits) {
  while (!edits.empty()) file = edited(file, cut_before(edits, " && "));
  return file;
}

// The message without the name of the file.
std::string fault_of_file(const TemporaryFolder& folder, const std::string& kind,
                          const std::string& content) {
  const bool is_mesh =
      std::string_view("ply off obj vtp stl glb 3mf").find(kind) != std::string_view::npos;
  const std::string name = is_mesh ? "'in'" : "v." + kind;
  try {
    if (is_mesh) {
      parse_mesh(content, mesh_format_of("in." + kind), "in");
    } else {
      read_volume(folder.write(name, content), {});
    }
  } catch (const InputError& error) {
    std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    const std::string path = folder.path("");
    for (std::size_t at; (at = message.find(path)) != std::string::npos;) {
      message.erase(at, path.size());
    }
    CHECK(message.starts_with(name));
    message.erase(0, name.size() + (message[name.size()] == ':' ? 2 : 1));
    return message;
  }
  return "ok";
}

bool says(std::string_view message, std::string_view wanted) {
  const bool open_end = wanted.ends_with("..."), open_start = wanted.starts_with("...");
  if (open_end) wanted.remove_suffix(3);
  if (open_start) wanted.remove_prefix(3);
  return open_start ? message.find(wanted) != std::string_view::npos
         : open_end ? message.starts_with(wanted)
                    : message == wanted;
}

}  // namespace

TEST_CASE("each fault of a file has its message") {
  const std::map<std::string, std::string> files = sound_files();
  const TemporaryFolder folder;
  std::string_view table = kTable;
  std::string base;
  int rows = 0;
  while (!table.empty()) {
    std::string_view row = cut_before(table, "\n");
    if (row.find(" | ") == std::string_view::npos) {
      base = row.substr(1, row.size() - 2);
      continue;
    }
    CAPTURE(base);
    CAPTURE(row);
    const std::string_view edit = cut_before(row, " | ");
    std::string file = all_edited(files.at(base), edit);
    if (base == "glb json") file = glb_file(file, rich_gltf().second);
    if (base == "3mf model") file = three_mf_file(file);
    const std::string message = fault_of_file(folder, base.substr(0, base.find(' ')), file);
    CHECK_MESSAGE(says(message, row), message);
    ++rows;
  }
  CHECK(rows > 250);
}
