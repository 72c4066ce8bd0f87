"""What is counted among made-up objects and kept beside the weights: materials, and what stands still."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from pydantic import Field

from ..tables import Table

# Objects of each category that are asked.
_ASKED = 24
# What the body is called here; no part is.
BODY = ""


class Knowledge(Table):
    """Of the categories that a network was trained on."""

    materials: dict[str, str] = Field(
        default={}, description="Key of the material table of each category/label, and of each /label."
    )
    still: tuple[str, ...] = Field(default=(), description="Categories of which nothing moves.")

    def material(self, chances: Mapping[str, float], label: str) -> str:
        """What a part is likeliest of, by the chances of what the object is; plastic if nothing is known."""
        likely: dict[str, float] = {}
        for category, chance in chances.items():
            usual = self._usual(category, label)
            likely[usual] = likely.get(usual, 0.0) + chance
        return max(likely, key=lambda material: likely[material], default="plastic")

    def _usual(self, category: str, label: str) -> str:
        """Of a part by name and object, else by name alone, else what the object is made of."""
        for key in (f"{category}/{label}", f"/{label}", f"{category}/{BODY}", f"/{BODY}"):
            if key in self.materials:
                return self.materials[key]
        return "plastic"


def counted(categories: Sequence[str], seed: int) -> Knowledge:
    """What objects of these categories, made from a seed, have in common."""
    from ..shapes.dice import Dice
    from .generate.catalogue import CATEGORIES
    from .generate.category import named

    counts: dict[str, Counter[str]] = {}
    still = []
    for name in categories:
        category = named(name, CATEGORIES)
        still += [] if category.moves else [name]
        for number in range(_ASKED):
            for k, body in enumerate(category.make(Dice((seed, number, 3))).bodies):
                label = body.label if k else BODY
                for key in (f"{name}/{label}", f"/{label}"):
                    counts.setdefault(key, Counter())[body.material] += 1
    usual = {key: sorted(found, key=lambda m: (-found[m], m))[0] for key, found in sorted(counts.items())}
    return Knowledge(materials=usual, still=tuple(still))
