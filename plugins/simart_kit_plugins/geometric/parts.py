"""Segments grouped into parts that can move, without any weights."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Note, PartGuess, Segmentation
from simart_kit.arrays import IntArray
from simart_kit.segments import Segments, find_segments
from simart_kit.submesh import submesh
from simart_kit.topology import without_gaps

from .contact import Contacts
from .controls import hand_controls
from .facing import Finder, faced, held, most
from .inner_drawers import inner_drawers, with_fronts
from .levers import with_levers
from .lids import lids
from .movers import Mover, doubtful_movers, front_movers
from .naming import in_order, names
from .open_leaves import open_leaves
from .racks import racks
from .rotors import rotors
from .rounds import collared, knobs, over_holes, wheels
from .scene import Scene, make_scene
from .seats import seats
from .skin_wheels import skin_wheels
from .skin_windows import window_leaves
from .spray_arms import spray_arms

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.spec.values import Spec

_MOST_PIECES = 600

# After the fronts; each has what those before it left.
_FINDERS: tuple[Finder, ...] = (
    rotors,
    open_leaves,
    seats,
    lids,
    spray_arms,
    racks,
    inner_drawers,
    wheels,
)
# The same, of those that look at the side that the object faces.
_FACED: tuple[Finder, ...] = (knobs, collared, over_holes)


def parts_of(mesh: Mesh, spec: Spec | None, max_parts: int, crease: float, node_hint: bool) -> Segmentation:
    """The body as part 0, then the surest movers.

    Args:
        mesh: of an object.
        spec: what is stated of its parts, or None.
        max_parts: most moving parts.
        crease: angle that bounds patches of a skin [rad].
        node_hint: whether scene-graph nodes stay apart.
    """
    segments = find_segments(mesh, crease, node_hint, relief=True)
    # Segments come largest first: what is beyond the most pieces counts as one, and stays with the body.
    piece = np.minimum(segments.face_segment, _MOST_PIECES)
    seen = ~segments.aside
    ids, shown = without_gaps(piece[seen])
    scene = make_scene(mesh if seen.all() else submesh(mesh, seen), shown)
    found = _off_the_skin(scene, _find(scene, segments, spec), np.unique(shown[segments.patch[seen]]))
    movers = found[:max_parts]
    face_part = np.zeros(len(mesh.faces), dtype=np.int32)
    for number, mover in enumerate(movers, start=1):
        face_part[np.isin(piece, ids[list(mover.pieces)])] = number
    guesses = [PartGuess("body", label="body")]
    for mover, name in zip(movers, names(scene, movers), strict=True):
        told = "; ".join(mover.evidence)
        guesses.append(PartGuess(name, label=mover.label, score=mover.score, description=told))
    return in_order(
        Segmentation(
            face_part,
            tuple(guesses),
            face_segment=segments.face_segment,
            notes=(*_notes(segments, movers), *_left(found[max_parts:])),
        )
    )


def _find(scene: Scene, segments: Segments, spec: Spec | None) -> list[Mover]:
    # So many patches are the noise of a scanned or generated skin: what they suggest is not there.
    if segments.count == 1 or (segments.patches and segments.count > _MOST_PIECES):
        return []
    contacts = Contacts(scene)
    fronts = with_levers(scene, contacts, front_movers(scene, contacts, segments.patches))
    if segments.patches:
        fronts = _with_windows(scene, fronts)
    found = _apart(most(hand_controls, held(scene), contacts, set()), fronts)
    taken = {piece for mover in found for piece in mover.pieces}
    sides = faced(scene, fronts)
    finders = (skin_wheels, *_FINDERS) if segments.patches else _FINDERS
    for finder, scenes in [*((one, [scene]) for one in finders), *((one, sides) for one in _FACED)]:
        for mover in most(finder, scenes, contacts, taken):
            if not taken.intersection(mover.pieces):
                found.append(mover)
                taken.update(mover.pieces)
    found = with_fronts(scene, found)
    if spec is not None:
        from .honouring import chosen_movers

        found = chosen_movers(spec, scene, found, lambda: doubtful_movers(scene, contacts, taken))
    return sorted(_on_a_body(scene, found), key=lambda mover: -mover.score)


def _with_windows(scene: Scene, fronts: list[Mover]) -> list[Mover]:
    """Leaves of windows, and the fronts that are none of their pieces."""
    windows = window_leaves(scene, {piece for front in fronts for piece in front.pieces})
    known = {piece for leaf in windows for piece in leaf.pieces}
    return windows + [front for front in fronts if not known.intersection(front.pieces)]


def _on_a_body(scene: Scene, found: list[Mover]) -> list[Mover]:
    """The movers, but for the largest if they leave nothing: something has to stand still."""
    if len({piece for mover in found for piece in mover.pieces}) < scene.count:
        return found
    largest = max(found, key=lambda mover: float(scene.areas[list(mover.pieces)].sum()))
    return [mover for mover in found if mover is not largest]


def _off_the_skin(scene: Scene, found: list[Mover], patches: IntArray) -> list[Mover]:
    """The movers, those that are mostly solids of their own without (N,) patches: a knob has no well."""
    kept, skin = [], set(patches.tolist())
    for mover in found:
        own = tuple(piece for piece in mover.pieces if piece not in skin)
        mostly = 2 * scene.areas[list(own)].sum() > scene.areas[list(mover.pieces)].sum()
        kept.append(replace(mover, pieces=own) if mostly else mover)
    return kept


def _apart(controls: list[Mover], fronts: list[Mover]) -> list[Mover]:
    """Controls, and the fronts without any. One that sits on a front is its handle; several are controls."""
    pressed = {piece for control in controls for piece in control.pieces}
    fronts = [
        front
        for front in fronts
        if front.pieces[0] not in pressed and len(pressed.intersection(front.pieces)) < 2
    ]
    carried = {piece for front in fronts for piece in front.pieces}
    return [control for control in controls if not carried.intersection(control.pieces)] + fronts


def _notes(segments: Segments, movers: list[Mover]) -> tuple[Note, ...]:
    notes = (Note("segment", "info", segments.describe()), Note("segment", "info", _told(movers)))
    if not segments.patches:
        return notes
    text = "the surface is one fused skin, in which much that moves cannot be told apart: look at it"
    return (*notes, Note("segment", "warning", text))


def _left(movers: list[Mover]) -> tuple[Note, ...]:
    """That there are more than may be."""
    text = f"{len(movers)} more that seem to move stay with the body, as max_parts has it"
    return (Note("segment", "warning", text),) if movers else ()


def _told(movers: list[Mover]) -> str:
    if not movers:
        return "nothing was found that moves: the object is taken as static"
    return "; ".join(f"{m.label}: {', '.join(m.evidence) or 'by its place'}" for m in movers)
