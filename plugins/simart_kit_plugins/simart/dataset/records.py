"""An object in one state to a record: voxels, tokens, answer, picture and questions."""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray, vec3
from simart_kit.asset import Joint

from ..answer.choices import said
from ..answer.tree import ordered
from ..answer.units import answer_of
from ..codec import ObjectGrids, TokenModel, encode_grids, object_grids
from ..prompt.texts import URDF_QUESTION, described, grounding_question
from ..tokens import VoxelTokens
from .describing import chosen, clear_phrases
from .part_facts import part_facts
from .record import Pair, Record
from .source_object import SourceObject
from .states import in_state, state_count

_DESCRIPTIONS = 2
"""Grounding questions of a part in a state."""
# How often the question for the whole object says what it is, as users may with --text.
_HINTED = 0.25


@dataclass(frozen=True, slots=True)
class RecordOptions:
    """What records are to be.

    Attributes:
        states: kinematic states of an object that moves.
        seed: decides states and questions.
        pictures: whether a picture is rendered.
    """

    states: int = 20
    seed: int = 0
    pictures: bool = True


def records_of(
    made: SourceObject, grids: ObjectGrids, model: TokenModel, options: RecordOptions
) -> Iterator[Record]:
    """The records of an object in all its states, the pose of its source first.

    Args:
        made: in the pose of its source.
        grids: its voxels in this pose, as `voxels_of` gives them.
        model: turns voxels into tokens; `codec.nearest_codes` gives the fast one.
        options: what records are to be.
    """
    yield record_of(made, 0, grids, model, options)
    for state in range(1, state_count(made, options.states)):
        there = in_state(made, state, options.seed)
        yield record_of(there, state, voxels_of(there), model, options)


def record_of(
    made: SourceObject, state: int, grids: ObjectGrids, model: TokenModel, options: RecordOptions
) -> Record:
    """The record of an object in the pose that it is in.

    Args:
        made: in its state.
        state: number of the state.
        grids: its voxels, as `voxels_of` gives them.
        model: turns voxels into tokens; `codec.nearest_codes` gives the fast one.
        options: seed and whether to draw.
    """
    from ..prompt.picture import object_picture, png

    whole, *parts = encode_grids(model, np.concatenate([grids.whole[None], grids.parts]))
    joints = _anchored(made)
    answer = answer_of(made.name, made.longest_side, made.guesses, joints, parts, grids.frame)
    return Record(
        f"{made.key}-{state:02d}",
        made.key,
        made.source,
        made.category,
        state,
        whole,
        answer,
        _pairs(made, state, joints, parts, options),
        png(object_picture(made.asset.mesh)) if options.pictures else None,
    )


def voxels_of(made: SourceObject) -> ObjectGrids:
    """Voxels of the whole and of each part in the object's cube of this pose; parts inside others too."""
    asset = made.asset
    return object_grids(asset.mesh, asset.face_part, [part.name for part in asset.parts])


def shape_hash(grids: ObjectGrids, names: Sequence[str]) -> int:
    """64 bits that are equal for objects of equal voxels and equal part names, in any order."""
    digest = hashlib.blake2b(np.packbits(grids.whole).tobytes(), digest_size=8)
    digest.update("\n".join(sorted(names)).encode())
    return int.from_bytes(digest.digest(), "big")


def _pairs(
    made: SourceObject,
    state: int,
    joints: Sequence[Joint],
    tokens: Sequence[VoxelTokens],
    options: RecordOptions,
) -> tuple[Pair, ...]:
    """The question for the whole object, then those for its parts in the order of the answer."""
    key = (options.seed, zlib.crc32(made.key.encode()), state, 1)
    generator = np.random.default_rng(key)
    hint = said(made.name) if generator.random() < _HINTED else ""
    article = "an" if hint[:1].lower() in "aeiou" else "a"
    pairs = [Pair("urdf", described(URDF_QUESTION, f"{article} {hint}" if hint else ""))]
    clear = clear_phrases(part_facts(made), colors=options.pictures)
    places = ordered(made.guesses, joints, [len(sequence.index) for sequence in tokens])
    for number, place in enumerate(places):
        for text in chosen(clear[place.part], _DESCRIPTIONS, generator):
            pairs.append(Pair("grounding", grounding_question(text), number))
    return tuple(pairs)


def _anchored(made: SourceObject) -> tuple[Joint, ...]:
    """The joints with origins that a shape tells: the point of the axis nearest to the middle of the part.

    Any point of an axis would do, and of a slide any point at all; sources differ in which they name.
    """
    middles = {
        part.name: _middle(triangles)
        for part, triangles in zip(made.asset.parts, made.part_triangles, strict=True)
    }
    return tuple(replace(joint, origin=vec3(_anchor(joint, middles[joint.child]))) for joint in made.joints)


def _anchor(joint: Joint, middle: FloatArray) -> FloatArray:
    if joint.kind == "prismatic":
        return middle
    if not joint.turns:
        return np.array(joint.origin)
    origin, axis = np.array(joint.origin), np.array(joint.axis)
    return np.asarray(origin + axis * float((middle - origin) @ axis))


def _middle(triangles: FloatArray) -> FloatArray:
    """(3,) middle of the box about (F, 3, 3) triangles [m]."""
    points = triangles.reshape(-1, 3)
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)
