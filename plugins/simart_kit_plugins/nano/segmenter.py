"""Segmenter `nano`: a small network that says which pieces move together, and how."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Note, Segmentation, Segmenter
from simart_kit.arrays import frozen_ints
from simart_kit.beside import ALONE, Beside

from .askew import seen_straight

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.segments import Segments
    from simart_kit.spec.values import Spec

    from .meshes import MeshCloud
    from .predicting import PredictedPart, Prediction
    from .proposals import Proposal


_SKIN = "the surface is one fused skin, in which parts are often missed or wrong: look at it"
# Of more faces geometry is asked only once it is known that something moves: it takes longer than it saves.
_MANY = 100_000


class Nano(Segmenter):
    """Parts and joints by a small network that was trained on made-up objects."""

    name = "nano"

    class Options(simart_kit.Options):
        """Which weights, and how sure they have to be."""

        model: str = Field(
            default="", description="Folder of the weights, such as `train nano` writes; the shipped ones."
        )
        least: float = Field(
            default=0.95,
            ge=0,
            le=1,
            description="Parts less sure than this stay with the body; a quarter of it is enough in an "
            "object that is recognised, half in one that is read much alike from all sides or is made as "
            "those that were trained on, five eighths in one in which `geometric` finds nothing.",
        )
        votes: int = Field(
            default=4,
            ge=1,
            le=8,
            description="From how many sides it is looked at; from one alone nothing is recognised.",
        )
        pool: bool = Field(default=True, description="Add what `geometric` finds, and keep what can move.")

    options: Options

    def segment(self, mesh: Mesh) -> Segmentation:
        """The body as part 0, then each part that moves, with its joint as a hint.

        Raises:
            BadInputError: the weights cannot be read.
        """
        return self.segment_beside(mesh, None, ALONE)

    def segment_to(self, mesh: Mesh, spec: Spec) -> Segmentation:
        """As `segment`; where a spec states other parts or joints, the likeliest of those that fit.

        Raises:
            BadInputError: the weights cannot be read.
        """
        return self.segment_beside(mesh, spec, ALONE)

    def segment_beside(self, mesh: Mesh, spec: Spec | None, beside: Beside) -> Segmentation:
        """As `segment` or `segment_to`; the network reads in another process, if there is one."""
        return seen_straight(mesh, lambda straight: self._segmented(straight, spec, beside))

    def _segmented(self, mesh: Mesh, spec: Spec | None, beside: Beside) -> Segmentation:
        from simart_kit.segments import find_segments

        from ..geometric.naming import in_order
        from .asking import said_by
        from .meshes import mesh_cloud
        from .proposals import of_geometry, with_body
        from .showing import evidence
        from .sliding_leaves import with_slides
        from .stored_model import SKINS_FILE, WEIGHTS_FILE, read_knowledge, reads_skins, shipped_folder
        from .trusting import enough, enough_on_skin, settled, stands_still

        folder = Path(self.options.model) if self.options.model else shipped_folder()
        segments = find_segments(mesh, relief=spec is None and reads_skins(folder))
        seen = mesh_cloud(mesh, segments, np.random.default_rng(self.seed))
        # With a spec, a skin is cut by what the network says of its patches; else geometry finds more on it.
        asked = self.options.pool and not (seen.skin and spec is not None)
        weights = SKINS_FILE if seen.relief else WEIGHTS_FILE
        known = read_knowledge(folder)
        saying = beside.ask(said_by, folder, weights, seen.cloud, self.options.votes)
        at_once = asked and len(mesh.faces) <= _MANY
        geometry = of_geometry(mesh, self.seed) if at_once else []
        said = saying.result()
        material = partial(known.material, said.categories)
        still = sum(said.categories[name] for name in known.still)
        moves = (spec is not None and spec.moves) or not stands_still(said, still)
        if not moves:
            geometry = []
        elif asked and not at_once:
            geometry = of_geometry(mesh, self.seed)
        if seen.relief:
            bar = enough_on_skin(said, self.options.least)
        else:
            bar = enough(said, self.options.least, seen.skin, alone=asked and moves and not geometry)
        if self.options.pool and moves and not seen.skin:
            said = with_slides(mesh, said, seen, self.options.least, doubtful=bar)
        said = settled(said, bar)
        fronts = with_body(mesh, geometry) if seen.skin else []
        if seen.relief and moves:
            found = _of_relief(mesh, said, seen, fronts, material)
        elif fronts or not moves:
            found = _of_proposals(mesh, fronts, seen, material)
        elif seen.skin:
            found = _of_patches(mesh, said, seen, material, spec)
        else:
            found = self._of_pieces(mesh, said, seen, geometry, material, spec)
        found = in_order(found)
        assert found.face_segment is not None
        shown = evidence(found.mesh_of(mesh), found.face_segment, said, seen)
        if seen.skin and not seen.relief and asked and (fronts or len(found.parts) == 1):
            # What geometry looked at tells more of it than what the network read.
            found = replace(found, face_segment=find_segments(mesh, relief=True).face_segment)
        return replace(
            found,
            notes=(
                *_notes(said, seen, 0.0 if moves else still, bar, len(found.parts) - 1),
                *_aside(segments),
            ),
            evidence=shown,
        )

    def _of_pieces(
        self,
        mesh: Mesh,
        said: Prediction,
        seen: MeshCloud,
        geometry: Sequence[Proposal],
        material: Callable[[str], str],
        spec: Spec | None,
    ) -> Segmentation:
        from .hardware import with_hardware
        from .honouring import chosen, rejoined
        from .joining import joined
        from .placing import placed
        from .pooling import pooled
        from .proposals import of_geometry, of_network, with_body
        from .rotors import with_rotors
        from .travel import with_travel
        from .trusting import heeded, leads

        if spec is None:
            geometry = heeded(said, geometry, seen.face_piece, mesh.face_areas)
            geometry = placed(mesh, geometry, said, seen)
        proposals = with_travel(mesh, of_network(said, said.piece_part[seen.face_piece], seen))
        if self.options.pool:
            proposals = with_rotors(mesh, proposals, geometry)
            # Borders and lines by geometry are exact, but who knows the object finds more of it.
            known = leads(said, proposals, geometry)
            first, second = (proposals, geometry) if known else (geometry, proposals)
            both = joined(mesh, pooled(mesh, first, second, known=known))
            proposals = with_hardware(mesh, seen.face_piece, both)
        if spec is not None:
            more = partial(of_geometry, mesh, self.seed, spec) if self.options.pool else list
            proposals = chosen(mesh, said, seen, proposals, spec, more)
        kept = with_body(mesh, proposals)
        found = _of_proposals(mesh, kept, seen, material)
        return found if spec is None else rejoined(mesh, found, kept, seen, spec)


def _of_relief(
    mesh: Mesh,
    said: Prediction,
    seen: MeshCloud,
    geometry: Sequence[Proposal],
    material: Callable[[str], str],
) -> Segmentation:
    """What is found on a skin that is cut by relief, by geometry if anything, unless the network knows it."""
    from .pooling import pooled
    from .proposals import of_network, with_body
    from .trusting import leads_on_skin

    proposals = of_network(said, said.piece_part[seen.face_piece], seen)
    if leads_on_skin(said, proposals, geometry):
        found = pooled(mesh, proposals, geometry)
    else:
        found = list(geometry) or proposals
    return _of_proposals(mesh, with_body(mesh, found), seen, material)


def _of_proposals(
    mesh: Mesh, proposals: Sequence[Proposal], seen: MeshCloud, material: Callable[[str], str]
) -> Segmentation:
    """The body and the proposals; none of them for an object in which nothing moves."""
    from .proposals import segmentation_of

    found = segmentation_of(proposals, len(mesh.faces), material)
    return replace(found, face_segment=frozen_ints(seen.face_piece.astype(np.int32)))


def _of_patches(
    mesh: Mesh, said: Prediction, seen: MeshCloud, material: Callable[[str], str], spec: Spec | None
) -> Segmentation:
    """What the network finds on a skin; creases, colours and short ways end parts, large faces are cut."""
    from .boundaries.cutting import cut
    from .boundaries.patch_parts import patch_parts, patch_size
    from .honouring import chosen_said, rejoined
    from .proposals import of_network, segmentation_of, with_body

    assert seen.middles is not None
    said = said if spec is None else chosen_said(said, seen, spec)
    face_part = said.piece_part[seen.face_piece].astype(np.int32)
    if not said.parts:
        return _of_proposals(mesh, [], seen, material)
    at = patch_parts(mesh, seen.middles, said.piece_part)
    done = cut(mesh, face_part, at, patch_size(mesh, seen.cloud.count))
    # The body's patches may be the middle of no face.
    proposals = with_body(done.mesh, of_network(said, done.face_part, seen))
    found = segmentation_of(proposals, len(done.face_part), material)
    found = found if spec is None else rejoined(done.mesh, found, proposals, seen, spec)
    pieces = frozen_ints(seen.face_piece[done.face_source].astype(np.int32))
    return replace(found, face_segment=pieces, mesh=None if done.mesh is mesh else done.mesh)


def _notes(said: Prediction, seen: MeshCloud, still: float, bar: float, parts: int) -> tuple[Note, ...]:
    of_skin = "pieces of one skin" if seen.relief else "patches of one skin"
    kind = of_skin if seen.skin else "pieces that lie apart"
    known = said.category and f"taken for a {said.category} ({said.categories[said.category]:.2f})"
    what = known or "of no known kind"
    if still:
        what += f", and nothing moves of such objects ({still:.2f} sure)"
    size, factor = said.size
    return (
        Note(
            "segment", "info", f"{seen.cloud.count} {kind}; {what}, about {size:.2g} m (/ or x {factor:.2f})"
        ),
        Note("segment", "info", _trust_on_skin(said, bar) if seen.relief else _trust(said, bar)),
        Note("segment", "info", f"{parts} moving parts"),
        *(Note("segment", "info", _doubt(part)) for part in said.doubtful),
        *([Note("segment", "warning", _SKIN)] if seen.skin else []),
    )


def _aside(segments: Segments) -> tuple[Note, ...]:
    told = segments.told_aside
    return (Note("segment", "info", told),) if told else ()


def _trust(said: Prediction, bar: float) -> str:
    knows = "recognises it" if said.recognised else "does not recognise it"
    measured = f"discord {said.discord:.2g}, novelty {said.novelty:.2f}, unlikeness {said.unlikeness:.2f}"
    return f"the network {knows} ({measured}): {bar:.2f} sure is enough for its parts"


def _trust_on_skin(said: Prediction, bar: float) -> str:
    enough = f"{bar:.2f} sure is enough for its parts" if bar < 1 else "too much for the network to be heard"
    return f"read from all sides with a discord of {said.discord:.2g}: {enough}"


def _doubt(part: PredictedPart) -> str:
    name = part.label or "part"
    sure = f"{part.score:.2f} sure that it moves, {part.confidence:.2f} how"
    return f"a {name} that the network took for {part.kind} was not sure enough: {sure}"
