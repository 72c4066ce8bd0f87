"""Kinds of parts: what each is for in words, and which words name a kind."""

from __future__ import annotations

# What things are for, by the last word of their label.
FUNCTIONS: dict[str, tuple[str, ...]] = {
    "door": ("the part that closes the opening", "the panel that lets one look or reach inside"),
    "drawer": ("the part that is pulled out to put things into", "the compartment that slides out"),
    "lid": ("the part that covers the opening from above", "the part that is lifted to look inside"),
    "wheel": ("the part that rolls", "the round part that turns as the object moves"),
    "caster": ("the part that lets the object roll in any direction",),
    "button": ("the part that is pressed with a finger",),
    "key": ("the part that is pressed down to play or type",),
    "knob": ("the part that is turned with two fingers", "the control that is twisted"),
    "handle": ("the part that a hand takes hold of",),
    "lever": ("the part that a hand pushes or pulls over",),
    "seat": ("the part that one sits on",),
    "backrest": ("the part that one leans back on",),
    "screen": ("the part that shows pictures",),
    "pedal": ("the part that a foot presses",),
    "latch": ("the part that keeps it shut",),
    "tray": ("the flat part that things are laid on",),
    "flap": ("the thin part that folds over",),
    "leg": ("the part that it stands on",),
    "blade": ("the flat part that moves air or cuts",),
    "switch": ("the part that turns it on and off",),
    "faucet": ("the part that water comes out of",),
    "spout": ("the part that water comes out of",),
}
_MORE = "arm body base shelf window fan tap rack hook panel cover cap switch frame cabinet hinge slide burner"
# Words that tell parts of one kind apart.
_SIDES = "left right upper lower top bottom front rear back inner outer main middle mid"
_OTHERS = "big small large little long short first second third fourth glass wood wooden metal plastic steel"
_MODIFIERS = frozenset([*_SIDES.split(), *_OTHERS.split()])
_KINDS = frozenset([*FUNCTIONS, *_MORE.split()])


def kind_named(name: str) -> str:
    """The kind that a name of words is of, such as "drawer" of "drawer small"; "" where nobody can tell.

    Words that are neither a kind nor tell like parts apart may make it something else: the "door frame" and
    the "tray sprinkler" are no door and no tray.
    """
    kinds = [word for word in name.split() if word not in _MODIFIERS]
    return kinds[0] if len(kinds) == 1 and kinds[0] in _KINDS else ""
