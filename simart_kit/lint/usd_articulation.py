"""USD articulations: bodies and joints as a graph, and the roots over it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from .findings import Finding
from .usd_joints import ends, missing_ends
from .usd_scene import UsdScene, body_of, stated

if TYPE_CHECKING:
    from pxr import Usd

_WORLD = ""


def articulation_findings(scene: UsdScene) -> Iterator[Finding]:
    """Breaches by loops of joints and by articulation roots."""
    links = list(_links(scene))
    yield from _loop_findings(links)
    covered = _roots_by_body(scene)
    yield from _missing_findings(scene, links, covered)
    for root in _roots(scene):
        yield from _static_findings(root)
    told = set()
    for roots in covered.values():
        if len(roots) > 1 and roots[-1] not in told:
            told.add(roots[-1])
            text = f"its bodies belong to root {roots[0]} too: keep one of the two"
            yield Finding("articulation-nested", roots[-1], text)


def _links(scene: UsdScene) -> Iterator[tuple[str, str, str]]:
    """Path of every joint that makes an articulation, and those of the bodies it connects."""
    for joint in scene.joints:
        off = stated(joint, "physics:jointEnabled") is False
        if off or stated(joint, "physics:excludeFromArticulation") or missing_ends(scene, joint):
            continue
        one, two = (str(end.GetPath()) if end else _WORLD for end in ends(scene, joint))
        if one != two:
            yield str(joint.GetPath()), one, two


def _groups(bodies: list[str], links: list[tuple[str, str, str]]) -> tuple[dict[str, str], list[str]]:
    """For each body, one that stands for all it is connected with; and the joints that close loops."""
    leader = {body: body for body in [*bodies, _WORLD]}
    closing = []
    for joint, one, two in links:
        first, second = leader[one], leader[two]
        if first == second:
            closing.append(joint)
        leader = {body: first if head == second else head for body, head in leader.items()}
    return leader, closing


def _loop_findings(links: list[tuple[str, str, str]]) -> Iterator[Finding]:
    bodies = [body for _, *pair in links for body in pair]
    for joint in _groups(bodies, links)[1]:
        text = "it closes a loop of joints: remove it, or set excludeFromArticulation"
        yield Finding("joint-loop", joint, text)


def _roots(scene: UsdScene) -> list[Usd.Prim]:
    from pxr import UsdPhysics

    return [prim for prim in scene.prims if prim.HasAPI(UsdPhysics.ArticulationRootAPI)]


def _roots_by_body(scene: UsdScene) -> dict[str, list[str]]:
    """Paths of the roots of every body's group, parents first."""
    links = [(joint, one, two) for joint, one, two in _links(scene) if _WORLD not in (one, two)]
    leader, _ = _groups([str(body.GetPath()) for body in scene.bodies], links)
    found: dict[str, list[str]] = {body: [] for body in leader}
    for root in _roots(scene):
        heads = {leader[str(body.GetPath())] for body in _governed(scene, root)}
        for body, head in leader.items():
            if head in heads:
                found[body].append(str(root.GetPath()))
    return found


def _governed(scene: UsdScene, root: Usd.Prim) -> list[Usd.Prim]:
    """The bodies that a root names: itself, those that it joins, or those below it."""
    from pxr import UsdPhysics

    if root.IsA(UsdPhysics.Joint):
        return [body for body in ends(scene, root) if body]
    if root in scene.bodies:
        return [root]
    return [body for body in scene.bodies if body.GetPath().HasPrefix(root.GetPath())]


def _missing_findings(
    scene: UsdScene, links: list[tuple[str, str, str]], covered: dict[str, list[str]]
) -> Iterator[Finding]:
    for joint, one, two in links:
        if _WORLD not in (one, two) and not covered[one]:
            text = "its bodies have no articulation root: apply ArticulationRootAPI to the base or its joint"
            yield Finding("articulation-missing", joint, text)
            return


def _static_findings(root: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdPhysics

    off = root.HasAPI(UsdPhysics.RigidBodyAPI) and body_of(root) != root
    if off or stated(root, "physics:kinematicEnabled"):
        text = "an articulation root cannot be static or kinematic: fix the body with a joint instead"
        yield Finding("articulation-static", str(root.GetPath()), text)
