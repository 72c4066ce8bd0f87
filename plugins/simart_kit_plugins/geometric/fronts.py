"""Fronts: pieces that close something off towards one side, with what hangs on them and what lies behind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray

from .casting import cast, grid
from .contact import HOLDS, TOUCH, Contacts, hanging_on
from .drawer_boxes import backing, bare, hanging_behind, hollow, is_drawer_box, reaches_back
from .scene import FACINGS, Box, Scene

# All lengths are shares of the object's diagonal.
PANEL = 0.7  # share of a piece's surface that faces out or back, above which it is a panel
LOOSE = 2e-4  # farther than this, a panel is not glued to its neighbour
SMALLEST = 0.035  # a front is at least this wide and high
SPANNING = 0.7  # a piece that fills this share of every extent is the body
VISIBLE = 0.7  # share of a front's rectangle that is seen from outside
OPEN = 0.3  # share of rays straight back that meet something, below which one may pass behind a panel

_LARGE = 0.25  # share of a panel's rectangle from which on a piece that lies on it is no handle
_BOARD = 0.15  # thickness of a board, as a share of its width
_WHOLE = 0.9  # share of a panel's rectangle that it fills
_SMALLER = 0.95  # the same of a board that lies on a panel: a larger one is another panel
_OVERHANG = 0.05  # of its width or height that a handle may reach over its panel's edge
_GRIPS = 0.15  # share of a panel's rectangle that what one takes hold of covers at most
_BAR, _LONG = 2.5, 0.4  # so many times as high as wide, and so much of its panel's height, an upright bar is
_PULL = 0.5  # of its panel's shorter side that a low pull takes at most
_AROUND = np.diag([-1.0, 1.0, -1.0])  # (u, v, w) as seen from the other side


@dataclass(frozen=True, eq=False)
class Front:
    """A piece seen squarely from one side.

    Attributes:
        piece: the panel, or the box with a front.
        facing: key of `FACINGS`.
        box: of the piece, in (u, v, w).
        inlays: pieces within the panel's rectangle and thickness, such as glass.
        handles: pieces that stick out of it.
        behind: pieces within its rectangle that hang on its back, such as a drawer's box.
        walled: share of rays from behind it to the sides that meet something.
        backed: share of rays from behind it straight back that meet something.
        depth: median way of those rays.
        framed: share of sides on which something stands close beside it.
        jambs: whether something stands close beside it on the left and on the right.
        boxed: whether it, with what hangs behind it, reaches as far back as a drawer does.
        hollow: whether the piece is open above, as a drawer in one piece is.
        flat: share of the piece's surface that faces out or back.
        loose: whether there is a gap, if a small one, to everything beside what moves with it.
        share: of the side's whole rectangle.
        tall: its height as a share of the whole's.
        held: (2,) how far from its middle the middle of its handles is, or of pulls so low that they are
            inlays, as shares of its width and height; None without any.
        grips: how many handles there are that do not touch each other.
        upright: whether one of them is an upright bar, as on doors.
    """

    piece: int
    facing: str
    box: Box
    inlays: tuple[int, ...]
    handles: tuple[int, ...]
    behind: tuple[int, ...]
    walled: float
    backed: float
    depth: float
    framed: float
    jambs: bool
    boxed: bool
    hollow: bool
    flat: float
    loose: bool
    share: float
    tall: float
    held: FloatArray | None
    grips: int
    upright: bool

    @property
    def pieces(self) -> tuple[int, ...]:
        """All that moves with it."""
        return (self.piece, *self.inlays, *self.handles, *self.behind)

    @property
    def area(self) -> float:
        """Of its rectangle, as a share of the squared diagonal."""
        return float(self.box.size[0] * self.box.size[1])


def find_fronts(scene: Scene, contacts: Contacts, facing: str, fused: bool = False) -> list[Front]:
    """Every front towards one side; of a fused skin, a board may span all, and carries what lies on it."""
    axes = FACINGS[facing]
    boxes = [box.turned(axes) for box in scene.boxes]
    whole = scene.box.turned(axes)
    found = []
    for piece, box in enumerate(boxes):
        spans = (box.size >= SPANNING * whole.size).all() and not (fused and thin(box))
        if (box.size[:2] < SMALLEST).any() or spans:
            continue
        inner = box.upper[2] < whole.center[2]
        if inner and not thin(box):
            continue
        inlays = _on_skin(boxes, piece) if fused else _layers(scene, axes, contacts, boxes, piece)
        if _seen(scene, axes, box, (piece, *inlays)) < VISIBLE:
            continue
        # Seen through an opening, it is a back wall, which has no handle.
        if not inner or _grips(contacts, boxes, piece, inlays):
            found.append(_front(scene, contacts, facing, boxes, piece, inlays, fused))
    return found


def _front(
    scene: Scene,
    contacts: Contacts,
    facing: str,
    boxes: list[Box],
    piece: int,
    inlays: tuple[int, ...],
    fused: bool,
) -> Front:
    axes, box = FACINGS[facing], boxes[piece]
    handles = _handles(contacts, boxes, piece, inlays)
    # What lies under a lid is what it closes, not what it carries.
    behind = hanging_behind(contacts, boxes, piece, (*inlays, *handles)) if facing != "top" else ()
    if behind and not is_drawer_box(scene, axes, boxes, piece, behind):
        # Racks, baskets and rails are not a drawer's box: they stay when a door opens.
        behind = backing(boxes, piece, behind)
    own = (piece, *inlays, *handles, *behind)
    whole = scene.box.turned(axes)
    flat = _flat(scene, axes, (piece, *inlays))
    # A flat piece is a panel however far back it reaches: then it stands ajar.
    deep = behind if flat > PANEL else (piece, *behind)
    boxed = bool(deep) and reaches_back(box.upper[2] - min(boxes[i].lower[2] for i in deep), box, whole)
    boxed = boxed and not (facing != "top" and bare(scene, axes, Box.around([boxes[i] for i in deep]), own))
    walled, backed, depth = _surroundings(
        scene, axes, box, own, box.upper[2] - 0.02 if boxed else box.lower[2]
    )
    if backed < OPEN and not boxed:  # what stands free is taken hold of from both sides
        around = [one.turned(_AROUND) for one in boxes]
        other = _grips(contacts, around, piece, inlays)
        if fused:  # there, one that reaches the edge of its leaf touches what is beside it
            other = (*other, *_opposite(boxes, handles, _handles(contacts, around, piece, inlays)))
        handles = tuple(dict.fromkeys((*handles, *other)))
    beside = _beside(scene, axes, box, own)
    return Front(
        piece,
        facing,
        box,
        inlays,
        handles,
        behind,
        walled,
        backed,
        depth,
        framed=sum(beside) / 4,
        jambs=beside[0] and beside[1],
        boxed=boxed,
        hollow=hollow(scene, axes, box, piece),
        flat=flat,
        loose=not any(contacts.within(piece, i, LOOSE) for i in range(len(boxes)) if i not in own),
        share=float(np.prod(box.size[:2]) / np.prod(whole.size[:2])),
        tall=float(box.size[1] / whole.size[1]),
        held=_held(boxes, piece, handles or _pulls(boxes, piece, inlays)),
        grips=_separate(contacts, boxes, handles),
        upright=any(_stands(boxes[i], box) for i in handles),
    )


def thin(box: Box) -> bool:
    """Whether a box (u, v, w) is a panel's."""
    return bool(box.size[2] < 0.5 * box.size[:2].min())


def _flat(scene: Scene, axes: FloatArray, pieces: tuple[int, ...]) -> float:
    faces = scene.faces_of(pieces)
    facing = np.abs(scene.normals[faces] @ axes[2]) > 0.9
    return float(scene.face_areas[faces][facing].sum() / max(scene.face_areas[faces].sum(), 1e-30))


def _inlays(boxes: list[Box], piece: int) -> tuple[int, ...]:
    panel = boxes[piece]
    return tuple(
        i
        for i, box in enumerate(boxes)
        if i != piece
        and box.lies_in(panel, LOOSE)
        and box.lower[2] >= panel.lower[2] - TOUCH
        and box.upper[2] <= panel.upper[2] + TOUCH
    )


def _layers(
    scene: Scene, axes: FloatArray, contacts: Contacts, boxes: list[Box], piece: int
) -> tuple[int, ...]:
    """Inlays, and of a board without holes, or that nothing else holds, the boards on it."""
    inlays, panel = _inlays(boxes, piece), boxes[piece]
    if panel.size[2] > _BOARD * panel.size[:2].min():
        return inlays
    smaller = _SMALLER * np.prod(panel.size[:2])
    lying = tuple(
        i
        for i in _carried(boxes, piece)
        if i not in inlays
        and thin(boxes[i])
        and np.prod(boxes[i].size[:2]) < smaller
        and _flat(scene, axes, (i,)) > PANEL
    )
    if not lying or _covers(scene, axes, panel, piece):
        return (*inlays, *lying)
    own = {piece, *inlays, *lying, *_handles(contacts, boxes, piece, inlays)}
    behind = hanging_behind(contacts, boxes, piece, tuple(own))
    if behind and is_drawer_box(scene, axes, boxes, piece, behind):
        own.update(behind)
    held = any(contacts.within(piece, i, LOOSE) for i in range(len(boxes)) if i not in own)
    return inlays if held else (*inlays, *lying)


def _covers(scene: Scene, axes: FloatArray, panel: Box, piece: int) -> bool:
    """Whether a panel fills its rectangle, as no frame does."""
    origins = np.column_stack([grid(panel, 8, 0.9), np.full(64, panel.upper[2] + TOUCH)])
    others = tuple(i for i in range(scene.count) if i != piece)
    labels, _ = cast(scene, axes, origins, np.array([0.0, 0.0, -1.0]), others)
    return float((labels >= 0).mean()) > _WHOLE


def _carried(boxes: list[Box], piece: int) -> tuple[int, ...]:
    """Inlays, and large pieces with what stands out of them, such as a panel and its handle in one."""
    panel = boxes[piece]
    large = _LARGE * np.prod(panel.size[:2])
    lying = (
        i
        for i, box in enumerate(boxes)
        if i != piece
        and np.prod(box.size[:2]) > large
        and box.lies_in(panel, LOOSE)
        and panel.lower[2] - TOUCH <= box.lower[2] <= panel.upper[2] + 2 * TOUCH
    )
    return tuple(dict.fromkeys((*_inlays(boxes, piece), *lying)))


def _on_skin(boxes: list[Box], piece: int) -> tuple[int, ...]:
    """What a panel carries, and what lies within flat ones of these, such as the glass of a rim."""
    carried = _carried(boxes, piece)
    inner = (i for one in carried if thin(boxes[one]) for i in _inlays(boxes, one) if i != piece)
    return tuple(dict.fromkeys((*carried, *inner)))


def _handles(contacts: Contacts, boxes: list[Box], piece: int, inlays: tuple[int, ...]) -> tuple[int, ...]:
    panel = boxes[piece]
    reach = 0.5 * (panel.lower[2] + panel.upper[2])
    spindles = thin(panel)  # through which a handle may go; a deep box may have all kinds of things within
    found = [
        i
        for i, box in enumerate(boxes)
        if i not in (piece, *inlays)
        and box.lies_in(panel, 0.5 * TOUCH, _OVERHANG)
        and box.upper[2] > panel.upper[2] + 0.5 * TOUCH
        and box.upper[2] > reach
        and np.prod(box.size[:2]) < _LARGE * np.prod(panel.size[:2])
        and box.upper[2] - (panel.upper[2] if spindles else box.lower[2]) < 0.5 * panel.size[:2].max()
        and not _glazing_bar(box, panel)
    ]
    # What touches the panel is on it, and so is what touches that: a knob on its stem.
    on = {piece, *inlays}
    if spindles:
        on.update(i for i in found if meet(contacts, boxes, i, piece))

    standing_out = set(found)

    def joined(i: int, j: int) -> bool:
        return contacts.within(i, j, TOUCH) or (j in standing_out and meet(contacts, boxes, i, j))

    on = hanging_on(on, found, joined)
    return tuple(i for i in found if i in on)


def _pulls(boxes: list[Box], piece: int, inlays: tuple[int, ...]) -> tuple[int, ...]:
    """Inlays that are small both ways, as no moulding is."""
    most = _PULL * boxes[piece].size[:2].min()
    return tuple(i for i in inlays if boxes[i].size[:2].max() < most)


def _held(boxes: list[Box], piece: int, by: tuple[int, ...]) -> FloatArray | None:
    if not by:
        return None
    panel, middle = boxes[piece], np.mean([boxes[i].center for i in by], axis=0)
    return np.asarray((middle - panel.center)[:2] / panel.size[:2])


def _grips(contacts: Contacts, boxes: list[Box], piece: int, inlays: tuple[int, ...]) -> tuple[int, ...]:
    """Handles of a panel that are few and small, and held by nothing but it, as no shelf is."""
    handles = _handles(contacts, boxes, piece, inlays)
    covered = sum(float(np.prod(boxes[i].size[:2])) for i in handles)
    if covered > _GRIPS * np.prod(boxes[piece].size[:2]):
        return ()
    others = [i for i in range(len(boxes)) if i not in (piece, *inlays, *handles)]
    return tuple(i for i in handles if not any(contacts.within(i, j, HOLDS) for j in others))


def _opposite(boxes: list[Box], handles: tuple[int, ...], others: tuple[int, ...]) -> list[int]:
    """Those of other pieces (u, v, w) whose middle is behind one of the handles."""
    return [i for i in others if any(_holds(boxes[handle], boxes[i].center) for handle in handles)]


def _holds(box: Box, point: FloatArray) -> bool:
    """Whether a point is in the rectangle of a box."""
    return bool(((point > box.lower) & (point < box.upper))[:2].all())


def _separate(contacts: Contacts, boxes: list[Box], handles: tuple[int, ...]) -> int:
    """How many groups there are of handles that touch each other, as a grip does its posts."""
    left, groups = list(handles), 0
    while left:
        on = hanging_on({left[0]}, left, lambda i, j: meet(contacts, boxes, i, j))
        left, groups = [i for i in left if i not in on], groups + 1
    return groups


def _stands(handle: Box, panel: Box) -> bool:
    """Whether a handle is a bar along much of the height of its panel."""
    wide, high = handle.size[:2]
    return bool(high > _BAR * wide and high > _LONG * panel.size[1])


def _glazing_bar(box: Box, panel: Box) -> bool:
    """Whether a piece runs across a pane from edge to edge and stands out on both sides: it divides it."""
    across = (box.size[:2] > 0.95 * panel.size[:2]).any()
    return bool(across and box.lower[2] < panel.lower[2] - LOOSE and box.upper[2] > panel.upper[2])


def meet(contacts: Contacts, boxes: Sequence[Box], one: int, other: int) -> bool:
    """Whether two pieces touch, or one is stuck into the other so deep that no corner is near its skin."""
    if not contacts.beside(one, other):
        return False
    return boxes[one].overlap(boxes[other], -TOUCH) or contacts.within(one, other, TOUCH)


def _seen(scene: Scene, axes: FloatArray, box: Box, own: tuple[int, ...]) -> float:
    """Share of the rectangle where the own pieces, or what sits on them, are met first from outside."""
    points = grid(box, 12, 1.0)
    outside = scene.box.turned(axes).upper[2] + 1.0
    origins = np.column_stack([points, np.full(len(points), outside)])
    labels, distance = cast(scene, axes, origins, np.array([0.0, 0.0, -1.0]))
    met = outside - distance
    on_top = (met > box.upper[2] - TOUCH) & (met < box.upper[2] + 0.1)  # a handle hides some of its panel
    return float((np.isin(labels, own) | on_top & _small(scene, labels, box)).mean())


def _small(scene: Scene, labels: IntArray, box: Box) -> BoolArray:
    areas = np.append(scene.areas, 0.0)
    return np.asarray(areas[labels] < 0.5 * np.prod(box.size[:2]))


def _surroundings(
    scene: Scene, axes: FloatArray, box: Box, own: tuple[int, ...], behind: float
) -> tuple[float, float, float]:
    """Shares of rays from just behind the panel that meet other pieces: to the sides, and straight back."""
    points = grid(box, 5, 0.8)
    origins = np.column_stack([points, np.full(len(points), behind - 0.5 * TOUCH)])
    sides = []
    for direction in ([1.0, 0, 0], [-1.0, 0, 0], [0, 1.0, 0], [0, -1.0, 0]):
        labels, _ = cast(scene, axes, origins, np.array(direction), own)
        sides.append((labels >= 0).mean())
    labels, distance = cast(scene, axes, origins, np.array([0.0, 0.0, -1.0]), own)
    met = labels >= 0
    return float(np.mean(sides)), float(met.mean()), float(np.median(distance[met])) if met.any() else 0.0


def _beside(scene: Scene, axes: FloatArray, box: Box, own: tuple[int, ...]) -> tuple[bool, ...]:
    """Whether another piece stands close beside the panel: on the left, right, below, above."""
    near = 0.05
    sides = []
    for axis in (0, 1):
        for sign in (-1.0, 1.0):
            points = np.tile(box.center, (5, 1))
            points[:, 1 - axis] += np.linspace(-0.3, 0.3, 5) * box.size[1 - axis]
            points[:, axis] = box.upper[axis] if sign > 0 else box.lower[axis]
            direction = np.zeros(3)
            direction[axis] = sign
            labels, distance = cast(scene, axes, points - 0.001 * direction, direction, own)
            sides.append(bool(((labels >= 0) & (distance < near)).mean() > 0.5))
    return tuple(sides)
