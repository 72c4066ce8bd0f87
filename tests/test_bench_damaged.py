"""Damaged files of truths and predictions: told as bad input that names a file, whatever the damage."""

from __future__ import annotations

import copy
import json
import math
import shutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from simart_kit.bench.articulation import Articulation
from simart_kit.bench.formats.articulate_anymesh import ArticulateAnyMesh
from simart_kit.bench.formats.labels import LabelArray
from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.bench.importing import write_case
from simart_kit.errors import BadInputError

from .bench_objects import cabinet, truth

CABINET = replace(truth(cabinet(), "cabinet"), name="it")
ODD: list[Any] = [
    None, "x", "None", "ball", -5, 0, 1.5, 10**400, 1e308, math.nan, math.inf, True, [], {}, [[]],
    [1e200, 0, 0],
]  # fmt: skip


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A truth in `it`, labels in `it.npy` with joints, and a prediction of Articulate-AnyMesh in `any/it`."""
    whole = CABINET.articulation
    write_case(CABINET, tmp_path / "it")
    np.save(tmp_path / "it.npy", whole.labels)
    shutil.copy(tmp_path / "it" / "gt.json", tmp_path / "it.json")
    parts = tmp_path / "any" / "it" / "mesh_parts"
    parts.mkdir(parents=True)
    rows = []
    for index, link in enumerate(whole.links):
        part = trimesh.Trimesh(whole.vertices, whole.faces[whole.labels == index], process=False)
        part.export(parts / f"{link.name}.glb")
        axis = {"origin": link.joint.origin, "direction": link.joint.axis}
        row = {"id": index, "name": link.name, "parent": link.parent, "joint": link.joint.kind}
        rows.append(row | {"jointData": {"axis": axis} if link.joint.axis else {}})
    (parts.parent / "mobility.json").write_text(json.dumps(rows))
    return tmp_path


READERS: dict[str, Callable[[Path], Articulation]] = {
    "it/gt.npz": lambda folder: SimartBench().read(folder / "it").articulation,
    "it/gt.json": lambda folder: SimartBench().read(folder / "it").articulation,
    "it/input.glb": lambda folder: SimartBench().read(folder / "it").articulation,
    "it.npy": lambda folder: LabelArray().read(folder / "it.npy", CABINET).articulation,
    "it.json": lambda folder: LabelArray().read(folder / "it.npy", CABINET).articulation,
    "any/it/mobility.json": lambda f: ArticulateAnyMesh().read(f / "any" / "it", CABINET).articulation,
    "any/it/mesh_parts/drawer.glb": lambda f: (
        ArticulateAnyMesh().read(f / "any" / "it", CABINET).articulation
    ),
}


def outcome(folder: Path, file: str) -> str:
    """The error that reading a damaged file ends with, or "" when what is read is still whole."""
    told = ""
    try:
        read = READERS[file](folder)
    except BadInputError as error:
        told = str(error)
    if told:
        assert str(folder) in told
        assert "\n" not in told
    else:
        assert np.isfinite(read.vertices).all()
    return told


@pytest.mark.parametrize("file", READERS)
def test_damaged_bytes_are_bad_input_or_harmless(folder: Path, file: str) -> None:
    whole, rng = (folder / file).read_bytes(), np.random.default_rng(0)
    assert outcome(folder, file) == ""
    told = 0
    for _ in range(60):
        damaged = np.frombuffer(whole, np.uint8).copy()
        places = rng.integers(len(damaged), size=rng.integers(1, 9))
        damaged[places] = rng.integers(256, size=len(places))
        (folder / file).write_bytes(damaged.tobytes())
        told += outcome(folder, file) != ""
    assert told > 0


@pytest.mark.parametrize("file", READERS)
def test_files_that_end_too_early_are_bad_input(folder: Path, file: str) -> None:
    whole = (folder / file).read_bytes()
    # Not to the last bytes: a closing line break or padding may be missing without harm.
    for length in np.linspace(0, len(whole) - 8, 20).astype(int):
        (folder / file).write_bytes(whole[:length])
        assert outcome(folder, file) != ""


@pytest.mark.parametrize("file", [file for file in READERS if file.endswith(".json")])
def test_odd_values_in_tables_are_bad_input_or_harmless(folder: Path, file: str) -> None:
    whole, rng = json.loads((folder / file).read_text()), np.random.default_rng(1)
    told = 0
    for _ in range(200):
        damaged = copy.deepcopy(whole)
        places = list(containers(damaged))
        for index in rng.integers(len(places), size=2):
            holder, key = places[index]
            holder[key] = copy.deepcopy(ODD[rng.integers(len(ODD))])
        (folder / file).write_text(json.dumps(damaged))
        told += outcome(folder, file) != ""
    assert told > 0


def containers(value: Any) -> Iterator[tuple[Any, Any]]:
    """Every list or dictionary of a JSON value, with each of its keys."""
    keys = list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    for key in keys:
        yield value, key
        yield from containers(value[key])
