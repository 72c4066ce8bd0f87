"""What became of each statement of a spec: honoured, or not and why. Judged on the finished asset."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..asset import Asset, Joint
from .moving import same_limits
from .places import Place, fits, part_places
from .values import Motion, PartSpec, Spec, position_limits
from .wishes import kind_of, place_of

_NEAR = 0.01  # of the object's diagonal: a line this near a point goes through it


@dataclass(frozen=True)
class Verdict:
    """What became of one statement.

    Attributes:
        statement: as the spec has it, such as "kinds.door.count = 2".
        why: why it was not honoured; "" where it was.
    """

    statement: str
    why: str = ""

    @property
    def text(self) -> str:
        """One line for the report."""
        return f"{self.statement}: {f'not honoured: {self.why}' if self.why else 'honoured'}"


def with_verdicts(asset: Asset, spec: Spec) -> Asset:
    """The asset with a note a statement: a warning for what was not honoured."""
    found = verdicts(spec, asset)
    told = asset.with_notes("spec", "info", [verdict.text for verdict in found if not verdict.why])
    return told.with_notes("spec", "warning", [verdict.text for verdict in found if verdict.why])


def verdicts(spec: Spec, asset: Asset) -> tuple[Verdict, ...]:
    """Every statement of a spec against a finished asset."""
    labels = [part.label or part.name for part in asset.parts]
    places = dict(
        zip([p.name for p in asset.parts], part_places(asset.mesh, asset.face_part, labels), strict=True)
    )
    kinds = {part.name: kind_of(spec, part.label or part.name) for part in asset.parts}
    found: list[Verdict] = []
    for word in spec.kinds:
        names = [name for name, kind in kinds.items() if kind == word]
        found += _of_kind(spec, word, names, asset, places)
    for part in spec.parts:
        found += _of_part(part, spec, asset, places)
    return tuple(found)


def _of_kind(
    spec: Spec, word: str, names: Sequence[str], asset: Asset, places: dict[str, Place]
) -> Iterator[Verdict]:
    kind, listed = spec.kinds[word], {part.name: part for part in spec.parts}
    moving = [name for name in names if _moves(asset.joint_to(name))]
    if kind.count is not None:
        why = "" if len(moving) == kind.count else _miscounted(len(moving), kind.count, names, moving)
        yield Verdict(f"kinds.{word}.count = {kind.count}", why)
    # What a part states of itself goes before what is stated of its kind.
    bound = [name for name in names if name not in listed or listed[name].joint in (None, kind.joint)]
    if not bound and any((kind.joint, kind.axis, kind.limits)) and kind.count != 0:
        yield Verdict(f"kinds.{word}", "there is none")
    told: dict[str, list[str]] = {}
    for name in bound:
        stated = listed.get(name)
        motion = kind.model_copy(
            update={k: None for k in ("axis", "limits") if stated and getattr(stated, k) is not None}
        )
        for statement, why in _of_motion(motion, asset.joint_to(name), places[name], asset.scale.factor):
            told.setdefault(statement, []).extend([f"{name}: {why}"] if why else [])
    for statement, reasons in told.items():
        yield Verdict(f"kinds.{word}.{statement}", "; ".join(reasons))


def _miscounted(found: int, count: int, names: Sequence[str], moving: Sequence[str]) -> str:
    still = [name for name in names if name not in moving]
    told = f"{found} found" + (f" ({', '.join(moving)})" if moving else "")
    if still:
        return f"{told}; {', '.join(still)} does not move"
    return f"{told}; nothing else looks like one" if found < count else told


def _of_part(part: PartSpec, spec: Spec, asset: Asset, places: dict[str, Place]) -> Iterator[Verdict]:
    if part.name not in places:
        yield Verdict(f"parts.{part.name}", "there is no such part")
        return
    joint, place, where = asset.joint_to(part.name), places[part.name], f"parts.{part.name}"
    yield Verdict(where)
    if part.root:
        yield Verdict(f"{where}.root = true", f"{joint.parent} carries it" if joint else "")
    if part.parent is not None:
        carrier = joint.parent if joint else "nothing"
        yield Verdict(
            f"{where}.parent = {part.parent}", "" if carrier == part.parent else f"{carrier} carries it"
        )
    for statement, why in _of_motion(part, joint, place, asset.scale.factor):
        yield Verdict(f"{where}.{statement}", why)
    if part.through is not None:
        bounds = asset.mesh.bounds
        factor = 1.0 if spec.coordinates == "fraction" else asset.scale.factor
        off = _distance(joint, factor * place_of(spec, part.through, bounds))
        near = off is not None and off <= _NEAR * asset.mesh.diagonal
        told = ", ".join(f"{value:g}" for value in part.through)
        why = "" if near else ("it has no axis" if off is None else f"its axis passes {off:.3g} m off")
        yield Verdict(f"{where}.through = {told}", why)


def _of_motion(motion: Motion, joint: Joint | None, place: Place, scale: float) -> Iterator[tuple[str, str]]:
    """Statements on a motion, and why each is not honoured, or ""."""
    kind = joint.kind if joint else "fixed"
    if motion.joint is not None:
        yield f"joint = {motion.joint}", "" if kind == motion.joint else f"it is {kind}"
    if motion.axis is not None:
        yield f"axis = {motion.axis}", _axis_missed(motion, joint, place)
    stated = position_limits(motion)
    if stated is not None and motion.limits is not None:
        factor = scale if motion.joint == "prismatic" else 1.0
        lower, upper = motion.limits
        yield f"limits = {lower:g} .. {upper:g}", _limits_missed(joint, stated, factor)


def _axis_missed(motion: Motion, joint: Joint | None, place: Place) -> str:
    word = motion.axis
    assert word is not None
    if joint is None or joint.kind in ("fixed", "ball", "free"):
        return "it has no axis"
    if fits(joint, word, place):
        return ""
    if word.endswith("edge") and not place.edges(word):
        return f"what opens to the {place.facing} has no {word}"
    x, y, z = (round(value, 3) + 0.0 for value in joint.axis)
    return f"its {joint.kind} axis is {x:g}, {y:g}, {z:g}"


def _limits_missed(joint: Joint | None, stated: tuple[float, float], scale: float) -> str:
    if joint is None or joint.limits is None:
        return "it has no limits"
    if same_limits(joint.limits, stated, scale):
        return ""
    unit, factor = ("degrees", 180 / np.pi) if joint.turns else ("m", 1.0)
    lower, upper = factor * joint.limits.lower, factor * joint.limits.upper
    return f"only {lower:.3g} .. {upper:.3g} {unit} are free of other parts"


def _distance(joint: Joint | None, point: FloatArray) -> float | None:
    """From a point to the axis of a joint [m]."""
    if joint is None or joint.kind in ("fixed", "free"):
        return None
    away = point - np.array(joint.origin)
    if joint.kind == "ball":
        return float(np.linalg.norm(away))
    return float(np.linalg.norm(np.cross(away, np.array(joint.axis))))


def _moves(joint: Joint | None) -> bool:
    return joint is not None and joint.moves
