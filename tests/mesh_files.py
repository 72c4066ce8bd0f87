"""Mesh files written by hand, so that what is read back owes nothing to another library's writer."""

import base64
import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image as Pillow

CORNER_COLORS = {  # of `corners_picture`, by texture coordinate, origin bottom left
    (0.0, 0.0): (255, 0, 0),
    (1.0, 0.0): (0, 255, 0),
    (0.0, 1.0): (0, 0, 255),
    (1.0, 1.0): (255, 255, 0),
}
# A unit square in the plane z = 0, and the texture coordinates (origin bottom left) of its corners.
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
SQUARE_FACES = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32)


def corners_picture(kind: str = "PNG") -> bytes:
    """A picture of four squares: red bottom left, green bottom right, blue top left, yellow top right."""
    pixels = np.zeros((32, 32, 3), dtype=np.uint8)
    pixels[:16, :16], pixels[:16, 16:] = CORNER_COLORS[0.0, 1.0], CORNER_COLORS[1.0, 1.0]
    pixels[16:, :16], pixels[16:, 16:] = CORNER_COLORS[0.0, 0.0], CORNER_COLORS[1.0, 0.0]
    stream = io.BytesIO()
    Pillow.fromarray(pixels).save(stream, kind)
    return stream.getvalue()


def gltf(vertices: Any, faces: Any, **attributes: Any) -> dict[str, Any]:
    """Header of a glTF with one node and one primitive, its data in the header; float32 attributes."""
    arrays = {"POSITION": np.asarray(vertices, dtype=np.float32)}
    arrays |= {name: np.asarray(values, dtype=np.float32) for name, values in attributes.items()}
    arrays["indices"] = np.asarray(faces, dtype=np.uint32).ravel()
    data = b"".join(array.tobytes() for array in arrays.values())
    starts = np.cumsum([0] + [array.nbytes for array in arrays.values()]).tolist()
    kinds = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "node", "mesh": 0}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {n: i for i, n in enumerate(arrays) if n != "indices"},
                        "indices": len(arrays) - 1,
                    }
                ]
            }
        ],
        "accessors": [
            {
                "bufferView": index,
                "componentType": 5125 if name == "indices" else 5126,
                "count": len(array),
                "type": kinds[1 if array.ndim == 1 else array.shape[1]],
            }
            for index, (name, array) in enumerate(arrays.items())
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": array.nbytes}
            for start, array in zip(starts, arrays.values(), strict=False)
        ],
        "buffers": [{"byteLength": len(data), "uri": data_uri(data)}],
    }


def textured_square(picture: str, **material: Any) -> dict[str, Any]:
    """Header of a square with a texture at this uri; glTF counts texture rows from the top."""
    uv = np.column_stack([SQUARE[:, 0], 1 - SQUARE[:, 1]])
    header = gltf(SQUARE, SQUARE_FACES, TEXCOORD_0=uv)
    header["images"], header["textures"] = [{"uri": picture}], [{"source": 0}]
    surface = {"baseColorTexture": {"index": 0}, "metallicFactor": 0.0}
    header["materials"] = [{"name": "paint", "pbrMetallicRoughness": surface} | material]
    header["meshes"][0]["primitives"][0]["material"] = 0
    return header


def data_uri(data: bytes) -> str:
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


def save_gltf(path: Path, header: dict[str, Any]) -> Path:
    path.write_text(json.dumps(header))
    return path


def save_glb(path: Path, header: dict[str, Any]) -> Path:
    """As one binary file, whose data stays in the header."""
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(
        b"glTF" + struct.pack("<II", 2, 20 + len(text)) + struct.pack("<I4s", len(text), b"JSON") + text
    )
    return path


def box_obj() -> str:
    """A unit cube of quads, counter-clockwise from outside."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(
        f"f {a} {b} {c} {d}\n" for a, b, c, d in quads
    )


def box_dae(unit: str, up_axis: str, frame: bool = True) -> str:
    """A tetrahedron of 100 x 50 x 200 file units below a node that lifts it by 10 along y."""
    asset = f'<asset><unit meter="{unit}"/><up_axis>{up_axis}</up_axis></asset>' if frame else ""
    points = "0 0 0 100 0 0 0 50 0 0 0 200"
    triangles = "0 2 1 0 1 3 1 2 3 0 3 2"
    accessor = "".join(f'<param name="{n}" type="float"/>' for n in "XYZ")
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">{asset}
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">{points}</float_array>
<technique_common><accessor source="#pa" count="4" stride="3">{accessor}</accessor></technique_common>
</source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>{triangles}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><translate>0 10 0</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
