"""How controls move: caps are pressed along where they face, triggers and sticks turn about level axes."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import unit

from .candidates import Candidate, Choice
from .caps import measure_cap
from .rounds import round_axis
from .scene import Scene
from .views import View

_PRESSED = 0.2  # of its width, how far a cap goes in
_PULLED, _TILTED = np.deg2rad(20.0), np.deg2rad(25.0)
_AHEAD, _UP = 0.37, 0.3  # of a trigger's box, from its middle, where the pin is that it hangs on
_LEANS = 0.1  # of its outward direction, from which on it tells ahead from behind; else its place does
_TURNED = np.deg2rad(270.0)  # most knobs have stops
_ROUNDED = 0.8  # width over length, of what is still round
_SET = 0.7  # share of its rim beside which something lies, from which on a peg stands in something
_AHEAD_ITSELF = 0.99  # of its outward direction, of a stick that points ahead: no axis of its own does
_PLAIN = 0.5  # length of the mean normal, from which on a piece faces one way


def pressed(scene: Scene, view: View) -> Choice | None:
    """Straight into what it sits on, against where it faces."""
    cap = measure_cap(scene, (view.part,))
    if cap is None or (cap.facing < _PLAIN and cap.rimmed < _SET):
        return None
    joint = Candidate("prismatic", view.axes @ -cap.outward, view.axes @ cap.top, _PRESSED * cap.wide)
    return joint, 0.7, ("pressed along where it faces",)


def pulled(scene: Scene, view: View) -> Choice | None:
    """About a level axis across the thing, at the upper end that is farther from the hand."""
    cap = measure_cap(scene, (view.part,))
    if cap is None:
        return None
    box = scene.boxes[view.part]
    leans = cap.outward
    if np.abs(leans[:2]).max() < _LEANS:
        leans = box.center - scene.box.center
    along = int(abs(leans[1]) >= abs(leans[0]))
    axis, away = np.eye(3)[1 - along], np.sign(leans[along]) * np.eye(3)[along]
    root = box.center + box.size * (_AHEAD * away + [0.0, 0.0, _UP])
    # Pulled, its lower end goes back towards the hand.
    turned = axis if np.cross(axis, [0.0, 0.0, -1.0]) @ away < 0 else -axis
    joint = Candidate("revolute", view.axes @ turned, view.axes @ root, _PULLED)
    return joint, 0.6, ("hung at its upper end",)


def tilted(scene: Scene, view: View) -> Choice | None:
    """Sideways, about the foot of its stem: of its two axes the one that points ahead."""
    cap = measure_cap(scene, (view.part,))
    if cap is None or abs(cap.outward[1]) > _AHEAD_ITSELF:
        return None
    ahead = unit(np.array([0.0, 1.0, 0.0]) - cap.outward[1] * cap.outward)
    foot = cap.top - cap.thick * cap.outward
    joint = Candidate("revolute", view.axes @ ahead, view.axes @ foot, _TILTED)
    return joint, 0.5, ("tilts about the foot of its stem",)


def turned(scene: Scene, view: View) -> Choice | None:
    """About the axis that a knob is round about; with a bar across it, about the one along which it faces."""
    points = scene.points_of(view.part)
    axis, cap = round_axis(points), measure_cap(scene, (view.part,))
    if axis is None and (cap is None or cap.narrow < _ROUNDED * cap.wide):
        return None
    outward = cap.outward if axis is None and cap is not None else np.eye(3)[axis]
    middle = (points.max(axis=0) + points.min(axis=0)) / 2
    return (
        Candidate("revolute", view.axes @ outward, view.axes @ middle, _TURNED),
        0.7,
        ("round about this axis",),
    )
