"""The answer's JSON as a script: the same lines write a given answer and ask a model for one."""

from __future__ import annotations

from simart_kit.arrays import IntArray

from ..answer.values import AXIS_MAX, CENTER_MAX, PART_TYPES, SLIDE_MAX, TURN_MAX
from ..tokens import VoxelTokens
from .fitting import DENSITY_DIGITS, MATERIALS, SCALE_DIGITS, YOUNGS_DIGITS, ObjectText, PartText
from .pen import Pen, Want, Writing
from .spelling import decimal, whole

_OPENINGS = (',"material":"', ',"density":"', ',"Young\'s Modulus (GPa)":')
_STILL = ("fixed", "free")


def write_answer(
    pen: Pen, cells: IntArray, max_parts: int, end: str, answer: ObjectText | None
) -> Writing[None]:
    """Write object_captions, parts_captions and parts_voxels, compact and in this order.

    Args:
        pen: writes the tokens.
        cells: (C,) ascending indices of the input's cells, of which every part names some.
        max_parts: how many parts there may be.
        end: text of the token that ends the answer.
        answer: what to write; None where a model chooses.
    """
    yield from pen.text('{"object_captions":{"name":"')
    yield from pen.words(('","scale":',), Want(answer.name) if answer else None)
    parts_open = ('},"parts_captions":{"0":{"name":"',)
    yield from pen.number(decimal(*SCALE_DIGITS), parts_open, Want(answer.scale) if answer else None)
    count, more = 0, True
    while more:
        part = answer.parts[count] if answer else None
        last = answer is None or count + 1 == len(answer.parts)
        more = yield from _Captions(pen, count, max_parts, part, last).write()
        count += 1
    for number in range(count):
        closing = f'","{number + 1}":"' if number + 1 < count else '"}}' + end
        yield from pen.voxels(cells, (closing,), answer.parts[number].voxels if answer else None)


def write_grounding(pen: Pen, cells: IntArray, end: str, tokens: VoxelTokens | None) -> Writing[None]:
    """Write the voxels of one part and nothing else; the arguments are those of `write_answer`."""
    yield from pen.voxels(cells, (end,), tokens)


class _Captions:
    """The captions of one part, from its name on."""

    def __init__(self, pen: Pen, number: int, max_parts: int, part: PartText | None, last: bool) -> None:
        self.pen, self.number, self.part, self.last = pen, number, part, last
        following = (f'}},"{number + 1}":{{"name":"',) if number + 1 < max_parts else ()
        self.tails = (*_OPENINGS, '}},"parts_voxels":{"0":"', *following)

    def write(self) -> Writing[bool]:
        """Write them; gives whether another part follows."""
        pen, part = self.pen, self.part
        yield from pen.words(('","type":"',), Want(part.name) if part else None)
        if self.number == 0:
            yield from pen.text("fixed")
            place = self._tail(part, 0) if part else None
            return (yield from self._physics((yield from pen.choice(self._ends('"', 0), place))))
        names = tuple(f'{name}","parent":"' for name in PART_TYPES)
        kind = PART_TYPES[(yield from pen.choice(names, PART_TYPES.index(part.type) if part else None))]
        parent = whole(0, self.number - 1)
        if kind in _STILL:
            want = self._want(part, part.parent, 0) if part else None
            tail = (yield from pen.number(parent, self._ends('"', 0), want)).end
            return (yield from self._physics(tail))
        yield from pen.number(parent, ('","center":[',), Want(part.parent) if part else None)
        return (yield from self._physics((yield from self._motion(kind))))

    def _motion(self, kind: str) -> Writing[int]:
        """Center, axis and limits, or for a ball joint the center alone; gives which tail follows."""
        pen, part = self.pen, self.part
        coordinate = whole(0, CENTER_MAX)
        for place in range(2):
            yield from pen.number(coordinate, (",",), Want(part.center[place]) if part else None)
        turning = '],"axis":['
        ends = (*self._ends("]", 0), turning) if kind == "hinge" else (turning,)
        want = self._want(part, part.center[2], 0) if part else None
        if part and part.axis:
            want = Want(part.center[2], len(ends) - 1)
        tail = (yield from pen.number(coordinate, ends, want)).end
        if ends[tail] != turning:
            return tail
        yield from self._axis()
        return (yield from self._limits(SLIDE_MAX if kind == "prismatic" else TURN_MAX))

    def _axis(self) -> Writing[None]:
        pen, part = self.pen, self.part
        still = True
        for place, end in enumerate((",", ",", '],"limits":[')):
            spelling = whole(-AXIS_MAX, AXIS_MAX, zero=place < 2 or not still)
            text = (yield from pen.number(spelling, (end,), Want(part.axis[place]) if part else None)).text
            still = still and text == "0"

    def _limits(self, largest: int) -> Writing[int]:
        """Lower and upper limit, which hold 0 and differ; gives which tail follows."""
        pen, part = self.pen, self.part
        lower = (
            yield from pen.number(whole(-largest, 0), (",",), Want(part.limits[0]) if part else None)
        ).text
        spelling = whole(0, largest, zero=lower != "0")
        want = self._want(part, part.limits[1], 0) if part else None
        return (yield from pen.number(spelling, self._ends("]", 0), want)).end

    def _physics(self, tail: int) -> Writing[bool]:
        """Material, density and Young's modulus as far as they are given, in this order."""
        pen = self.pen
        if tail == 0:
            endings = self._ends('"', 1)
            names = tuple(name + end for name in MATERIALS for end in endings)
            tail = 1 + (yield from pen.choice(names, self._wanted_material(len(endings)))) % len(endings)
        if tail == 1:
            ends = self._ends(' g/cm^3"', 2)
            tail = 2 + (yield from pen.number(decimal(*DENSITY_DIGITS), ends, self._wanted_physics(1))).end
        if tail == 2:
            ends = self._ends("", 3)
            tail = 3 + (yield from pen.number(decimal(*YOUNGS_DIGITS), ends, self._wanted_physics(2))).end
        return tail > 3

    def _ends(self, closing: str, field: int) -> tuple[str, ...]:
        """What may follow a value: its closing text and a tail, of the physics from `field` on."""
        return tuple(closing + tail for tail in self.tails[field:])

    def _want(self, part: PartText, text: str, field: int) -> Want:
        return Want(text, self._tail(part, field) - field)

    def _wanted_material(self, tails: int) -> int | None:
        """Place of the material and what follows it, among all pairs of both."""
        if self.part is None or self.part.physics[0] is None:
            return None
        return MATERIALS.index(self.part.physics[0]) * tails + self._tail(self.part, 1) - 1

    def _wanted_physics(self, field: int) -> Want | None:
        """Density or Young's modulus, and what follows it."""
        text = self.part.physics[field] if self.part else None
        return None if self.part is None or text is None else self._want(self.part, text, field + 1)

    def _tail(self, part: PartText, field: int) -> int:
        """The tail that is wanted, at or behind a field of the physics."""
        given = (place for place in range(field, len(_OPENINGS)) if part.physics[place] is not None)
        return next(given, len(_OPENINGS) + (0 if self.last else 1))
