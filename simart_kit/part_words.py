"""What words a description of a part is made of: things, sides, sizes, orders, counts and materials."""

from __future__ import annotations

import re
from dataclasses import dataclass

from .asset import clean_name


def _words(text: str) -> tuple[str, ...]:
    return tuple(text.split())


# Words for the same thing, as people and models use them.
_SYNONYMS: tuple[frozenset[str], ...] = tuple(
    frozenset(words.split())
    for words in (
        "lid cover cap hatch flap",
        "door leaf gate flap shutter",
        "handle knob grip pull",
        "knob dial",
        "button key switch",
        "body base frame case casing housing chassis carcass shell enclosure hull",
        "body box cabinet",
        "wheel caster castor tyre tire roller",
        "screen display monitor",
        "shelf rack",
        "tap faucet spout",
        "lever arm rod",
        "leg foot",
        "window pane",
        "seat cushion",
        "blade vane",
        "bonnet hood",
        "boot trunk tailgate",
        "plate panel board",
        "latch lock catch",
        "slider slide",
        "bar rod pole post",
    )
)
_SIDES: dict[str, str] = {
    word: side
    for side, words in {
        "upper": "upper top topmost uppermost highest higher high",
        "lower": "lower bottom bottommost lowest low",
        "left": "left leftmost",
        "right": "right rightmost",
        "front": "front frontmost foremost",
        "back": "back rear rearmost backmost hind",
        "middle": "middle center centre central mid",
    }.items()
    for word in words.split()
}
_SIZES = dict.fromkeys(_words("big bigger biggest large larger largest"), 1) | dict.fromkeys(
    _words("small smaller smallest little tiny"), -1
)
_ORDINALS = _words("first second third fourth fifth sixth seventh eighth ninth tenth")
_ORDERS = {word: number for number, word in enumerate(_ORDINALS, start=1)} | {"last": -1}
_COUNTS = {word: number for number, word in enumerate(_words("two three four five six"), start=2)} | {
    "both": 2
}
_METALS = frozenset({"steel", "aluminium", "brass"})
_MATERIALS: dict[str, frozenset[str]] = (
    {
        name: frozenset({name})
        for name in _words("glass steel aluminium brass plastic ceramic stone concrete rubber fabric foam")
    }
    | dict.fromkeys(("metal", "metallic"), _METALS)
    | dict.fromkeys(("wood", "wooden"), frozenset({"wood", "plywood", "mdf"}))
    | {"aluminum": frozenset({"aluminium"}), "iron": frozenset({"steel"}), "cloth": frozenset({"fabric"})}
)
_EMPTY = frozenset({"", "and"}).union(
    _words("the a an this that its it part piece link one ones number object side please find")
)
_ALL = frozenset({"all", "every", "each"})
# What follows says where the part is, or whose it is.
_OF = frozenset(_words("of on at in from to with near inside beside for under over above below behind which"))
_PLURALS = {"feet": "foot", "leaves": "leaf", "shelves": "shelf", "lenses": "lens", "buses": "bus"}
_UNCHANGED = frozenset(_words("glass glasses lens chassis axis canvas brass bus gas cross"))


@dataclass(frozen=True)
class Wanted:
    """A description taken apart.

    Attributes:
        things: what is meant, in one form a word, such as ("cabinet", "door"); the last one counts most.
        sides: of "upper", "lower", "left", "right", "front", "back" and "middle".
        size: 1 for a big part, -1 for a small one, 0 where nothing is said.
        order: 1 for the first, -1 for the last, 0 where nothing is said.
        order_from: side where counting starts, or "".
        number: as in "drawer 2", or 0.
        many: whether several parts may be meant.
        count: how many, or 0.
        materials: keys of the material table that fit; none where nothing is said.
        context: whose part or beside what: "left door" in "handle of the left door", or "".
    """

    things: tuple[str, ...]
    sides: tuple[str, ...] = ()
    size: int = 0
    order: int = 0
    order_from: str = ""
    number: int = 0
    many: bool = False
    count: int = 0
    materials: frozenset[str] = frozenset()
    context: str = ""


def wanted(description: str) -> Wanted:
    """Take a description apart; `things` is empty where it names none."""
    words = [_plain(word) for word in clean_name(description, "").split("_") if word not in _EMPTY]
    head, tail = _split(words)
    placed = [word for word in tail if word not in _OF]
    # "drawer on the left" tells a side of the drawer; "handle of the left door" one of the door.
    own = all(word in _SIDES for word in placed)
    order = next((_ORDERS[word] for word in head if word in _ORDERS), 0)
    sides = [_SIDES[word] for word in head if word in _SIDES]
    counted_from = _SIDES[placed[0]] if own and placed and order else ""
    if own and not counted_from:
        sides += [_SIDES[word] for word in placed]
    materials = [_MATERIALS[word] for word in head if word in _MATERIALS]
    nouns = [word for word in head if _is_thing(word)] or [word for word in head if word in _MATERIALS]
    numbers = [int(word) for word in head if word.isdigit()]
    many = bool(nouns and one_form(nouns[-1]) != nouns[-1]) or any(
        word in _ALL | _COUNTS.keys() for word in head
    )
    return Wanted(
        things=tuple(map(one_form, nouns)),
        sides=tuple(dict.fromkeys(sides)),
        size=next((_SIZES[word] for word in head if word in _SIZES), 0),
        order=order,
        order_from=counted_from,
        number=int(head[-1]) if head and head[-1].isdigit() and not many else 0,
        many=many,
        count=next(
            (_COUNTS[word] for word in head if word in _COUNTS), numbers[0] if many and numbers else 0
        ),
        materials=frozenset().union(*materials),
        context="" if own else " ".join(placed),
    )


def name_words(text: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The things that a part's name is made of, in one form, and the sides that it claims."""
    words = [word for word in clean_name(text, "").split("_") if not (word in _EMPTY or word.isdigit())]
    things = [one_form(word) for word in words if word not in _SIDES and word not in _ORDERS]
    return tuple(things), tuple(_SIDES[word] for word in words if word in _SIDES)


def synonyms(one: str, other: str) -> bool:
    """Whether two words, each in one form, may mean the same thing."""
    return any(one in group and other in group for group in _SYNONYMS)


def one_form(word: str) -> str:
    """The singular of an English noun, well enough to compare by."""
    if word in _PLURALS:
        return _PLURALS[word]
    if word in _UNCHANGED or not word.endswith("s") or word.endswith("ss") or len(word) < 4:
        return word
    if word.endswith("ies"):
        return f"{word[:-3]}y"
    return word[:-2] if re.search(r"(ss|x|ch|sh)es$", word) else word[:-1]


def _plain(word: str) -> str:
    """A number without its ending: 2nd is the second."""
    found = re.fullmatch(r"(\d+)(st|nd|rd|th)", word)
    return _ORDINALS[int(found[1]) - 1] if found and 1 <= int(found[1]) <= len(_ORDINALS) else word


def _split(words: list[str]) -> tuple[list[str], list[str]]:
    """The words before and from the first that begins a phrase such as "of the door"."""
    place = next((i for i, word in enumerate(words) if word in _OF), len(words))
    return words[:place], words[place:]


def _is_thing(word: str) -> bool:
    known = (_SIDES, _SIZES, _ORDERS, _COUNTS, _MATERIALS, _ALL)
    return bool(word) and not word.isdigit() and not any(word in table for table in known)
