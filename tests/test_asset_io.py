"""asset.json and parts.npz: nothing is lost on the way, and a wrong edit is named."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.asset_io import ARRAYS_FILE, ASSET_FILE, load_asset, save_asset, save_value
from simart_kit.errors import BadInputError
from simart_kit.mesh import Image, Mesh, Note, VisualMaterial
from simart_kit.normals import with_normals
from simart_kit.testing.fingerprint import fingerprint, folder_fingerprint
from simart_kit.testing.meshes import cabinet_asset, cabinet_mesh, chain_asset, static_asset

Table = dict[str, Any]


def picture(value: int) -> Image:
    return Image.from_pixels(np.full((4, 6, 4), value, dtype=np.uint8))


def full_asset() -> sk.Asset:
    """The cabinet with something other than the default in every field that is kept."""
    asset = cabinet_asset()
    rng = np.random.default_rng(1)
    mesh = with_normals(asset.mesh)
    looks = (
        VisualMaterial("painted", (0.1, 0.2, 0.3, 0.4), 0.5, 0.6, picture(10), picture(20), picture(30)),
        VisualMaterial("bare", (1.0, 0.5, 1 / 3, 1.0), 1.0, 0.0),
        VisualMaterial("bumpy", normal_image=picture(40)),
    )
    mesh = replace(
        mesh,
        colors=rng.integers(0, 256, (len(mesh.vertices), 4), dtype=np.uint8),
        materials=looks,
        face_material=np.arange(108) % 3,
        face_node=np.arange(108) // 12,
    )
    door = replace(
        asset.joint("door_hinge"),
        effort=7.5,
        velocity=0.25,
        confidence=0.625,
        evidence=("handle on the right", "höher als breit"),
        flags=("sweep: blocked after 3 degrees",),
    )
    body = replace(
        asset.part("body"), description="Korpus \u2603", material=sk.Material("oak", 710.5, 0.25, 0.75)
    )
    source = np.array([[0.0, -0.01, 0.0, 1.5], [0.01, 0, 0, -2.0], [0, 0, 0.01, 1 / 7], [0, 0, 0, 1]])
    return replace(
        asset.with_joints({"door_hinge": door}).with_parts({"body": body}),
        mesh=mesh,
        asset_from_source=source,
        scale=sk.Scale(0.01, "the file is in centimetres"),
        floating=True,
        notes=(Note("load", "warning", "a texture is missing"), Note("mass", "info", "guessed")),
    )


def other_joints() -> sk.Asset:
    """The chain with the kinds of joint that the cabinet has not."""
    asset = chain_asset()
    ball = sk.Joint("arm_hinge", "ball", "post", "arm", (0.1, 0.2, 0.3))
    free = sk.Joint("post_spin", "free", "base", "post")
    return asset.with_joints({"arm_hinge": ball, "post_spin": free})


@pytest.mark.parametrize(
    "make",
    [full_asset, cabinet_asset, chain_asset, static_asset, other_joints, lambda: cabinet_asset(False, False)],
)
def test_every_field_and_bit_comes_back(make: Callable[[], sk.Asset], tmp_path: Path) -> None:
    asset = make()
    assert save_asset(asset, tmp_path) == tmp_path / ASSET_FILE
    assert fingerprint(load_asset(tmp_path)) == fingerprint(asset)


def test_textures_come_back_as_pictures(tmp_path: Path) -> None:
    save_asset(full_asset(), tmp_path)
    painted, bare, bumpy = load_asset(tmp_path).mesh.materials
    assert painted.base_color_image is not None
    assert (painted.base_color_image.pixels == 10).all()
    assert painted.metallic_roughness_image is not None
    assert (painted.metallic_roughness_image.pixels == 20).all()
    assert bare.base_color_image is None
    assert bumpy.normal_image is not None
    assert bumpy.normal_image.pixels.shape == (4, 6, 4)


def test_the_same_asset_gives_the_same_bytes(tmp_path: Path) -> None:
    save_asset(full_asset(), tmp_path / "one")
    save_asset(full_asset(), tmp_path / "two")
    assert folder_fingerprint(tmp_path / "one") == folder_fingerprint(tmp_path / "two")


def test_saving_what_was_loaded_gives_the_same_bytes(tmp_path: Path) -> None:
    save_asset(full_asset(), tmp_path / "one")
    save_asset(load_asset(tmp_path / "one"), tmp_path / "two")
    assert folder_fingerprint(tmp_path / "one") == folder_fingerprint(tmp_path / "two")


def test_an_edit_by_hand_takes_effect(tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    edit(tmp_path, lambda t: t["joints"][0]["limits"].update(lower=-2, upper=0.25))
    edit(tmp_path, lambda t: t["parts"][1].update(label="flap"))
    edit(tmp_path, lambda t: t["joints"].reverse())
    asset = load_asset(tmp_path)
    assert asset.joint("door_hinge").limits == sk.Limits(-2.0, 0.25)
    assert asset.part("door").label == "flap"
    assert [j.name for j in asset.joints] == ["drawer_slide", "door_hinge"]


def test_fields_with_a_default_may_be_left_out(tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    edit(tmp_path, lambda t: t["joints"][0].pop("damping"))
    edit(tmp_path, lambda t: t.pop("notes"))
    assert load_asset(tmp_path).joint("door_hinge").damping == 0.0


def edit(folder: Path, change: Callable[[Table], object]) -> None:
    path = folder / ASSET_FILE
    table = json.loads(path.read_text(encoding="utf-8"))
    change(table)
    path.write_text(json.dumps(table), encoding="utf-8")


MISTAKES: dict[str, tuple[Callable[[Table], object], str]] = {
    "axis not unit": (
        lambda t: t["joints"][0].update(axis=[0, 0, 2]),
        "joint 'door_hinge': axis (0.0, 0.0, 2.0) is not a unit vector",
    ),
    "axis too short": (lambda t: t["joints"][0].update(axis=[0, 1]), "joints.0.axis"),
    "axis a word": (lambda t: t["joints"][0].update(axis="z"), "joints.0.axis"),
    "limits reversed": (
        lambda t: t["joints"][1].update(limits={"lower": 0.3, "upper": 0.0}),
        "joints.1.limits.lower",
    ),
    "limits missing": (
        lambda t: t["joints"][1].pop("limits"),
        "joint 'drawer_slide': a prismatic joint needs limits",
    ),
    "limits of a fixed joint": (
        lambda t: t["joints"][1].update(kind="fixed"),
        "joint 'drawer_slide': a fixed joint takes no limits",
    ),
    "kind unknown": (lambda t: t["joints"][0].update(kind="hinge"), "joints.0.kind"),
    "unknown parent": (
        lambda t: t["joints"][0].update(parent="bdy"),
        "joint 'door_hinge' names part 'bdy': parts are body, door, drawer",
    ),
    "loop": (
        lambda t: (t["joints"][0].update(parent="drawer"), t["joints"][1].update(parent="door")),
        "the joints form a loop",
    ),
    "own parent": (
        lambda t: t["joints"][0].update(parent="door"),
        "the joints form a loop through part 'door'",
    ),
    "two roots": (lambda t: t["joints"].pop(), "needs one root part, found body, drawer"),
    "moved twice": (lambda t: t["joints"][1].update(child="door"), "joint child name used twice: door"),
    "joint name twice": (
        lambda t: t["joints"][1].update(name="door_hinge"),
        "joint name used twice: door_hinge",
    ),
    "name with a space": (lambda t: t["parts"][0].update(name="the body"), "name 'the body'"),
    "NaN in an origin": (lambda t: t["joints"][0].update(origin=[0, float("nan"), 0]), "joints.0.origin.1"),
    "NaN in a centre": (lambda t: t["parts"][0]["mass"].update(center=[0, 0, float("nan")]), "mass.center.2"),
    "NaN in a matrix": (lambda t: t["asset_from_source"][1].__setitem__(2, float("nan")), "source.1.2"),
    "infinite damping": (lambda t: t["joints"][0].update(damping=float("inf")), "joints.0.damping"),
    "negative damping": (lambda t: t["joints"][0].update(damping=-1), "joints.0.damping"),
    "confidence": (lambda t: t["joints"][0].update(confidence=1.5), "joints.0.confidence"),
    "mass of nothing": (lambda t: t["parts"][2]["mass"].update(mass=0), "parts.2.mass.mass"),
    "density": (lambda t: t["parts"][2]["material"].update(density=-5), "parts.2.material.density"),
    "extra key": (lambda t: t["joints"][1].update(stiffness=3), "joints.1.stiffness"),
    "extra key on top": (lambda t: t.update(colour="red"), "colour: Extra inputs are not permitted"),
    "missing key": (lambda t: t["joints"][1].pop("child"), "joints.1.child: Field required"),
    "missing parts": (lambda t: t.pop("parts"), "parts: Field required"),
    "matrix of three rows": (lambda t: t["asset_from_source"].pop(), "asset_from_source.3"),
    "later version": (lambda t: t.update(schema=2), "schema: Input should be 1"),
    "part removed": (lambda t: (t["parts"].pop(), t["joints"].pop()), "face_part uses ids [0, 1, 2]"),
    "more shapes than stored": (lambda t: t["parts"][0].update(collision_shapes=6), "collision_0_5_vertices"),
    "material removed": (
        lambda t: t["visual_materials"].clear(),
        "face_material must lie in 0..-1",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_in_an_edited_file_is_named(name: str, tmp_path: Path) -> None:
    change, said = MISTAKES[name]
    save_asset(cabinet_asset(), tmp_path)
    edit(tmp_path, change)
    with pytest.raises(BadInputError) as caught:
        load_asset(tmp_path)
    told = str(caught.value)
    assert said in told
    assert str(tmp_path) in told
    assert "\n" not in told


def test_all_mistakes_of_the_fields_are_told_at_once(tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    edit(tmp_path, lambda t: (t["joints"][0].update(damping=-1, extra=0), t["scale"].pop("reason")))
    with pytest.raises(BadInputError) as caught:
        load_asset(tmp_path)
    for field in ("joints.0.damping", "joints.0.extra", "scale.reason"):
        assert field in str(caught.value)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "file: Invalid JSON"),
        (b'{"schema": 1,', "file: Invalid JSON"),
        (b"[]", "file: Input should be an object"),
        (b"\xff\xfe\x00", "cannot read"),
    ],
)
def test_a_file_that_is_no_asset(content: bytes, said: str, tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    (tmp_path / ASSET_FILE).write_bytes(content)
    with pytest.raises(BadInputError, match=said):
        load_asset(tmp_path)


def test_a_folder_without_an_asset(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match=r"has no asset.json: give the output folder of a conversion"):
        load_asset(tmp_path)
    with pytest.raises(BadInputError, match=r"has no asset.json"):
        load_asset(str(tmp_path / "nowhere"))


@pytest.mark.parametrize("content", [None, b"", b"text", b"PK\x03\x04broken"])
def test_arrays_that_are_missing_or_broken(content: bytes | None, tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    arrays = tmp_path / ARRAYS_FILE
    arrays.unlink() if content is None else arrays.write_bytes(content)
    with pytest.raises(BadInputError, match=ARRAYS_FILE):
        load_asset(tmp_path)


def test_a_truncated_array_file(tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    whole = (tmp_path / ARRAYS_FILE).read_bytes()
    for size in range(0, len(whole), 997):
        (tmp_path / ARRAYS_FILE).write_bytes(whole[:size])
        with pytest.raises(BadInputError, match=ARRAYS_FILE):
            load_asset(tmp_path)


def test_a_damaged_array_file(tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    whole = bytearray((tmp_path / ARRAYS_FILE).read_bytes())
    for start in range(0, len(whole), 997):
        broken = whole.copy()
        broken[start : start + 40] = bytes(value ^ 0x5A for value in whole[start : start + 40])
        (tmp_path / ARRAYS_FILE).write_bytes(broken)
        with pytest.raises(BadInputError, match=ARRAYS_FILE):
            load_asset(tmp_path)


def test_arrays_of_another_asset(tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    save_asset(chain_asset(), tmp_path / "chain")
    (tmp_path / "chain" / ARRAYS_FILE).replace(tmp_path / ARRAYS_FILE)
    with pytest.raises(BadInputError, match="collision_0_1_vertices"):
        load_asset(tmp_path)


@pytest.mark.parametrize(
    ("name", "values", "said"),
    [
        ("vertices", np.zeros((72, 2)), "vertices has shape (72, 2)"),
        ("vertices", np.full((72, 3), np.nan), "NaN or infinite"),
        ("faces", np.full((108, 3), 99), "face index 99 is out of range"),
        ("face_part", np.zeros(7, dtype=int), "face_part has shape (7,)"),
        ("uv", np.zeros((5, 2)), "uv has shape (5, 2)"),
        ("face_part", np.array(["a"] * 108), "no numbers in face_part"),
        ("faces", None, "faces"),
        ("face_part", None, "face_part"),
    ],
)
def test_a_wrong_array_is_named(name: str, values: Any, said: str, tmp_path: Path) -> None:
    save_asset(cabinet_asset(), tmp_path)
    with np.load(tmp_path / ARRAYS_FILE) as archive:
        arrays = {key: archive[key] for key in archive.files if key != name}
    if values is not None:
        arrays[name] = values
    np.savez(tmp_path / ARRAYS_FILE, **arrays)
    with pytest.raises(BadInputError) as caught:
        load_asset(tmp_path)
    assert said in str(caught.value)


def test_what_the_format_does_not_allow_is_not_written(tmp_path: Path) -> None:
    asset = cabinet_asset()
    door = asset.part("door")
    assert door.mass is not None
    for mass, said in (
        (replace(door.mass, mass=0.0), "parts.1.mass.mass: Input should be greater than 0"),
        (replace(door.mass, center=(0.0, float("nan"), 0.0)), "parts.1.mass.center.1"),
    ):
        with pytest.raises(BadInputError, match=f"asset 'cabinet' cannot be stored: {said}"):
            save_asset(asset.with_parts({"door": replace(door, mass=mass)}), tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_the_input_of_a_failed_stage_can_be_looked_into(tmp_path: Path) -> None:
    mesh = cabinet_mesh()
    save_value(mesh, tmp_path / "mesh")
    with np.load(tmp_path / "mesh" / "mesh.npz") as arrays:
        np.testing.assert_array_equal(arrays["faces"], mesh.faces)
        assert Image(arrays["material_0_base_color_image"].tobytes()).pixels.shape == (8, 8, 4)
    labels = np.repeat([0, 1, 2], [60, 24, 24])
    parts = tuple(sk.PartGuess(n) for n in ("body", "door", "drawer"))
    save_value(sk.Segmentation(labels, parts), tmp_path / "segmentation")
    with np.load(tmp_path / "segmentation" / "segmentation.npz") as arrays:
        np.testing.assert_array_equal(arrays["face_part"], labels)
        assert arrays["parts"].tolist() == ["body", "door", "drawer"]
    save_value(chain_asset(), tmp_path / "asset")
    assert load_asset(tmp_path / "asset").name == "chain"


def test_an_asset_without_extras_has_a_plain_mesh(tmp_path: Path) -> None:
    mesh = Mesh(static_asset().mesh.vertices, static_asset().mesh.faces)
    save_asset(replace(static_asset(), mesh=mesh), tmp_path)
    again = load_asset(tmp_path).mesh
    assert again.normals is None
    assert again.uv is None
    assert again.colors is None
    assert again.face_node is None
    assert fingerprint(again.materials) == fingerprint((VisualMaterial(),))
