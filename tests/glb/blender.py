"""Imports GLB files into Blender and compares what it sees with what each file says: objects, size, UVs, materials."""

import json
import struct
import sys

import bpy
import numpy

# Blender 3.4 asks for a name that the numpy beside it in Debian no longer has.
if "bool" not in vars(numpy):
    numpy.bool = bool


def document(path):
    """The JSON of a GLB."""
    with open(path, "rb") as file:
        length = struct.unpack("<12xI4x", file.read(20))[0]
        return json.loads(file.read(length))


def expected(gltf):
    """Lowest and highest corner of all triangles, and what every mesh node has."""
    low, high, nodes, used = [float("inf")] * 3, [float("-inf")] * 3, {}, set()
    for node in (n for n in gltf["nodes"] if "mesh" in n):
        parts = gltf["meshes"][node["mesh"]]["primitives"]
        solid = [p for p in parts if p.get("mode", 4) == 4]
        for part in parts:
            position = gltf["accessors"][part["attributes"]["POSITION"]]
            low = [min(a, b) for a, b in zip(low, position["min"])]
            high = [max(a, b) for a, b in zip(high, position["max"])]
            used |= images(gltf, part)
        nodes[node["name"]] = {
            "uv": sum(k.startswith("TEXCOORD") for k in solid[0]["attributes"]) if solid else 0,
            "material": any("material" in p for p in parts),
        }
    return low, high, nodes, len(used)


def images(gltf, part):
    """Numbers of the images that a part is drawn with."""
    material = gltf["materials"][part["material"]] if "material" in part else {}
    base = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
    textures = [t["index"] for t in (base, material.get("normalTexture")) if t]
    return {gltf["textures"][t]["source"] for t in textures}


def seen():
    """The same as Blender has it; its z is up, and its -y is the front."""
    low, high, nodes = [float("inf")] * 3, [float("-inf")] * 3, {}
    for thing in (o for o in bpy.data.objects if o.type == "MESH"):
        for vertex in thing.data.vertices:
            x, y, z = thing.matrix_world @ vertex.co
            low = [min(a, b) for a, b in zip(low, (x, z, -y))]
            high = [max(a, b) for a, b in zip(high, (x, z, -y))]
        nodes[thing.name] = {"uv": len(thing.data.uv_layers), "material": any(thing.data.materials)}
    return low, high, nodes


def check(path):
    """Words for all that is wrong with a file."""
    gltf = document(path)
    if "EXT_meshopt_compression" in gltf.get("extensionsRequired", []) and bpy.app.version < (5, 2):
        print(f"{path}: blender {bpy.app.version_string}: packed, which it cannot read")
        return []
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    (low, high, nodes, count), (seen_low, seen_high, seen_nodes) = expected(gltf), seen()
    wrong = []
    if max(abs(a - b) for a, b in zip(low + high, seen_low + seen_high)) > 1e-3:
        wrong.append(f"size {seen_low} {seen_high} where the file has {low} {high}")
    if nodes != seen_nodes:
        wrong.append(f"objects {seen_nodes} where the file has {nodes}")
    dark = [image.name for image in bpy.data.images if 0 in image.size[:]]
    if len(bpy.data.images) < count or dark:
        wrong.append(f"{len(bpy.data.images)} images where the file shows {count}; without a size: {dark}")
    size = " x ".join(f"{1e3 * (b - a):.0f}" for a, b in zip(seen_low, seen_high))
    print(f"{path}: blender {bpy.app.version_string}: {len(seen_nodes)} objects, {size} mm; {'; '.join(wrong) or 'good'}")
    return wrong


if any([check(path) for path in sys.argv[sys.argv.index("--") + 1 :]]):
    sys.exit(1)
