"""What P3-SAM is, and where it is looked for."""

from __future__ import annotations

from ..workers.installation import System

P3SAM = System(
    name="P3-SAM",
    stage="p3sam",
    repository="Tencent-Hunyuan/Hunyuan3D-Part",
    needs=("P3-SAM/demo/auto_mask.py", "XPart/partgen"),
    licence=(
        "Tencent's community licence: it is not granted in the European Union, the United Kingdom and South "
        "Korea, and what P3-SAM finds must not be used to train or improve other models"
    ),
)
