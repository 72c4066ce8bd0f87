"""On real objects nothing is lost on the way: a model that knows the truth reaches it."""

import numpy as np
import pytest
from simart_kit_plugins.marks import axis_sheet, sheets
from simart_kit_plugins.marks.segmenter import P3SamVlm

from simart_kit.assemble import assemble, checked
from simart_kit.asset import clean_name
from simart_kit.loading import read_source
from simart_kit.plugins import Plugins
from simart_kit.recipe import read_options
from simart_kit.stages import PartGuess, Segmentation

from .marks_cases import Knowing
from .real_objects import needs_data, overlap, source, true_axis, truth

PLUGINS = Plugins(installed=False)


class Oracle(P3SamVlm):
    """Asks a model that knows the truth about the object of a name."""

    def of(self, name, loaded):
        """Give it the truth, in the frame of the loaded mesh; returns the parts and (F,) their faces."""
        known = truth(name)
        blank = assemble("blank", loaded.mesh, _whole(loaded.mesh), (), loaded.asset_from_source)
        ids = [part["id"] for part in known.parts]
        labels = np.searchsorted(ids, known.labels(blank))
        parts = [_part(part, ids, loaded.asset_from_source) for part in known.parts]
        self._vlm = Knowing(loaded.mesh, self._proposed(loaded.mesh).piece, labels, parts)
        return parts, labels


def _whole(mesh):
    return Segmentation(np.zeros(len(mesh.faces), np.int32), (PartGuess("body"),))


def _part(part, ids, asset_from_source):
    joint = part["joint"]
    axis, origin = (None, None) if joint["type"] == "fixed" else true_axis(part, asset_from_source)
    parent = ids.index(part["parent"]) if part["parent"] in ids else -1
    name = clean_name(part["name"])
    return {"name": name, "kind": joint["type"], "parent": parent, "axis": axis, "origin": origin}


@needs_data
@pytest.mark.parametrize("name", ["calvin_table_A", "bigym_wall_cabinet_glass"])
def test_pieces_and_letters_hold_the_truth(name, monkeypatch):
    monkeypatch.setattr(sheets, "PANEL", 32)
    monkeypatch.setattr(sheets, "TILE", 24)
    monkeypatch.setattr(axis_sheet, "PANEL", 32)
    loaded = read_source(source(name), PLUGINS, None, None)
    stage = Oracle(read_options(P3SamVlm, {"proposer": {"use": "geometric"}}), plugins=PLUGINS)
    parts, labels = stage.of(name, loaded)
    found = checked(stage.segment(loaded.mesh), loaded.mesh)
    asset = assemble("object", loaded.mesh, found, found.joints, loaded.asset_from_source)
    assert len(asset.parts) == len(parts)
    for index, part in enumerate(parts):
        mine = found.face_part == asset.part_index(part["name"])
        assert overlap(loaded.mesh.face_areas, mine, labels == index) > 0.99
        if part["kind"] == "fixed":
            continue
        joint = asset.joint_to(part["name"])
        assert joint.kind == part["kind"]
        assert abs(np.dot(joint.axis, part["axis"])) > np.cos(np.deg2rad(1))
        if joint.turns:
            off = np.linalg.norm(np.cross(np.subtract(part["origin"], joint.origin), part["axis"]))
            assert off < 0.03 * loaded.mesh.diagonal
