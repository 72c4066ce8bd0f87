"""A loader may state parts and joints: the core turns them with the mesh, and refuses what does not fit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit import hookimpl
from simart_kit.assemble import assemble
from simart_kit.asset import Joint, Limits
from simart_kit.errors import PluginError
from simart_kit.loading import Source, read_source
from simart_kit.mesh import Mesh, UpAxis
from simart_kit.plugins import Plugins
from simart_kit.stages import PartGuess, Segmentation

from .bench_objects import cabinet

SLIDE = Joint("slide", "prismatic", "Body", "drawer", (0.0, 0.875, 0.25), (0.0, 0.0, 1.0), Limits(0.0, 0.3))


def stated() -> Segmentation:
    """The cabinet in two parts, +Y up, in decimetres."""
    file = cabinet()
    return Segmentation(
        np.where(file.labels == 3, 1, 0).astype(np.int32),
        (PartGuess("Body", mass=12.0), PartGuess("drawer")),
        joints=(SLIDE,),
        mesh=Mesh(file.vertices, file.faces, up="+y", metres_per_unit=0.1),
    )


def read(value: object, tmp_path: Path, up: UpAxis | None = None, unit: str | None = None) -> Source:
    class Loader:
        @hookimpl
        def load_mesh(self, path: Path) -> object:
            return value

    plugins = Plugins(installed=False)
    plugins.register(Loader())
    path = tmp_path / "thing.abc"
    path.write_text("something")
    return read_source(path, plugins, up, unit)


def test_joints_are_turned_and_scaled_with_the_mesh(tmp_path: Path) -> None:
    source = read(stated(), tmp_path)
    assert source.stated is not None
    assert source.stated.joints is not None
    (joint,) = source.stated.joints
    # (x, y, z) with +Y up is (x, 0.01 - z, y) here, as the box is centred; a decimetre is 0.1 m.
    np.testing.assert_allclose(joint.origin, (0, -0.024, 0.0875), atol=1e-12)
    np.testing.assert_allclose(joint.axis, (0, -1, 0), atol=1e-12)
    assert joint.limits is not None
    assert joint.limits.upper == pytest.approx(0.03)
    assert (joint.parent, joint.child) == ("body", "drawer"), "names are cleaned"


def test_what_is_said_of_the_file_goes_for_its_joints(tmp_path: Path) -> None:
    source = read(stated(), tmp_path, "+z", "cm")
    assert source.stated is not None
    assert source.stated.joints is not None
    (joint,) = source.stated.joints
    np.testing.assert_allclose(joint.axis, (0, 0, 1), atol=1e-12)
    assert joint.limits is not None
    assert joint.limits.upper == pytest.approx(0.003)


def test_a_mass_that_is_stated_is_kept(tmp_path: Path) -> None:
    source = read(stated(), tmp_path)
    assert source.stated is not None
    assert source.stated.joints is not None
    asset = assemble("a", source.mesh, source.stated, source.stated.joints, source.asset_from_source)
    assert [part.stated_mass for part in asset.parts] == [12.0, None]


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (replace(stated(), mesh=None), "a Segmentation without its mesh and joints"),
        (replace(stated(), joints=None), "a Segmentation without its mesh and joints"),
        (replace(stated(), face_part=np.zeros(48, np.int32)), "face_part uses ids 0 for 2 parts"),
        (replace(stated(), face_part=np.zeros(3, np.int32)), "face_part has shape"),
        ("text", "returned str, not a Mesh"),
    ],
)
def test_a_loader_that_states_nonsense_is_named_in_one_line(value: object, told: str, tmp_path: Path) -> None:
    with pytest.raises(PluginError, match=told) as caught:
        read(value, tmp_path)
    assert str(tmp_path / "thing.abc") in str(caught.value)
    assert "\n" not in str(caught.value)
