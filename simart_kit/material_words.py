"""Which row of the material table a word means."""

from __future__ import annotations

import re

from .materials import MATERIALS

# Each with where it is from: "EC1" are tables A.1 to A.5 of EN 1991-1-1:2002, which list both with like
# densities; "kind" is a kind of the material, by definition; "made" is what such things are made of.
_SYNONYMS: tuple[tuple[str, str, str], ...] = (
    ("wood", "wooden timber oak pine beech birch walnut maple cherry teak bamboo mahogany", "kind"),
    ("mdf", "fiberboard fibreboard", "kind"),
    ("mdf", "chipboard hardboard particleboard", "EC1"),
    ("steel", "iron", "EC1"),
    ("steel", "stainless inox", "kind"),
    ("steel", "chrome", "made"),
    ("aluminium", "aluminum duralumin", "kind"),
    ("brass", "bronze copper", "EC1"),
    ("plastic", "polymer abs pvc pp pe hdpe pet nylon polypropylene polyethylene polystyrene", "kind"),
    ("plastic", "polycarbonate plexiglass", "kind"),
    ("plastic", "acrylic", "EC1"),
    ("ceramic", "ceramics porcelain earthenware stoneware", "kind"),
    ("stone", "marble granite slate limestone sandstone", "EC1"),
    ("concrete", "cement mortar", "EC1"),
    ("rubber", "silicone latex elastomer", "kind"),
    ("rubber", "tire tyre", "made"),
    ("fabric", "cloth textile cotton linen wool polyester canvas velvet", "kind"),
    ("foam", "sponge", "kind"),
)
_MEANT = {word: material for material, words, _ in _SYNONYMS for word in words.split()}
# Words for several materials.
_METALS = ("steel", "aluminium", "brass")
_SEVERAL: dict[str, tuple[str, ...]] = {"metal": _METALS, "metallic": _METALS, "alloy": _METALS}


def words_of(text: str) -> list[str]:
    """Words in lower case, also of names such as "OakWood_01"."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", text)]


def rows_meant(word: str) -> tuple[str, ...]:
    """The rows that a word in lower case, or its plural, may mean: several of "metal", none of most words."""
    for known in (word, word.removesuffix("s")):
        if known in MATERIALS:
            return (known,)
        if known in _MEANT:
            return (_MEANT[known],)
        if known in _SEVERAL:
            return _SEVERAL[known]
    return ()
