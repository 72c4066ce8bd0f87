"""Words of an answer to and from those of the kit: materials and names."""

from __future__ import annotations

import math
import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

from simart_kit.material_words import rows_meant
from simart_kit.materials import DEFAULT_MATERIAL, MATERIALS

from .values import NAME_LENGTH

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
    meant = [rows for word in reversed(words) if (rows := rows_meant(word))]
    if meant:
        # Words for several materials, such as "metal", tell where none is named; then density decides.
        return MaterialChoice(_nearest(min(meant, key=len), density), "name")
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
