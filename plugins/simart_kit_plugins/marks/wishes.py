"""What a person states of what moves, as words that go with the questions."""

from __future__ import annotations

import json

from simart_kit.spec.values import Spec

# Numbers of pieces, places and changes to an earlier run mean nothing in these pictures: the core obeys them.
_LEFT_OUT = ("pieces", "points", "through", "found_as")


def wishes_text(spec: Spec | None) -> str:
    """A paragraph with what is stated of kinds of parts and of parts; "" where there is nothing."""
    if spec is None:
        return ""
    table = spec.table()
    stated = {key: table[key] for key in ("only", "kinds", "parts") if key in table}
    if "parts" in stated:
        stated["parts"] = [
            {key: value for key, value in part.items() if key not in _LEFT_OUT} for part in stated["parts"]
        ]
    if not stated:
        return ""
    told = json.dumps(stated, ensure_ascii=False)
    return (
        f"\n\nThe owner of the object states what moves. Follow it wherever the object allows, and use its "
        f"names; limits are in degrees or metres, and `only` says that nothing else moves: {told}"
    )
