"""What parts are made of: what most parts of that name, of such objects, are among made-up ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

# Objects of each category that are asked.
_ASKED = 6
# What the body is called here; no part is.
BODY = ""


def usual_materials(categories: Sequence[str], seed: int) -> dict[str, str]:
    """Of each "category/label", and of each label of whatever object, the key of the material table.

    Args:
        categories: to make objects of.
        seed: of the objects.
    """
    from ..shapes.dice import Dice
    from .generate.catalogue import CATEGORIES
    from .generate.category import named

    counts: dict[str, Counter[str]] = {}
    for name in categories:
        category = named(name, CATEGORIES)
        for number in range(_ASKED):
            for k, body in enumerate(category.make(Dice((seed, number, 3))).bodies):
                largest = max(body.surfaces, key=lambda surface: surface.triangles.shape[0])
                label = body.label if k else BODY
                for key in (f"{name}/{label}", f"/{label}"):
                    counts.setdefault(key, Counter())[largest.look.material] += 1
    return {key: sorted(found, key=lambda m: (-found[m], m))[0] for key, found in sorted(counts.items())}


def material_of(known: dict[str, str], category: str, label: str) -> str:
    """The material of a part by name and object, else by name alone, else by what the object is made of."""
    for key in (f"{category}/{label}", f"/{label}", f"{category}/{BODY}", f"/{BODY}"):
        if key in known:
            return known[key]
    return "plastic"
