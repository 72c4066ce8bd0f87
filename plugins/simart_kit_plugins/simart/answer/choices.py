"""Words of an answer to and from those of the kit: materials and names."""

from __future__ import annotations

import math
import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

from simart_kit.materials import DEFAULT_MATERIAL, MATERIALS

from .values import NAME_LENGTH

# Which row of the material table a word means, and where that is from: "EC1" are tables A.1 to A.5 of
# EN 1991-1-1:2002, which list both with like densities; "kind" is a kind of the material, by definition.
_SYNONYMS: tuple[tuple[str, str, str], ...] = (
    ("wood", "wooden timber oak pine beech birch walnut maple cherry teak bamboo", "kind"),
    ("mdf", "fiberboard fibreboard", "kind"),
    ("mdf", "chipboard hardboard particleboard", "EC1"),
    ("steel", "iron", "EC1"),
    ("aluminium", "aluminum duralumin", "kind"),
    ("brass", "bronze copper", "EC1"),
    ("plastic", "polymer abs pvc pp pe hdpe pet nylon polypropylene polyethylene polystyrene", "kind"),
    ("plastic", "polycarbonate plexiglass", "kind"),
    ("plastic", "acrylic", "EC1"),
    ("ceramic", "ceramics porcelain earthenware stoneware", "kind"),
    ("stone", "marble granite slate limestone sandstone", "EC1"),
    ("concrete", "cement mortar", "EC1"),
    ("rubber", "silicone latex elastomer", "kind"),
    ("fabric", "cloth textile cotton linen wool polyester canvas", "kind"),
    ("foam", "sponge", "kind"),
)
_MEANT = {word: material for material, words, _ in _SYNONYMS for word in words.split()}
# Words for several materials: density decides, and where there is none the first is meant.
_METALS = ("steel", "aluminium", "brass")
_SEVERAL: dict[str, tuple[str, ...]] = {"metal": _METALS, "metallic": _METALS, "alloy": _METALS}
# Abbreviations that a capital letter alone would spoil.
_WRITTEN = {"mdf": "MDF"}


@dataclass(frozen=True, slots=True)
class MaterialChoice:
    """A row of the material table for what an answer says.

    Attributes:
        material: its name.
        by: "name" where the answer names it, "density" where only the density told, "default" where neither.
    """

    material: str
    by: Literal["name", "density", "default"]


def choose_material(text: str, density: float | None) -> MaterialChoice:
    """The row of the material table that an answer means.

    A name in the table or a synonym, in any case, decides; of several words the last one that is known,
    since English puts the kind of thing last ("Wood Plastic", but "Stainless Steel").

    Args:
        text: such as "Stainless Steel"; "" for none.
        density: [g/cm^3]; None for none.
    """
    words = re.findall(r"[a-z]+", text.lower())
    for word in reversed(words):
        for known in (word, word.removesuffix("s")):
            if known in MATERIALS:
                return MaterialChoice(known, "name")
            if known in _MEANT:
                return MaterialChoice(_MEANT[known], "name")
    for word in reversed(words):
        if several := _SEVERAL.get(word) or _SEVERAL.get(word.removesuffix("s")):
            return MaterialChoice(_nearest(several, density), "name")
    if density is not None:
        return MaterialChoice(_nearest(tuple(MATERIALS), density), "density")
    return MaterialChoice(DEFAULT_MATERIAL, "default")


def material_of(text: str, density: float | None) -> str:
    """Name of the row of the material table; see `choose_material`."""
    return choose_material(text, density).material


def material_text(material: str) -> str:
    """A row of the material table as an answer says it, such as "Steel"."""
    return _WRITTEN.get(material, said(material).capitalize())


def said(name: str) -> str:
    """A name in the letters that an answer may have, without accents and other signs; "" if none is left."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    kept = re.sub(r"[^A-Za-z0-9_\-]+", " ", plain)
    return kept.strip(" _-")[:NAME_LENGTH].rstrip(" _-")


def _nearest(names: tuple[str, ...], density: float | None) -> str:
    """The material whose density is nearest by ratio [g/cm^3], the first of equal ones; the first without."""
    if density is None:
        return names[0]
    return min(names, key=lambda name: abs(math.log(MATERIALS[name].density / 1000 / density)))
