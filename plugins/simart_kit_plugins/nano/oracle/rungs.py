"""The steps of the ladder that need no network: nano's pieces, and its best candidates for them."""

from __future__ import annotations

from .case import Case
from .judging import Judged, judge
from .lines import best_joint, part_candidates


def pieces_step(case: Case) -> Judged:
    """Every piece given to the part that most of it is of, with the true joints: the pieces' ceiling."""
    return judge(case.truth, case.with_links(case.truth.links))


def candidates_step(case: Case) -> Judged:
    """These parts with the best candidate of each."""
    joints = {
        link: best_joint(part_candidates(case.seen.cloud, pieces), case.truth.links[link])
        for link, pieces in case.groups().items()
    }
    return judge(case.truth, case.with_joints(joints))
