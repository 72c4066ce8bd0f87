"""What formats cannot show, and the sentences that say so."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from simart_kit.bake import loses_colors
from simart_kit.surfaces import Surface

from .sheets import backed, is_speck


def joined(found: Iterable[tuple[str, Sequence[str]]]) -> tuple[str, ...]:
    """A sentence for each text that has names."""
    return tuple(f"{text}: {', '.join(names)}" for text, names in found if names)


def hiding_colors(groups: Mapping[str, Sequence[Surface]]) -> list[str]:
    """Names of the parts whose texture hides vertex colours that are not plain white."""
    return [name for name, surfaces in groups.items() if any(map(loses_colors, surfaces))]


def look_gaps(groups: Mapping[str, Sequence[Surface]]) -> tuple[str, ...]:
    """A sentence for each way in which OBJ files differ from the surfaces of an asset, by part."""
    maps = {
        part: any(s.material.normal_image or s.material.metallic_roughness_image for s in surfaces)
        for part, surfaces in groups.items()
    }
    return joined(
        (
            ("vertex colours beside a texture are left out", hiding_colors(groups)),
            ("normal, metallic and roughness textures are left out", [n for n, has in maps.items() if has]),
            (
                "a surface smaller than a speck is left out",
                [n for n, g in groups.items() if any(map(is_speck, g))],
            ),
            (
                "a flat surface is given a back, for simulators refuse meshes without volume",
                [n for n, g in groups.items() if any(not is_speck(s) and backed(s) is not s for s in g)],
            ),
        )
    )
