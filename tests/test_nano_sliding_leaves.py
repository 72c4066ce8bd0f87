"""Leaves of which the network is sure that they move, and geometry that they slide."""

from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.nano.segmenter import Nano
from simart_kit_plugins.nano.truth import KINDS

from simart_kit.recipe import read_options
from simart_kit.segments import find_segments
from simart_kit.testing.meshes import boxes_mesh

from .furniture import bar, box
from .test_nano_segmenter import KNOWN, SURE, Oracle, Told

# A face, and on one half of it a leaf with its handle in the middle.
BODY, LEAF = box((-0.6, 0.6), (0.0, 0.3), (0.0, 0.5)), box((-0.58, -0.02), (-0.025, -0.002), (0.02, 0.48))


class InDoubt(Oracle):
    """Is sure what moves, but not how."""

    def parts(self, tokens, owner, share, numbers, real):
        said = super().parts(tokens, owner, share, numbers, real)
        kind = np.full_like(said.kind, -SURE)
        kind[:, [KINDS.index("revolute"), KINDS.index("prismatic")]] = (0.3, 0.0)
        return replace(said, kind=kind)


@pytest.mark.parametrize(
    ("handle", "options", "kinds"),
    [
        (-0.3, {}, ["prismatic"]),
        (-0.08, {}, []),  # on the side of the room: it may be hinged
        (-0.3, {"pool": False}, []),
        (-0.3, {"least": 1.0}, []),
    ],
)
def test_a_leaf_that_surely_moves_slides_where_it_has_room_for_that_alone(
    monkeypatch, handle, options, kinds
):
    mesh = boxes_mesh([BODY, LEAF, bar(handle, 0.25, -0.025)])
    order = find_segments(mesh).face_segment[::12]
    part = np.zeros(3, dtype=int)
    part[order[1:]] = 1
    model = Told(InDoubt(part, slides=False), KNOWN)
    model.stand_in(monkeypatch)
    monkeypatch.setattr("simart_kit_plugins.nano.proposals.of_geometry", lambda mesh, seed: [])
    found = Nano(read_options(Nano, {"model": "any", **options})).segment(mesh)
    assert [joint.kind for joint in found.joints] == kinds
    if kinds:
        (joint,) = found.joints
        assert found.parts[1].label == "sliding door"
        np.testing.assert_allclose(joint.axis, (1.0, 0.0, 0.0), atol=1e-9)
        assert joint.limits.upper == pytest.approx(0.56, abs=0.03)
        assert joint.evidence == ("has room beside itself to slide into",)
        assert (found.face_part > 0).sum() == 24
    else:
        assert any("not sure enough" in note.text for note in found.notes)
