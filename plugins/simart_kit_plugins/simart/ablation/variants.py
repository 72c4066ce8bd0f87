"""The rows of the ablation: what each changes in the config that all start from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from pydantic import ValidationError

from simart_kit.errors import BadInputError

from ...tables import told
from ..models import VoxelConfig

ZERO, FORCE_SPARSE, DENSE = "zero", "force-sparse", "dense"


@dataclass(frozen=True)
class Variant:
    """A row.

    Attributes:
        key: on the command line, and the name of its folder.
        title: in tables.
        changes: of the config that all rows start from.
        codebooks: size of its codebook, in those of that config.
    """

    key: str
    title: str
    changes: Mapping[str, str]
    codebooks: int = 1

    def of(self, config: VoxelConfig) -> VoxelConfig:
        """The config of this row.

        Raises:
            BadInputError: the network cannot have this row's tokens.
        """
        changed = {**self.changes, "codebook_size": config.codebook_size * self.codebooks}
        try:
            return type(config).model_validate(config.model_dump() | changed)
        except ValidationError as error:
            raise BadInputError(
                f"the config cannot be changed to row '{self.key}' ({told(error)}): "
                "leave the row out with --rows, or take another --config"
            ) from error


VARIANTS = (
    Variant(ZERO, "Sparse 8x8x8", {"grid": "8x8x8", "mode": "zero"}),
    Variant("16x8x8", "Sparse 16x8x8", {"grid": "16x8x8", "mode": "zero"}),
    Variant("codebook-x2", "Codebook x2", {"grid": "8x8x8", "mode": "zero"}, codebooks=2),
    Variant(FORCE_SPARSE, "Force sparse (no zero token)", {"grid": "8x8x8", "mode": "force-sparse"}),
    Variant(DENSE, "Dense", {"grid": "8x8x8", "mode": "dense"}),
)


def chosen_variants(names: str | None) -> tuple[Variant, ...]:
    """The rows of a list such as "zero,dense", in the tables' order; all of them for None.

    Raises:
        BadInputError: a name is unknown, or there is none.
    """
    if names is None:
        return VARIANTS
    asked = [name.strip() for name in names.split(",") if name.strip()]
    known = ", ".join(variant.key for variant in VARIANTS)
    unknown = [name for name in asked if name not in {variant.key for variant in VARIANTS}]
    if unknown or not asked:
        raise BadInputError(
            f"--rows: {f'unknown row {unknown[0]!r}' if asked else 'no row'}; rows are {known}"
        )
    return tuple(variant for variant in VARIANTS if variant.key in asked)
