"""The parts of a run made those that a spec states: split, merged, collected, counted and named."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import BoolArray, FloatArray, frozen_ints
from ..asset import Joint
from ..mesh import Mesh
from ..part_words import name_words
from ..stages import PartGuess, Segmentation
from .choosing import Option, choose
from .pieces import nearest_face, pieces_of
from .reading import refuse
from .unknowns import unknowns
from .values import PartSpec, Point, Spec
from .wishes import place_of


def with_parts(segmentation: Segmentation, given: Mesh, spec: Spec) -> Segmentation:
    """The segmentation with the parts that a spec states.

    What was not done is told by `verdicts`.

    Args:
        segmentation: as `assemble.checked` returns it.
        given: the mesh that the segmenter was given.
        spec: what is stated.

    Raises:
        BadInputError: the spec names parts or pieces that the run has not, or leaves a part without a face.
    """
    mesh = segmentation.mesh_of(given)
    body = body_of(segmentation, mesh, spec)
    refuse("spec", unknowns(spec, segmentation, int(pieces_of(segmentation, given).max()) + 1, body))
    drawn = _Drawing(segmentation, given, spec, body)
    drawn.split()
    drawn.merge()
    drawn.collect()
    drawn.leave_out()
    drawn.count()
    return drawn.result()


def body_of(segmentation: Segmentation, mesh: Mesh, spec: Spec) -> int:
    """The part that stands still: the root stated, else one called so, else the largest without a hint."""
    names = [guess.name for guess in segmentation.parts]
    root = next((part for part in spec.parts if part.root), None)
    if root is not None and (root.found_as or root.name) in names:
        return names.index(root.found_as or root.name)
    moved = {joint.child for joint in segmentation.joints or () if joint.moves}
    still = [i for i, name in enumerate(names) if name not in moved] or [0]
    called = [i for i in still if (segmentation.parts[i].label or names[i]) in ("body", "base", "frame")]
    areas = np.bincount(segmentation.face_part, mesh.face_areas, minlength=len(names))
    return max(called or still, key=lambda i: float(areas[i]))


class _Drawing:
    """Labels and guesses while they are drawn anew; `result` makes a value of them."""

    def __init__(self, segmentation: Segmentation, given: Mesh, spec: Spec, body: int) -> None:
        self._found, self._spec, self._body = segmentation, spec, body
        self._mesh = segmentation.mesh_of(given)
        self._pieces = pieces_of(segmentation, given)
        self._label = np.array(segmentation.face_part, dtype=np.int64)
        self._guesses = list(segmentation.parts)
        self._place = {guess.name: index for index, guess in enumerate(segmentation.parts)}
        self._listed: dict[int, PartSpec] = {}

    def split(self) -> None:
        """Give the new parts their faces."""
        mistakes = []
        for split in self._spec.split:
            part = self._place[split.part]
            numbers = (*split.pieces, *map(self._piece_at, split.points))
            inside = (self._label == part) & self._of_pieces(numbers)
            if not inside.any() or not ((self._label == part) & ~inside).any():
                share = "none" if not inside.any() else "all"
                mistakes.append(f"split of '{split.part}': {share} of its faces would be of '{split.name}'")
            self._label[inside] = self._new(split.name, inside)
        refuse("spec", mistakes)

    def merge(self) -> None:
        """Give the faces of parts to the one that stays."""
        for merge in self._spec.merge:
            for name in merge.parts:
                self._label[self._label == self._place[name]] = self._place[merge.into]

    def collect(self) -> None:
        """Give each listed part its pieces; what it had besides falls to the body."""
        claims: list[tuple[int, BoolArray]] = []
        for part in self._spec.parts:
            index, faces = self._claimed(part)
            self._listed[index] = part
            if faces is not None:
                claims.append((index, faces))
        for index, _ in claims:
            self._label[self._label == index] = self._body
        for index, faces in claims:
            self._label[faces] = index
        gone = [part.name for index, part in self._listed.items() if not (self._label == index).any()]
        refuse("spec", [f"part '{name}' has no face left: others have its pieces" for name in gone])

    def leave_out(self) -> None:
        """With `only`, give parts that are not listed to the body."""
        if self._spec.only:
            kept = [*self._listed, *(self._place[split.name] for split in self._spec.split)]
            self._label[~np.isin(self._label, kept)] = self._body

    def count(self) -> None:
        """Give parts that are too many of a kind to the body; name others what they are taken for."""
        areas = np.bincount(self._label, self._mesh.face_areas, minlength=len(self._guesses))
        still = [self._body, *(i for i, part in self._listed.items() if part.joint == "fixed")]
        moving = [i for i in range(len(self._guesses)) if areas[i] > 0 and i not in still]
        options = [
            Option(guess.label or guess.name, guess.score, float(areas[i]), pinned=i in self._listed)
            for i, guess in ((i, self._guesses[i]) for i in moving)
        ]
        for i, option, label in zip(moving, options, choose(self._spec, options), strict=True):
            if label is None:
                self._label[self._label == i] = self._body
            elif label != option.label:
                self._guesses[i] = replace(self._guesses[i], label=label)

    def result(self) -> Segmentation:
        """The segmentation; parts without a face are gone."""
        used = np.unique(self._label)
        names = {i: self._listed[i].name if i in self._listed else self._guesses[i].name for i in used}
        taken = {part.name for part in self._listed.values()}
        for i in used:
            while i not in self._listed and names[i] in taken:
                names[i] += "_found"
        guesses = tuple(self._named(int(i), names[i]) for i in used)
        number = np.zeros(len(self._guesses), dtype=np.int64)
        number[used] = np.arange(len(used))
        return replace(
            self._found,
            face_part=frozen_ints(number[self._label]),
            parts=guesses,
            joints=self._hints({self._guesses[i].name: names[i] for i in used}, names[self._body]),
        )

    def _hints(self, renamed: dict[str, str], body: str) -> tuple[Joint, ...] | None:
        """The joint hints of parts that there still are; what carries no more gives way to the body."""
        if self._found.joints is None:
            return None
        return tuple(
            replace(joint, parent=renamed.get(joint.parent, body), child=renamed[joint.child])
            for joint in self._found.joints
            if joint.child in renamed and renamed[joint.child] != body
        )

    def _named(self, index: int, name: str) -> PartGuess:
        guess, part = self._guesses[index], self._listed.get(index)
        label = part.label if part and part.label is not None else guess.label
        return replace(guess, name=name, label=label)

    def _claimed(self, part: PartSpec) -> tuple[int, BoolArray | None]:
        """The number of a listed part, and the faces that it is stated to have, if any."""
        name = part.found_as or part.name
        if part.pieces is not None:
            faces = self._of_pieces(part.pieces)
        elif part.points is not None:
            at = [nearest_face(self._mesh, self._point(point)) for point in part.points]
            of = [int(self._label[face]) for face in at]
            if len(set(of)) == 1 and of[0] != self._body and of[0] not in self._listed:
                return of[0], None
            faces = np.zeros(len(self._label), dtype=np.bool_)
            for face, found in zip(at, of, strict=True):
                whole = self._label == found
                faces |= self._pieces == self._pieces[face] if found == self._body else whole
        else:
            return self._place[name], None
        return (self._place[name] if name in self._place else self._new(name, faces)), faces

    def _new(self, name: str, faces: BoolArray) -> int:
        """A new part, of what most of it was taken for so far."""
        areas = np.bincount(self._label[faces], self._mesh.face_areas[faces], minlength=1)
        most, things = self._guesses[int(areas.argmax())], name_words(name)[0]
        label = things[-1] if things else ""
        self._guesses.append(PartGuess(name, label, most.material, material_stated=most.material_stated))
        self._place[name] = len(self._guesses) - 1
        return self._place[name]

    def _of_pieces(self, numbers: Sequence[int]) -> BoolArray:
        return np.isin(self._pieces, np.array(numbers, dtype=np.int64))

    def _piece_at(self, point: Point) -> int:
        return int(self._pieces[nearest_face(self._mesh, self._point(point))])

    def _point(self, point: Point) -> FloatArray:
        return place_of(self._spec, point, self._mesh.bounds)
