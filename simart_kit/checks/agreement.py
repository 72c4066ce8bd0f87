"""Check `agreement`: every format says the same of masses, joints, shapes and poses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from pydantic import Field

from ..asset import MassProperties
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .mechanism import Link, Mechanism
from .subject import Subject

_POSES = 5
# Kinds that a format may have to write as fixed, which its exporter then tells.
_NOT_EVERYWHERE = ("ball", "free")


class Agreement(Check):
    """Masses, centres, inertias, limits, poses and counts of shapes are those of the asset in each file.

    Without an asset, files are compared with the first of them.
    """

    name = "agreement"

    class Options(StageOptions):
        """How equal."""

        difference: float = Field(
            default=1e-5, gt=0, description="Of lengths [m], angles [rad] and, as a share, of masses."
        )

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Each file against the reference."""
        found, reference = subject.mechanisms, subject.mechanism
        name = "the asset" if subject.asset is not None else next(iter(found))
        rows = {
            kind: list(self._differences(reference, other))
            for kind, other in found.items()
            if other is not reference
        }
        wrong = [f"{kind}: {text}" for kind, texts in rows.items() for text in texts]
        sound = f"{', '.join(rows)} as {name}" if rows else "nothing to compare with"
        evidence = {"reference": name, "differences": rows}
        return CheckResult(self.name, not wrong, "; ".join(wrong) or sound, evidence)

    def _differences(self, one: Mechanism, other: Mechanism) -> Iterator[str]:
        if one.body.keys() != other.body.keys():
            listed = ", ".join(sorted(one.body.keys() ^ other.body.keys()))
            yield f"bodies differ: {listed}"
            return
        for name, body in one.body.items():
            mass, its = body.mass, other.body[name].mass
            if (mass is None) != (its is None):
                yield f"{name}: mass is in one only"
            elif mass and its and (text := self._masses(mass, its)):
                yield f"{name}: {text}"
            here, there = len(body.colliders), len(other.body[name].colliders)
            if here != there:
                yield f"{name}: {there} collision shapes instead of {here}"
        yield from self._joints(one, other)

    def _masses(self, one: MassProperties, other: MassProperties) -> str:
        tolerance = self.options.difference
        here, there = np.array(one.inertia), np.array(other.inertia)
        # "Not within" rather than "beyond": what is NaN differs.
        if not abs(one.mass - other.mass) <= tolerance * one.mass:
            return f"mass {other.mass:.6g} instead of {one.mass:.6g} kg"
        apart = np.linalg.norm(np.array(one.center) - other.center)
        if not apart <= tolerance:
            return f"its centre of mass is {apart:.3g} m away"
        differ = np.abs(here - there).max() / np.trace(here)
        return "" if differ <= tolerance else f"its inertia differs by {differ:.2%}"

    def _joints(self, one: Mechanism, other: Mechanism) -> Iterator[str]:
        ours, theirs = ({link.child: link for link in m.links} for m in (one, other))
        carriers = {name: (_carrier(ours, name), _carrier(theirs, name)) for name in one.body}
        # What a free joint holds hangs on nothing, and some formats say so by having no joint.
        loose = {link.child for link in one.links if link.kind == "free" and link.child not in theirs}
        hanging = {n: pair for n, pair in carriers.items() if pair[0] != pair[1] and n not in loose}
        for name, (here, there) in hanging.items():
            yield f"{name} hangs on {there} instead of {here}"
        common = []
        for link in (link for link in one.links if link.child not in hanging.keys() | loose):
            its = theirs[link.child]
            if text := self._travel(link, its):
                yield f"{link.name} {text}"
            elif its.kind == link.kind:
                common.append((link, its))
        if not hanging:
            yield from self._poses(one, other, common)

    def _travel(self, link: Link, its: Link) -> str:
        if its.kind == "fixed" and (link.rigid or link.kind in _NOT_EVERYWHERE):
            return ""
        if its.kind != link.kind:
            return f"is {its.kind} instead of {link.kind}"
        for here, there in ((link.lower, its.lower), (link.upper, its.upper)):
            if not _near(here, there, self.options.difference):
                return f"goes to {_shown(there)} instead of {_shown(here)}"
        return ""

    def _poses(self, one: Mechanism, other: Mechanism, links: list[tuple[Link, Link]]) -> Iterator[str]:
        """Where bodies stand at a few positions drawn within limits."""
        rng, worst = np.random.default_rng(0), dict.fromkeys(one.body, 0.0)
        # What lies loose in a drawer goes with it in one format, and by contact alone in another.
        lying = {link.child for link in one.links if link.kind == "free"}
        for _ in range(_POSES):
            values = [rng.uniform(*_span(link)) for link, _ in links]
            here = one.posed({link.name: v for (link, _), v in zip(links, values, strict=True)})
            there = other.posed({its.name: v for (_, its), v in zip(links, values, strict=True)})
            for name in here.keys() - lying:
                worst[name] = max(worst[name], float(np.abs(here[name] - there[name]).max()))
        for name, difference in worst.items():
            if not difference <= self.options.difference:
                yield f"{name} moves elsewhere: poses differ by {difference:.2g}"


def _carrier(links: Mapping[str, Link], name: str) -> str:
    return links[name].parent if name in links else "nothing"


def _near(one: float | None, other: float | None, tolerance: float) -> bool:
    """Whether two limits are the same; None is no limit."""
    return one is other if one is None or other is None else abs(one - other) <= tolerance


def _shown(limit: float | None) -> str:
    return "no limit" if limit is None else f"{limit:.6g}"


def _span(link: Link) -> tuple[float, float]:
    if link.lower is not None and link.upper is not None:
        return link.lower, link.upper
    return (-np.pi, np.pi) if link.kind == "continuous" else (0.0, 0.0)
