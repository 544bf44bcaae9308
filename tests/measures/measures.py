"""Takes measures of a garment anew, from its GLB alone and in plain Python, and compares them with measures.csv.

    python3 measures.py GLB MEASURES.csv…

The GLB needs the node `body` and texture coordinates in metres. Girths are cut by level planes at the heights of the
table; free edges are the edges of one triangle that is sewn to no other. Exit code 1 when a measure is 1 mm off.
"""

import csv
import json
import math
import struct
import sys

# Sewn vertices lie at one place, in single precision.
WELD = 2e-6
ALLOWED = 1.0
# Measures along lines of the garment; seams are found again by their length.
LINES = ["seam", "shoulder", "armhole", "hem", "neckline", "edge", "rise", "opening"]
# Measures of the balance are no lengths of lines.
BALANCE = ["above", "forward"]


def read(path):
    """Pieces and body: positions, metres of cloth (none for the body) and triangles, by node name."""
    data = open(path, "rb").read()
    size = struct.unpack("<I", data[12:16])[0]
    gltf, start = json.loads(data[20 : 20 + size]), 28 + size

    def numbers(index):
        a = gltf["accessors"][index]
        view = gltf["bufferViews"][a["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[a["type"]]
        letter, length = {5126: ("f", 4), 5123: ("H", 2), 5125: ("I", 4)}[a["componentType"]]
        begin = start + view.get("byteOffset", 0)
        flat = struct.unpack_from(f"<{a['count'] * width}{letter}", data, begin)
        return [flat[k : k + width] for k in range(0, len(flat), width)]

    out = {}
    for node in (n for n in gltf["nodes"] if "mesh" in n):
        part = gltf["meshes"][node["mesh"]]["primitives"][0]
        if part.get("mode", 4) != 4 or node["name"].endswith("wrong side"):
            continue
        corners = [c[0] for c in numbers(part["indices"])]
        at = part["attributes"]
        cloth = numbers(at["TEXCOORD_0"]) if "TEXCOORD_0" in at else None
        out[node["name"]] = (numbers(at["POSITION"]), cloth, list(zip(*[iter(corners)] * 3)))
    return out


def between(a, b, share):
    return tuple(x + share * (y - x) for x, y in zip(a, b))


def cut(positions, cloth, triangles, height):
    """Segments of a level plane through a mesh: both ends seen from above, and the length on the flat cloth."""
    out = []
    for triangle in triangles:
        ends = []
        for i, j in zip(triangle, triangle[1:] + triangle[:1]):
            low, high = positions[i][1] - height, positions[j][1] - height
            if (low < 0) != (high < 0):
                share = low / (low - high)
                x, _, z = between(positions[i], positions[j], share)
                ends.append(((x, z), between(cloth[i], cloth[j], share) if cloth else None))
        if len(ends) == 2:
            (a, flat_a), (b, flat_b) = ends
            out.append((a, b, math.dist(flat_a, flat_b) if cloth else math.dist(a, b)))
    return out


def rings(segments):
    """Groups of segments that hang together."""
    near, groups = {}, list(range(len(segments)))

    def root(k):
        while groups[k] != k:
            groups[k] = groups[groups[k]]
            k = groups[k]
        return k

    for k, (a, b, _) in enumerate(segments):
        for x, z in (a, b):
            cell = (round(x / (10 * WELD)), round(z / (10 * WELD)))
            for dx in (-1, 0, 1):
                for dz in (-1, 0, 1):
                    for other in near.get((cell[0] + dx, cell[1] + dz), []):
                        groups[root(k)] = root(other)
            near.setdefault(cell, []).append(k)
    found = {}
    for k, segment in enumerate(segments):
        found.setdefault(root(k), []).append(segment)
    return list(found.values())


def hull(points):
    """The convex hull of points, counter-clockwise."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def half(points):
        out = []
        for p in points:
            while len(out) > 1 and (out[-1][0] - out[-2][0]) * (p[1] - out[-2][1]) <= (out[-1][1] - out[-2][1]) * (
                p[0] - out[-2][0]
            ):
                out.pop()
            out.append(p)
        return out[:-1]

    return half(points) + half(points[::-1])


def tape(ring):
    corners = hull([p for a, b, _ in ring for p in (a, b)])
    return sum(math.dist(a, b) for a, b in zip(corners, corners[1:] + corners[:1]))


def holds(ring, point):
    """Does the hull of a ring hold a point?"""
    corners = hull([p for a, b, _ in ring for p in (a, b)])
    sides = zip(corners, corners[1:] + corners[:1])
    return all((b[0] - a[0]) * (point[1] - a[1]) >= (b[1] - a[1]) * (point[0] - a[0]) for a, b in sides)


def middle(ring):
    points = [p for a, b, _ in ring for p in (a, b)]
    return tuple(sum(p[k] for p in points) / len(points) for k in (0, 1))


def girths(parts, name, height):
    """Girths of body and cloth around the trunk at a height, metres."""
    skin = rings(cut(*parts["body"], height))
    # The trunk is the ring around the middle of the body; of two legs the left one lies at greater x.
    skin.sort(key=tape)
    own = skin[-1]
    if name.startswith("thigh"):
        side = 1 if "left" in name else -1
        own = max((r for r in skin if side * middle(r)[0] > 0), key=tape)
    cloth = [s for n, part in parts.items() if n != "body" for s in cut(*part, height)]
    around = [r for r in rings(cloth) if holds(r, middle(own))]
    worn = max(around, key=tape)
    along = sum(math.dist(a, b) for a, b, _ in worn)
    return {
        ("body", "tape"): tape(own),
        ("pattern", "surface"): sum(flat for _, _, flat in worn),
        ("drape", "surface"): along,
        ("drape", "tape"): tape(worn),
    }


class Cloth:
    """The cloth of all pieces, welded where it is sewn."""

    def __init__(self, parts):
        self.points, self.edges, self.count, known = [], {}, {}, {}
        for name, (positions, cloth, triangles) in parts.items():
            if name == "body":
                continue
            number = [self.weld(p, known) for p in positions]
            for t in triangles:
                for i, j in zip(t, t[1:] + t[:1]):
                    key = tuple(sorted((number[i], number[j])))
                    if key[0] != key[1]:
                        own = tuple(sorted((i, j)))
                        self.edges.setdefault(key, {})[(name, own)] = math.dist(cloth[i], cloth[j])
                        self.count[key] = self.count.get(key, 0) + 1

    def weld(self, p, known):
        cell = tuple(round(x / WELD) for x in p)
        for d in range(27):
            other = (cell[0] + d % 3 - 1, cell[1] + d // 3 % 3 - 1, cell[2] + d // 9 - 1)
            if other in known:
                return known[other]
        known[cell] = len(self.points)
        self.points.append(p)
        return known[cell]

    def worn(self, edge):
        return math.dist(self.points[edge[0]], self.points[edge[1]])

    def chains(self, edges):
        """Groups of edges that hang together."""
        beside = {}
        for e in edges:
            for v in e:
                beside.setdefault(v, []).append(e)
        out, seen = [], set()
        for start in edges:
            if start in seen:
                continue
            stack, group = [start], []
            while stack:
                e = stack.pop()
                if e in seen:
                    continue
                seen.add(e)
                group.append(e)
                stack.extend(o for v in e for o in beside[v])
            out.append(group)
        return out

    def free_edges(self):
        """Closed lines of edges that are sewn to nothing: mean height, lengths flat, and length worn, metres."""
        out = []
        for group in self.chains([e for e, n in self.count.items() if n == 1]):
            worn = [self.worn(e) for e in group]
            height = sum(0.5 * (self.points[a][1] + self.points[b][1]) * w for (a, b), w in zip(group, worn)) / sum(worn)
            out.append((height, [sum(sum(self.edges[e].values()) for e in group)], sum(worn)))
        return out

    def seams(self):
        """Sewn lines between two pieces, and all lines of one piece with others: lengths flat, and length worn, metres."""
        sewn = {}
        for e, sides in self.edges.items():
            if len(sides) > 1:
                sewn.setdefault(tuple(sorted(name for name, _ in sides)), []).append(e)
        lines = [(pair, group) for pair, edges in sewn.items() for group in self.chains(edges)]
        out = [self.lengths(pair, group) for pair, group in lines]
        for name in {n for pair in sewn for n in pair}:
            own = [e for pair, edges in sewn.items() for e in edges if name in pair and len(set(pair)) > 1]
            for group in self.chains(own):
                out.append(self.lengths((name,), group))
                others = [min(v for (n, _), v in self.edges[e].items() if n != name) for e in group]
                out.append((0.0, [sum(others)], out[-1][2]))
        return out

    def lengths(self, names, group):
        sides = [[[v for (n, _), v in self.edges[e].items() if n == name] for e in group] for name in names]
        flat = [sum(min(values) for values in side if values) for side in sides]
        return (0.0, flat, sum(self.worn(e) for e in group))


def found(row, parts, free, seams):
    """The measure of a row, taken anew, mm; None where this script cannot take it."""
    name, on, method, value = row["name"], row["on"], row["method"], float(row["value"])
    height = float(row["height_mm"]) / 1e3 if row["height_mm"] else None
    if name == "total_length":
        heights = [p[1] for n, part in parts.items() if n != "body" for p in part[0]]
        return 1e3 * (max(heights) - min(heights))
    if height is not None and (name.endswith("_girth") or name.startswith("thigh")):
        return 1e3 * girths(parts, name, height)[(on, method)]
    if on not in ("pattern", "drape") or not any(w in name for w in LINES) or any(w in name for w in BALANCE):
        return None
    lengths = [1e3 * x for _, flat, worn in free + seams for x in (flat if on == "pattern" else [worn])]
    return min(lengths, key=lambda x: abs(x - value), default=None)


def check(path, table):
    parts = read(path)
    cloth = Cloth(parts)
    free, seams = cloth.free_edges(), cloth.seams()
    worst, wrong, taken, left = 0.0, 0, 0, []
    for row in (r for r in csv.DictReader(open(table)) if r["unit"] == "mm"):
        anew = found(row, parts, free, seams)
        if anew is None:
            left.append(f"{row['name']} {row['on']}")
            continue
        off = anew - float(row["value"])
        taken, worst = taken + 1, max(worst, abs(off))
        if abs(off) > ALLOWED:
            wrong += 1
            print(f"{path}: {row['name']} {row['on']} {row['method']}: {anew:.1f} mm where the table has {row['value']} mm")
    told = f"; not taken: {', '.join(left)}" if left else ""
    print(f"{path}: {taken} measures, {worst:.2f} mm off at most: {'good' if taken and not wrong else 'BAD'}{told}")
    return wrong == 0 and taken > 0


pairs = list(zip(*[iter(sys.argv[1:])] * 2))
if not all([check(*pair) for pair in pairs]):
    sys.exit(1)
