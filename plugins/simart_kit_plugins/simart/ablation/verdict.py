"""Whether the zero token beat the model without one, in this run."""

from __future__ import annotations

from dataclasses import dataclass

from .experiment import Ablation, Block, Row
from .judging import Judgement
from .variants import FORCE_SPARSE, ZERO


@dataclass(frozen=True)
class Verdict:
    """Chamfer distances in the paper's sense, means over grids [square of the cube's side].

    Attributes:
        block: what was judged on.
        zero, force_sparse: by the decoder alone.
        zero_masked, force_sparse_masked: with cells without a token empty.
        zero_lost, force_sparse_lost: number of grids of which no voxel came back, by the decoder alone.
        zero_found, force_sparse_found: by the decoder alone, means over the grids that neither lost; None
            where there is none.
        better, equal, grids: on how many grids the zero token's distance is the lower one, and the same, by
            the decoder alone; of how many.
    """

    block: str
    zero: float
    force_sparse: float
    zero_masked: float
    force_sparse_masked: float
    zero_lost: int
    force_sparse_lost: int
    zero_found: float | None
    force_sparse_found: float | None
    better: int
    equal: int
    grids: int

    def text(self) -> str:
        """Sentences for people."""
        where = f"on {self.grids} grids of {self.block}"
        return (
            f"{_compared(self.zero, self.force_sparse)} {where} in this run, codes alone: "
            f"CD x1e5 {_shown(self.zero)} against {_shown(self.force_sparse)}, lower on {self.better} grids, "
            f"equal on {self.equal}; masked {_shown(self.zero_masked)} against "
            f"{_shown(self.force_sparse_masked)}.{self._lost()}"
        )

    def _lost(self) -> str:
        if not self.zero_lost and not self.force_sparse_lost:
            return ""
        lost = f"{self.zero_lost} and {self.force_sparse_lost}"
        told = f" Of {lost} grids nothing came back, which weighs most in CD"
        if self.zero_found is None or self.force_sparse_found is None:
            return f"{told}: train longer to compare the two."
        return f"{told}; on the others {_shown(self.zero_found)} against {_shown(self.force_sparse_found)}."


def verdicts(ablation: Ablation) -> tuple[Verdict, ...]:
    """One for each block; none where a row of the two is missing."""
    rows = {row.key: row for row in ablation.rows}
    if ZERO not in rows or FORCE_SPARSE not in rows:
        return ()
    return tuple(
        _verdict(block, i, rows[ZERO], rows[FORCE_SPARSE]) for i, block in enumerate(ablation.blocks)
    )


def _verdict(block: Block, number: int, zero: Row, force_sparse: Row) -> Verdict:
    ours: Judgement = zero.judgements[number]
    theirs: Judgement = force_sparse.judgements[number]
    found = ~(ours.lost_alone | theirs.lost_alone)
    return Verdict(
        block.title,
        ours.alone.cd_squared,
        theirs.alone.cd_squared,
        ours.masked.cd_squared,
        theirs.masked.cd_squared,
        ours.alone.nothing,
        theirs.alone.nothing,
        float(ours.each_alone[found].mean()) if found.any() else None,
        float(theirs.each_alone[found].mean()) if found.any() else None,
        int((ours.each_alone < theirs.each_alone).sum()),
        int((ours.each_alone == theirs.each_alone).sum()),
        len(block.grids),
    )


def _compared(zero: float, force_sparse: float) -> str:
    if zero == force_sparse:
        return "The zero token and force sparse are equal on CD"
    return f"The zero token {'beat' if zero < force_sparse else 'did not beat'} force sparse on CD"


def _shown(value: float) -> str:
    return f"{value * 1e5:.2f}"
