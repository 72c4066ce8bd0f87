"""Joints of given parts: each part is one piece, which bears its number."""

from __future__ import annotations

from dataclasses import replace

from simart_kit import Mesh
from simart_kit.arrays import IntArray
from simart_kit.asset import Joint

from .answers import parts_answer
from .linking import Link, links_of
from .moving import chosen, joints
from .prompts import PICTURES, RED, kinds_text
from .sheets import marks_sheet, plain_sheet, red_sheets
from .talk import Talk
from .views import Seen


def part_joints(
    talk: Talk, mesh: Mesh, face_part: IntArray, names: tuple[str, ...], wishes: str = ""
) -> tuple[Joint, ...]:
    """Ask what kind of joint each part has, then about which line it moves.

    Args:
        talk: with the model.
        mesh: in the canonical frame.
        face_part: (F,) part of each face.
        names: of the parts.
        wishes: what a person states, as `wishes_text` puts it.

    Raises:
        BadInputError: there is no usable answer.
    """
    seen = Seen.of(mesh, face_part)
    links = _of_parts(talk, seen, names, wishes)
    choices = {
        link.name: choice
        for link in links
        if link.parent and (choice := chosen(talk, seen, links, link, wishes))
    }
    return joints(seen, links, choices)


def _of_parts(talk: Talk, seen: Seen, names: tuple[str, ...], wishes: str) -> tuple[Link, ...]:
    """Ask how parts of these names move; each is a link."""
    views = red_sheets(seen, [(str(piece), (piece,)) for piece in range(seen.count)])
    pictures = [
        (PICTURES[0], plain_sheet(seen)),
        (PICTURES[1], marks_sheet(seen)),
        *((RED, view) for view in views),
    ]
    answer = talk.ask("links", kinds_text(names, seen) + wishes, pictures, parts_answer(seen.count))
    links = links_of(answer, seen.count)
    name_of = {link.name: names[link.pieces[0]] for link in links} | {"": ""}
    return tuple(replace(link, name=name_of[link.name], parent=name_of[link.parent]) for link in links)
