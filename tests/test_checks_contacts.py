"""Checks of contact: `penetration`, `sweep` and `travel` bite at the place and depth worked out by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit import Subject
from simart_kit.asset import Asset, ConvexMesh, Limits

from .checks_cases import cabinet, judged, mjcf, subject_in

FORMATS = ("urdf", "mjcf", "usd")


def with_door_moved(shift: tuple[float, float, float]) -> Asset:
    """The cabinet with the collision shapes of its door elsewhere."""
    asset = cabinet()
    shapes = tuple(ConvexMesh(s.vertices + shift, s.faces) for s in asset.part("door").collision)
    return asset.with_parts({"door": replace(asset.part("door"), collision=shapes)})


def with_joint(name: str, **changes: object) -> Asset:
    asset = cabinet()
    return asset.with_joints({name: replace(asset.joint(name), **changes)})  # type: ignore[arg-type]


class TestPenetration:
    @pytest.mark.parametrize("kind", [*FORMATS, "asset"])
    def test_a_door_18_mm_in_the_frame(self, kind: str, tmp_path: Path) -> None:
        """It ends at x = -0.298, the side at -0.28; forwards it would have to move by 20 mm."""
        asset = with_door_moved((-0.023, 0.0, 0.0))
        subject = subject_in(tmp_path, asset, *([kind] if kind in FORMATS else []))
        result = judged("penetration", subject)
        assert not result.passed
        assert result.text == "overlap at rest: body in door by 18 mm"
        fault = result.fault
        assert fault is not None
        assert (fault.positions, fault.text) == ({}, "body in door")
        assert fault.depth == pytest.approx(0.018, abs=1e-5)
        x, y, z = fault.point
        assert -0.2981 <= x <= -0.2799
        assert -0.2001 <= y <= -0.1799
        assert 0.0249 <= z <= 0.5201
        (row,) = [row for row in result.evidence["contacts"] if row["depth"] > 0.01]
        assert row == {"pair": ["body", "door"], "depth": pytest.approx(0.018, abs=1e-5)}

    def test_an_exclude_of_the_file_hides_nothing(self, tmp_path: Path) -> None:
        bodies = """<body name="base"><geom type="box" size="0.5 0.5 0.5"/></body>
        <body name="lid" pos="0 0 0.96"><joint name="up" type="slide" axis="0 0 1" range="0 1"/>
        <geom type="box" size="0.5 0.5 0.5"/></body>"""
        exclude = '<contact><exclude body1="base" body2="lid"/></contact>'
        result = judged("penetration", mjcf(tmp_path, bodies, more=exclude))
        assert not result.passed
        assert result.fault is not None
        assert result.fault.depth == pytest.approx(0.04, abs=1e-6)

    def test_a_little_is_allowed_by_size_or_by_depth(self) -> None:
        """4 mm in an object of 1.09 m: less than 0.5 % of its diagonal, 5.44 mm."""
        subject = Subject({}, with_door_moved((-0.009, 0.0, 0.0)))
        result = judged("penetration", subject)
        assert result.passed
        diagonal = np.linalg.norm(np.array([0.6, 0.43, 0.8]))
        assert result.evidence["allowed"] == pytest.approx(0.005 * diagonal, rel=0.01)
        assert "deepest by 4 mm" in result.text
        assert not judged("penetration", subject, share=0.0).passed
        assert judged("penetration", subject, share=0.0, depth=0.0041).passed


class TestSweep:
    @pytest.mark.parametrize("kind", ["urdf", "usd"])
    def test_a_drawer_that_opens_backwards(self, kind: str, tmp_path: Path) -> None:
        """It goes t into the back, which is at y = 0.18 .. 0.20: out again by t - 0.03 m, or on by 0.4 - t.

        Of the 41 poses, that of t = 0.2175 is deepest: 0.4 - 0.2175 = 0.1825 m.
        """
        subject = subject_in(tmp_path, with_joint("drawer_slide", axis=(0.0, 1.0, 0.0)), kind)
        result = judged("sweep", subject)
        assert not result.passed
        fault = result.fault
        assert fault is not None
        assert fault.positions == {"drawer_slide": pytest.approx(0.2175)}
        assert fault.depth == pytest.approx(0.1825, abs=5e-4)
        assert fault.text == "body in drawer"
        assert "drives body in drawer by 18" in result.text
        assert result.evidence["deep"][0]["depth"] == pytest.approx(0.1825, abs=5e-4)

    @pytest.mark.parametrize("kind", ["urdf", "mjcf", "usd"])
    def test_what_moves_on_a_part_may_graze_it_in_every_format(self, kind: str, tmp_path: Path) -> None:
        """The drawer goes 5 cm into the back, 3 cm of which are free: 2 cm in an object of 1.09 m."""
        short = with_joint("drawer_slide", axis=(0.0, 1.0, 0.0), limits=Limits(0.0, 0.05))
        subject = subject_in(tmp_path, short, kind)
        for known in (subject, Subject(subject.files)):
            result = judged("sweep", known)
            assert result.passed
            assert max(row["depth"] for row in result.evidence["deep"]) == pytest.approx(0.02, abs=1e-3)
            assert judged("travel", known).passed

    def test_a_door_that_opens_inwards(self) -> None:
        """The handle stands out by 3 cm in front and the door goes through the drawer or the side."""
        result = judged("sweep", Subject({}, with_joint("door_hinge", axis=(0.0, 0.0, -1.0))))
        assert not result.passed
        assert result.fault is not None
        assert set(result.fault.positions) == {"door_hinge"}
        assert -1.5 <= result.fault.positions["door_hinge"] < 0.0
        assert result.fault.depth > 0.01

    BLOCKED = """<body name="base"><geom type="box" size="0.1 0.1 0.1"/>
    <geom type="box" size="0.1 0.1 0.1" pos="0.5 0 0"/></body>
    <body name="slider" pos="0.25 0 0"><joint name="run" type="slide" axis="1 0 0" range="0 0.1"/>
    <geom type="box" size="0.1 0.05 0.05"/></body>"""

    def test_pairs_that_the_file_excludes_are_listed(self, tmp_path: Path) -> None:
        """The slider ends at x = 0.35 + 0.1, the block begins at 0.4: 50 mm deep at the end."""
        open_eyed = judged("sweep", mjcf(tmp_path / "a", self.BLOCKED))
        assert not open_eyed.passed
        assert open_eyed.fault is not None
        assert open_eyed.fault.depth == pytest.approx(0.05, abs=1e-6)
        assert open_eyed.fault.positions == {"run": pytest.approx(0.1)}
        exclude = '<contact><exclude body1="slider" body2="base"/></contact>'
        listed = judged("sweep", mjcf(tmp_path / "b", self.BLOCKED, more=exclude))
        assert listed.passed
        assert listed.text == "1 joints sweep their range freely; 1 excluded pairs overlap on their way"
        assert listed.evidence["excluded"] == ["base in slider"]
        assert max(row["depth"] for row in listed.evidence["deep"]) == pytest.approx(0.05, abs=1e-6)

    def test_what_sinks_into_a_free_part_that_carries_it_passes(self, tmp_path: Path) -> None:
        """MuJoCo lets a body and the one that it moves on pass, and the file need not exclude them."""
        asset = with_joint("door_hinge", kind="free", limits=None)
        slide = replace(asset.joint("drawer_slide"), parent="door", axis=(0.0, 0.0, -1.0))
        subject = subject_in(tmp_path, asset.with_joints({"drawer_slide": slide}), "mjcf")
        result = judged("sweep", subject)
        assert result.passed
        assert result.evidence["excluded"] == ["door in drawer"]
        assert max(row["depth"] for row in result.evidence["deep"]) == pytest.approx(0.02, abs=1e-3)

    def test_a_base_that_floats_excludes_nothing(self, tmp_path: Path) -> None:
        inside = self.BLOCKED.replace("</body>", "", 1) + "</body>"
        floating = inside.replace('<body name="base">', '<body name="base"><freejoint/>')
        result = judged("sweep", mjcf(tmp_path, floating))
        assert result.evidence["excluded"] == []
        assert not result.passed

    def test_how_deep_is_too_deep(self, tmp_path: Path) -> None:
        subject = mjcf(tmp_path, self.BLOCKED)
        assert judged("sweep", subject, depth=0.051).passed
        assert not judged("sweep", subject, depth=0.049).passed


class TestTravel:
    def test_an_obstacle(self, tmp_path: Path) -> None:
        """A bar of 0.4 m turns from x towards y, where a post stands 0.3 m away."""
        bodies = """<body name="post"><geom type="box" size="0.02 0.02 0.2" pos="0 0.3 0"/></body>
        <body name="bar"><joint name="turn" axis="0 0 1" range="0 3"/>
        <geom type="box" size="0.2 0.01 0.01" pos="0.2 0 0"/></body>"""
        result = judged("travel", mjcf(tmp_path, bodies, 'damping="0.1"'))
        assert not result.passed
        assert result.text.startswith("turn stops at 1.4")  # 90 degrees less atan(0.03 / 0.3): 1.47
        assert result.evidence["joints"] == {"turn": {"lower": True, "upper": False}}

    def test_without_it(self, tmp_path: Path) -> None:
        bodies = """<body name="post"><geom type="box" size="0.02 0.02 0.2" pos="0 -0.3 0"/></body>
        <body name="bar"><joint name="turn" axis="0 0 1" range="0 3"/>
        <geom type="box" size="0.2 0.01 0.01" pos="0.2 0 0"/></body>"""
        result = judged("travel", mjcf(tmp_path, bodies, 'damping="0.1"'))
        assert (result.passed, result.text) == (True, "1 joints reach both ends")

    def test_no_travel(self) -> None:
        asset = with_joint("drawer_slide", limits=Limits(0.0, 1e-5))
        assert "drawer_slide has no travel" in judged("travel", Subject({}, asset)).text
