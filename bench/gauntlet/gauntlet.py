#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Meshes random small volumes by every tool that is there (tools.py), and scores each by `deliso check`.

  gauntlet.py BUILD OUT [--count N] [--first-seed S] [--jobs J] [--only NAME,...] [--tools FILE]
              [--data FOLDER] [--page PAGE]

BUILD has deliso and bench/gauntlet_volumes. If it has bench/gauntlet_judge, too, this second judge,
which shares nothing with `deliso check` but the readers, scores each mesh by its indices. With FOLDER
there are crops of the paper's volumes, of the kind `real`. Prints the tables in Markdown, which go
between the two comments of the gauntlet in PAGE too. OUT gets scores.tsv, a line for each mesh, and in
failures/ for each tool and kind of fault the smallest volume, the mesh, and in list.txt the command that
shows it. A tool may take 10 processor seconds for a volume.
"""
import argparse
import collections
import datetime
import importlib.util
import json
import multiprocessing
import os
import pathlib
import resource
import shlex
import shutil
import statistics
import subprocess
import sys

try:
    import numpy as np
except ImportError as missing:
    sys.exit(f"gauntlet.py: {missing} (Debian: python3-numpy, and PYTHON=/usr/bin/python3)")

LIMIT_S = 10
TOPOLOGY = {"missing components", "extra components", "different components"}
NOT_MANIFOLD = {"non-manifold edges", "non-manifold vertices", "orientation", "duplicate triangles"}
# Faults of others are no failures here: a file of another program states no limits.
FAILURES = TOPOLOGY | NOT_MANIFOLD | {"holes", "self-intersections", "turned components",
                                      "duplicate vertices", "degenerate triangles", "no mesh"}

BY_INDEX = ["index exact", "index manifold", "index closed", "index meeting itself"]

Volume = collections.namedtuple("Volume", "seed kind isovalue closed path samples spacing")


def read_volume(line, folder):
    """Returns the volume of a line that gauntlet_volumes printed, with samples[x, y, z]."""
    seed, kind, isovalue, closed = line.split()
    path = folder / f"{seed}.nrrd"
    head, samples = path.read_bytes().split(b"\n\n", 1)
    field = dict(row.split(": ", 1) for row in head.decode().splitlines()[1:])
    samples = np.frombuffer(samples, {"float": "f4", "double": "f8"}.get(field["type"], field["type"]))
    return Volume(seed, kind, float(isovalue), closed == "closed", path,
                  samples.reshape([int(n) for n in field["sizes"].split()], order="F"),
                  tuple(float(step.strip("()").split(",")[axis])
                        for axis, step in enumerate(field["space directions"].split())))


def has_tie(volume):
    """True if a sample, or the saddle of a voxel's face, equals the isovalue."""
    d = volume.samples.astype(float) - volume.isovalue
    for axis in range(3):
        e = np.moveaxis(d, axis, 0)
        a, b, c, f = e[:, :-1, :-1], e[:, :-1, 1:], e[:, 1:, 1:], e[:, 1:, :-1]
        if ((a * c == b * f) & (a * b <= 0) & (b * c <= 0)).any():
            return True
    return bool((d == 0).any())


def write_ply(path, points, triangles):
    faces = np.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    with open(path, "wb") as out:
        out.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\n"
                  b"property float y\nproperty float z\nelement face %d\n"
                  b"property list uchar int vertex_indices\nend_header\n" % (len(points), len(faces)))
        out.write(np.asarray(points, "<f4").tobytes() + faces.tobytes())


def run_tool(tool, volume, mesh, build):
    """Returns the processor seconds, reading and writing included. A crash ends a process of its own."""
    child = os.fork()
    if child == 0:
        try:
            resource.setrlimit(resource.RLIMIT_CPU, (LIMIT_S, LIMIT_S))
            os.chdir(mesh.parent)  # some leave files behind
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.dup2(1, 2)
            if callable(tool.mesh):
                write_ply(mesh, *tool.mesh(volume))
            else:
                words = [word.format(build=build, volume=volume.path, iso=repr(volume.isovalue), mesh=mesh)
                         for word in shlex.split(tool.mesh)]
                os.execvp(words[0], words)
            os._exit(0)
        except BaseException:
            os._exit(1)
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        pathlib.Path(mesh).unlink(missing_ok=True)
    return usage.ru_utime + usage.ru_stime


def check(deliso, volume, mesh):
    """Returns what `deliso check` measures, nothing if there is no mesh that it can read."""
    done = subprocess.run(check_command(deliso, mesh, volume) + ["--json", "-"], capture_output=True)
    return json.loads(done.stdout)["check"] if done.returncode < 2 else None


def check_command(deliso, mesh, volume):
    return [str(deliso), "check", str(mesh), str(volume.path), "--iso", repr(volume.isovalue)]


def judge(program, volume, mesh):
    """Returns what the second judge counts (judge.cpp), nothing if there is none or no mesh."""
    if not program.exists() or not mesh.exists():
        return None
    done = subprocess.run([program, mesh, volume.path], capture_output=True, text=True)
    return [int(word) for word in done.stdout.split()] if done.returncode == 0 else None


def score_by_index(row, counts, exact):
    """Adds the second judge's scores to the row of one mesh. `exact`: what `deliso check` tells of the
    isosurface, whose numbers the mesh should have."""
    manifold, inside, *topology, pairs = counts
    closed = manifold == 1 and inside == 0
    same = topology == [exact[key] for key in ("components", "euler", "boundary_loops")]
    row.update(zip(BY_INDEX, (closed and same, manifold == 1, closed, pairs > 0)))


def score(found, counts, seconds):
    """Returns the row of one mesh. `far` are points beyond D, either way (2 D from the surface)."""
    row = {"exact": False, "manifold": False, "closed": False, "pairs": 0, "seconds": seconds,
           "angle": None, "far": 0, "points": 0, "faults": ["no mesh"],
           **dict.fromkeys(BY_INDEX, False)}
    if found is None:
        return row
    faults = {name: fault["count"] for name, fault in found["faults"].items()}
    mesh, exact = found["topology"], found["exact_topology"]
    ways = [found["mesh_to_surface_voxels"], found["surface_to_mesh_voxels"]]
    row.update(
        exact=found["equal_components"] == exact["components"] and not TOPOLOGY & set(faults),
        manifold=not NOT_MANIFOLD & set(faults),
        closed="holes" not in faults and mesh["boundary_loops"] == exact["boundary_loops"],
        pairs=faults.get("self-intersections", 0), angle=found["criteria"]["min_angle_degrees"],
        far=sum(way["beyond_bound"] + way["not_found"] for way in ways),
        points=sum(way["points"] + way["not_found"] for way in ways),
        faults=sorted(FAILURES & set(faults)))
    if counts:
        score_by_index(row, counts, exact)
    return row


def run_task(volume):
    return task(volume)


def score_all(tool, volumes, mesh_of, options):
    """Returns the rows of the tool. Processes of their own inherit `task`, as functions cannot be sent."""
    global task

    def task(volume):
        seconds = run_tool(tool, volume, mesh_of(volume), options.build)
        return score(check(options.build / "deliso", volume, mesh_of(volume)),
                     judge(options.build / "bench/gauntlet_judge", volume, mesh_of(volume)), seconds)
    with multiprocessing.get_context("fork").Pool(options.jobs) as pool:
        return pool.map(run_task, volumes, chunksize=1)


def keep_failures(smallest, folder, deliso):
    """Copies the smallest volume of each tool and fault, and its mesh."""
    folder.mkdir()
    with open(folder / "list.txt", "w") as out:
        for (tool, fault), (_, volume, mesh) in sorted(smallest.items()):
            name = f"{tool}-{fault}".replace(" ", "_").replace(",", "")
            kept = shutil.copy(volume.path, folder / f"{name}.nrrd")
            words = [f"{tool}: {fault} (seed {volume.seed}, {volume.kind}), isovalue {volume.isovalue!r}"]
            if mesh.exists():
                copy = shutil.copy(mesh, folder / f"{name}{mesh.suffix}")
                words.append("  " + shlex.join(check_command(deliso, copy, volume._replace(path=kept))))
            out.write("\n".join(words) + "\n")


def share(rows, key=lambda row: row["exact"]):
    return f"{100 * sum(map(key, rows)) / len(rows):.1f}" if rows else "-"


def table(header, rows):
    lines = [header, ["---"] + ["---:"] * (len(header) - 1)] + rows
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def report(scores, versions, volumes, ties, first_seed, judged):
    """Returns a sentence and the tables. `scores` has for each tool the rows by seed."""
    kinds = list(dict.fromkeys(volume.kind for volume in volumes))
    drawn, crops = ([v for v in volumes if (v.kind == "real") == real] for real in (False, True))
    first, second, third = [], [], []
    for tool, by_seed in scores.items():
        of = lambda some: [by_seed[v.seed] for v in some if v.seed in by_seed]
        rows = of(drawn)
        angles = [row["angle"] for row in rows if row["angle"] is not None]
        far, points = (sum(row[key] for row in rows) for key in ("far", "points"))
        first.append([f"{tool} {versions[tool]}", str(len(rows)), share(rows),
                      share(of(v for v in drawn if v.seed not in ties)), share(rows, lambda r: r["manifold"]),
                      share(rows, lambda r: r["closed"]), share(rows, lambda r: r["pairs"] > 0),
                      f"{sum(row['pairs'] for row in rows):,}",
                      f"{statistics.median(angles):.1f}" if angles else "-",
                      f"{100 * far / points:.2f}" if points else "-",
                      f"{sum(row['seconds'] for row in rows):.0f}"])
        second.append([tool, share(of(v for v in drawn if v.closed))] +
                      [share(of(v for v in volumes if v.kind == kind)) for kind in kinds])
        third.append([tool])
        for some in filter(None, (drawn, crops)):
            by_index = of(some)
            third[-1] += [share(by_index, lambda r: r[key]) for key in BY_INDEX] + [
                f"{sum(r['exact'] and not r['index exact'] for r in by_index)}, "
                f"{sum(r['index exact'] and not r['exact'] for r in by_index)}"]
    with_tie = lambda some: f"{sum(v.seed in ties for v in some):,} with a tie."
    sentence = (f"{datetime.date.today()}: {len(drawn):,} volumes from seed {first_seed}, "
                f"{sum(not v.closed for v in drawn):,} of them with a surface that ends on the box, "
                + with_tie(drawn))
    if crops:
        sentence += f" {len(crops):,} crops of real volumes, {with_tie(crops)}"
    columns = [key.removeprefix("index ") + ", %" for key in BY_INDEX] + ["check alone, judge alone"]
    return "\n\n".join([
        sentence,
        table(["tool", "volumes", "exact, %", "without ties, %", "manifold, %", "closed, %", "crossing, %",
               "pairs", "least angle", "far, %", "seconds"], first),
        table(["exact, %", "closed surfaces"] + kinds, second)] + (
            [table(["by index"] + columns + ["real: " + name for name in columns if crops], third)]
            if judged else []))


def put_into(page, text):
    begin, end = "<!--gauntlet: made by make gauntlet-->\n", "<!--gauntlet: end-->\n"
    before, rest = page.read_text().split(begin)
    page.write_text(before + begin + "\n" + text + "\n\n" + end + rest.split(end)[1])


def load_tools(path, only):
    spec = importlib.util.spec_from_file_location("tools", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return [tool for tool in module.TOOLS if not only or tool.name in only]


def version_of(tool, build):
    """Returns the version, nothing if the tool is not there."""
    try:
        if callable(tool.version):
            return tool.version()
        words = [word.format(build=build) for word in shlex.split(tool.version)]
        return subprocess.run(words, check=True, capture_output=True, text=True).stdout.split()[-1]
    except (ImportError, OSError, subprocess.CalledProcessError):
        return None


def main():
    here = pathlib.Path(__file__).parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", type=lambda folder: pathlib.Path(folder).resolve())
    parser.add_argument("out", type=lambda folder: pathlib.Path(folder).resolve())
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", type=lambda names: names.split(","))
    parser.add_argument("--tools", type=pathlib.Path, default=here / "tools.py")
    parser.add_argument("--data")
    parser.add_argument("--page", type=pathlib.Path)
    options = parser.parse_args()
    build, out = options.build, options.out
    for name in ("volumes", "meshes", "failures"):
        shutil.rmtree(out / name, ignore_errors=True)
    for name in ("volumes", "meshes"):
        (out / name).mkdir(parents=True)
    command = [build / "bench/gauntlet_volumes", str(options.first_seed), str(options.count),
               out / "volumes"] + ([options.data] if options.data else [])
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    volumes = [read_volume(line, out / "volumes") for line in lines.splitlines()]
    ties = {volume.seed for volume in volumes if has_tie(volume)}

    scores, versions, smallest = {}, {}, {}
    with open(out / "scores.tsv", "w") as log:
        for tool in load_tools(options.tools, options.only):
            versions[tool.name] = version_of(tool, build)
            if versions[tool.name] is None:
                print(f"{tool.name}: not there", file=sys.stderr)
                continue
            print(tool.name, versions[tool.name], file=sys.stderr)
            chosen = [volume for volume in volumes if volume.closed or not tool.closed_only]
            mesh_of = lambda v: out / "meshes" / f"{len(versions)}-{v.seed}{tool.suffix}"
            rows = score_all(tool, chosen, mesh_of, options)
            scores[tool.name] = dict(zip([volume.seed for volume in chosen], rows))
            for volume, row in zip(chosen, rows):
                print(tool.name, volume.seed, volume.kind, *row.values(), sep="\t", file=log, flush=True)
                for fault in row["faults"]:
                    place = (volume.samples.size, volume, mesh_of(volume))
                    smallest[tool.name, fault] = min(smallest.get((tool.name, fault), place), place,
                                                     key=lambda p: p[0])
    keep_failures(smallest, out / "failures", build / "deliso")
    text = report(scores, versions, volumes, ties, options.first_seed,
                  (build / "bench/gauntlet_judge").exists())
    print(text)
    if options.page:
        put_into(options.page, text)


if __name__ == "__main__":
    main()
