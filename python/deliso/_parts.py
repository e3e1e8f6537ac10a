# SPDX-License-Identifier: MIT
"""Meshes in parts: of arrays that are sliced box by box, by other processes too."""

from __future__ import annotations

import contextlib
import ctypes
import functools
import math
import mmap
import operator
import os
import sys
from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy

from . import (
    _OK,
    _TYPES,
    _Place,
    Error,
    Mesh,
    Progress,
    Three,
    _bar,
    _kind_of,
    _level,
    _library,
    _MeshHandle,
    _named,
    _ok,
    _options,
    _place,
    _require_three,
    _required,
    _unmasked,
    _watched,
    _whole,
    _with_options,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import JoinOptions, MeshOptions

# What join() decides, and all parts are made without.
_OF_JOIN = ("float", "double", "check", "allow_empty", "restricted")
# By default a part has at most about so many samples: 64 blocks of 128 x 128 x 128.
_PART_SAMPLES = 1 << 27
# What is done when all parts are, and the join begins.
_PARTS_SHARE = 0.8

_SIZES = ctypes.c_size_t * 3
_READ = ctypes.CFUNCTYPE(
    ctypes.c_int,
    ctypes.c_void_p,
    ctypes.POINTER(ctypes.c_size_t),
    ctypes.POINTER(ctypes.c_size_t),
    ctypes.c_void_p,
)


class _SourceData(ctypes.Structure):
    _fields_ = [
        ("type", ctypes.c_int),
        ("shape", _SIZES),
        ("place", ctypes.POINTER(_Place)),
        ("read", _READ),
        ("context", ctypes.c_void_p),
    ]


class _Source:
    """The library's view of an array that is sliced box by box, which this keeps alive."""

    def __init__(self, array, *place):
        self.array = array() if callable(array) else array
        with _required("an array has shape and dtype"):
            self.own_kind = _kind_of(numpy.dtype(self.array.dtype))
            shape = [operator.index(n) for n in self.array.shape]
        self.kind = "f8" if self.own_kind in ("i8", "u8") else self.own_kind
        _require_three(shape)
        if not 0 <= min(shape) <= max(shape) < 1 << 63:
            raise Error(f"an array of shape {tuple(shape)} cannot be meshed")
        self.error = None
        placed = ctypes.pointer(_place(shape, *place))
        self.data = _SourceData(_TYPES[self.kind], _SIZES(*shape), placed)

    def _read(self, _context, begin, end, samples):
        # An exception does not pass through the library: call() raises it afterwards.
        try:
            box = tuple(slice(begin[n], end[n]) for n in range(3))
            shape = tuple(end[n] - begin[n] for n in range(3))
            sliced = self.array[box]
            dask = sys.modules.get("dask")
            if dask and dask.is_dask_collection(sliced):
                # Here and now: a worker that waits for other tasks might wait for itself.
                sliced = sliced.compute(scheduler=dask.get)
            sliced = _unmasked(sliced)
            if sliced.shape != shape:
                raise Error(f"a slice of the array has shape {sliced.shape}, not {shape}")
            if _kind_of(sliced.dtype) != self.own_kind:
                raise Error(
                    f"a slice of the array has samples of type {sliced.dtype}, and the array says "
                    f"{self.array.dtype}"
                )
            count = math.prod(shape) * numpy.dtype(self.kind).itemsize
            memory = (ctypes.c_char * count).from_address(samples)
            box = numpy.frombuffer(memory, self.kind).reshape(shape)
            box[...] = sliced
            if self.kind != self.own_kind:
                with numpy.errstate(invalid="ignore"):
                    is_exact = (box.astype(self.own_kind) == sliced).all()
                if not is_exact:
                    raise Error("float64 does not hold all of the array's 64-bit integers exactly")
            return 0
        except BaseException as error:
            self.error = error
            return 1

    def call(self, function, progress):
        """Returns function(source, watch), as _watched() does."""
        self.data.read = _READ(self._read)
        try:
            return _watched(lambda watch: _ok(function(ctypes.byref(self.data), watch)), progress)
        except Error:
            if self.error:
                raise self.error from None
            raise
        finally:
            self.data.read = _READ(0)  # which keeps this object


@_with_options(_named.MeshOptions)
def part(
    array: Any,
    isovalue: Optional[float],
    number: int,
    parts: int,
    *,
    spacing: Three = None,
    origin: Three = None,
    direction: Optional[Sequence] = None,
    space: Optional[str] = None,
    progress: Progress = False,
    **options: Unpack[MeshOptions],
) -> bytes:
    """Meshes part `number` of `parts`, counted from 1. Returns bytes, for join().

    array     as of mesh_blocks(). Only slices of this part are read, and some samples around them;
              with largest, min_component and label all of the array.
    options   those of mesh(), the same for all parts, but for those about the mesh as a whole:
              join() has float, check and allow_empty
    """
    source = _Source(array, spacing, origin, direction, space)
    words = _options(options)
    text, size = ctypes.c_void_p(), ctypes.c_size_t()
    choice = _level(isovalue), _whole("number", number), _whole("parts", parts)
    made = ctypes.byref(text), ctypes.byref(size)
    source.call(
        lambda data, watch: _library.deliso_part_create(data, *choice, words, watch, *made),
        progress,
    )
    try:
        return ctypes.string_at(text, size.value)
    finally:
        _library.deliso_text_free(text)


@_with_options(_named.JoinOptions)
def join(
    parts: Sequence,
    array: Any,
    *,
    spacing: Three = None,
    origin: Three = None,
    direction: Optional[Sequence] = None,
    space: Optional[str] = None,
    progress: Progress = False,
    **options: Unpack[JoinOptions],
) -> Mesh:
    """Joins all parts of a mesh, in any order. Returns the Mesh that mesh() makes of the array.

    parts     what part() returned, or the program's --part: bytes, memory maps, names of files
    array     that of the parts. Only slices around the seams and the surface are read; with
              check=True, and of parts with cap or label, all of it.
    options   threads, float, check, allow_empty
    """
    place = spacing, origin, direction, space
    return _joined(parts, array, place, progress, options)


def _joined(parts, array, place, progress, options):
    source = _Source(array, *place)
    words = _options(options)
    named = (str, os.PathLike)
    with _required("a part"):
        views = [
            numpy.memmap(p, "u1", "r")
            if isinstance(p, named)
            else numpy.frombuffer(memoryview(p).cast("B"), "u1")
            for p in parts
        ]
    addresses = (ctypes.c_void_p * len(views))(*(view.ctypes.data for view in views))
    sizes = (ctypes.c_size_t * len(views))(*map(len, views))
    handle = _MeshHandle()
    status = source.call(
        lambda data, watch: _library.deliso_join(
            addresses, sizes, len(views), data, words, watch, ctypes.byref(handle)
        ),
        progress,
    )
    return Mesh(handle, status == _OK)


@_with_options(_named.MeshOptions)
def mesh_blocks(
    array: Any,
    isovalue: Optional[float] = None,
    *,
    spacing: Three = None,
    origin: Three = None,
    direction: Optional[Sequence] = None,
    space: Optional[str] = None,
    parts: Optional[int] = None,
    client: Any = None,
    progress: Progress = False,
    **options: Unpack[MeshOptions],
) -> Mesh:
    """Meshes an array that need not fit into memory. Returns the Mesh that mesh() makes of it in C
    order.

    array     anything with shape and dtype that is sliced as array[z0:z1, y0:y1, x0:x1]: of NumPy,
              zarr, h5py, dask.array. Or a function without arguments that returns it, which each
              process calls for itself: what cannot be pickled is opened there.
    client    runs the parts: an executor of concurrent.futures, or a dask.distributed.Client.
              Without one this process makes all of them.
    parts     how many; the mesh does not depend on it. By default four for each worker, and more of
              large arrays; without a client one
    progress  as of mesh()
    options   those of mesh(), but not those about the number of vertices, and the paper's. With a
              client each part is made by one thread, unless threads says otherwise.

    An exception of a worker, as when a slice cannot be read, is raised here.
    """
    show = _bar if progress is True else progress
    of_join = {name: options.pop(name) for name in _OF_JOIN if name in options}
    if "threads" in options:
        of_join["threads"] = options["threads"]
    elif client is not None:
        options["threads"] = 1
    if parts is None:
        parts = 1 if client is None else _part_count(array, client)
    parts = _whole("parts", parts)
    place = {"spacing": spacing, "origin": origin, "direction": direction, "space": space}
    make = functools.partial(part, **place, **options)
    if client is not None:
        made = _made_by(client, make, array, isovalue, parts, show)
    else:
        shares = [_PARTS_SHARE * n / parts for n in range(parts + 1)]
        made = [
            make(array, isovalue, n + 1, parts, progress=_between(shares[n], shares[n + 1], show))
            for n in range(parts)
        ]
    joining = _between(_PARTS_SHARE, 1, show)
    return _joined(made, array, tuple(place.values()), joining, of_join)


def _between(begin, end, show):
    """Returns a progress function for a piece of the work, from one share of it to another."""

    def show_piece(stage, share):
        if stage != "done" or end == 1:
            show(stage, begin + (end - begin) * share)

    return show and show_piece


def _part_count(array, client):
    """Several parts for each worker, since some take longer; and none of many samples."""
    if hasattr(client, "nthreads"):  # of dask.distributed
        workers = sum(client.nthreads().values())
    else:
        workers = getattr(client, "_max_workers", None) or os.cpu_count() or 1
    samples = math.prod((array() if callable(array) else array).shape)
    return max(4 * workers, samples // _PART_SAMPLES)


def _made_by(client, make, array, isovalue, parts, show):
    more = {}
    if isinstance(array, numpy.memmap) and isinstance(array.base, mmap.mmap) and array.filename:
        # A pickled memory map is a copy of its file. Each worker opens the file for itself.
        order = "C" if array.flags.c_contiguous else "F"
        place = (array.filename, array.dtype, "r", array.offset, array.shape, order)
        array = functools.partial(numpy.memmap, *place)
    if hasattr(client, "scatter"):  # of dask.distributed
        # It would look for an equal task by a hash of all arguments.
        more["pure"] = False
        if isinstance(array, numpy.ndarray):
            array = client.scatter(array, broadcast=True)
    with _required("client"):
        submit = client.submit
    futures = [submit(make, array, isovalue, n + 1, parts, **more) for n in range(parts)]
    with _required("what the client's submit() gives"):
        results = [future.result for future in futures]
    made = []
    try:
        for result in results:
            made.append(result())
            if show:
                show("parts", _PARTS_SHARE * len(made) / parts)
        return made
    except BaseException:
        for future in futures:
            future.cancel()
        if not more:
            # Until Python 3.11.2 an executor waited for ever if only canceled tasks were left.
            with contextlib.suppress(RuntimeError):  # a broken one takes no more
                client.submit(int)
        raise
