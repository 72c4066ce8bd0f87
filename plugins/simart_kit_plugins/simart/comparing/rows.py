"""The rows of the ablation: how each writes voxels, and whether it sees."""

from __future__ import annotations

from dataclasses import dataclass

from simart_kit.errors import BadInputError


@dataclass(frozen=True)
class Row:
    """A row.

    Attributes:
        key: on the command line.
        title: in tables, as in the paper's.
        dense: a code for every cell and no coordinates, in question and answer; else a triplet a cell.
        dropped: codes are those of a voxel model without zero token, and the one code that most empty cells
            have is left out; else they are the data's own.
        picture: whether the model is shown the object.
        paper: output tokens an object in the paper's table.
    """

    key: str
    title: str
    dense: bool
    dropped: bool
    picture: bool
    paper: int


ROWS = (
    Row("dense", "Dense token", True, False, False, 4138),
    Row("force-sparse", "Force sparse", False, True, False, 862),
    Row("zero-sparse", "Zero sparse", False, False, False, 516),
    Row("vision", "Zero sparse + vision", False, False, True, 516),
)


def chosen_rows(names: str | None) -> tuple[Row, ...]:
    """The rows of a list such as "dense,vision", in the table's order; all of them for None.

    Raises:
        BadInputError: a name is unknown, or there is none.
    """
    if names is None:
        return ROWS
    asked = [name.strip() for name in names.split(",") if name.strip()]
    known = [row.key for row in ROWS]
    unknown = [name for name in asked if name not in known]
    if unknown or not asked:
        fault = f"unknown row {unknown[0]!r}" if asked else "no row"
        raise BadInputError(f"--rows: {fault}; rows are {', '.join(known)}")
    return tuple(row for row in ROWS if row.key in asked)
