#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a zarr to measure with: the bumpy ball of bench/make_shell.cpp in 8 bits, N samples along
each axis (512 by default), in chunks of 64 a side. Its noise is of other seeds. One layer of chunks is
in memory at a time.
  make_zarr.py OUT.zarr [N]
Mesh it with isovalue 128.5.
"""
import sys

# The outer radius, the inner one and the height of the bumps, in halves of the volume's side.
OUTER, INNER, BUMPS = 0.8, 0.55, 0.03
WAVES = 9
GRAY_PER_SAMPLE = 16  # the slope at the surface
CHUNK = 64


def fail(message):
    print(f"make_zarr.py: {message}", file=sys.stderr)
    sys.exit(2)


try:
    import numpy as np
    import zarr
except ImportError as missing:
    fail(f"{missing} (Debian: python3-zarr)")


def layer(begin, end, n):
    """Returns the slices begin to end as an array [z, y, x]."""
    half = 0.5 * (n - 1)
    x = np.arange(n) / half - 1
    y = x[:, np.newaxis]
    waves = WAVES * np.pi
    slices = np.empty((end - begin, n, n), np.uint8)
    for k in range(begin, end):
        z = x[k]
        r = np.sqrt(x * x + y * y + z * z)
        bump = BUMPS * np.sin(waves * x) * np.sin(waves * y) * np.sin(waves * z)
        inside = half * np.minimum(OUTER + bump - r, r - INNER - bump)
        noise = np.random.default_rng(k).integers(-1, 2, (n, n))
        slices[k - begin] = np.rint(np.clip(128 + GRAY_PER_SAMPLE * inside + noise, 0, 255))
    return slices


def main(out, n="512"):
    if not n.isdigit() or int(n) < 2:
        fail("usage: make_zarr.py OUT.zarr [N]")
    n = int(n)
    try:
        array = zarr.open(out, mode="w", shape=(n, n, n), chunks=(CHUNK,) * 3, dtype="u1")
        for begin in range(0, n, CHUNK):
            end = min(begin + CHUNK, n)
            array[begin:end] = layer(begin, end, n)
    except (OSError, KeyError):  # zarr says KeyError where a folder cannot be made
        fail(f"{out} cannot be written")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        fail("usage: make_zarr.py OUT.zarr [N]")
    main(*sys.argv[1:])
