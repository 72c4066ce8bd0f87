from dataclasses import dataclass, fields, replace

import numpy as np

from simart_kit.asset import Asset
from simart_kit.kept import kept
from simart_kit.testing.meshes import cabinet_asset


@dataclass(frozen=True, eq=False)
class Box:
    width: float


class TestKept:
    def test_is_worked_out_once_a_value(self) -> None:
        asked = []

        @kept
        def area(box: Box) -> float:
            asked.append(box)
            return box.width**2

        one, other = Box(2.0), Box(3.0)
        assert [area(one), area(other), area(one)] == [4.0, 9.0, 4.0]
        assert asked == [one, other]

    def test_keeps_an_answer_that_is_nothing(self) -> None:
        asked = []

        @kept
        def nothing(box: Box) -> None:
            asked.append(box)

        box = Box(2.0)
        nothing(box)
        nothing(box)
        assert len(asked) == 1

    def test_tells_functions_of_one_value_apart(self) -> None:
        @kept
        def half(box: Box) -> float:
            return box.width / 2

        @kept
        def twice(box: Box) -> float:
            return box.width * 2

        box = Box(3.0)
        assert (half(box), twice(box), half(box)) == (1.5, 6.0, 1.5)

    def test_tells_questions_apart_by_their_words(self) -> None:
        asked = []

        @kept
        def scaled(box: Box, factor: float, upward: bool = False) -> float:
            asked.append((factor, upward))
            return box.width * factor + upward

        box = Box(3.0)
        assert [scaled(box, 2.0), scaled(box, 3.0), scaled(box, 2.0, upward=True)] == [6.0, 9.0, 7.0]
        assert [scaled(box, np.float64(2.0)), scaled(box, 2.0, upward=True)] == [6.0, 7.0]
        assert asked == [(2.0, False), (3.0, False), (2.0, True)]

    def test_a_changed_copy_starts_anew(self) -> None:
        @kept
        def double(box: Box) -> float:
            return box.width * 2

        box = Box(3.0)
        double(box)
        assert double(replace(box, width=5.0)) == 10.0
        assert [field.name for field in fields(box)] == ["width"]

    def test_a_note_on_an_asset_changes_no_answer_but_a_joint_may(self) -> None:
        asked = []

        @kept
        def names(asset: Asset) -> tuple[str, ...]:
            asked.append(asset)
            return tuple(joint.name for joint in asset.joints)

        asset = cabinet_asset()
        noted = asset.with_notes("test", "info", ["seen"])
        assert names(noted) == names(asset)
        again = noted.with_notes("test", "info", ["and again"])
        assert names(again) == names(noted)
        assert len(asked) == 2  # of the first note's asset, made before anything was asked, and of the asset
        assert [note.text for note in again.notes[-2:]] == ["seen", "and again"]
        hinge = asset.joint("door_hinge")
        assert "lid_hinge" in names(again.with_joints({"door_hinge": replace(hinge, name="lid_hinge")}))
