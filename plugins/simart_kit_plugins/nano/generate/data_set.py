"""Many objects: which dice make which, and folders of them."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import staging

from ...shapes.dice import Dice
from .category import Category
from .objects import GeneratedObject
from .posing import ajar
from .skins import skin_of, write_skin
from .writing import write_object

# Told after each object: done, and of how many.
Progress = Callable[[int, int], None]
_MAKE, _POSE, _PAINT, _COVER = range(4)


def generated(category: Category, seed: int, number: int, open_share: float = 1 / 3) -> GeneratedObject:
    """Object `number` of a category and a seed, whatever else is made.

    Args:
        category: of the object.
        seed: of the data set, from 0.
        number: of the object, from 0.
        open_share: how many joints stand somewhere between their limits; 0..1.
    """
    made = category.make(_dice(category, seed, number, _MAKE))
    return ajar(made, _dice(category, seed, number, _POSE), open_share)


def write_objects(
    categories: Sequence[Category],
    count: int,
    seed: int,
    out: Path,
    open_share: float = 1 / 3,
    progress: Progress | None = None,
    skins: bool = False,
) -> tuple[Path, ...]:
    """Write `count` objects of each category as SIMART-Bench folders out/CATEGORY_0000 and so on.

    All are written aside first, so that a run that stops leaves nothing behind. With `skins`, each also gets
    a closed skin, as the variant `fused`.

    Returns:
        The folders.

    Raises:
        BadInputError: one of the folders is there already.
        OutputError: they cannot be written.
    """
    jobs = [(category, number) for category in categories for number in range(count)]
    names = [f"{category.name}_{number:04d}" for category, number in jobs]
    there = [name for name in names if (out / name).exists()]
    if there:
        raise BadInputError(f"{out / there[0]} is there already: choose another folder")
    with staging(out) as draft:
        try:
            for done, ((category, number), name) in enumerate(zip(jobs, names, strict=True), start=1):
                made = generated(category, seed, number, open_share)
                mesh = write_object(made, name, draft / name, _dice(category, seed, number, _PAINT))
                if skins:
                    generator = np.random.default_rng(_entropy(category, seed, number, _COVER))
                    write_skin(skin_of(mesh, generator), draft / name)
                if progress is not None:
                    progress(done, len(jobs))
            for name in names:
                (draft / name).rename(out / name)
        except OSError as error:
            raise OutputError(f"cannot write to {out}: {error.strerror or error}") from error
    return tuple(out / name for name in names)


def _dice(category: Category, seed: int, number: int, use: int) -> Dice:
    return Dice(_entropy(category, seed, number, use))


def _entropy(category: Category, seed: int, number: int, use: int) -> tuple[int, ...]:
    """What decides chance for one use; a name's checksum keeps categories apart when others are added."""
    return seed, zlib.crc32(category.name.encode()), number, use
