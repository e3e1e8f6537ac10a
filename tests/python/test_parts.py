# SPDX-License-Identifier: MIT
"""Meshes in parts, of arrays that are sliced, by pools of processes: the mesh of one process. Usage:
test_parts.py PROGRAM, with the package's folder in PYTHONPATH and its library beside or in DELISO_LIBRARY."""

import concurrent.futures
import importlib
import logging
import os
import pathlib
import pickle
import random
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy

import deliso
import in_folder

PROGRAM = sys.argv[-1]
LEVEL = 10.25
SPACING = (1, 1, 1.5)
BLOCKS = {"block_side": 10, "spacing": SPACING}


def field(nz=34, ny=28, nx=40):
    """Two balls, one of which leaves the box, with some noise."""
    z, y, x = numpy.mgrid[0:nz, 0:ny, 0:nx].astype("f4")
    one = 24 - numpy.sqrt((z - 17) ** 2 + (y - 10) ** 2 + (x - 14) ** 2)
    other = 15 - numpy.sqrt((z - 25) ** 2 + (y - 20) ** 2 + (x - 33) ** 2)
    return numpy.maximum(one, other) + numpy.random.default_rng(3).random(z.shape, "f4") / 4


def labels():
    return numpy.where(field() > LEVEL, 3, 0).astype("i2")


class Fails:
    """An array that cannot be read."""

    shape, dtype = (30, 30, 30), numpy.dtype("u1")

    def __getitem__(self, box):
        raise OSError("no such disk")


class Kills:
    """An array in a file, which kills the first process but `parent` that reads it. It is small when
    it is pickled: a broken pool of Python 3.11.2 waits for ever while a large task is sent."""

    def __init__(self, array, folder):
        self.path, self.shape, self.dtype = os.path.join(folder, "a.npy"), array.shape, array.dtype
        self.killed, self.parent = os.path.join(folder, "killed"), os.getpid()
        numpy.save(self.path, array)

    def __getitem__(self, box):
        if os.getpid() != self.parent:
            try:
                open(self.killed, "x").close()
                os.kill(os.getpid(), signal.SIGKILL)
            except FileExistsError:
                pass
        return numpy.load(self.path, "r")[box]


class OpensHdf5:
    """Opens the data set in each process: it cannot be pickled."""

    def __init__(self, path):
        self.path = path

    def __call__(self):
        return importlib.import_module("h5py").File(self.path, "r")["a"]


def needs(*modules):
    for module in modules:
        try:
            importlib.import_module(module)
        except ImportError:
            return unittest.skip(f"no {module} here")
    return lambda test: test


class TestCase(in_folder.InFolder):
    def saved(self, m):
        m.save(self.path("m.ply"))
        return pathlib.Path(self.path("m.ply")).read_bytes()

    def assert_same(self, m, other):
        self.assertGreater(len(m.triangles), 100)
        for name in ("vertices", "triangles", "normals"):
            self.assertEqual(getattr(m, name).tobytes(), getattr(other, name).tobytes())
        self.assertEqual(self.saved(m), self.saved(other))


class TestParts(TestCase):
    def test_parts_in_any_order_are_the_mesh_of_the_array(self):
        cases = [
            ({}, {}),
            ({"smooth": "0.7vox"}, {}),
            ({"median": 1}, {"threads": 1}),
            ({"largest": 1}, {}),
            ({"cap": True}, {"check": True}),
            ({"max_distance": "0.2vox"}, {"float": True}),
            ({"label": 3}, {}),
        ]
        order = random.Random(1)
        for of_parts, of_join in cases:
            array, level = (labels(), None) if "label" in of_parts else (field(), LEVEL)
            whole = deliso.mesh(array, level, **BLOCKS, **of_parts, **of_join)
            for count in (1, 4, 7):
                with self.subTest(of_parts, count=count):
                    parts = [
                        deliso.part(array, level, n + 1, count, **BLOCKS, **of_parts)
                        for n in range(count)
                    ]
                    order.shuffle(parts)
                    joined = deliso.join(parts, array, spacing=SPACING, **of_join)
                    self.assert_same(joined, whole)
                    self.assertTrue(joined.sound)
                    for key in ("vertices", "triangles", "components", "topology_exact"):
                        self.assertEqual(
                            joined.report["mesh"].get(key), whole.report["mesh"].get(key)
                        )
            with self.subTest(of_parts):
                again = deliso.mesh_blocks(array, level, parts=3, **BLOCKS, **of_parts, **of_join)
                self.assert_same(again, whole)

    def test_arrays_of_every_kind(self):
        a = field()
        kinds = {
            "Fortran": numpy.asfortranarray(a),
            "strided": numpy.repeat(a, 2, 0)[::2],
            "bytes turned": a.astype(">f8"),
            "int64": a.astype("i8"),
            "bool": a > LEVEL,
            "float16": a.astype("f2"),
        }
        for name, array in kinds.items():
            with self.subTest(name):
                level = 0.5 if name == "bool" else LEVEL
                whole = deliso.mesh(numpy.ascontiguousarray(array), level, **BLOCKS)
                self.assert_same(deliso.mesh_blocks(array, level, **BLOCKS), whole)

    def test_parts_of_the_program(self):
        numpy.save(self.path("v.npy"), field())
        command = [PROGRAM, self.path("v.npy"), "-k", str(LEVEL), "--spacing", "1,1,1.5", "-q"]
        parts = []
        for n in (2, 1):
            part = self.path(f"{n}.part")
            subprocess.run([*command, "--part", f"{n}/2", "-o", part], check=True)
            parts.append(numpy.memmap(part, "u1", "r"))
        subprocess.run([*command, "-o", self.path("whole.ply")], check=True)
        joined = deliso.join(parts, numpy.load(self.path("v.npy"), "r"), spacing=SPACING)
        self.assertEqual(self.saved(joined), pathlib.Path(self.path("whole.ply")).read_bytes())

    def test_only_slices_around_the_seams_and_blocks_are_read(self):
        a, sizes = field(), []

        class Watched:
            shape, dtype = a.shape, a.dtype

            def __getitem__(self, box):
                sizes.append(a[box].size)
                return a[box]

        deliso.mesh_blocks(Watched(), LEVEL, parts=2, **BLOCKS)
        self.assertGreater(len(sizes), 36)
        self.assertLess(max(sizes), a.size / 4)

    def test_errors(self):
        a = field()
        parts = [deliso.part(a, LEVEL, n, 2, **BLOCKS) for n in (1, 2)]
        infinite = a.copy()
        infinite[30, 20, 10] = numpy.inf
        short = type("Short", (), {"shape": (99, 99, 99), "dtype": a.dtype})()
        type(short).__getitem__ = lambda self, box: a[box]
        other = type("Other", (), {"shape": a.shape, "dtype": a.dtype})()
        type(other).__getitem__ = lambda self, box: a[box].astype("f8")
        for call, words in [
            (lambda: deliso.join([], a), "no parts"),
            (lambda: deliso.join(parts[1:], a, spacing=SPACING), "part 1 of 2 is missing"),
            (lambda: deliso.join([parts[0], b"solid"], a), "parts[1]"),
            (lambda: deliso.join([parts[0], bytearray()], a), "parts[1]"),
            (lambda: deliso.join(parts, a), "is no part of"),
            (lambda: deliso.join(parts, a, smooth=1), "--smooth"),
            (lambda: deliso.part(a, LEVEL, 3, 2), "--part"),
            (lambda: deliso.part(a, LEVEL, 1, 2, max_distanc=1), "--max-distance"),
            (lambda: deliso.mesh_blocks(a, LEVEL, vertices=90), "--vertices"),
            (lambda: deliso.mesh_blocks(a, LEVEL, parts=0), "parts is 0, and must be from 1"),
            (lambda: deliso.mesh_blocks(a, LEVEL, parts="two"), "parts: "),
            (lambda: deliso.part(a, LEVEL, 2**32 + 1, 2), "number is 4294967297"),
            (lambda: deliso.part(a, LEVEL, 1, 2**32 + 2), "parts is 4294967298"),
            (lambda: deliso.part(a, LEVEL, 1.5, 2), "number: "),
            (lambda: deliso.part(a, "high", 1, 2), "isovalue: "),
            (lambda: deliso.part(a.tolist(), LEVEL, 1, 2), "an array has shape and dtype: "),
            (lambda: deliso.join([7], a), "a part: "),
            (lambda: deliso.join([self.path("none.part")], a), "a part: "),
            (lambda: deliso.mesh_blocks(a, 1e9), "empty"),
            (lambda: deliso.mesh_blocks(a[0], LEVEL), "2 dimensions"),
            (lambda: deliso.mesh_blocks(a * 1j, LEVEL), "complex"),
            (lambda: deliso.mesh_blocks(a, LEVEL, spacing=2), "spacing"),
            (lambda: deliso.mesh_blocks(infinite, LEVEL, **BLOCKS), "(10, 20, 30)"),
            (lambda: deliso.mesh_blocks(short, LEVEL), "a slice of the array has shape"),
            (lambda: deliso.mesh_blocks(other, LEVEL), "samples of type float64, and the array says"),
        ]:
            with self.subTest(words), self.assertRaises(deliso.Error) as caught:
                call()
            self.assertIn(words, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaisesRegex(OSError, "no such disk"):
            deliso.mesh_blocks(Fails(), 5)
        self.assertEqual(len(deliso.mesh_blocks(a, 1e9, allow_empty=True).vertices), 0)

    def test_progress_and_interrupt(self):
        seen = []
        a = field()
        deliso.mesh_blocks(a, LEVEL, parts=3, progress=lambda *now: seen.append(now), **BLOCKS)
        self.assertEqual(seen[-1], ("done", 1.0))
        self.assertEqual([stage for stage, _ in seen].count("done"), 1)
        shares = [share for _, share in seen]
        self.assertEqual(shares, sorted(shares))

        began = threading.Event()
        noise = numpy.random.default_rng(7).random((48, 48, 48))

        def interrupt():
            began.wait()
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=interrupt).start()
        # Processor time, which a busy machine does not lengthen: the whole takes 15 seconds of it.
        start = time.process_time()
        with self.assertRaises(KeyboardInterrupt):
            deliso.mesh_blocks(noise, 0.5, progress=lambda stage, share: began.set())
        self.assertLess(time.process_time() - start, 4)


class TestPools(TestCase):
    def test_an_executor_of_processes(self):
        a = field()
        whole = deliso.mesh(a, LEVEL, **BLOCKS)
        numpy.save(self.path("a.npy"), a)
        # A memory map is not copied: its slices would be, which have an offset of their own.
        mapped = numpy.load(self.path("a.npy"), "r")
        seen = []
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            for array in (a, mapped, mapped[2:], numpy.asfortranarray(a)):
                with self.subTest(type(array)):
                    m = deliso.mesh_blocks(
                        array, LEVEL, client=pool, progress=lambda *now: seen.append(now), **BLOCKS
                    )
                    same = deliso.mesh(a[2:], LEVEL, **BLOCKS) if len(array) < len(a) else whole
                    self.assert_same(m, same)
                    self.assertEqual(seen[-1], ("done", 1.0))
            with self.assertRaisesRegex(OSError, "no such disk"):
                deliso.mesh_blocks(Fails(), 5, client=pool)
            with self.assertRaisesRegex(deliso.Error, "--vertices"):
                deliso.mesh_blocks(a, LEVEL, client=pool, vertices=90)
        self.assertIn("parts", [stage for stage, _ in seen])

    def test_a_memory_map_is_sent_as_the_name_of_its_file(self):
        sizes = []

        class Executor(concurrent.futures.ThreadPoolExecutor):
            def submit(self, *call):
                sizes.append(len(pickle.dumps(call)))
                return super().submit(*call)

        a = numpy.asfortranarray(field())
        numpy.save(self.path("a.npy"), a)
        with Executor(2) as pool:
            m = deliso.mesh_blocks(numpy.load(self.path("a.npy"), "r"), LEVEL, client=pool, **BLOCKS)
        self.assert_same(m, deliso.mesh(field(), LEVEL, **BLOCKS))
        self.assertEqual(len(sizes), 8)  # four for each worker
        self.assertLess(max(sizes), 2000)

    def test_what_is_no_client_is_refused(self):
        class Gives:
            def submit(self, *call):
                return None

        for client in (5, Gives()):
            with self.assertRaisesRegex(deliso.Error, "client"):
                deliso.mesh_blocks(field(), LEVEL, client=client, **BLOCKS)

    def test_a_killed_worker_breaks_an_executor(self):
        array = Kills(field(), self.folder.name)
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            with self.assertRaises(concurrent.futures.process.BrokenProcessPool):
                deliso.mesh_blocks(array, LEVEL, client=pool, **BLOCKS)
        self.assertTrue(os.path.exists(array.killed))

    @needs("zarr")
    def test_zarr(self):
        array = importlib.import_module("zarr").open(
            self.path("a.zarr"), mode="w", shape=field().shape, chunks=(16, 16, 16), dtype="f4"
        )
        array[:] = field()
        whole = deliso.mesh(field(), LEVEL, **BLOCKS)
        self.assert_same(deliso.mesh_blocks(array, LEVEL, **BLOCKS), whole)
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            self.assert_same(deliso.mesh_blocks(array, LEVEL, client=pool, **BLOCKS), whole)

    @needs("h5py")
    def test_h5py(self):
        with importlib.import_module("h5py").File(self.path("a.h5"), "w") as file:
            file["a"] = field()
            whole = deliso.mesh(field(), LEVEL, **BLOCKS)
            self.assert_same(deliso.mesh_blocks(file["a"], LEVEL, **BLOCKS), whole)
        opens = OpensHdf5(self.path("a.h5"))
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            self.assert_same(deliso.mesh_blocks(opens, LEVEL, client=pool, **BLOCKS), whole)
            with self.assertRaises(TypeError):
                deliso.mesh_blocks(opens(), LEVEL, client=pool, **BLOCKS)

    @needs("dask.array")
    def test_dask_arrays(self):
        array = importlib.import_module("dask.array").from_array(field(), chunks=16)
        whole = deliso.mesh(field() * 2, 2 * LEVEL, **BLOCKS)
        self.assert_same(deliso.mesh_blocks(array * 2, 2 * LEVEL, **BLOCKS), whole)
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            m = deliso.mesh_blocks(array * 2, 2 * LEVEL, client=pool, parts=3, **BLOCKS)
        self.assert_same(m, whole)

    @needs("distributed", "dask.array")
    def test_dask_distributed_also_where_a_worker_is_killed(self):
        distributed = importlib.import_module("distributed")
        a = field()
        whole = deliso.mesh(a, LEVEL, **BLOCKS)
        killing = Kills(a, self.folder.name)
        lazy = importlib.import_module("dask.array").from_array(a, chunks=16)
        options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
        options.update(local_directory=self.folder.name, silence_logs=logging.CRITICAL)
        with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
            for array in (a, lazy, killing):
                with self.subTest(type(array)):
                    self.assert_same(deliso.mesh_blocks(array, LEVEL, client=client, **BLOCKS), whole)
            with self.assertRaisesRegex(OSError, "no such disk"):
                deliso.mesh_blocks(Fails(), 5, client=client)
        self.assertTrue(os.path.exists(killing.killed))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-1])
