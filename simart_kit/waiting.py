"""How far each joint of an object is free to go, some once others are open: a rack waits for its door."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .asset import Asset, Joint, Limits
from .beside import ALONE, Beside
from .bounds import bounds_of, sharing
from .kinematics import LEAST_TRAVEL, carried, reach_box, rest_to_posed
from .sweeping import Sweep, free_range, move

_ENOUGH = 0.5  # of the wanted travel: what comes so far waits for nothing, and waiting has to yield it
SMALL, _HELD = 0.1, 0.3  # of the object's diagonal: buttons, keys and switches; triggers and grips
# Words of what fingers press, which may take half of the object: a presenter's touchpad.
_PRESSED, _MOST = {"button", "key", "switch", "touchpad", "trigger", "squeeze", "thumbstick"}, 0.5
_KNOBS, _MIDDLE = {"knob", "dial"}, 0.1  # how far from its middle, of its size, a knob's line may pass
_LITTLE, _TILT = 0.25, np.deg2rad(30.0)  # of its size that a larger thing is pressed, and how far one turns


@dataclass(frozen=True)
class FreeRange:
    """How far a joint can go before surfaces meet.

    Attributes:
        lower: lowest position [rad | m].
        upper: highest position [rad | m].
        opened: positions of the joints that have to be open for it, by name; none where it goes by itself.
    """

    lower: float
    upper: float
    opened: Mapping[str, float] = field(default_factory=dict)

    @property
    def travel(self) -> float:
        """From end to end [rad | m]."""
        return self.upper - self.lower


def free_ranges(asset: Asset, steps: int, seed: int, beside: Beside = ALONE) -> dict[str, FreeRange]:
    """The free range of each limited joint, by name, within its limits.

    What is in the way of a joint that hardly moves is no obstacle if its own joint can take it out of there.
    It is then as far from rest as it goes, and so is what it waits for itself. Two that wait for each other
    stay blocked.

    Args:
        asset: at rest.
        steps: stops on the way to each limit.
        seed: of the sampling.
        beside: who looks at every second joint.
    """
    limited = [joint for joint in asset.joints if joint.limits is not None]
    ways = [(joint, faces_of(asset, joint.child)) for joint in limited]
    vertices, faces = asset.mesh.vertices, asset.mesh.faces
    others = beside.ask(_each_free, vertices, faces, ways[1::2], steps, seed)
    free = _each_free(vertices, faces, ways[::2], steps, seed) | others.result()
    found = {joint.name: free[joint.name] for joint in limited}
    held = [joint for joint in limited if found[joint.name].travel < _ENOUGH * wanted(joint)]
    for _ in held:
        better = {joint.name: _waited(asset, joint, found, steps, seed) for joint in held}
        if better == {joint.name: found[joint.name] for joint in held}:
            break
        # One at a time: what has just found out that it waits for another must not be waited for by that one.
        first = next(name for name, free in better.items() if free != found[name])
        found[first] = better[first]
        held = [joint for joint in held if joint.name != first]
    return found


def stops(joint: Joint, free: FreeRange, least: float) -> bool:
    """Whether a joint with limits comes less than this share of its way, or none."""
    return free.travel < max(least * wanted(joint), LEAST_TRAVEL)


def sunk(asset: Asset, joint: Joint, steps: int, seed: int, held: Collection[str] = ()) -> Joint | None:
    """A joint that moves something small into the part that carries it, as a button without a hole.

    It is small beside the object, or its label says that it is pressed; slides by no more than its own length
    along its axis, or turns or slides by little, as triggers and grips do; and nothing else is in its way.
    What slides farther goes as far as that, if its label says that it is pressed. A knob, by its label, turns
    about its own middle as far as it wants.

    Args:
        asset: at rest.
        joint: with limits.
        steps: stops on the way to each limit.
        seed: of the sampling.
        held: other parts that are held where they are: on its carrier, they are one with that.

    Returns:
        The joint with the travel that it may have; None if it may have none.
    """
    if joint.kind not in ("prismatic", "revolute") or wanted(joint) < LEAST_TRAVEL:
        return None
    mesh, moving = asset.mesh, faces_of(asset, joint.child)
    points = mesh.vertices[mesh.faces[moving]].reshape(-1, 3)
    along, size = np.ptp(points @ np.array(joint.axis)), np.linalg.norm(np.ptp(points, axis=0))
    words = set(asset.part(joint.child).label.replace("_", " ").split())
    named = not _PRESSED.isdisjoint(words)
    little = _LITTLE * size
    most = _TILT if joint.turns else max(along, little) if size <= SMALL * mesh.diagonal else little
    if joint.turns and not _KNOBS.isdisjoint(words) and _within(joint, points):
        most, named = np.inf, False
    elif named and not joint.turns:
        joint = _shortened(joint, float(most))
    if wanted(joint) > most or size > (_MOST if named else _HELD) * mesh.diagonal:
        return None
    fixed = [name for name in held if _parent(asset, name) == joint.parent]
    carrier = np.isin(asset.face_part, [asset.part_index(name) for name in (joint.parent, *fixed)])
    free = swept(asset, joint, {}, carrier, steps, seed).travel == wanted(joint)
    return joint if free else None


def _parent(asset: Asset, part: str) -> str | None:
    joint = asset.joint_to(part)
    return None if joint is None else joint.parent


def _within(joint: Joint, points: FloatArray) -> bool:
    """Whether a line leads through the middle of (N, 3) points."""
    off = (points.max(axis=0) + points.min(axis=0)) / 2 - np.array(joint.origin)
    distance = np.linalg.norm(np.cross(off, np.array(joint.axis)))
    return bool(distance < _MIDDLE * np.linalg.norm(np.ptp(points, axis=0)))


def _shortened(joint: Joint, most: float) -> Joint:
    """A joint whose travel, if it is longer than `most`, is shortened to that on both sides of rest alike."""
    assert joint.limits is not None
    share = min(1.0, most / max(wanted(joint), 1e-12))
    return replace(joint, limits=Limits(share * joint.limits.lower, share * joint.limits.upper))


def _waited(asset: Asset, joint: Joint, found: Mapping[str, FreeRange], steps: int, seed: int) -> FreeRange:
    """The range of a joint once what can go out of its way is; as found where that is no more."""
    alone = found[joint.name]
    others = {name: faces_of(asset, asset.joint(name).child) for name in _openable(asset, joint, found)}
    gone = np.any([np.zeros(len(asset.face_part), dtype=bool), *others.values()], axis=0)
    most = swept(asset, joint, {}, gone, steps, seed)
    least = _ENOUGH * wanted(joint)
    if not others or most.travel < least:
        return alone
    mine = faces_of(asset, joint.child)
    reach = reach_box(joint, asset.mesh.points_of(mine))
    blockers = [
        name
        for name, faces in others.items()
        if len(sharing(reach, np.array([bounds_of(asset.mesh.points_of(faces))])))
        and swept(asset, joint, {}, ~(faces | mine), steps, seed).travel < most.travel
    ]
    opened: dict[str, float] = {}
    for name in blockers:
        free = found[name]
        opened |= {**free.opened, name: max(free.lower, free.upper, key=abs)}
    waited = swept(asset, joint, opened, np.zeros_like(gone), steps, seed)
    return FreeRange(waited.lower, waited.upper, opened) if waited.travel >= least else alone


def _openable(asset: Asset, joint: Joint, found: Mapping[str, FreeRange]) -> list[str]:
    """Names of the joints that could make way: they do not carry this one, hang on it or wait for it."""
    mine = carried(asset, joint.child)
    return [
        name
        for name, free in found.items()
        if asset.joint(name).child not in mine
        and joint.child not in carried(asset, asset.joint(name).child)
        and joint.name not in free.opened
        and free.travel > 0
    ]


def swept(
    asset: Asset, joint: Joint, opened: Mapping[str, float], without: BoolArray, steps: int, seed: int
) -> FreeRange:
    """The free range of a joint with limits, whatever it waits for.

    Args:
        asset: at rest.
        joint: as it shall be; its child is the asset's.
        opened: positions of other joints that are open, by name.
        without: (F,) faces that are left out.
        steps: stops on the way to each limit.
        seed: of the sampling.
    """
    mesh, moving = asset.mesh, faces_of(asset, joint.child)
    vertices, faces = mesh.vertices, mesh.faces
    if opened:
        posed = rest_to_posed(asset, opened)
        places, faces = [vertices], faces.copy()
        for name in _moved(asset, opened):
            part = asset.face_part == asset.part_index(name)
            faces[part] += len(vertices) * len(places)
            places.append(move(posed[name], vertices))
        vertices = np.concatenate(places)
    return _free(vertices, faces, joint, moving, without, steps, seed)


def _each_free(
    vertices: FloatArray, faces: IntArray, ways: Sequence[tuple[Joint, BoolArray]], steps: int, seed: int
) -> dict[str, FreeRange]:
    """The free range of each joint, by name, that moves some of the (F,) faces against all others."""
    none = np.zeros(len(faces), dtype=np.bool_)
    return {joint.name: _free(vertices, faces, joint, moving, none, steps, seed) for joint, moving in ways}


def _free(
    vertices: FloatArray,
    faces: IntArray,
    joint: Joint,
    moving: BoolArray,
    without: BoolArray,
    steps: int,
    seed: int,
) -> FreeRange:
    sweep = Sweep(vertices, faces[moving], faces[~(moving | without)], seed, holes=True)
    return FreeRange(*free_range(joint, sweep, steps))


def _moved(asset: Asset, opened: Collection[str]) -> list[str]:
    """Names of the parts that move when joints are opened, in the asset's order."""
    names = set().union(*(carried(asset, asset.joint(name).child) for name in opened))
    return [part.name for part in asset.parts if part.name in names]


def faces_of(asset: Asset, part: str) -> BoolArray:
    """(F,) faces of a part and of what it carries."""
    return np.isin(asset.face_part, [asset.part_index(name) for name in carried(asset, part)])


def wanted(joint: Joint) -> float:
    """The whole travel of a joint with limits [rad | m]."""
    assert joint.limits is not None
    return joint.limits.upper - joint.limits.lower
