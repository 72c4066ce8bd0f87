"""Generated objects as a source."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import IntArray, vec3
from simart_kit.asset import Asset, Joint, Limits, Part, clean_name
from simart_kit.mesh import Image, Mesh, VisualMaterial, canonical
from simart_kit.stages import PartGuess
from simart_kit.triangles import areas

from ...nano.generate.catalogue import CATEGORIES
from ...nano.generate.category import named
from ...nano.generate.data_set import generated
from ...nano.generate.objects import Body, GeneratedObject
from ...nano.generate.writing import mesh_of
from ...shapes.dice import Dice
from .color_words import color_word, fair_shares
from .source_object import PartWords, SourceObject

SOURCE = "generated"
# The generator's own look of written objects: matte, lit like them.
_ROUGHNESS = 0.7
_PAINT = 7


@dataclass(frozen=True, slots=True)
class GeneratedJob:
    """A generated object to be made.

    Attributes:
        category: its name.
        seed: of the data set.
        number: of the object in its category.
    """

    category: str
    seed: int
    number: int

    @property
    def key(self) -> str:
        """Of the object."""
        return f"{SOURCE}-{self.category}-{self.seed}-{self.number:05d}"

    def make(self) -> SourceObject:
        """The object, closed: every joint at 0."""
        made = generated(named(self.category, CATEGORIES), self.seed, self.number, open_share=0.0)
        return source_object(made, self.key, Dice((self.seed, zlib.crc32(self.key.encode()), _PAINT)))


def category_names(which: str) -> tuple[str, ...]:
    """The categories that a name means, "all" all of them; raises BadInputError naming those there are."""
    if which == "all":
        return tuple(category.name for category in CATEGORIES)
    return (named(which, CATEGORIES).name,)


def source_object(made: GeneratedObject, key: str, dice: Dice) -> SourceObject:
    """A generated object in the pose that it is in.

    Args:
        made: its motions count from this pose.
        key: for the data set.
        dice: of its texture.
    """
    mesh, face_part, shift = _mesh(made, dice)
    parts = tuple(Part(clean_name(body.name), body.label) for body in made.bodies)
    joints = tuple(_joint(body, parts, number, shift) for number, body in enumerate(made.bodies) if number)
    guesses = tuple(
        PartGuess(part.name, body.label, _shares(body, "material")[0])
        for part, body in zip(parts, made.bodies, strict=True)
    )
    words = tuple(
        PartWords(frozenset(_shares(body, "material")), _shares(body, "color")) for body in made.bodies
    )
    asset = Asset(clean_name(made.category, "object"), mesh, face_part, parts, joints)
    name = made.category.replace("_", " ")
    return SourceObject(key, SOURCE, made.category, name, asset, guesses, words)


def _mesh(made: GeneratedObject, dice: Dice) -> tuple[Mesh, IntArray, np.ndarray]:
    """The surface in the canonical frame, (F,) part of each face, and (3,) how far it was moved [m]."""
    raw = mesh_of(made, dice)
    look = VisualMaterial(
        base_color=(1.0, 1.0, 1.0, 1.0),
        roughness=_ROUGHNESS,
        base_color_image=Image.from_pixels(raw.picture),
    )
    surface = Mesh(raw.vertices, raw.faces, uv=raw.uv, materials=(look,), up="+y")
    moved, asset_from_source = canonical(surface)
    return moved, raw.face_part, asset_from_source[:3, 3]


def _joint(body: Body, parts: tuple[Part, ...], number: int, shift: np.ndarray) -> Joint:
    motion = body.motion
    assert motion is not None
    limited = motion.kind in ("revolute", "prismatic")
    return Joint(
        f"{parts[number].name}_joint",
        motion.kind,
        parts[body.parent].name,
        parts[number].name,
        vec3(motion.origin + shift),
        vec3(motion.axis),
        Limits(motion.lower, motion.upper) if limited else None,
    )


def _shares(body: Body, what: str) -> tuple[str, ...]:
    """Materials or colours that cover a fair share of a body."""
    words = [s.look.material if what == "material" else color_word(s.look.color) for s in body.surfaces]
    return fair_shares(words, np.array([areas(s.triangles).sum() for s in body.surfaces]))
