"""Files that cannot be used: one clear line that names the file, nothing printed, nothing left behind."""

import json
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from simart_kit.errors import BadInputError
from simart_kit.loading import read_source
from simart_kit.pipeline import convert
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import box

from .mesh_files import SQUARE, SQUARE_FACES, box_dae, box_obj, gltf, save_glb, save_gltf, textured_square

Make = Callable[[Path], Path]
MODEL = b"<model xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02'>"


def text(name: str, content: str | bytes) -> Make:
    def make(folder: Path) -> Path:
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        return folder / name

    return make


def changed_gltf(change: Callable[[dict[str, Any]], object]) -> Make:
    def make(folder: Path) -> Path:
        header = gltf(SQUARE, SQUARE_FACES)
        change(header)
        return save_gltf(folder / "a.gltf", header)

    return make


def picture_at(uri: str) -> Make:
    return lambda folder: save_gltf(folder / "a.gltf", textured_square(uri))


def buffer_at(uri: str) -> Make:
    return changed_gltf(lambda header: header["buffers"][0].update(uri=uri))


def cut(kind: str, keep: float) -> Make:
    """A file that ends after a part of its bytes."""

    def make(folder: Path) -> Path:
        vertices, faces = box((0, 0, 0), (1, 1, 1))
        data = trimesh.Trimesh(vertices, faces, process=False).export(file_type=kind)
        assert isinstance(data, bytes)
        return text(f"a.{kind}", data[: int(keep * len(data))])(folder)

    return make


def broken_vertices(kind: str, value: float) -> Make:
    def make(folder: Path) -> Path:
        vertices, faces = box((0, 0, 0), (1, 1, 1))
        vertices[[2, 5], 1] = value
        path = folder / f"a.{kind}"
        if kind == "glb":
            return save_glb(path, gltf(vertices, faces))
        if kind == "usda":
            points = ", ".join(f"({x}, {y}, {z})" for x, y, z in vertices.tolist())
            return usda(points, [3] * 12, faces.ravel().tolist())(folder)
        if kind == "ply":
            trimesh.Trimesh(vertices, faces, process=False).export(path)
            return path
        rows = "".join(f"v {x} {y} {z}\n" for x, y, z in vertices)
        return text(f"a.{kind}", rows + "".join(f"f {a} {b} {c}\n" for a, b, c in faces + 1))(folder)

    return make


def archive(name: str, entries: dict[str, bytes]) -> Make:
    def make(folder: Path) -> Path:
        with zipfile.ZipFile(folder / name, "w", zipfile.ZIP_DEFLATED) as file:
            for entry, data in entries.items():
                file.writestr(entry, data)
        return folder / name

    return make


def usda(points: str, counts: list[int], indices: list[int]) -> Make:
    return text(
        "a.usda",
        '#usda 1.0\ndef Mesh "m" {\n'
        f"point3f[] points = [{points}]\nint[] faceVertexCounts = {counts}\n"
        f"int[] faceVertexIndices = {indices}\n}}",
    )


def usda_line(line: str) -> Make:
    return text("a.usda", f"#usda 1.0\n{line}\n")


def sparse(header: dict[str, Any]) -> None:
    del header["accessors"][0]["bufferView"]
    header["accessors"][0]["sparse"] = {"count": 1}


TRIANGLE = "(0, 0, 0), (1, 0, 0), (0, 1, 0)"
BOMB = '<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>'

BAD: dict[str, tuple[Make, str]] = {
    # GLB and glTF
    "zero bytes": (text("a.glb", ""), "empty"),
    "text named glb": (text("a.glb", "hello, I am not a mesh"), "not a GLB"),
    "glb of eight bytes": (text("a.glb", b"glTF\x02\0\0\0"), "cut off"),
    "glb cut in its header": (cut("glb", 0.3), "cut off"),
    "glb cut in its data": (cut("glb", 0.9), "cut off"),
    "glb version 1": (text("a.glb", b"glTF" + struct.pack("<IIII", 1, 20, 0, 0)), "glTF 2.0"),
    "gltf that is no json": (text("a.gltf", "{nonsense"), "cannot be read as GLTF"),
    "gltf version 1 that says so": (text("a.gltf", '{"asset": {"version": "1.0"}}'), "version 1, which"),
    "gltf version 1 by its objects": (text("a.gltf", '{"asset": {}, "meshes": {"a": 1}}'), "glTF 2.0"),
    "glb with a first chunk of another kind": (
        text("a.glb", b"glTF" + struct.pack("<IIII", 2, 20, 0, 0)),
        "not JSON",
    ),
    "gltf of triangle fans": (
        text("a.gltf", '{"asset": {}, "meshes": [{"primitives": [{"attributes": {}, "mode": 6}]}]}'),
        "triangle fans",
    ),
    "gltf that is a list": (text("a.gltf", "[1, 2]"), "not glTF"),
    "gltf nested too deep": (text("a.gltf", "[" * 100_000), "cannot be read as GLTF"),
    "buffer missing": (buffer_at("gone.bin"), "'gone.bin'.*not in its folder"),
    "buffer outside": (buffer_at("../secret.bin"), r"'\.\./secret\.bin'.*outside"),
    "buffer at an absolute path": (buffer_at("/etc/hostname"), "'/etc/hostname'.*outside"),
    "buffer outside in disguise": (buffer_at("%2e%2e/secret.bin"), r"'%2e%2e/secret\.bin'"),
    "buffer at a url": (buffer_at("http://localhost/a.bin"), "'http://localhost/a.bin'"),
    "buffer shorter than it says": (buffer_at("data:;base64,AAAA"), "do not fit together"),
    "picture missing": (picture_at("gone.png"), "'gone.png'.*not in its folder"),
    "picture outside": (picture_at("../secret.bin"), r"'\.\./secret\.bin'.*outside"),
    "index out of range": (
        changed_gltf(lambda h: h.update(gltf(SQUARE, [[0, 1, 99]]))),
        "face index 99 .* 4 vert",
    ),
    "no faces": (changed_gltf(lambda h: h.pop("scenes")), "no faces"),
    "no meshes at all": (text("a.gltf", json.dumps({"asset": {"version": "2.0"}})), "no faces"),
    "compressed": (
        changed_gltf(lambda h: h.update(extensionsRequired=["KHR_draco_mesh_compression"])),
        "KHR_draco_mesh_compression",
    ),
    "sparse": (changed_gltf(sparse), "POSITION sparse"),
    "normalized": (
        changed_gltf(lambda h: h["accessors"][0].update(normalized=True)),
        "POSITION as normalized",
    ),
    "accessor that is not there": (
        changed_gltf(lambda h: h["accessors"].pop()),
        "refers to what it does not have",
    ),
    "nan": (broken_vertices("glb", np.nan), "2 of 8 vertices are NaN or infinite"),
    "infinity": (broken_vertices("glb", np.inf), "2 of 8 vertices are NaN or infinite"),
    "far too large": (
        lambda folder: save_glb(folder / "a.glb", gltf(SQUARE * 1e30, SQUARE_FACES)),
        "1.41e\\+30 m across",
    ),
    "no surface": (lambda folder: save_glb(folder / "a.glb", gltf(SQUARE, [[0, 1, 1]])), "surface of 0 m2"),
    # OBJ
    "obj without anything": (text("a.obj", "# nothing here\n"), "no faces"),
    "obj of points": (text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "no faces"),
    "obj index out of range": (text("a.obj", box_obj() + "f 1 2 99\n"), "cannot be read as OBJ.*index 98"),
    "obj index out of range backwards": (
        text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9\n"),
        "face index -9 .* 3 vert",
    ),
    "obj index zero": (text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"), "face index 0"),
    "obj of letters": (text("a.obj", "v 0 0 zero\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "cannot be read as OBJ"),
    "obj nan": (broken_vertices("obj", np.nan), "2 of 8 vertices are NaN or infinite"),
    # PLY, STL, OFF
    "ply nan": (broken_vertices("ply", np.inf), "2 of 8 vertices are NaN or infinite"),
    "ply cut": (cut("ply", 0.8), "cannot be read as PLY"),
    "ply of text": (text("a.ply", "hello"), "cannot be read as PLY"),
    "stl cut": (cut("stl", 0.8), "no faces|cannot be read as STL"),
    "stl of no triangles": (text("a.stl", b"\0" * 84), "no faces"),
    "off index out of range": (
        text("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
        "outside the range",
    ),
    "off of text": (text("a.off", "hello"), "cannot be read as OFF"),
    # DAE and 3MF
    "dae entity bomb": (text("a.dae", box_dae("1", "Y_UP").replace("?>", "?>" + BOMB)), "DOCTYPE"),
    "dae cut": (text("a.dae", box_dae("1", "Y_UP")[:600]), "cannot be read as DAE"),
    "dae with no unit to speak of": (text("a.dae", box_dae("0", "Y_UP")), "m a unit"),
    "3mf that is no zip": (text("a.3mf", "hello"), "not a zip"),
    "3mf bomb": (archive("a.3mf", {"3D/3dmodel.model": b" " * 30_000_000}), "zip bomb"),
    "3mf of many files": (archive("a.3mf", {f"{i}.txt": b"" for i in range(1001)}), "1001 files"),
    "3mf with an archive": (
        archive("a.3mf", {"3D/3dmodel.model": MODEL, "more.zip": b""}),
        "another archive",
    ),
    "3mf without a model": (archive("a.3mf", {"readme.txt": b"hello"}), "cannot be read as 3MF"),
    # USD
    "usda of text": (text("a.usda", "hello"), "not a valid usda layer"),
    "usda cut": (usda_line('def Mesh "m" { point3f[] points = [(0, 0'), "not readable as USD"),
    "usdc cut": (text("a.usdc", b"PXR-USDC" + b"\0" * 20), "not readable as USD"),
    "usdz that is no zip": (text("a.usdz", "hello"), "not a zip"),
    "usdz bomb": (archive("a.usdz", {"a.usda": b"#usda 1.0\n" + b" " * 30_000_000}), "zip bomb"),
    "usd without meshes": (usda_line('def Xform "x" {}'), "no faces"),
    "usd layer missing": (usda_line('def "x" (references = @./gone.usda@) {}'), r"'\./gone\.usda'"),
    "usd layer outside": (usda_line('def "x" (references = @../secret.usda@) {}'), r"'\.\./secret\.usda'"),
    "usd payload outside": (usda_line('def "x" (payload = @/etc/hostname@) {}'), "'/etc/hostname'"),
    "usd index out of range": (usda(TRIANGLE, [3], [0, 1, 9]), "face index 9 of mesh /m.*3 points"),
    "usd counts that do not add up": (usda(TRIANGLE, [4], [0, 1, 2]), "4 face corners but has 3"),
    "usd nan": (broken_vertices("usda", np.nan), "2 of 8 vertices are NaN or infinite"),
    # anything
    "unknown extension": (text("a.blend", "BLENDER"), "no plugin reads '.blend' files.*glb"),
    "no extension": (text("mesh", "what"), "no plugin reads 'mesh' files"),
}


@pytest.fixture(scope="module")
def plugins() -> Plugins:
    return Plugins(installed=False, load=())


@pytest.fixture
def inbox(tmp_path: Path) -> Path:
    """The folder of the bad file, beside readable files that it has no business with."""
    (tmp_path / "secret.bin").write_bytes(b"\0" * 200)
    (tmp_path / "secret.usda").write_text('#usda 1.0\ndef "x" {}\n')
    (tmp_path / "inbox").mkdir()
    return tmp_path / "inbox"


@pytest.mark.parametrize("name", BAD)
def test_one_line_says_what_is_wrong_with_which_file(
    name: str, inbox: Path, plugins: Plugins, capfd: pytest.CaptureFixture[str]
) -> None:
    make, said = BAD[name]
    path = make(inbox)
    with pytest.raises(BadInputError, match=said) as caught:
        read_source(path, plugins)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert "\n" not in message
    assert len(message) < 400
    assert caught.value.exit_code == 2
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    "name", ["zero bytes", "glb cut in its data", "nan", "buffer outside", "unknown extension"]
)
def test_a_run_on_a_bad_file_leaves_nothing_behind(name: str, inbox: Path, plugins: Plugins) -> None:
    make, said = BAD[name]
    path = make(inbox)
    before = sorted(inbox.parent.rglob("*"))
    with pytest.raises(BadInputError, match=said):
        convert(path, "default", out=inbox / "deep" / "out", plugins=plugins)
    assert sorted(inbox.parent.rglob("*")) == before


@pytest.mark.parametrize(("name", "said"), [("gone.glb", "no such file"), ("inbox", "folder")])
def test_a_path_that_is_no_file(name: str, said: str, inbox: Path, plugins: Plugins) -> None:
    with pytest.raises(BadInputError, match=said):
        convert(inbox.parent / name, "default", out=inbox / "out", plugins=plugins)
    assert list(inbox.iterdir()) == []


@pytest.mark.parametrize("unit", ["mile", 0, -1, float("nan")])
def test_units_that_make_no_sense(unit: str | float, inbox: Path, plugins: Plugins) -> None:
    path = text("a.obj", box_obj())(inbox)
    with pytest.raises(BadInputError, match="metres a unit"):
        read_source(path, plugins, unit=unit)


def test_a_layer_of_usd_through_a_link_out_of_the_folder(inbox: Path, plugins: Plugins) -> None:
    (inbox / "inside.usda").symlink_to(inbox.parent / "secret.usda")
    path = usda_line('def "x" (references = @./inside.usda@) {}')(inbox)
    with pytest.raises(BadInputError, match=r"'\./inside\.usda'"):
        read_source(path, plugins)


def test_a_usd_texture_outside_the_folder(inbox: Path, plugins: Plugins) -> None:
    path = usda_line(
        f"""def Mesh "m" (prepend apiSchemas = ["MaterialBindingAPI"]) {{
        point3f[] points = [{TRIANGLE}]
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        rel material:binding = </paint>
        }}
        def Material "paint" {{
        token outputs:surface.connect = </paint/surface.outputs:surface>
        def Shader "surface" {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </paint/picture.outputs:rgb>
        token outputs:surface
        }}
        def Shader "picture" {{
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @../secret.bin@
        float3 outputs:rgb
        }}
        }}"""
    )(inbox)
    with pytest.raises(BadInputError, match=r"'\.\./secret\.bin'.*outside"):
        read_source(path, plugins)
