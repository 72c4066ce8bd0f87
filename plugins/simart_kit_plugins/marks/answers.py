"""What the model must answer: strict tables whose mistakes are told in words, so that it can mend them."""

from __future__ import annotations

from collections import Counter
from typing import Annotated, Literal, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, field_validator, model_validator

from simart_kit.asset import JointKind, clean_name
from simart_kit.materials import DEFAULT_MATERIAL, MATERIALS

T = TypeVar("T", bound=BaseModel)


def _line(text: str) -> str:
    """One line of letters: codes for a terminal must not come through to reports."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


Spoken = Annotated[str, AfterValidator(_line)]


class Answer(BaseModel):
    """Base of all answers: no unknown keys."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class LinkAnswer(Answer):
    """A rigid link."""

    name: str = Field(min_length=1, max_length=60, description="Unique, such as upper_left_door.")
    label: Spoken = Field(max_length=60, description="What kind of thing it is, such as door or drawer.")
    pieces: tuple[int, ...] = Field(description="Numbers of all pieces that move as one with it.")
    parent: str = Field(description='Name of the link that carries it; "" for the body.')
    kind: JointKind = Field(description="How it moves against its parent; fixed for the body.")
    material: str = Field(
        description="What it is mostly made of.", json_schema_extra={"enum": [*sorted(MATERIALS)]}
    )
    confidence: int = Field(ge=0, le=100, description="How sure this is [percent].")

    @field_validator("material")
    @classmethod
    def _known(cls, material: str) -> str:
        if material not in MATERIALS:
            raise ValueError(
                f"'{material}' is not known: use one of {', '.join(sorted(MATERIALS))}; "
                f"{DEFAULT_MATERIAL} if unsure"
            )
        return material


class ObjectAnswer(Answer):
    """An object as links."""

    category: Spoken = Field(max_length=60, description="What the object is, such as cabinet.")
    longest_side_m: float = Field(
        gt=0, le=1000, description="Length of the real object's longest side [metres]."
    )
    links: tuple[LinkAnswer, ...] = Field(min_length=1, description="The body first, then every other link.")

    @model_validator(mode="after")
    def _tree(self) -> ObjectAnswer:
        _check_tree(self.links)
        return self


class AxisAnswer(Answer):
    """The line that a link moves about or along."""

    letter: str = Field(description="Letter of the line or arrow.")
    confidence: int = Field(ge=0, le=100, description="How sure this is [percent].")


class Fault(Answer):
    """Something wrong with how a link moves."""

    link: str = Field(description="Name of the link.")
    wrong: Literal["axis", "direction", "pieces"] = Field(
        description="axis: it turns about or slides along the wrong line; direction: it moves the wrong way; "
        "pieces: pieces are missing from it, and `add` names them."
    )
    add: tuple[int, ...] = Field(default=(), description="Pieces of this link that are in another.")
    reason: Spoken = Field(default="", max_length=300, description="What is wrong, in a few words.")


class CriticAnswer(Answer):
    """What is wrong with the pictures of the object closed and open."""

    faults: tuple[Fault, ...] = Field(description="Empty where all moves as it should.")


class Match(Answer):
    """Whether a piece belongs to what was described."""

    piece: int = Field(description="Number of the view.")
    belongs: Literal["yes", "no", "partly"] = Field(description="Whether what is red belongs to it.")
    confidence: int = Field(ge=0, le=100, description="How sure this is [percent].")


class GroundingAnswer(Answer):
    """What a description means."""

    matches: tuple[Match, ...] = Field(description="An entry for each view.")


def object_answer(count: int) -> type[ObjectAnswer]:
    """`ObjectAnswer` for pieces 0..count-1: each in one link at most; those in none are the body's."""

    class Numbered(ObjectAnswer):
        @model_validator(mode="after")
        def _pieces(self) -> Numbered:
            _check_pieces(self.links, count)
            return self

    return _named(Numbered, ObjectAnswer)


def parts_answer(count: int) -> type[ObjectAnswer]:
    """`ObjectAnswer` in which each of the pieces 0..count-1 is a link of its own."""

    class Single(ObjectAnswer):
        @model_validator(mode="after")
        def _pieces(self) -> Single:
            _check_pieces(self.links, count)
            several = [link.name for link in self.links if len(link.pieces) != 1]
            if several or len(self.links) != count:
                raise ValueError(f"make {count} links of one piece each, of pieces 0..{count - 1}")
            return self

    return _named(Single, ObjectAnswer)


def axis_answer(letters: tuple[str, ...]) -> type[AxisAnswer]:
    """`AxisAnswer` with one of some letters."""

    class Lettered(AxisAnswer):
        letter: str = Field(
            description="Letter of the line or arrow.", json_schema_extra={"enum": [*letters]}
        )

        @field_validator("letter")
        @classmethod
        def _drawn(cls, letter: str) -> str:
            if letter not in letters:
                raise ValueError(f"there is no letter '{letter}' in the picture, only {', '.join(letters)}")
            return letter

    return _named(Lettered, AxisAnswer)


def critic_answer(names: tuple[str, ...], count: int) -> type[CriticAnswer]:
    """`CriticAnswer` about links of some names and pieces 0..count-1."""

    class Known(CriticAnswer):
        @model_validator(mode="after")
        def _there(self) -> Known:
            for fault in self.faults:
                if fault.link not in names:
                    raise ValueError(f"there is no link '{fault.link}', only {', '.join(names)}")
                _check_range(fault.add, count)
                if fault.wrong == "pieces" and not fault.add:
                    raise ValueError(f"fault of '{fault.link}': `add` must name the pieces")
            return self

    return _named(Known, CriticAnswer)


def grounding_answer(count: int) -> type[GroundingAnswer]:
    """`GroundingAnswer` with one entry for each piece 0..count-1."""

    class Complete(GroundingAnswer):
        @model_validator(mode="after")
        def _each(self) -> Complete:
            told = [match.piece for match in self.matches]
            _check_range(told, count)
            _check_once(told, "views")
            missing = sorted(set(range(count)) - set(told))
            if missing:
                raise ValueError(f"no entry for {_listed(missing)}: give one for every view")
            return self

    return _named(Complete, GroundingAnswer)


def _check_tree(links: tuple[LinkAnswer, ...]) -> None:
    names = [clean_name(link.name) for link in links]
    twice = sorted(name for name, times in Counter(names).items() if times > 1)
    if twice:
        raise ValueError(f"two links are called '{twice[0]}': give each its own name")
    roots = [link.name for link in links if not link.parent]
    if len(roots) != 1:
        raise ValueError(f'one link, the body, has the parent "", found {len(roots)}')
    parents = dict(
        zip(names, (clean_name(link.parent) if link.parent else "" for link in links), strict=True)
    )
    for link in links:
        if not link.parent and link.kind != "fixed":
            raise ValueError(f"'{link.name}' has no parent, so its kind must be fixed, not {link.kind}")
        at, steps = clean_name(link.name), 0
        while parents[at]:
            if parents[at] not in parents:
                raise ValueError(f"the parent '{link.parent}' of '{link.name}' is no link")
            at, steps = parents[at], steps + 1
            if steps > len(links):
                raise ValueError(f"'{link.name}' is carried by itself: parents must lead to the body")


def _check_pieces(links: tuple[LinkAnswer, ...], count: int) -> None:
    told = [piece for link in links for piece in link.pieces]
    _check_range(told, count)
    _check_once(told, "links")
    for link in links:
        if link.parent and not link.pieces:
            raise ValueError(f"link '{link.name}' has no piece: name its pieces, or leave the link out")
    body = next(link for link in links if not link.parent)
    if not body.pieces and len(told) == count:
        raise ValueError(f"no piece is left for the body '{body.name}'")


def _check_range(pieces: tuple[int, ...] | list[int], count: int) -> None:
    unknown = sorted({piece for piece in pieces if not 0 <= piece < count})
    if unknown:
        raise ValueError(f"there is no piece {_listed(unknown)}: they are 0..{count - 1}")


def _check_once(pieces: list[int], where: str) -> None:
    twice = sorted(piece for piece, times in Counter(pieces).items() if times > 1)
    if twice:
        raise ValueError(f"piece {_listed(twice)} is in two {where}: each piece is in exactly one")


def _listed(pieces: list[int]) -> str:
    shown = ", ".join(map(str, pieces[:8]))
    return shown if len(pieces) <= 8 else f"{shown} and {len(pieces) - 8} more"


def _named(made: type[T], like: type[BaseModel]) -> type[T]:
    """A model under the name that its base has, which is the title of its schema."""
    made.__name__ = made.__qualname__ = like.__name__
    made.model_rebuild(force=True)
    return made
