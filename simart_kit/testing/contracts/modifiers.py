"""What a modifier must keep."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...asset import Asset
from ...beside import Beside, EarlyModifier, HelpedModifier, begun_by, modify_by
from ...stages import Modifier
from .. import meshes
from ..fingerprint import fingerprint
from .stages import StageContract


class ModifierContract(StageContract):
    """For Modifiers."""

    kind = Modifier

    def asset(self) -> Asset:
        """What is modified: by default a cabinet with a door and a drawer, without masses and shapes."""
        return meshes.cabinet_asset(physics=False)

    def test_keeps_faces_and_labels(self) -> None:
        asset = self.asset()
        result = self.make().modify(asset)
        assert isinstance(result, Asset), f"modify() returned {type(result).__name__}, expected an Asset"
        assert np.array_equal(result.mesh.faces, asset.mesh.faces), "modify() changed the faces"
        assert len(result.face_part) == len(asset.face_part), "one label a face"

    def test_same_answer_every_time(self) -> None:
        asset = self.asset()
        one, two = self.make().modify(asset), self.make().modify(asset)
        assert fingerprint(one) == fingerprint(two), (
            "make generators with numpy.random.default_rng(self.seed)"
        )

    def test_help_changes_nothing(self) -> None:
        stage = self.make()
        with Beside(isinstance(stage, HelpedModifier)) as another:
            helped = modify_by(stage, self.asset(), another)
        assert fingerprint(helped) == fingerprint(stage.modify(self.asset())), "modify_beside() gives another"

    def test_an_early_start_changes_nothing(self) -> None:
        stage, asset, another = self.make(), self.asset(), meshes.chain_asset()
        with Beside(isinstance(stage, EarlyModifier)) as beside:
            begun = begun_by(stage, asset, beside)
            early = [fingerprint(modify_by(begun, one, beside)) for one in (asset, another)]
        assert early == [fingerprint(stage.modify(one)) for one in (asset, another)], "begun() gives another"

    def test_leaves_the_asset_alone(self) -> None:
        asset = self.asset()
        before = fingerprint(asset)
        self.make().modify(asset)
        assert fingerprint(asset) == before, "modify() changed its input"

    def test_works_on_a_finished_asset(self) -> None:
        self._modify(meshes.cabinet_asset())

    def test_works_on_a_chain_of_joints(self) -> None:
        self._modify(meshes.chain_asset())

    def test_static_object_stays_static(self) -> None:
        assert self._modify(meshes.static_asset()).joints == ()

    def test_works_when_nothing_moves(self) -> None:
        asset = meshes.cabinet_asset()
        stuck = tuple(replace(joint, kind="fixed", limits=None) for joint in asset.joints)
        result = self._modify(replace(asset, joints=stuck))
        assert not any(joint.moves for joint in result.joints), "modify() made fixed joints move"

    def _modify(self, asset: Asset) -> Asset:
        result = self.make().modify(asset)
        assert isinstance(result, Asset), f"modify() returned {type(result).__name__}, expected an Asset"
        assert len(result.face_part) == len(asset.face_part), "one label a face"
        return result
