"""Skins that are cut by relief: made to learn from, and read by weights of their own."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.geometric.segmenter import Geometric
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
from simart_kit_plugins.nano.generate.category import named
from simart_kit_plugins.nano.generate.data_set import generated
from simart_kit_plugins.nano.generate.posing import ajar
from simart_kit_plugins.nano.generate.skins import skin_of
from simart_kit_plugins.nano.generate.writing import mesh_of
from simart_kit_plugins.nano.meshes import mesh_cloud
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.predicting import Prediction
from simart_kit_plugins.nano.proposals import of_geometry
from simart_kit_plugins.nano.relief_examples import relief_example, relief_of, skin_mesh, surface_of
from simart_kit_plugins.nano.segmenter import Nano
from simart_kit_plugins.nano.store import load, save, stored
from simart_kit_plugins.nano.stored_model import (
    SKINS_FILE,
    WEIGHTS_FILE,
    read_model,
    reads_skins,
    shipped_folder,
)
from simart_kit_plugins.nano.training import pool
from simart_kit_plugins.nano.training.plan import TrainingPlan
from simart_kit_plugins.nano.trusting import enough_on_skin, leads_on_skin
from simart_kit_plugins.nano.weights import save_network
from simart_kit_plugins.shapes.dice import Dice

from simart_kit.arrays import IntArray
from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh
from simart_kit.recipe import read_options
from simart_kit.segments import find_segments
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

from .test_skins import SLAB, skin


def said(discord: float) -> Prediction:
    none = np.zeros(1)
    return Prediction((), (), none.astype(np.int64), none, "", discord, 1.0, {}, (1.0, 1.0))


class TestExamples:
    def test_the_pieces_of_a_skin_know_what_they_are_of(self) -> None:
        made = ajar(named("bicycle", CATEGORIES).make(Dice(5)), Dice(6), 0.0)
        found = relief_example(made, np.random.default_rng(0))
        assert found.cloud.count == len(found.part) == len(found.pieces.own)
        wheels = [k for k, body in enumerate(made.bodies) if body.label == "wheel"]
        assert len(wheels) == 2
        assert all(found.shown[wheel] and found.parts[wheel - 1] is not None for wheel in wheels)
        for wheel in wheels:
            part = found.parts[wheel - 1]
            assert part is not None
            assert part.truth.right.any()
        # The two wheels are apart along the ground, and as high as each other.
        middles = [
            found.cloud.points[np.isin(found.cloud.piece, np.flatnonzero(found.part == wheel))].mean(axis=0)
            for wheel in wheels
        ]
        away = np.abs(middles[0] - middles[1])
        assert away[:2].max() > 0.4
        assert away[2] < 0.1

    def test_it_is_read_in_training_as_in_use(self) -> None:
        mesh = skin_mesh(generated(named("toilet", CATEGORIES), 7, 0), np.random.default_rng(0))
        segments = find_segments(mesh, relief=True)
        assert segments.relief
        seen = mesh_cloud(mesh, segments, np.random.default_rng(0))
        assert np.array_equal(seen.face_piece, relief_of(mesh))

    def test_a_pool_makes_as_many_as_a_plan_says_and_the_same_ones_twice(self, tmp_path: Path) -> None:
        for share, name in ((1.0, "skins"), (1.0, "again"), (0.0, "solids")):
            plan = TrainingPlan(objects=2, relief_share=share, skin_share=0, seed=3)
            (shard,) = pool.shards(plan, tmp_path / name, pool.TRAIN)
            pool.make([shard], 1, lambda done, of: None)
        skins, again, solids = (load(tmp_path / n / "train-000000.npz") for n in ("skins", "again", "solids"))
        assert [one.category for one in skins] == [one.category for one in solids]
        for one, same, solid in zip(skins, again, solids, strict=True):
            assert np.array_equal(one.points, same.points)
            assert one.points.shape != solid.points.shape or not np.allclose(one.points, solid.points)

    def test_it_is_stored_as_any_other(self, tmp_path: Path) -> None:
        made = generated(named("cabinet", CATEGORIES), 3, 0)
        found = stored(relief_example(made, np.random.default_rng(1)))
        save([found], tmp_path / "one.npz")
        (back,) = load(tmp_path / "one.npz")
        assert np.array_equal(back.piece, found.piece)
        assert back.category == "cabinet"


class TestClouds:
    def test_a_fine_skin_is_read_by_its_relief_and_a_coarse_one_by_patches(self) -> None:
        fine, coarse = skin(SLAB), boxes_mesh([((0, 0, 0), (1, 1, 1))])
        for mesh, relief in ((fine, True), (coarse, False)):
            segments = find_segments(mesh, relief=True)
            seen = mesh_cloud(mesh, segments, np.random.default_rng(0))
            assert seen.skin
            assert seen.relief == relief
        assert seen.cloud.count > 100

    def test_what_is_aside_is_not_read(self) -> None:
        mesh = skin(SLAB)
        segments = find_segments(mesh, relief=True)
        aside = np.zeros(len(mesh.faces), dtype=np.bool_)
        aside[segments.face_segment == 0] = mesh.triangles[segments.face_segment == 0][:, 0, 2] > 0.5
        seen = mesh_cloud(mesh, replace(segments, aside=aside), np.random.default_rng(0))
        places = seen.cloud.points[seen.cloud.piece == 0] * seen.size + seen.center
        assert 0.3 < places[:, 2].max() < 0.52


class TestTrust:
    @pytest.mark.parametrize(("discord", "bar"), [(0.001, 0.3), (0.01, 0.3), (0.02, 1.0)])
    def test_who_reads_a_skin_alike_from_all_sides_is_heard(self, discord: float, bar: float) -> None:
        assert enough_on_skin(said(discord), 0.9) == pytest.approx(bar)

    def test_geometry_comes_first_unless_the_network_knows_more_for_sure(self) -> None:
        one, *_ = of_geometry(cabinet_asset().mesh, 0)
        assert leads_on_skin(said(0.001), [one, one], [one])
        assert not leads_on_skin(said(0.001), [one], [one])
        assert not leads_on_skin(said(0.01), [one, one], [one])


class TestWeights:
    def copied(self, folder: Path) -> Path:
        return Path(shutil.copytree(shipped_folder(), folder))

    def test_skins_have_their_own_of_the_same_network(self) -> None:
        assert reads_skins(shipped_folder())
        solids, skins = read_model(shipped_folder()), read_model(shipped_folder(), SKINS_FILE)
        assert any(not np.array_equal(solids.weights[name], skins.weights[name]) for name in skins.weights)

    def test_without_them_a_skin_is_read_by_patches(self, tmp_path: Path) -> None:
        folder = self.copied(tmp_path / "model")
        (folder / SKINS_FILE).unlink()
        assert not reads_skins(folder)
        for model, kind in ((folder, "patches of one skin"), (shipped_folder(), "pieces of one skin")):
            found = Nano(read_options(Nano, {"model": str(model)})).segment(skin(SLAB))
            assert any(kind in note.text for note in found.notes)

    def test_those_of_another_network_are_refused(self, tmp_path: Path) -> None:
        folder = self.copied(tmp_path / "model")
        save_network(NanoNetwork(NanoConfig(channels=16, heads=2)), tmp_path / "other")
        shutil.copy(tmp_path / "other" / WEIGHTS_FILE, folder / SKINS_FILE)
        with pytest.raises(
            BadInputError, match=r"skins\.safetensors is not of .* with --start and this folder"
        ):
            Nano(read_options(Nano, {"model": str(folder)})).segment(skin(SLAB))

    def test_damaged_ones_are_refused(self, tmp_path: Path) -> None:
        folder = self.copied(tmp_path / "model")
        (folder / SKINS_FILE).write_bytes(b"nothing")
        with pytest.raises(BadInputError, match=r"skins\.safetensors is damaged"):
            Nano(read_options(Nano, {"model": str(folder)})).segment(skin(SLAB))


def overlaps(mesh: Mesh, true: IntArray, found: IntArray) -> list[float]:
    """Of each true moving part, the IoU by area of the best part that was found."""
    areas, numbers = mesh.face_areas, range(1, int(found.max()) + 1)
    return [
        max(
            (
                areas[(true == t) & (found == k)].sum() / areas[(true == t) | (found == k)].sum()
                for k in numbers
            ),
            default=0.0,
        )
        for t in np.unique(true[true > 0])
    ]


def test_parts_of_skins_are_found_that_geometry_does_not_know() -> None:
    """Of objects of a seed that nobody trained on."""
    by_network = by_geometry = wanted = 0
    for name in ("bicycle", "toilet", "wheelchair"):
        made = mesh_of(generated(named(name, CATEGORIES), 4242, 0), Dice(0))
        closed = skin_of(made, np.random.default_rng(0))
        mesh = surface_of(closed)
        by_network += sum(o > 0.5 for o in overlaps(mesh, closed.face_part, Nano().segment(mesh).face_part))
        alone = Geometric(seed=0).segment(mesh).face_part
        by_geometry += sum(o > 0.5 for o in overlaps(mesh, closed.face_part, alone))
        wanted += len(np.unique(closed.face_part[closed.face_part > 0]))
    assert by_network > by_geometry
    assert by_network / wanted > 0.3
