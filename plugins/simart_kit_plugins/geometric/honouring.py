"""What a spec states, honoured among geometry's own candidates: which fronts move, and about which lines."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from simart_kit import Joint, Mesh, Segmentation
from simart_kit.spec.choosing import Option, choose
from simart_kit.spec.places import part_places
from simart_kit.spec.values import Spec
from simart_kit.spec.wishes import kind_of, wishes_of

from .candidates import Candidate, Choice, hinges, slide, spin
from .choice import Surroundings, edge_score, hinge_score, slide_score
from .movers import Mover
from .rounds import round_axis
from .scene import Scene
from .views import View

_CONFIDENCE = 0.5  # of what a spec states and geometry alone would not have chosen


def chosen_movers(
    spec: Spec, scene: Scene, sure: Sequence[Mover], doubtful: Callable[[], Sequence[Mover]]
) -> list[Mover]:
    """As many movers of each kind as are stated; those in doubt are asked for where there are too few."""
    chosen = _chosen(spec, scene, sure, ())
    enough = all(
        stated.count is None or stated.count <= sum(_is(spec, mover, word) for mover in chosen)
        for word, stated in spec.kinds.items()
    )
    return chosen if enough else _chosen(spec, scene, sure, doubtful())


def granting(mesh: Mesh, segmentation: Segmentation, spec: Spec) -> Callable[[int, Joint], bool]:
    """Whether kind and axis of a joint of the part of a number are as stated."""
    wishes = wishes_of(spec, segmentation.parts, mesh.bounds)
    labels = [guess.label or guess.name for guess in segmentation.parts]
    places = part_places(mesh, segmentation.face_part, labels)
    return lambda part, joint: wishes[part].granted(joint, places[part])


def alternatives(scene: Scene, view: View, label: str, around: Surroundings) -> tuple[Choice, ...]:
    """Every joint that the geometry allows a part; the one for which most speaks first."""
    sliding, hinged = slide_score(view, label), hinge_score(view, label)
    found: list[tuple[float, Candidate, tuple[str, ...]]] = [(sliding.value, slide(view), sliding.reasons)]
    for hinge in hinges(view):
        best = edge_score(view, hinge, around)
        found.append((hinged.value + best.value, hinge, hinged.reasons + best.reasons))
    points = scene.points_of(view.part)
    axis = round_axis(points)
    if axis is not None:
        middle = view.axes @ ((points.max(axis=0) + points.min(axis=0)) / 2)
        found.append((0.0, spin(view.axes[:, axis], middle), ("round about this axis",)))
    ranked = sorted(found, key=lambda one: -one[0])
    return tuple((joint, _CONFIDENCE, (*reasons, "as the spec states")) for _, joint, reasons in ranked)


def _chosen(spec: Spec, scene: Scene, sure: Sequence[Mover], doubtful: Sequence[Mover]) -> list[Mover]:
    movers = [*sure, *doubtful]
    options = [
        Option(m.label, m.score, float(scene.areas[list(m.pieces)].sum()), k < len(sure))
        for k, m in enumerate(movers)
    ]
    labels = choose(spec, options)
    return [
        mover if label == mover.label else replace(mover, label=label)
        for mover, label in zip(movers, labels, strict=True)
        if label is not None
    ]


def _is(spec: Spec, mover: Mover, word: str) -> bool:
    return kind_of(spec, mover.label) == word
