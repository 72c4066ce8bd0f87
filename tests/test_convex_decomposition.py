"""V-HACD and CoACD in their own process: what comes back, and what happens when nothing good does."""

from __future__ import annotations

import importlib.util
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import Delaunay
from simart_kit_plugins.modifiers.collision import Collision

import simart_kit as sk
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.convex_decomposition import DecompositionError, Tool, lacks, run_tool
from simart_kit.decompose import Budget, decompose_by_tool
from simart_kit.hulls import convex_hull, volume
from simart_kit.testing.meshes import boxes_mesh

needs_coacd = pytest.mark.skipif(bool(lacks("coacd")), reason="coacd is an extra that is not installed")
HULL = "rng = np.random.default_rng(0); hull = rng.uniform(0, 0.1, (9, 3))"


def bracket() -> tuple[FloatArray, IntArray]:
    """An L of 0.4 x 0.1 x 0.4 with legs 0.1 thick, in one surface: 0.007 m^3."""
    outline = np.array([(0, 0), (0.4, 0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0, 0.4)])
    vertices = np.concatenate([np.insert(outline, 1, y, axis=1) for y in (0.0, 0.1)])
    flat = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)])
    sides = [face for i in range(6) for j in [(i + 1) % 6] for face in ((i, i + 6, j), (j, i + 6, j + 6))]
    return vertices, np.concatenate([flat, flat[:, ::-1] + 6, sides])


def worker(folder: Path, *lines: str) -> tuple[str, str]:
    """A stand-in that reads what it is asked and then runs lines of Python."""
    program = folder / "worker.py"
    head = ("import io, os, sys, time", "import numpy as np", "asked = sys.stdin.buffer.read()")
    program.write_text("\n".join([*head, *lines]))
    return sys.executable, str(program)


def answer(arrays: str) -> tuple[str, ...]:
    return "out = io.BytesIO()", f"np.savez(out, {arrays})", "sys.stdout.buffer.write(out.getvalue())"


def ask(command: tuple[str, str], seconds: float = 20.0) -> list[FloatArray]:
    return run_tool("vhacd", *bracket(), most=4, corners=32, seconds=seconds, worker=command)


@pytest.mark.parametrize("tool", ["vhacd", pytest.param("coacd", marks=needs_coacd)])
def test_an_l_comes_apart_into_few_pieces_that_leave_its_corner_free(tool: Tool) -> None:
    found = run_tool(tool, *bracket(), most=4, corners=32, seconds=60.0)
    assert 2 <= len(found) <= 4
    assert all(len(points) <= 32 for points in found)
    hulls = [Delaunay(points) for points in found]
    assert all(hull.find_simplex([0.25, 0.05, 0.25]) < 0 for hull in hulls)


@needs_coacd
def test_coacd_keeps_the_volume() -> None:
    found = run_tool("coacd", *bracket(), most=4, corners=32, seconds=60.0)
    assert sum(volume(convex_hull(points)) for points in found) == pytest.approx(0.007, rel=0.05)


def test_vhacd_gives_the_same_twice() -> None:
    one, two = (run_tool("vhacd", *bracket(), most=4, corners=32, seconds=60.0) for _ in range(2))
    for left, right in zip(one, two, strict=True):
        np.testing.assert_array_equal(left, right)


def test_a_good_answer_is_taken(tmp_path: Path) -> None:
    (hull,) = ask(worker(tmp_path, HULL, *answer("hull_0=hull")))
    np.testing.assert_array_equal(hull, np.random.default_rng(0).uniform(0, 0.1, (9, 3)))


def test_one_that_hangs_is_killed(tmp_path: Path) -> None:
    started, pid = time.monotonic(), tmp_path / "pid"
    with pytest.raises(DecompositionError, match="vhacd took longer than 1 s"):
        ask(worker(tmp_path, f"open({str(pid)!r}, 'w').write(str(os.getpid()))", "time.sleep(600)"), 1.0)
    assert time.monotonic() - started < 10
    if pid.exists():
        assert not Path(f"/proc/{pid.read_text()}").exists()


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        (("os.abort()",), "vhacd failed with status -6"),
        (("raise ValueError('bad mesh')",), "failed with status 1: ValueError: bad mesh"),
        (("print('hulls: 3')",), "an answer that cannot be read"),
        ((), "an answer that cannot be read"),
        (answer("other=np.zeros(3)"), "an answer that cannot be read"),
        (answer("hull_0=np.array([{}], dtype=object)"), "an answer that cannot be read"),
        (answer(""), "found no pieces"),
        ((HULL, *answer("hull_0=hull * np.nan")), "a piece that does not lie in the mesh"),
        ((HULL, *answer("hull_0=hull + 1.0")), "a piece that does not lie in the mesh"),
        ((HULL, *answer("hull_0=hull[:, :2]")), "a piece that does not lie in the mesh"),
        ((HULL, *answer("hull_0=hull[:3]")), "a piece that does not lie in the mesh"),
    ],
)
def test_whatever_else_comes_back_is_refused(lines: tuple[str, ...], told: str, tmp_path: Path) -> None:
    with pytest.raises(DecompositionError, match=told):
        ask(worker(tmp_path, *lines))


def test_without_an_answer_the_hull_stands_in_and_the_report_says_so(tmp_path: Path) -> None:
    vertices, faces = bracket()
    found = decompose_by_tool(vertices, faces, Budget(tool_seconds=0.01))
    assert volume(found.shapes[0]) == pytest.approx(0.1 * (0.4 * 0.4 - 0.3 * 0.3 / 2))
    asset = sk.Asset("bracket", sk.Mesh(vertices, faces), np.zeros(len(faces), dtype=int), (sk.Part("body"),))
    modified = Collision(Collision.Options(mode="decompose", tool_timeout=0.01)).modify(asset)
    (note,) = [note for note in modified.notes if note.level == "warning"]
    assert note.text == "body has looser shapes: vhacd took longer than 0.01 s"


def test_mode_decompose_uses_the_tool() -> None:
    mesh = boxes_mesh([((0, 0, 0), (0.4, 0.1, 0.1)), ((0, 0, 0.3), (0.4, 0.1, 0.4))])
    asset = sk.Asset("boards", mesh, np.zeros(24, dtype=int), (sk.Part("body"),))
    options = Collision.Options(mode="decompose", tool_timeout=60.0)
    shapes = Collision(options).modify(asset).parts[0].collision
    assert len(shapes) >= 2
    assert all(np.ptp(shape.vertices[:, 2]) < 0.11 for shape in shapes)  # none joins the two boards
    assert all(shape.primitive is None for shape in shapes)


def test_what_is_lacking_is_what_cannot_be_imported() -> None:
    assert lacks("vhacd") == ""
    assert bool(lacks("coacd")) == (importlib.util.find_spec("coacd") is None)
