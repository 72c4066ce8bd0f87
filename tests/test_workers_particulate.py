"""Particulate's own `infer.py`, run as users run it: a stand-in that writes what it documents."""

import numpy as np
import pytest
from simart_kit_plugins.particulate import diagnose
from simart_kit_plugins.particulate.segmenter import Particulate
from simart_kit_plugins.workers.failures import WorkerError

from simart_kit.recipe import read_options
from simart_kit.testing.meshes import cabinet_asset, static_asset

from .p3sam_stand_in import still_there
from .particulate_stand_in import ParticulateStandIn


def segment(stand_in, mesh, **options):
    return Particulate(read_options(Particulate, {**stand_in.options, **options})).segment(mesh)


def test_parts_and_joints_come_back_in_place_and_metres(tmp_path):
    truth = cabinet_asset()
    stand_in = ParticulateStandIn(tmp_path)
    found = segment(stand_in, truth.mesh)
    assert found.face_part.tolist() == truth.face_part.tolist()
    assert [part.name for part in found.parts] == ["part_0", "part_1", "part_2"]
    assert found.joints is not None
    hinge, slide = found.joints
    assert (hinge.kind, hinge.parent, hinge.child) == ("revolute", "part_0", "part_1")
    assert np.allclose(hinge.axis, (0, 0, 1))
    assert np.allclose(hinge.origin[:2], (-0.275, -0.19)), "a point of the true axis"
    assert np.allclose((hinge.limits.lower, hinge.limits.upper), (-1.5, 0))
    assert (slide.kind, slide.parent, slide.child) == ("prismatic", "part_0", "part_2")
    assert np.allclose(slide.axis, (0, -1, 0))
    assert np.allclose((slide.limits.lower, slide.limits.upper), (0, 0.3)), "metres, not of its own unit"
    assert "not for commercial use" in " ".join(note.text for note in found.notes)
    again = Particulate(read_options(Particulate, {"cache": str(tmp_path / "cache")})).segment(truth.mesh)
    assert again.face_part.tolist() == found.face_part.tolist()
    assert again.joints == found.joints
    assert "--no_strict" not in stand_in.arguments
    assert len(stand_in.pids) == 1, "the second time, the answer was in the cache"


def test_options_are_arguments(tmp_path):
    stand_in = ParticulateStandIn(tmp_path)
    segment(stand_in, static_asset().mesh, strict=False, min_part_confidence=0.25)
    given = stand_in.arguments
    assert given[given.index("--up_dir") + 1] == "Z"
    assert given[given.index("--min_part_confidence") + 1] == "0.25"
    assert "--no_strict" in given
    assert "--eval" in given


@pytest.mark.parametrize(
    ("behaviour", "told"),
    [
        ("no cuda", "RuntimeError: CUDA is required for inference"),
        ("nothing", r"wrote no eval/pred\.npz"),
        ("garbage", r"answered nonsense: pred\.npz"),
        ("nan", r"answered nonsense: pred\.npz: 'revolute_range' holds values that are NaN or infinite"),
        ("short", r"answered nonsense: pred\.npz: 'face_part_ids' has 11 values"),
        ("hang", "took longer than 0.8 s"),
    ],
)
def test_what_goes_wrong_is_one_line_and_leaves_no_process(tmp_path, behaviour, told):
    stand_in = ParticulateStandIn(tmp_path, behaviour)
    with pytest.raises(WorkerError, match=told) as error:
        segment(stand_in, static_asset().mesh, timeout=0.8 if behaviour == "hang" else 60.0)
    assert str(error.value).startswith("Particulate ")
    assert "\n" not in str(error.value)
    assert stand_in.pids
    assert still_there(stand_in.pids) == []


def test_the_doctor_tells_its_licence(monkeypatch):
    monkeypatch.delenv("SIMART_PARTICULATE_FOLDER", raising=False)
    found = diagnose()
    assert "SIMART_PARTICULATE_FOLDER is not set" in found[0].detail
    assert "not for commercial use" in found[-1].detail
