"""URDF as a source: what an asset cannot say is told, and damage is refused in one line."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from simart_kit.asset import Limits
from simart_kit.errors import BadInputError

from .adapter_cases import BASE, BOX, joint, limit, load, write

LID = f'<link name="lid">{BOX}</link>'


@pytest.mark.parametrize(
    ("kind", "inner", "found", "told"),
    [
        ("floating", "", ("free", None), None),
        ("planar", "", ("free", None), "is left free"),
        ("revolute", "", ("revolute", Limits(-math.pi / 2, math.pi / 2)), "90 degrees either way"),
        ("prismatic", "", ("prismatic", Limits(-1.0, 1.0)), "1 m either way"),
        ("revolute", limit(1, -1), ("revolute", Limits(-1, 1)), "reversed"),
        ("revolute", f'{limit(0, 1)}<mimic joint="x"/>', ("revolute", Limits(0, 1)), "mimics"),
        ("continuous", limit(-1, 1), ("continuous", None), None),
    ],
)
def test_what_an_asset_cannot_say_is_told(
    kind: str, inner: str, found: tuple[str, Limits | None], told: str | None, tmp_path: Path
) -> None:
    asset = load(write(tmp_path, BASE, LID, joint("j", kind, "base", "lid", inner)))
    (only,) = asset.joints
    assert (only.kind, only.limits) == found
    warnings = [note.text for note in asset.notes if note.level == "warning"]
    assert len(warnings) == (told is not None)
    assert told is None or told in warnings[0]


def test_two_joints_in_a_row_keep_the_first_and_say_so(tmp_path: Path) -> None:
    asset = load(
        write(
            tmp_path, BASE, '<link name="helper"/>', f'<link name="Lid-1">{BOX}</link>',
            joint("slide", "prismatic", "base", "helper", limit(0, 1)),
            joint("turn", "continuous", "helper", "Lid-1"),
        )
    )  # fmt: skip
    (only,) = asset.joints
    assert (only.name, only.kind, only.child) == ("slide", "prismatic", "lid_1")
    texts = " ".join(note.text for note in asset.notes)
    assert "only the first, prismatic, is kept, not the continuous one" in texts
    assert "'Lid-1' is lid_1" in texts


def test_equal_masses_of_all_links_are_a_placeholder(tmp_path: Path) -> None:
    heavy = '<inertial><mass value="1.0"/></inertial>'
    links = [f'<link name="{name}">{BOX}{heavy}</link>' for name in ("base", "lid")]
    asset = load(write(tmp_path, *links, joint("j", "fixed", "base", "lid")))
    assert [part.stated_mass for part in asset.parts] == [None, None]
    assert any("placeholder" in note.text for note in asset.notes)
    one = load(write(tmp_path, links[0]))
    assert one.parts[0].stated_mass == 1.0


@pytest.mark.parametrize(
    ("elements", "told"),
    [
        (("<link",), "no well-formed XML"),
        (('<link name="a"/>',), "no link has a shape"),
        ((BASE, BASE), "two links are named 'base'"),
        ((BASE, joint("j", "fixed", "base", "lid")), "its child link 'lid' does not exist"),
        ((BASE, LID, joint("j", "screw", "base", "lid")), "type 'screw' is not"),
        ((BASE.replace('<box size="1 1 1"/>', '<mesh filename="no.obj"/>'),), "no such mesh file"),
        ((BASE.replace('<box size="1 1 1"/>', '<mesh filename="http://a/b.obj"/>'),), "download it"),
        ((BASE.replace('<box size="1 1 1"/>', '<mesh filename="thing.urdf"/>'),), "no mesh file: known are"),
        ((BASE.replace("1 1 1", "1 1"),), "should be 3 finite number(s)"),
        ((BASE.replace("<box", "<cone"),), "link 'base': a <visual> needs a <geometry> with one of"),
        (
            (
                BASE,
                LID,
                joint("j", "fixed", "base", "lid"),
                joint("k", "fixed", "lid", "base"),
            ),
            "loop",
        ),
        (
            (
                '<link name="world"/>',
                BASE,
                LID,
                joint("j", "continuous", "world", "base"),
                joint("k", "continuous", "world", "lid"),
            ),
            "nothing stands still",
        ),
        (
            (BASE, LID, joint("j", "continuous", "base", "lid", '<dynamics damping="-1"/>')),
            "damping -1.0 must be a finite number",
        ),
    ],
)  # fmt: skip
def test_damage_is_one_line_that_names_the_file(elements: tuple[str, ...], told: str, tmp_path: Path) -> None:
    path = write(tmp_path, *elements)
    with pytest.raises(BadInputError) as caught:
        load(path)
    assert told in str(caught.value)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)
