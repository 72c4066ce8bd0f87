"""Controllers for one hand, as headsets have them: a handle below a face with a stick, or a wand."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, cylinder, prism, revolve, superquadric, torus
from . import looks
from .category import Category
from .objects import Body, Look, ball, hinge, slide, surface
from .rigging import DOWN, LEFT, RIGHT, Rig, lying, plate

# The frame of all makers here: the face up, the thumb at 0, the trigger to y, the handle down or to -y.
_STICK = np.array(
    [[0, -0.003], [0.0045, -0.003], [0.004, 0.006], [0.009, 0.008], [0.0085, 0.011], [0, 0.0095]]
)


def _motion_controller(dice: Dice) -> list[Body]:
    whole = _wand(dice) if dice.chance(0.3) else _grip(dice)
    return whole.bodies(rotation(RIGHT, dice.between(-0.9, 0.9)))


def _grip(dice: Dice) -> Rig:
    """A handle below a face, most with a ring around."""
    shell, dark = looks.plastic(dice), looks.rubber(dice)
    thick, long = dice.between(0.026, 0.036), dice.between(0.08, 0.13)
    deep, radius = thick * dice.between(1.0, 1.4), dice.between(0.022, 0.032)
    lean = rotation(RIGHT, dice.between(-0.3, 0.5))
    stem = superquadric((thick, deep, long), dice.between(0.3, 0.6), 0.9, 9) - [0, 0, 0.45 * long]
    whole = Rig(surface([*turned([stem], lean), *_head(dice, radius)], shell), label="body")
    if dice.chance(0.7):
        ring = dice.between(0.035, 0.055)
        tilt = rotation(RIGHT, dice.between(-0.4, 1.6))
        loop = torus(ring, dice.between(0.004, 0.008), 24) * [1, dice.between(1.0, 1.3), 1]
        whole.dress(0, surface(moved(turned([loop], tilt), (0, dice.between(0, 0.03), 0)), shell))
    _face(dice, whole, radius, dark)
    _trigger(dice, whole, np.array([0, max(deep / 2, 0.6 * radius), -0.012]), looks.darker(shell))
    if dice.chance(0.85):
        side = dice.sign()
        _squeeze(dice, whole, side, thick, long, lean, looks.darker(shell))
    return whole


def _head(dice: Dice, radius: float) -> Pieces:
    """What carries the face, its top at z = 0."""
    size = np.array([2 * radius, radius * dice.between(2.0, 2.8), dice.between(0.012, 0.026)])
    outline = dice.pick((ngon(24), rounded(0.3)))
    body = prism(outline, size) if dice.chance(0.6) else superquadric(size, 0.3, 0.9, 8)
    pieces = [body - [0, 0, size[2] / 2]]
    if dice.chance(0.5):
        pieces.append(prism(outline, (*(0.9 * size[:2]), 0.002)))
    return pieces


def _face(dice: Dice, whole: Rig, radius: float, dark: Look) -> None:
    """A stick or a pad, two buttons beside it, and a small one."""
    side = dice.sign()
    main = np.array([-side * 0.35 * radius, dice.between(-0.3, 0.1) * radius, 0])
    if dice.chance(0.75):
        stick = [revolve(_STICK * dice.between(0.8, 1.1), 16) + main]
        whole.dress(0, surface([torus(0.009, 0.0012, 18) + main], dark))
        whole.add("thumbstick", ball(main), surface(stick, dark))
    else:
        pad = cylinder(0.35 * radius, 0.002, 24) + main + [0, 0, 0.001]
        whole.add("touchpad", slide(DOWN, 0.0012), surface([pad], dark))
    size, rise = radius * dice.between(0.26, 0.36), dice.between(0.001, 0.003)
    form = prism(ngon(18), (size, size, rise + 0.002))
    if dice.chance(0.5):
        form = revolve(
            np.array([[0, -0.001], [0.5, -0.001], [0.47, 0.6], [0.25, 1], [0, 1.1]]) * [size, rise], 14
        )
    key = looks.plastic(dice) if dice.chance(0.3) else dark
    for place in ((0.45, 0.35), (0.5, -0.25))[: dice.pick((1, 2, 2, 2))]:
        spot = np.array([side * place[0] * radius, place[1] * radius, 0])
        whole.add("button", slide(DOWN, 0.0015), surface([form + spot], key))
    if dice.chance(0.6):
        spot = np.array([-side * 0.4 * radius, -0.75 * radius, 0])
        whole.add("menu button", slide(DOWN, 0.0012), surface([form * 0.6 + spot], dark))


def _trigger(dice: Dice, whole: Rig, pin: FloatArray, look: Look) -> None:
    """A curved piece under the first finger, hung at its upper end."""
    reach, drop = dice.between(0.014, 0.022), dice.between(0.02, 0.034)
    arc = np.array(
        [
            [0, 0.002],
            [0.6 * reach, 0.001],
            [reach, -0.45 * drop],
            [0.8 * reach, -drop],
            [0.3 * reach, -0.8 * drop],
        ]
    )
    piece = pointed(plate(arc, dice.between(0.012, 0.02)), X) + pin
    whole.add("trigger", hinge(pin, LEFT, dice.between(0.2, 0.35)), surface([piece], look))


def _squeeze(
    dice: Dice, whole: Rig, side: int, thick: float, long: float, lean: FloatArray, look: Look
) -> None:
    """A button in the side of the handle: a short one is pressed, a long one tips about its upper end."""
    middle = np.array([side * 0.47 * thick, 0, -0.45 * long])
    inwards = np.array([-side, 0, 0])
    if dice.chance(0.55):
        piece = superquadric((0.007, dice.between(0.014, 0.022), dice.between(0.022, 0.03)), 0.4, 0.7, 8)
        pill = surface(turned([piece + middle], lean), look)
        whole.add("squeeze", slide(inwards, 0.003), pill)
        return
    size = (0.008, dice.between(0.012, 0.018), dice.between(0.036, 0.05))
    pin = middle + [0, 0, 0.48 * size[2]]
    pieces = [superquadric(size, 0.3, 0.5, 8) + middle, lying(0.0035, 1.1 * size[1], Y, 10) + pin]
    motion = hinge(lean @ pin, lean @ np.array([0, side, 0]), dice.between(0.1, 0.2))
    whole.add("squeeze", motion, surface(turned(pieces, lean), look))


def _wand(dice: Dice) -> Rig:
    """A long handle with a round pad on top, buttons before and behind it, and a button in either side."""
    shell, dark = looks.plastic(dice), looks.rubber(dice)
    long, thick = dice.between(0.14, 0.2), dice.between(0.03, 0.042)
    stem = superquadric((thick, long, 0.9 * thick), 0.6, 0.3, 10) - [0, 0.25 * long, 0.42 * thick]
    whole = Rig(surface([stem], shell), label="body")
    if dice.chance(0.7):
        ring = torus(dice.between(0.035, 0.05), 0.009, 24)
        tilt = rotation(RIGHT, dice.between(-0.3, 0.9))
        whole.dress(0, surface(moved(turned([ring], tilt), (0, 0.25 * long + 0.03, -0.3 * thick)), shell))
    pad = cylinder(0.38 * thick, 0.003, 26)
    whole.dress(0, surface([torus(0.41 * thick, 0.0012, 26)], dark))
    whole.add("touchpad", slide(DOWN, 0.0012), surface([pad + [0, 0, 0.001]], dark))
    small = prism(ngon(16), (0.009, 0.009, 0.004))
    for y in (0.75 * thick, -0.75 * thick)[: dice.whole(1, 2)]:
        spot = np.array([0, y, 0.0])
        whole.add("menu button", slide(DOWN, 0.0012), surface([small + spot], dark))
    _trigger(dice, whole, np.array([0, 0.1 * long, -0.8 * thick]), looks.darker(shell))
    if dice.chance(0.6):
        grip = superquadric((0.006, 0.4 * thick * dice.between(1.5, 3), 0.3 * thick), 0.4, 0.6, 8)
        for side in (-1, 1):
            spot = np.array([side * 0.47 * thick, -0.3 * long, -0.45 * thick])
            motion = slide(np.array([-side, 0, 0]), 0.002)
            whole.add("squeeze", motion, surface([grip + spot], dark))
    return whole


CATEGORIES: tuple[Category, ...] = (Category("motion_controller", _motion_controller),)
