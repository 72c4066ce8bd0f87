"""How each link moves: the model chooses a line, usual limits say how far."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray, vec3
from simart_kit.asset import Joint

from .answers import axis_answer
from .axis_sheet import axis_sheet
from .limits import extent, usual_limits
from .lines import Line, Shape, contact_point, same_line, shape_of, sliding_lines, turning_lines
from .linking import Link
from .prompts import again_text, axis_text
from .talk import Talk
from .views import Seen

_WITH_AXIS = ("revolute", "continuous", "prismatic")
_SUFFIX = {"revolute": "hinge", "continuous": "spin", "prismatic": "slide", "ball": "ball", "free": "free"}


@dataclass(frozen=True)
class Choice:
    """A line that the model chose.

    Attributes:
        line: the line.
        confidence: 0..1.
        turned: whether it opens against the sense in which the line was drawn.
        refused: lines that were chosen before, and looked wrong.
    """

    line: Line
    confidence: float
    turned: bool = False
    refused: tuple[Line, ...] = ()


def chosen(
    talk: Talk,
    seen: Seen,
    links: Sequence[Link],
    link: Link,
    wishes: str = "",
    before: Choice | None = None,
    reason: str = "",
) -> Choice | None:
    """Ask for the line that a link moves about or along.

    Args:
        talk: with the model.
        seen: the object.
        links: all of them.
        link: the one.
        wishes: what a person states, as `wishes_text` puts it.
        before: what was chosen and looked wrong; its line is not offered again.
        reason: why it looked wrong.

    Returns:
        None for a kind of joint without an axis.
    """
    if link.kind not in _WITH_AXIS:
        return None
    shape = _shape(seen, links, link)
    lines = sliding_lines(shape) if link.kind == "prismatic" else turning_lines(shape)
    refused = (*before.refused, before.line) if before else ()
    offered = tuple(line for line in lines if not any(same_line(line, bad, shape) for bad in refused))
    if not offered:
        return before
    text = axis_text(link, link.parent, offered) + wishes
    if refused:
        text = again_text(text, [line.letter for line in refused], reason)
    picture = axis_sheet(seen, link.pieces, shape, offered)
    what = (
        f"the link '{link.name}' in red, and {'arrows' if link.kind == 'prismatic' else 'lines'} with letters"
    )
    wanted = axis_answer(tuple(line.letter for line in offered))
    answer = talk.ask(f"axis of {link.name}", text, [(what, picture)], wanted)
    line = next(line for line in offered if line.letter == answer.letter)
    return Choice(line, answer.confidence / 100.0, refused=refused)


def reversed_choice(choice: Choice) -> Choice:
    """The same line, opening the other way."""
    return replace(choice, turned=not choice.turned)


def joints(seen: Seen, links: Sequence[Link], choices: Mapping[str, Choice]) -> tuple[Joint, ...]:
    """A joint for every link but the body.

    Args:
        seen: the object.
        links: all of them.
        choices: by the name of the link, of those that have an axis.
    """
    return tuple(_joint(seen, links, link, choices.get(link.name)) for link in links if link.parent)


def _joint(seen: Seen, links: Sequence[Link], link: Link, choice: Choice | None) -> Joint:
    if link.kind == "fixed":
        return Joint(f"{link.name}_mount", "fixed", link.parent, link.name, confidence=link.score)
    shape = _shape(seen, links, link)
    name = f"{link.name}_{_SUFFIX[link.kind]}"
    if choice is None:
        origin = vec3(contact_point(shape))
        return Joint(name, link.kind, link.parent, link.name, origin, confidence=link.score)
    axis = -choice.line.axis if choice.turned else choice.line.axis
    words = f"{link.name} {link.label}".replace("_", " ")
    held = extent(shape.others, axis) if len(shape.others) else 0.0
    limits = usual_limits(link.kind, words, extent(shape.points, axis), held, shape.diagonal)
    told = f"line {choice.line.letter} ({choice.line.source}) chosen among those drawn"
    return Joint(
        name=name,
        kind=link.kind,
        parent=link.parent,
        child=link.name,
        origin=vec3(choice.line.origin),
        axis=vec3(_rounded(axis)),
        limits=limits,
        confidence=round(min(link.score, choice.confidence), 3),
        evidence=(told, *(f"not {line.letter}" for line in choice.refused)),
    )


def _shape(seen: Seen, links: Sequence[Link], link: Link) -> Shape:
    carrier = next(other for other in links if other.name == link.parent)
    return shape_of(seen.mesh, seen.faces(link.pieces), seen.faces(carrier.pieces))


def _rounded(axis: FloatArray) -> FloatArray:
    """Without the last bits of a turn to and fro, so that an axis along x reads 1, 0, 0."""
    axis = np.where(np.abs(axis) < 1e-9, 0.0, axis)
    return np.asarray(axis / np.linalg.norm(axis))
