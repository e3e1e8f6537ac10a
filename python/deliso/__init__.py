# SPDX-License-Identifier: MIT
"""Delaunay meshes of isosurfaces of NumPy arrays and of files.

    import deliso
    m = deliso.mesh(array, 40, spacing=(1, 1, 2.5), max_distance="0.1vox")
    m.vertices, m.triangles, m.normals, m.report
    m.save("mesh.ply")
    m = deliso.mesh("scan.nii.gz", 40)

An array is indexed [z, y, x], as scikit-image and SimpleITK have it. Everything with three columns
or three numbers, the vertices, `spacing` and `origin`, is in the order x, y, z. The mesh is the one
that the program `deliso` makes of the array saved by numpy.save, or of the file, to the byte.
deliso.mesh_blocks makes it of arrays beyond the memory, by other processes too. deliso.solid fills a
closed mesh with tetrahedra.
"""

from __future__ import annotations

import contextlib
import ctypes
import inspect
import json
import math
import operator
import os
import pathlib
import sys
import threading
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, Optional, Sequence, Tuple, Union

import numpy

from . import _options as _named

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import CheckOptions, InfoOptions, MeshOptions, RenderOptions

__all__ = ["Error", "Labels", "Mesh", "SharedLabels", "Warning", "check", "info", "join", "mesh", "mesh_blocks", "part"]
__all__ += ["read", "render", "Solid", "solid", "version"]

# An array, or what the program reads: a file, a folder of slices, builtin:NAME.
Source = Union[numpy.ndarray, str, os.PathLike]
Three = Optional[Sequence[Union[float, Sequence[float]]]]
Progress = Union[bool, Callable[[str, float], Any]]


class Error(Exception):
    """Bad input, or a file that cannot be written: one line that says what is wrong."""


class Warning(UserWarning):
    """A warning of the library: the result may not be the one wanted.

    code    names its kind: docs/glossary.md has the list
    file    that it is about, or an empty text
    values  numbers of the words, by name

    A report has the warnings too, beside the notes, as report["diagnostics"].
    """

    def __init__(self, words="", code="", file="", values=()):
        super().__init__(f"{file}: {words}" if file else words)
        self.code, self.file, self.values = code, file, dict(values)


@contextlib.contextmanager
def _required(what):
    """Makes an Error of what Python and NumPy raise of an argument that is not as it must be."""
    try:
        yield
    except (TypeError, ValueError, OverflowError, AttributeError, OSError) as error:
        raise Error(f"{what}: {' '.join(str(error).split())}") from None


_OK, _FAULT, _BAD_INPUT, _CANCELED, _FAILED = range(5)
_TYPES = {"u1": 0, "i1": 1, "u2": 2, "i2": 3, "u4": 4, "i4": 5, "f4": 6, "f8": 7, "i8": 8, "u8": 9}
# What the library has no type for, and the type that takes its place.
_CONVERTED = {"b1": "u1", "f2": "f4"}
_PROGRESS = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_double)
_TAKE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int)


# Of a solid: the type and the columns of each array.
_SOLID_ARRAYS = {
    "points": (ctypes.c_double, 3),
    "cells": (ctypes.c_uint32, 4),
    "regions": (ctypes.c_int64, 1),
    "walls": (ctypes.c_uint32, 3),
    "kinds": (ctypes.c_uint32, 1),
}


class _Watch(ctypes.Structure):
    _fields_ = [
        ("cancel", ctypes.POINTER(ctypes.c_int)),
        ("progress", _PROGRESS),
        ("context", ctypes.c_void_p),
    ]


class _Place(ctypes.Structure):
    _fields_ = [
        ("spacing", ctypes.c_double * 3),
        ("origin", ctypes.c_double * 3),
        ("direction", ctypes.c_double * 9),
        ("space", ctypes.c_char_p),
        ("coordinates", ctypes.POINTER(ctypes.c_double) * 3),
    ]


class _MeshData(ctypes.Structure):
    _fields_ = [
        ("vertices", ctypes.c_void_p),
        ("vertex_count", ctypes.c_size_t),
        ("triangles", ctypes.c_void_p),
        ("triangle_count", ctypes.c_size_t),
        ("normals", ctypes.c_void_p),
        ("report", ctypes.c_char_p),
        ("comment", ctypes.c_char_p),
        ("name", ctypes.c_char_p),
        ("space", ctypes.c_char_p),
        ("first_cap", ctypes.c_ssize_t),  # -1, the largest size_t, without caps
        ("single_precision", ctypes.c_int),
        ("sides", ctypes.c_void_p),
        ("names", ctypes.c_char_p),
        ("color", ctypes.c_int32),
    ]


def _load():
    here = pathlib.Path(__file__).parent
    # In a wheel the library is beside this file; `make install` puts it two folders up.
    places = [os.environ.get("DELISO_LIBRARY")]
    places += [str(p) for up in (here, here.parent.parent) for p in up.glob("libdeliso_c.*")]
    for place in filter(None, places):
        library = ctypes.CDLL(place)
        break
    else:
        raise ImportError(f"libdeliso_c is not beside {here}, nor named by DELISO_LIBRARY")
    pointer, text = ctypes.c_void_p, ctypes.c_char_p
    for name, result, *arguments in [
        ("version", text),
        ("last_error", text),
        ("notes", text),
        ("volume_create", int, pointer, int, pointer, int, pointer, pointer),
        ("volume_read", int, text, pointer, pointer),
        ("volume_free", None, pointer),
        ("mesh_create", int, pointer, ctypes.c_double, pointer, pointer, pointer),
        ("mesh_labels", int, pointer, pointer, pointer, _TAKE, pointer),
        ("mesh_shared", int, pointer, pointer, pointer, pointer),
        ("mesh_of_label", int, pointer, ctypes.c_int64, pointer),
        ("mesh_from_data", int, pointer, pointer),
        ("mesh_read", int, text, pointer),
        ("mesh_get_data", int, pointer, pointer),
        ("mesh_free", None, pointer),
        ("mesh_save", int, pointer, text),
        ("labels_save", int, pointer, pointer, ctypes.c_size_t, text),
        ("render", int, pointer, ctypes.c_size_t, pointer, text),
        ("info", int, pointer, ctypes.c_double, pointer, pointer, pointer),
        ("info_file", int, text, ctypes.c_double, pointer, pointer, pointer),
        ("check", int, pointer, pointer, ctypes.c_double, pointer, pointer, pointer),
        ("text_free", None, pointer),
        ("solid_create", int, pointer, pointer, pointer, pointer),
        ("solid_free", None, pointer),
        *(("solid_" + name, pointer, pointer, pointer) for name in _SOLID_ARRAYS),
        ("solid_report", text, pointer),
        ("solid_save", int, pointer, text),
        ("part_create", int, pointer, ctypes.c_double, int, int) + (pointer,) * 4,
        ("join", int, pointer, pointer, ctypes.c_size_t) + (pointer,) * 4,
    ]:
        function = getattr(library, "deliso_" + name)
        function.restype = ctypes.c_int if result is int else result
        function.argtypes = [ctypes.c_int if a is int else a for a in arguments]
    return library


_library = _load()
version = __version__ = _library.deliso_version().decode()


def _ok(status):
    """Raises the library's error of this thread, unless the status tells of none."""
    if status in (_OK, _FAULT):
        return status
    message = _library.deliso_last_error().decode(errors="replace")
    raise Error(message) if status == _BAD_INPUT else RuntimeError(message)


def _warn_of(notes):
    """Warns of what a call of the library warned of, where the package was called."""
    frame, level = sys._getframe(), 1
    while frame.f_back and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    for note in json.loads(notes)["diagnostics"]:
        if note["severity"] == "warning":
            words = {name: note[name] for name in ("words", "code", "file", "values")}
            warnings.warn(Warning(**words), stacklevel=level)


def _text_of(value):
    if isinstance(value, (tuple, list)):
        return ",".join(_text_of(v) for v in value)
    # item() makes a Python number of NumPy's, whose text may name its type.
    return str(value.item() if isinstance(value, numpy.generic) else value)


def _with_options(kind):
    """Puts the named options into a function's signature, in place of **options."""

    def named(function):
        signature = inspect.signature(function)
        parameters = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        parameters += [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=kind_of)
            for name, kind_of in kind.__annotations__.items()
            if name not in signature.parameters
        ]
        function.__signature__ = signature.replace(parameters=parameters)
        return function

    return named


def _options(options):
    """The options as the library has them: max_distance=0.1 is "max-distance=0.1"."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        word = name.rstrip("_").replace("_", "-")
        with _required(f"option {name!r}"):
            words.append((word if value is True else word + "=" + _text_of(value)).encode())
    if any(b"\0" in word for word in words):
        raise Error("an option has a zero byte")
    return (ctypes.c_char_p * (len(words) + 1))(*words, None)


class _Handle(ctypes.c_void_p):
    """Owns an object of the library. A copy would free it a second time: there is none."""

    def __del__(self):
        if self:
            self._free(self)

    def __reduce__(self):
        raise TypeError(f"a {type(self).__name__} cannot be copied")


class _VolumeHandle(_Handle):
    _free = _library.deliso_volume_free


class _MeshHandle(_Handle):
    _free = _library.deliso_mesh_free


class _Volume:
    """The library's view of an array, which this keeps alive, or of a file."""

    def __init__(self, source, spacing, origin, direction, space, options):
        """Takes the options about reading out of `options`."""
        self.handle = _VolumeHandle()
        if isinstance(source, (str, os.PathLike)):
            _refuse_direction(direction)
            of_file = {name: options.pop(name) for name in _named.OF_FILES if name in options}
            if options.get("label") != "all":
                of_file["label"] = options.get("label")  # a segment tells its channel
            words = _options({**of_file, "spacing": spacing, "origin": origin, "space": space})
            path, to = _path(source), ctypes.byref(self.handle)
            # Reading has no watch: after Ctrl-C it goes on, and what it has read is dropped.
            # What it tells is told again by the call that the volume is for.
            _watched(
                lambda _: _ok(_library.deliso_volume_read(path, words, to)),
                False,
                joins=False,
                warns=False,
            )
            return
        array = _unmasked(source)
        kind = _kind_of(array.dtype)
        ones = [n for n in reversed(range(array.ndim)) if array.shape[n] == 1]
        array = array.squeeze(tuple(ones[: max(0, array.ndim - 3)]))
        _require_three(array.shape)
        # As numpy.save has it: in Fortran order if that is the array's only one.
        fortran = array.flags.f_contiguous and not array.flags.c_contiguous
        self.array = numpy.require(array, "=" + kind, ["F" if fortran else "C", "A"])
        _ok(
            _library.deliso_volume_create(
                self.array.ctypes.data,
                _TYPES[kind],
                (ctypes.c_size_t * 3)(*array.shape),
                int(fortran),
                ctypes.byref(_place(array.shape, spacing, origin, direction, space)),
                ctypes.byref(self.handle),
            )
        )


def _refuse_direction(direction):
    if direction is not None:
        raise Error("direction has no meaning for a file: it has its own")


def _unmasked(array):
    if numpy.ma.is_masked(array):
        raise Error("has masked samples: array.filled(value) gives them a value")
    with _required("no array"):
        return numpy.asarray(array)


def _place(shape, spacing, origin, direction, space):
    with _required("space"):
        place = _Place(space=space and str(space).encode())
    place.spacing[:] = _numbers("spacing", _even_steps(shape, spacing, place), (1, 1, 1))
    place.origin[:] = _numbers("origin", origin, (0, 0, 0))
    # All 0 stand for the axes of the world.
    place.direction[:] = _numbers("direction", direction, numpy.zeros((3, 3)))
    return place


def _even_steps(shape, spacing, place):
    """The spacing with 1 for the axes that have coordinates, which `place` gets."""
    if not isinstance(spacing, (list, tuple)) or len(spacing) != 3:
        return spacing
    steps, place.kept = list(spacing), []
    for n in range(3):
        if not isinstance(steps[n], (list, tuple, numpy.ndarray)):
            continue
        with _required("spacing"):
            at = numpy.array(steps[n], float)
        if at.shape != (shape[2 - n],):
            along = f"coordinates along {'xyz'[n]}, for {shape[2 - n]} samples"
            raise Error(f"spacing has {at.size} {along}")
        place.kept.append(at)
        place.coordinates[n] = at.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        steps[n] = 1
    return steps


def _kind_of(dtype):
    kind = dtype.kind + str(dtype.itemsize)
    kind = _CONVERTED.get(kind, kind)
    if kind not in _TYPES:
        raise Error(f"samples of type {dtype} are not supported: use astype('float32')")
    return kind


def _require_three(shape):
    if len(shape) != 3:
        raise Error(
            f"an array of {len(shape)} dimensions: only three-dimensional ones can be meshed"
        )


def _numbers(name, numbers, default):
    try:
        flat = numpy.asarray(default if numbers is None else numbers, float).ravel()
    except (TypeError, ValueError, OverflowError):
        flat = numpy.empty(0)
    if flat.size != numpy.size(default):
        raise Error(f"{name} wants {numpy.size(default)} numbers, in the order x, y, z")
    return flat.tolist()


def _whole(name, number):
    """The number as an int of C."""
    with _required(name):
        whole = operator.index(number)
    if not 1 <= whole < 1 << 31:
        raise Error(f"{name} is {whole}, and must be from 1 to {(1 << 31) - 1}")
    return whole


def _path(path):
    with _required("a path"):
        name = os.fsencode(path)
    if b"\0" in name:
        raise Error("a path has a zero byte")
    return name


def _bar(stage, share):
    sys.stderr.write("\r\033[K" + ("" if share == 1 else f"meshing {share:4.0%}  {stage}"))
    sys.stderr.flush()


def _watched(call, progress, joins=True, warns=True):
    """Returns call(watch), run so that Ctrl-C and a progress function that raises stop it. Without
    `joins` they leave it behind. Warns of what the call warned of.

    Python handles signals in the main thread between two of its instructions. So the main thread
    waits, and another one is in the library; the progress function runs in the waiting one.
    """
    show = _bar if progress is True else progress or (lambda stage, share: None)
    cancel = ctypes.c_int(0)
    latest, news, result = [], threading.Semaphore(0), []

    def note(_context, stage, share):
        latest[:] = [(stage.decode(), share)]
        news.release()

    def work():
        try:
            watch = _Watch(ctypes.pointer(cancel), _PROGRESS(note if progress else 0), None)
            value = call(ctypes.byref(watch))
            result.append((value, _library.deliso_notes(), None))
        except BaseException as error:
            result.append((None, None, error))
        finally:
            news.release()

    worker = threading.Thread(target=work, name="deliso", daemon=not joins)
    try:
        worker.start()
        while not result:
            news.acquire()
            if latest:
                show(*latest[0])
        if progress:
            show("done", 1.0)
    finally:
        cancel.value = 1
        if joins and worker.ident is not None:
            worker.join()
    value, notes, error = result[0]
    if error:
        raise error
    if warns:
        _warn_of(notes)
    return value


def _made(kind, handle, call, progress):
    """Returns what call(watch, to) makes, which the handle then owns, as a Mesh or another kind."""
    to = ctypes.byref(handle)
    status = _watched(lambda watch: _ok(call(watch, to)), progress)
    return kind(handle, status == _OK)


def _view_of(handle, address, count, kind, columns):
    """A read-only array over the library's memory, which the handle owns."""
    view = numpy.empty((0, columns), kind)
    if address and count:
        memory = (kind * (columns * count)).from_address(address)
        memory.owner = handle
        view = numpy.frombuffer(memory, kind).reshape(-1, columns)
    view.flags.writeable = False
    return view


class Mesh:
    """A mesh: vertices, triangles, and the report of its making.

    vertices   float64, (n, 3): x, y, z in the unit of the spacing
    triangles  uint32, (m, 3): counterclockwise seen from the smaller samples
    normals    float64, (n, 3): unit vectors outwards, along the volume's gradient
    report     what the program writes with --json, as a dict
    sound      False if the mesh breaks a rule or a check that was asked for (exit status 1)

    Arrays are read-only views of the library's memory, which they keep. A Mesh can be copied,
    pickled, and returned by another process; it is saved with the same bytes there.
    """

    vertices: numpy.ndarray
    triangles: numpy.ndarray
    normals: numpy.ndarray
    report: Dict[str, Any]
    sound: bool

    def __init__(self, handle, sound=True):
        self._handle = handle
        self._data = _MeshData()
        _ok(_library.deliso_mesh_get_data(handle, ctypes.byref(self._data)))
        self.sound = sound
        self.vertices, self.triangles, self.normals = self._views()
        self.report = json.loads(self._data.report or "{}")

    def _views(self):
        data = self._data
        vertices = self._view(data.vertices, data.vertex_count, ctypes.c_double)
        triangles = self._view(data.triangles, data.triangle_count, ctypes.c_uint32)
        normals = self._view(data.normals, data.vertex_count, ctypes.c_double)
        return vertices, triangles, normals

    def _view(self, address, count, kind, columns=3):
        return _view_of(self._handle, address, count, kind, columns)

    def __copy__(self):
        other = object.__new__(type(self))
        vars(other).update(vars(self))
        return other

    def __reduce__(self):
        others = ("report", "comment", "name", "names", "space", "first_cap")
        others += ("single_precision", "color")
        remade = ("_handle", "_data", "vertices", "triangles", "normals")
        state = {name: value for name, value in vars(self).items() if name not in remade}
        return _from_data, (self._views(), {n: getattr(self._data, n) for n in others}), state

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes any of the program's formats, by the path's ending, whole or not at all: .ply,
        .off, .obj, .stl, .vtp, .glb, .3mf, .smesh, .poly."""
        _ok(_library.deliso_mesh_save(self._handle, _path(path)))
        _warn_of(_library.deliso_notes())

    def to_meshio(self):
        """Returns a meshio.Mesh."""
        import meshio

        data = {"Normals": self.normals.copy()} if len(self.normals) else {}
        cells = [("triangle", self.triangles.astype("i8"))]
        return meshio.Mesh(self.vertices.copy(), cells, point_data=data)

    def to_pyvista(self):
        """Returns a pyvista.PolyData."""
        import pyvista

        threes = numpy.full((len(self.triangles), 1), 3)
        mesh = pyvista.PolyData(self.vertices.copy(), numpy.hstack([threes, self.triangles]).ravel())
        if len(self.normals):
            mesh.point_data["Normals"] = self.normals.copy()
        return mesh

    def to_trimesh(self):
        """Returns a trimesh.Trimesh, with these vertices in this order."""
        import trimesh

        normals = self.normals.copy() if len(self.normals) else None
        return trimesh.Trimesh(
            self.vertices.copy(), self.triangles.astype("i8"), vertex_normals=normals, process=False
        )

    def __repr__(self):
        return f"<deliso.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles>"


def _level(isovalue):
    with _required("isovalue"):
        return math.nan if isovalue is None else float(isovalue)


class SharedLabels(Mesh):
    """All labels of a segmentation as one mesh: neighbors have common vertices and triangles.

    vertices, triangles  as of a Mesh; it is no manifold where three labels meet
    labels     int64, (m, 2): the label in front of each triangle, from which its corners run
               counterclockwise, and the label behind. With cap=True the triangles on the border of
               the volume have in front -1 at the low end of x, -2 at the high end, -3, -4 of y, and
               -5, -6 of z.
    topology   by label: components, Euler number and boundary loops of its mesh, as a dict
    report     what the program writes with --label all --shared and --json, as a dict

    shared[7] is the mesh of label 7, keys() are the labels but 0. So deliso.Labels(shared) are all
    of these meshes, and deliso.Labels(shared).save("organs.glb") writes them with their colors.
    """

    labels: numpy.ndarray
    topology: Dict[int, Dict[str, int]]

    def __init__(self, handle, sound=True):
        super().__init__(handle, sound)
        data = self._data
        self.labels = self._view(data.sides, data.triangle_count, ctypes.c_int64, 2)
        told = self.report.get("labels", [])
        self.topology = {label["label"]: label["topology"] for label in told}

    def __reduce__(self):
        make, arguments, state = super().__reduce__()
        return make, (*arguments, SharedLabels, state.pop("labels")), state

    def keys(self):
        """The labels but 0, ascending."""
        return [label for label in self.topology if label != 0]

    def mesh(self, label: int) -> Mesh:
        """Returns the mesh of a label, without normals and report. It is closed with cap=True, and
        else where the label is not at the border of the volume."""
        if label not in self.topology:
            raise KeyError(label)
        handle = _MeshHandle()
        _ok(_library.deliso_mesh_of_label(self._handle, label, ctypes.byref(handle)))
        return Mesh(handle)

    def __getitem__(self, label: int) -> Mesh:
        return self.mesh(label)

    def __repr__(self):
        return f"<deliso.SharedLabels: {len(self.keys())} labels, {len(self.triangles)} triangles>"


class Labels(Dict[int, Mesh]):
    """The meshes of the labels of a segmentation, by label."""

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes one .glb, .3mf or .vtp, in which each label has its name and color."""
        handles = (ctypes.c_void_p * len(self))(*(m._handle.value for m in self.values()))
        labels = (ctypes.c_int64 * len(self))(*self)
        _ok(_library.deliso_labels_save(handles, labels, len(self), _path(path)))


@_with_options(_named.MeshOptions)
def mesh(
    source: Source,
    isovalue: Optional[float] = None,
    *,
    spacing: Three = None,
    origin: Three = None,
    direction: Optional[Sequence] = None,
    space: Optional[str] = None,
    shared: bool = False,
    progress: Progress = False,
    **options: Unpack[MeshOptions],
) -> Union[Mesh, Labels, SharedLabels]:
    """Meshes the surface on which the interpolated samples are `isovalue`. Returns a Mesh.

    source     an array: three-dimensional, indexed [z, y, x], of numbers or bools; 64-bit integers
               become float64. Or the name of a file, of a folder of slices, or builtin:NAME. An
               array or a file that another thread or process changes during the call gives a
               wrong mesh, or RuntimeError ("internal error").
    isovalue   left out with label=1 or label="1,4", which meshes labels of a segmentation. With
               label="all" the meshes of all labels but 0 are returned, as Labels.
    spacing    distance between samples along x, y, z; in place of one of them, the coordinates of
               all samples along that axis, if their steps are not even
    origin     place of array[0, 0, 0]: x, y, z
    direction  matrix whose columns are the directions of x, y, z, as 3 x 3 or 9 numbers: that of
               SimpleITK's GetDirection()
    space      "RAS" or "LPS" (SimpleITK's): which way x, y, z run in a patient; the mesh of a file
               is turned to it
    shared     with label="all": the labels are one mesh, as SharedLabels
    progress   True draws a line on standard error; a function is called with (stage, share)
    options    those of the program's mesh command (deliso mesh --help): max_distance="0.1vox",
               largest=1, cap=True; True stands for an option without a value, lambda_ for lambda

    Raises Error for bad input, RuntimeError when there is not enough memory. Ctrl-C stops the work.
    """
    volume = _Volume(source, spacing, origin, direction, space, options)
    if options.get("label") == "all" and isovalue is None:
        return (_shared_labels if shared else _meshes_of_labels)(volume, options, progress)
    if shared:
        raise Error('shared=True is for label="all"')
    given = volume.handle, _level(isovalue), _options(options)
    create = _library.deliso_mesh_create
    return _made(Mesh, _MeshHandle(), lambda watch, to: create(*given, watch, to), progress)


def _options_of_all(options):
    return _options({name: value for name, value in options.items() if name != "label"})


def _shared_labels(volume, options, progress):
    given = volume.handle, _options_of_all(options)
    create = _library.deliso_mesh_shared
    return _made(SharedLabels, _MeshHandle(), lambda watch, to: create(*given, watch, to), progress)


def _meshes_of_labels(volume, options, progress):
    words = _options_of_all(options)
    made = []
    take = _TAKE(lambda _, label, mesh, status: made.append((label, _MeshHandle(mesh), status)))
    _watched(
        lambda watch: _ok(_library.deliso_mesh_labels(volume.handle, words, watch, take, None)),
        progress,
    )
    return Labels((label, Mesh(mesh, status == _OK)) for label, mesh, status in made)


def _json_of(call, progress, joins=True):
    """Returns the JSON of call(watch, text)."""
    text = ctypes.c_void_p()
    _watched(lambda watch: _ok(call(watch, ctypes.byref(text))), progress, joins)
    try:
        return json.loads(ctypes.string_at(text))
    finally:
        _library.deliso_text_free(text)


@_with_options(_named.CheckOptions)
def check(
    mesh: Union[Mesh, Tuple[Any, Any], str, os.PathLike],
    source: Source,
    isovalue: Optional[float] = None,
    *,
    spacing: Three = None,
    origin: Three = None,
    direction: Optional[Sequence] = None,
    space: Optional[str] = None,
    progress: Progress = False,
    **options: Unpack[CheckOptions],
) -> Dict[str, Any]:
    """Compares a mesh with the exact surface. Returns the program's report (--json) as a dict.

    `mesh` is a Mesh, a file, or (vertices, triangles) of another program. Its faults are in the
    report. The source is that of mesh(), the options are those of the program's check command.
    """
    mesh = _mesh_of(mesh)
    volume = _Volume(source, spacing, origin, direction, space, options)
    words = _options(options)
    given = mesh._handle, volume.handle, _level(isovalue), words
    return _json_of(lambda watch, text: _library.deliso_check(*given, watch, text), progress)


@_with_options(_named.InfoOptions)
def info(
    source: Source,
    isovalue: Optional[float] = None,
    *,
    spacing: Three = None,
    origin: Three = None,
    direction: Optional[Sequence] = None,
    space: Optional[str] = None,
    progress: Progress = False,
    **options: Unpack[InfoOptions],
) -> Dict[str, Any]:
    """Tells what is in an array or a file, which isovalues to try ("suggestions"), and with an
    isovalue the topology of its surface: what the program's info command writes with --json. Of a
    file of several channels or times it tells of the first, unless an option chooses one. Of a
    folder of several series it lists these ("series")."""
    if isinstance(source, (str, os.PathLike)):
        _refuse_direction(direction)
        options = {**options, "spacing": spacing, "origin": origin, "space": space}
        given = _path(source), _level(isovalue), _options(options)
        call = _library.deliso_info_file
        return _json_of(lambda watch, text: call(*given, watch, text), progress, joins=False)
    volume = _Volume(source, spacing, origin, direction, space, options)
    given = volume.handle, _level(isovalue), _options(options)
    return _json_of(lambda watch, text: _library.deliso_info(*given, watch, text), progress)


def read(path: Union[str, os.PathLike]) -> Mesh:
    """Reads the mesh in a .ply, .off, .obj, .stl, .vtp, .glb or .3mf. It has no report."""
    handle = _MeshHandle()
    _ok(_library.deliso_mesh_read(_path(path), ctypes.byref(handle)))
    return Mesh(handle)


@_with_options(_named.RenderOptions)
def render(
    meshes: Any, path: Union[str, os.PathLike], **options: Unpack[RenderOptions]
) -> None:
    """Draws a mesh, or a list of meshes side by side, into a .png.

    A mesh is a Mesh, a file, or (vertices, triangles). The options are those of the program's
    render command: size="800x600", color_by="component".
    """
    drawn = meshes if isinstance(meshes, list) else [meshes]
    drawn = [_mesh_of(mesh) for mesh in drawn]
    handles = (ctypes.c_void_p * len(drawn))(*(mesh._handle.value for mesh in drawn))
    words, to = _options(options), _path(path)
    _watched(lambda _: _ok(_library.deliso_render(handles, len(drawn), words, to)), False)


def _mesh_of(mesh):
    if isinstance(mesh, Mesh):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        return read(mesh)
    with _required("a mesh is a Mesh, a file, or (vertices, triangles)"):
        vertices, triangles = mesh
        numbers = numpy.asarray(triangles)
        with numpy.errstate(invalid="ignore"):  # of numbers that are none of uint32
            is_whole = not (numbers != numbers.astype("u4")).any()
    if not is_whole:
        raise Error("a triangle has three numbers of vertices, from 0 on")
    return _from_data((vertices, numbers, numpy.empty((0, 3))), {"first_cap": -1})


def _from_data(arrays, others, kind=Mesh, labels=None):
    """Returns a mesh of copies: of vertices, triangles, normals or none, and the other data."""
    with _required("arrays of a mesh"):
        arrays = [numpy.ascontiguousarray(a, kind) for a, kind in zip(arrays, ("f8", "u4", "f8"))]
    if any(a.ndim != 2 or a.shape[1] != 3 for a in arrays):
        raise Error("vertices, triangles and normals of a mesh are arrays of three columns")
    vertices, triangles, normals = arrays
    if len(normals) not in (0, len(vertices)):
        raise Error("a mesh has a normal for each vertex, or none")
    if labels is not None:
        labels = numpy.ascontiguousarray(labels, "i8")
        if labels.shape != (len(triangles), 2):
            raise Error("a triangle has two labels")
    data = _MeshData(
        vertices=vertices.ctypes.data,
        vertex_count=len(vertices),
        triangles=triangles.ctypes.data,
        triangle_count=len(triangles),
        normals=normals.ctypes.data if len(normals) else None,
        sides=None if labels is None else labels.ctypes.data,
        **others,
    )
    handle = _MeshHandle()
    _ok(_library.deliso_mesh_from_data(ctypes.byref(data), ctypes.byref(handle)))
    return kind(handle)


from ._parts import join, mesh_blocks, part  # noqa: E402  (which needs all of the above)
from ._solids import Solid, solid  # noqa: E402
