"""Objects as files for the checks, and one check at a time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from simart_kit import Check, CheckResult, Plugins, Subject
from simart_kit.arrays import mat3
from simart_kit.asset import Asset, Limits
from simart_kit.checks import run_checks
from simart_kit.recipe import read_options
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset

BUILT_IN = Plugins(installed=False, strict=True)
NAMES = tuple(r.name for r in BUILT_IN.registrations("check"))
_QUICK = {"usd": {"thumbnail": False}}


def cabinet() -> Asset:
    """The cabinet with its hinge at the front edge, so that no corner of the door turns into the side."""
    asset = cabinet_asset(textured=False)
    return asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), origin=(-0.275, -0.2, 0.0))})


def chain() -> Asset:
    """The chain with limits that its shapes allow, and an arm that is not thrown about."""
    asset = chain_asset()
    arm = replace(asset.joint("arm_hinge"), limits=Limits(-0.3, 0.3), armature=0.05, damping=1.0)
    heavy = {}
    for part in asset.parts:
        assert part.mass is not None
        inertia = mat3(10 * np.array(part.mass.inertia))
        heavy[part.name] = replace(part, mass=replace(part.mass, mass=10 * part.mass.mass, inertia=inertia))
    return asset.with_joints({"arm_hinge": arm}).with_parts(heavy)


SOUND: dict[str, Callable[[], Asset]] = {"cabinet": cabinet, "chain": chain, "static": static_asset}


def export(asset: Asset, folder: Path, kind: str, **options: Any) -> Path:
    """The main file that the built-in exporter of a format writes into `folder/KIND`."""
    stage = BUILT_IN.find("exporter", kind).value
    home = folder / kind
    home.mkdir(parents=True)
    main: Path = stage(read_options(stage, _QUICK.get(kind, {}) | options), seed=0).export(asset, home)
    return main


def subject_in(folder: Path, asset: Asset, *kinds: str, **options: Any) -> Subject:
    """An asset with its files in these formats."""
    return Subject({kind: export(asset, folder, kind, **options) for kind in kinds}, asset)


def judged(name: str, subject: Subject, **options: Any) -> CheckResult:
    """What one check says, with these thresholds."""
    registration = BUILT_IN.find("check", name)
    check: Check = registration.value(read_options(registration.value, options), seed=0)
    (result,) = run_checks([(check, registration)], subject)
    assert "\n" not in result.text
    assert result.name == name
    return result


def mjcf(
    folder: Path, bodies: str, joints: str = "", more: str = "", integrator: str = "implicitfast"
) -> Subject:
    """A hand-written MJCF file: elements of its worldbody, attributes of its joints, and other sections."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "made.xml"
    path.write_text(
        f"""<mujoco><compiler angle="radian"/><option integrator="{integrator}"/>
        <default><geom density="600"/><joint {joints}/></default>
        <worldbody>{bodies}</worldbody>{more}</mujoco>"""
    )
    return Subject({"mjcf": path})
