"""What Particulate is, and where it is looked for."""

from __future__ import annotations

from ..workers.installation import System

PARTICULATE = System(
    name="Particulate",
    stage="particulate",
    repository="RuiningLi/particulate",
    needs=("infer.py", "configs/particulate-B.yaml"),
    licence=(
        "Particulate's weights are CC-BY-4.0 and its repository names no licence; PartField, which it needs, "
        "is NVIDIA's and not for commercial use"
    ),
)
