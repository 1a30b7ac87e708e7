"""Writes a replay of many grains that a wheel of air sweeps aside: what a page must play smoothly.

Usage: replay_of_many.py FILE [GRAINS] [FRAMES]
"""
import json
import math
import random
import struct
import sys
import zlib
from pathlib import Path


def grains_at_rest(count, seed=1):
    """Places on a lattice, a little disordered, in a bed 4 m long and 0.8 m wide [m]."""
    chance = random.Random(seed)
    apart = (4 * 0.8 * 0.3 / count) ** (1 / 3)
    across, along = int(0.8 / apart), int(4 / apart)
    off = lambda: chance.uniform(-0.15, 0.15)
    return sorted([(k // across % along + off()) * apart, (k % across + off()) * apart, (k // (across * along) + off()) * apart]
                  for k in range(count))


def after(place, wheel_x):
    """Where a grain is once the wheel's centre is at wheel_x: pressed down under its track, dragged forward a little."""
    x, y, z = place
    passed = min(1.0, max(0.0, (wheel_x + 0.2 - x) / 0.4))
    under = max(0.0, 1 - abs(y - 0.4) / 0.25)
    return x + 0.06 * passed * under * z / 0.3, y, z - 0.08 * passed * under * z / 0.3


def prism(radius, width, sides):
    """Vertices and triangles of a wheel."""
    points = [(radius * math.cos(2 * math.pi * k / sides), side * width / 2, radius * math.sin(2 * math.pi * k / sides))
              for side in (-1, 1) for k in range(sides)] + [(0, -width / 2, 0), (0, width / 2, 0)]
    faces = []
    for k in range(sides):
        n = (k + 1) % sides
        faces += [(k, n, sides + k), (n, sides + n, sides + k), (2 * sides, n, k), (2 * sides + 1, sides + k, sides + n)]
    return points, faces


def replay(count, frames):
    rest, step = grains_at_rest(count), 4.2 / 65535
    points, faces = prism(0.45, 0.3, 48)
    wheel = [[0.5 + 3.0 * f / (frames - 1), 0.4, 0.3 + 0.45 - 0.05] for f in range(frames)]
    header = {"format": "soilbin-replay/1", "title": "made for the test", "facts": [["seed", "1"]], "grains": count,
              "frames": frames, "vertices": len(points), "triangles": len(faces), "origin": [-0.05, -0.05, -0.1],
              "step": step, "surface": 0.3, "times": [0.04 * f for f in range(frames)], "wheel": wheel,
              "rotation": [[math.cos(x / 2), 0, math.sin(x / 2), 0] for x in ((c[0] - 0.5) / 0.45 for c in wheel)],
              "force": [[300 + 50 * math.sin(f), 10 * math.cos(f), 4000 + 200 * math.sin(2 * f)] for f in range(frames)],
              "torque": [[0, -900 - 30 * math.cos(f), 0] for f in range(frames)], "pressing": 400.0,
              "bin": {"lower": [0, 0, -0.05], "upper": [4, 0.8, 1e6], "periodic": [False, False, False]}}
    radius = 0.5 * (4 * 0.8 * 0.3 / count) ** (1 / 3)
    raw = b"".join(struct.pack("<f", radius) for _ in rest)
    raw += b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<3I", *f) for f in faces)
    before = [[0] * count for _ in range(3)]
    for centre in wheel:
        now = [after(place, centre[0]) for place in rest]
        for axis in range(3):
            changes = []
            for k in range(count):
                at = round((now[k][axis] - header["origin"][axis]) / step)
                change = (at - before[axis][k] + 32768) % 65536 - 32768  # modulo 2^16, as a signed number
                changes.append(change << 1 if change >= 0 else (-change << 1) - 1)
                before[axis][k] = at
            raw += bytes(c & 0xFF for c in changes) + bytes(c >> 8 for c in changes)
    for centre in wheel:  # most under the wheel, less around
        raw += bytes(int(255 * math.sqrt(math.exp(-20 * math.dist(place, (centre[0], 0.4, 0.3)) ** 2))) for place in rest)
    return json.dumps(header).encode() + b"\n" + zlib.compress(raw, 6)


if __name__ == "__main__":
    Path(sys.argv[1]).write_bytes(replay(int(sys.argv[2]) if len(sys.argv) > 2 else 50000,
                                         int(sys.argv[3]) if len(sys.argv) > 3 else 24))
