"""What prims are, in words and in Wikidata's codes, for synthetic data and for search."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from simart_kit.asset import Asset

if TYPE_CHECKING:
    from pxr import Usd


class Category(NamedTuple):
    """A kind of object.

    Attributes:
        name: in plain English.
        qcode: item of https://www.wikidata.org.
    """

    name: str
    qcode: str


OTHER = Category("physical object", "Q223557")
_FURNITURE = Category("furniture", "Q14745")
_CATEGORIES = {
    "fridge": Category("refrigerator", "Q37828"),
    "refrigerator": Category("refrigerator", "Q37828"),
    "dishwasher": Category("dishwasher", "Q186263"),
    "microwave": Category("microwave oven", "Q127956"),
    "oven": Category("oven", "Q36539"),
    "washer": Category("washing machine", "Q124441"),
    "washing": Category("washing machine", "Q124441"),
    "cabinet": _FURNITURE,
    "chest": _FURNITURE,
    "cupboard": _FURNITURE,
    "desk": _FURNITURE,
    "drawer": _FURNITURE,
    "drawers": _FURNITURE,
    "dresser": _FURNITURE,
    "nightstand": _FURNITURE,
    "shelf": _FURNITURE,
    "stool": _FURNITURE,
    "table": _FURNITURE,
    "wardrobe": _FURNITURE,
    "door": Category("door", "Q36794"),
}


def category(asset: Asset) -> Category:
    """What an asset is, from the words of its name, or else of what stands still in it.

    The order of the table decides: a fridge with drawers is a refrigerator.
    """
    for text in (asset.name, f"{asset.root.label} {asset.root.name}"):
        words = set(text.lower().replace("_", " ").split())
        for word, found in _CATEGORIES.items():
            if word in words:
                return found
    return OTHER


def label(prim: Usd.Prim, taxonomy: str, text: str) -> None:
    """Say what a prim is in the words of a taxonomy: `class`, `material` or `wikidata_qcode`."""
    from pxr import UsdSemantics

    UsdSemantics.LabelsAPI.Apply(prim, taxonomy).CreateLabelsAttr([text])
