"""The words of the questions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .lines import Line
from .linking import Link
from .views import Seen

SYSTEM = (
    "You look at pictures of one object and say how it is put together and how its parts move, for a robot "
    "simulator. Left, right, front and back are those of the object as you stand before it. "
    "You choose among numbers and letters that are drawn in the pictures; you never make up coordinates."
)

PICTURES = (
    "the object as it is, from the front left and from the back right",
    "its surface cut into numbered pieces, from four sides; a colour each",
)
RED = "each piece alone in red, its number in the corner; pale red where other pieces hide it"

_EXAMPLES = """Examples of links:
- A wardrobe with two doors and a drawer: body (fixed, parent ""), left_door (revolute, parent body), \
right_door (revolute, parent body), drawer (prismatic, parent body). A handle goes with the door or drawer \
that it is screwed to; the sides, back and bottom of a drawer's box go with its front.
- An office chair: base (fixed, parent ""), seat (continuous, parent base), five casters (continuous, \
parent base).
- A stool, a vase: one link, the body, with all pieces."""


def grouping_text(seen: Seen) -> str:
    """The first question: which pieces are one rigid link, and how each moves."""
    return f"""The object's surface was cut into {seen.count} pieces, 0..{seen.count - 1}, far too finely. \
Group them into rigid links.

- A link is everything that moves as one. Put each piece into exactly one link; pieces in none go to the body.
- The first link is the body, which stays where it is: kind fixed, parent "".
- Every other link has a parent: the link that carries it.
- kind: revolute for a hinge with an end, continuous for what turns without end (wheel, fan, knob), \
prismatic for what slides (drawer, tray, sliding door, button), ball for a ball joint, free for what lies \
loose, fixed for what does not move against its parent.
- Make a link only of what really moves; boards, legs, panels and trim are of the body.
- longest_side_m: the longest side of the real object's bounding box in metres.

{_EXAMPLES}

The pieces, with their middle and size in percent of the object's width, depth and height (from the left, \
from the front, from the ground):
{_table(seen)}"""


def axis_text(link: Link, parent: str, lines: Sequence[Line]) -> str:
    """Which of the lines a link moves about or along."""
    letters = ", ".join(line.letter for line in lines)
    if link.kind == "prismatic":
        what = "slides. Which arrow shows the way in which it opens, or is pulled or pushed in use?"
    else:
        what = "turns. About which line does it turn? The hinge lies where it is held, away from its handle."
    return (
        f"The red link '{link.name}' ({link.label}) is carried by '{parent}' and {what} "
        f"Letters: {letters}. Answer with one letter."
    )


def again_text(text: str, refused: Sequence[str], reason: str) -> str:
    """A question once more, after what was chosen looked wrong."""
    told = f" ({reason})" if reason else ""
    return f"{text} You chose {', '.join(refused)} before, which looked wrong in motion{told}: choose anew."


def critic_text(links: Sequence[Link]) -> str:
    """Whether the object moves as it should."""
    listed = "\n".join(
        f"- {link.name} ({link.label}): {link.kind}, carried by {link.parent}, pieces "
        f"{', '.join(map(str, link.pieces))}"
        for link in links
        if link.parent
    )
    return f"""Picture 1 shows the object closed, half open and open, as it moves by now. Each moving link \
has a colour, with its axis or way drawn; they are seen from the side where most moves, which may be \
the back:
{listed}

Does each link move as the real thing does? List what is wrong, or nothing. Say axis where it turns about or \
slides along a wrong line, direction where the line is right but it moves the wrong way, and pieces where \
pieces of it stay behind; `add` then names them by the numbers of picture 2."""


def grounding_text(description: str, count: int) -> str:
    """Which views show what is described."""
    quoted = " ".join(description.split())
    return f"""Each of the {count} numbered views has one piece of the object in red; the first picture \
shows the object as it is.

Does what is red belong to: "{quoted}"?

Give an entry for each view: yes where all of the red belongs to it, partly where some of it does, else no. \
If it has several parts, such as a front, a handle and a box behind it, each of them belongs to it."""


def kinds_text(names: Sequence[str], seen: Seen) -> str:
    """How given parts move, where the parts are not for the model to choose."""
    listed = "\n".join(f"- {index}: {name}" for index, name in enumerate(names))
    return f"""{grouping_text(seen)}

Here each numbered piece is one part already: make one link of each, with its name, and join none:
{listed}"""


def _table(seen: Seen) -> str:
    rows = []
    low, size = seen.mesh.bounds[0], np.maximum(np.ptp(seen.mesh.bounds, axis=0), 1e-12)
    order = np.argsort(seen.piece, kind="stable")
    for piece, faces in enumerate(np.split(order, np.cumsum(np.bincount(seen.piece))[:-1])):
        points = (seen.mesh.triangles[faces].reshape(-1, 3) - low) / size * 100
        middle, extent = (points.min(axis=0) + points.max(axis=0)) / 2, np.ptp(points, axis=0)
        rows.append(
            f"{piece}: middle {middle[0]:.0f} {middle[1]:.0f} {middle[2]:.0f}, "
            f"size {extent[0]:.0f} x {extent[1]:.0f} x {extent[2]:.0f}"
        )
    return "\n".join(rows)
