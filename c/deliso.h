/* SPDX-License-Identifier: MIT */
/* DelIso for C, and for every language that calls C: an array in, the mesh of an isosurface out.
 *
 *   deliso_volume* volume = NULL;
 *   deliso_mesh* mesh = NULL;
 *   const size_t shape[3] = {64, 128, 128};
 *   const char* const options[] = {"max-distance=0.1vox", "largest=1", NULL};
 *   if (deliso_volume_create(samples, DELISO_UINT16, shape, DELISO_C_ORDER, NULL, &volume)
 *           != DELISO_OK ||
 *       deliso_mesh_create(volume, 40, options, NULL, &mesh) != DELISO_OK ||
 *       deliso_mesh_save(mesh, "mesh.ply") != DELISO_OK) {
 *     fprintf(stderr, "%s\n", deliso_last_error());
 *   }
 *   deliso_mesh_free(mesh);
 *   deliso_volume_free(volume);
 *
 * Lengths and coordinates are in the unit of the spacing. The mesh is the one that the program
 * `deliso` makes from the same array as a .npy file, to the byte.
 *
 * Errors: a function that can fail returns a status, and deliso_last_error() has one line about it.
 * No exception leaves the library. Where a function fails, what it should have made is unchanged.
 * Null, where nothing says that it is allowed, is DELISO_BAD_INPUT.
 *
 * Threads: calls in different threads do not disturb each other, on the same volume or mesh too. A
 * call itself works in as many threads as the option "threads" says. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): this is C, in C's style. */
#ifndef DELISO_C_DELISO_H
#define DELISO_C_DELISO_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define DELISO_API __attribute__((visibility("default")))
#else
#define DELISO_API
#endif

typedef enum deliso_status {
  DELISO_OK = 0,
  DELISO_FAULT = 1,     /* done, but the mesh has faults, which the report names */
  DELISO_BAD_INPUT = 2, /* the array, an option, a file */
  DELISO_CANCELED = 3,
  DELISO_FAILED = 4 /* memory, or an error of the library */
} deliso_status;

/* Types of samples, in the machine's byte order. */
typedef enum deliso_type {
  DELISO_UINT8,
  DELISO_INT8,
  DELISO_UINT16,
  DELISO_INT16,
  DELISO_UINT32,
  DELISO_INT32,
  DELISO_FLOAT32,
  DELISO_FLOAT64,
  DELISO_INT64, /* held as float64; if that is not exact, only the labels of these can be meshed */
  DELISO_UINT64
} deliso_type;

/* Which index runs fastest: the last one, or the first one. */
typedef enum deliso_order { DELISO_C_ORDER, DELISO_FORTRAN_ORDER } deliso_order;

typedef struct deliso_volume deliso_volume;
typedef struct deliso_mesh deliso_mesh;

/* How a call is watched and stopped. Every member may be null. */
typedef struct deliso_watch {
  /* Polled by the call, which returns DELISO_CANCELED soon after it is not 0. Any thread and any
   * signal handler may set it. */
  const volatile int* cancel;
  /* Called some ten times a second with the stage and the share of the whole that is done, in
   * [0, 1]. The calls come from any of the threads at work, never two at once. */
  void (*progress)(void* context, const char* stage, double share);
  void* context;
} deliso_watch;

/* Returns "0.1.0" or the like. */
DELISO_API const char* deliso_version(void);

/* Returns one line about the last call in this thread that did not return DELISO_OK. It is valid
 * until the next such call in this thread. */
DELISO_API const char* deliso_last_error(void);

/* Returns the notes and warnings of the last call in this thread that returned a status, as JSON:
 * an object with the list "diagnostics", which reports have, too. An item has a code, a severity
 * ("note" or "warning"), words, a file and values. A call that failed has none. The text is valid
 * until the next call of this function in this thread. */
DELISO_API const char* deliso_notes(void);

/* The place of an array in the world. A null pointer to one stands for spacing 1, 1, 1. */
typedef struct deliso_place {
  double spacing[3]; /* along x, y, z */
  double origin[3];  /* x, y, z of sample [0][0][0] */
  /* Row by row a matrix whose columns are the directions of x, y, z, at right angles; all 0 for the
   * world's own axes. */
  double direction[9];
  const char* space; /* "RAS", "LPS", or null: the world is no patient's */
  /* Of the samples along x, y, z, if their steps are not even: as many increasing numbers as
   * samples, in place of their indices times the spacing; else null. They are copied. */
  const double* coordinates[3];
} deliso_place;

/* Makes a volume of an array indexed [z][y][x], with shape[0] samples along z, shape[1] along y and
 * shape[2] along x. `type` is a deliso_type, `order` a deliso_order. The samples are borrowed: they
 * must stay as they are until the volume is freed. If they change during a call, it makes a wrong
 * mesh, or returns DELISO_FAILED. */
DELISO_API deliso_status deliso_volume_create(const void* samples, int type, const size_t shape[3],
                                              int order, const deliso_place* place,
                                              deliso_volume** volume);
/* Makes a volume of any input of the program: a file, a folder of slices, builtin:NAME. `options`
 * are those about reading, as "roi=0:64,0:64,0:64" or "array=NAME". A file must stay as it is until
 * the volume is freed. */
DELISO_API deliso_status deliso_volume_read(const char* path, const char* const* options,
                                            deliso_volume** volume);
DELISO_API void deliso_volume_free(deliso_volume* volume); /* null is allowed */

/* Meshes the surface on which the volume's interpolant has the isovalue. `options` are texts
 * "name=value", or "name" for switches, with a null after the last: those of the program's mesh
 * command without the two dashes. Options about files have no meaning here. `options` and `watch`
 * may be null. With the option "label=L" the isovalue is NaN, for none. After DELISO_OK and
 * DELISO_FAULT the caller owns the mesh; it does not need the volume. */
DELISO_API deliso_status deliso_mesh_create(const deliso_volume* volume, double isovalue,
                                            const char* const* options, const deliso_watch* watch,
                                            deliso_mesh** mesh);

/* Meshes each label of a segmentation but 0. `options` are those of deliso_mesh_create(), without
 * "label". Calls take() with each mesh, which the function then owns, and its status, DELISO_OK or
 * DELISO_FAULT. Returns DELISO_FAULT if one of them did. */
DELISO_API deliso_status deliso_mesh_labels(const deliso_volume* volume, const char* const* options,
                                            const deliso_watch* watch,
                                            void (*take)(void* context, int64_t label,
                                                         deliso_mesh* mesh, deliso_status status),
                                            void* context);

/* Meshes all labels of a segmentation as one mesh, in which neighbors have common vertices and
 * triangles, as the program does with --label all --shared. `options` are those of
 * deliso_mesh_labels(), without "check", "largest" and "min-component". The mesh has no normals. It
 * is no manifold where three labels meet; the mesh of each label is one. */
DELISO_API deliso_status deliso_mesh_shared(const deliso_volume* volume, const char* const* options,
                                            const deliso_watch* watch, deliso_mesh** mesh);

/* Returns two labels for each triangle of such a mesh: the one in front, from which its corners are
 * seen counterclockwise, and the one behind. With the option "cap" the triangles on the border of
 * the volume have in front -1 at the low end of x, -2 at the high end, -3, -4 of y, and -5, -6 of
 * z. Null, and a count of 0, of any other mesh. `count` may be null. */
DELISO_API const int64_t* deliso_mesh_sides(const deliso_mesh* mesh, size_t* count);

/* Makes the mesh of one label of such a mesh, counterclockwise seen from outside: its triangles,
 * and their vertices. It is empty if no triangle has the label. It has no normals or
 * report. */
DELISO_API deliso_status deliso_mesh_of_label(const deliso_mesh* shared, int64_t label,
                                              deliso_mesh** mesh);

/* Makes a mesh, to be checked or saved, from copies of x, y, z for each vertex and of three numbers
 * of vertices for each triangle. It has no normals or report. */
DELISO_API deliso_status deliso_mesh_import(const double* vertices, size_t vertex_count,
                                            const uint32_t* triangles, size_t triangle_count,
                                            deliso_mesh** mesh);
/* Makes the same of a file: .ply, .off, .obj, .stl, .vtp, .glb or .3mf, by the path's ending. */
DELISO_API deliso_status deliso_mesh_read(const char* path, deliso_mesh** mesh);
DELISO_API void deliso_mesh_free(deliso_mesh* mesh); /* null is allowed */

/* All that a mesh holds, so that a program can store it or send it to another process. A text may
 * be null, which stands for an empty one. An array without an entry may be null. */
typedef struct deliso_mesh_data {
  const double* vertices; /* the arrays and the report: as the functions below return them */
  size_t vertex_count;
  const uint32_t* triangles;
  size_t triangle_count;
  const double* normals; /* one for each vertex; null if the mesh has none */
  const char* report;
  const char* comment;  /* of the mesh's files: the criteria, which a check reads */
  const char* name;     /* of a label's segment */
  const char* space;    /* of the volume, as in deliso_place */
  size_t first_cap;     /* triangles from this one on are caps; SIZE_MAX without the option "cap" */
  int single_precision; /* 1 with the option "float", else 0 */
  const int64_t* sides; /* of deliso_mesh_sides(), two for each triangle; null if there are none */
  const char* names;    /* beside sides: lines "label name", of the segments that have a name */
  int32_t color;        /* of a label's segment: 0x1rrggbb, or 0 if it has none */
} deliso_mesh_data;

/* Fills in `data`. The mesh owns the arrays and texts. */
DELISO_API deliso_status deliso_mesh_get_data(const deliso_mesh* mesh, deliso_mesh_data* data);

/* Makes a mesh of copies of the data. It is saved with the same bytes as the mesh that the data was
 * taken from. */
DELISO_API deliso_status deliso_mesh_from_data(const deliso_mesh_data* data, deliso_mesh** mesh);

/* Arrays and texts of the mesh, which owns them. `count` may be null. A null mesh has no vertex,
 * triangle or normal, and its texts are empty.
 *   vertices   x, y, z of each
 *   triangles  three numbers of vertices each, counterclockwise seen from the smaller samples
 *   normals    a unit vector at each vertex, towards the smaller samples, against the gradient of
 *              the interpolant averaged over a voxel along each axis, on caps too; 0, 0, 0 where
 *              that is 0
 *   report     what the program writes with --json */
DELISO_API const double* deliso_mesh_vertices(const deliso_mesh* mesh, size_t* count);
DELISO_API const uint32_t* deliso_mesh_triangles(const deliso_mesh* mesh, size_t* count);
DELISO_API const double* deliso_mesh_normals(const deliso_mesh* mesh, size_t* count);
DELISO_API const char* deliso_mesh_report(const deliso_mesh* mesh);

/* Writes the mesh as .ply, .off, .obj, .stl, .vtp, .glb, .3mf, .smesh or .poly, by the path's
 * ending. The file appears whole or not at all. */
DELISO_API deliso_status deliso_mesh_save(const deliso_mesh* mesh, const char* path);
/* Writes the meshes of labels into one .glb, .3mf or .vtp, each with a color, and with the name of
 * its segment, else "label N". */
DELISO_API deliso_status deliso_labels_save(const deliso_mesh* const* meshes, const int64_t* labels,
                                            size_t count, const char* path);

/* Draws meshes side by side into a .png, with the options of the program's render command. */
DELISO_API deliso_status deliso_render(const deliso_mesh* const* meshes, size_t count,
                                       const char* const* options, const char* path);

/* Tells of a volume what the program's info command does. `isovalue` may be NaN, for none. After
 * DELISO_OK `json` is what that command writes with --json; the caller frees it. */
DELISO_API deliso_status deliso_info(const deliso_volume* volume, double isovalue,
                                     const char* const* options, const deliso_watch* watch,
                                     char** json);

/* Tells the same of any input of the program, with the options about reading, too. Of a file of
 * several channels or times it tells of the first, if no option chooses one; of a folder of several
 * series it lists these. */
DELISO_API deliso_status deliso_info_file(const char* path, double isovalue,
                                          const char* const* options, const deliso_watch* watch,
                                          char** json);

/* Compares a mesh with the exact surface, as the program's check command does, with the options of
 * that command. Returns DELISO_FAULT if it finds a fault. After DELISO_OK and DELISO_FAULT `json`
 * is what that command writes with --json; the caller frees it. `json` may be null. */
DELISO_API deliso_status deliso_check(const deliso_mesh* mesh, const deliso_volume* volume,
                                      double isovalue, const char* const* options,
                                      const deliso_watch* watch, char** json);
DELISO_API void deliso_text_free(char* text); /* null is allowed */

/* Fills a closed surface with tetrahedra, as the program's solid command does, with the options of
 * that command. The surface is a mesh that was made with the option "cap" or lies inside the
 * volume, or a mesh of all labels with "cap". Returns DELISO_FAULT if the solid has a fault, which
 * its report names. After DELISO_OK and DELISO_FAULT the caller owns the solid; it does not need
 * the mesh. */
typedef struct deliso_solid deliso_solid;
DELISO_API deliso_status deliso_solid_create(const deliso_mesh* surface, const char* const* options,
                                             const deliso_watch* watch, deliso_solid** solid);
DELISO_API void deliso_solid_free(deliso_solid* solid); /* null is allowed */

/* Arrays and texts of the solid, which owns them. `count` may be null. A null solid has none.
 *
 * - points: x, y, z of each: the surface's, then those where it was cut, then those inside
 * - cells: four numbers of points each: the first three run counterclockwise seen from the fourth
 * - regions: of each cell its label; 1 of a surface without labels
 * - walls: three numbers of points for each facet on the surface, counterclockwise seen from in
 *   front of the surface's triangle
 * - kinds: of each wall 1 at the low end of x, 2 at the high end, 3, 4 of y, 5, 6 of z; else 0
 * - report: what the program writes with --json */
DELISO_API const double* deliso_solid_points(const deliso_solid* solid, size_t* count);
DELISO_API const uint32_t* deliso_solid_cells(const deliso_solid* solid, size_t* count);
DELISO_API const int64_t* deliso_solid_regions(const deliso_solid* solid, size_t* count);
DELISO_API const uint32_t* deliso_solid_walls(const deliso_solid* solid, size_t* count);
DELISO_API const uint32_t* deliso_solid_kinds(const deliso_solid* solid, size_t* count);
DELISO_API const char* deliso_solid_report(const deliso_solid* solid);
/* Writes the solid as .vtu, .msh, .mesh, or .node, .ele and .face, by the path's ending. */
DELISO_API deliso_status deliso_solid_save(const deliso_solid* solid, const char* path);

/* An array that is read box by box, so that no process needs all of it: of a file of chunks, or of
 * another machine. The samples are those of deliso_volume_create() in C order. */
typedef struct deliso_source {
  int type;                  /* a deliso_type */
  size_t shape[3];           /* along z, y, x */
  const deliso_place* place; /* may be null */
  /* Writes the samples [begin[0], end[0]) x [begin[1], end[1]) x [begin[2], end[2]), along z, y, x,
   * into `samples`, the last index fastest and nothing between, all of the type above. Returns 0;
   * anything else is DELISO_BAD_INPUT. The calls come from any thread, never two at once for one
   * call of a function below. A box may be read more than once, and must then be the same. */
  int (*read)(void* context, const size_t begin[3], const size_t end[3], void* samples);
  void* context;
} deliso_source;

/* Meshes part `number` of `parts`, counted from 1: the N-th of M contiguous runs of blocks. Reads
 * their samples and some around them; all of them with the options "label", "largest" and
 * "min-component". The options are those of deliso_mesh_create(), but for those about the whole
 * mesh. All parts of a mesh have the same options. After DELISO_OK the bytes are the part, which a
 * file or a message may take to another process of the same version; the caller frees them with
 * deliso_text_free(). */
DELISO_API deliso_status deliso_part_create(const deliso_source* source, double isovalue,
                                            int number, int parts, const char* const* options,
                                            const deliso_watch* watch, char** bytes, size_t* size);

/* Joins all parts of a mesh, in any order. The mesh is the one that deliso_mesh_create() makes of
 * the whole array, and is saved with the same bytes. Its report is that of the program's join
 * command. The options are "threads", "float", "double", "check" and "allow-empty"; all others are
 * those of the parts. Reads the samples around the seams between parts, and around the vertices for
 * their normals; all of them with "check", and if the parts have "cap" or "label". */
DELISO_API deliso_status deliso_join(const char* const* parts, const size_t* sizes, size_t count,
                                     const deliso_source* source, const char* const* options,
                                     const deliso_watch* watch, deliso_mesh** mesh);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
