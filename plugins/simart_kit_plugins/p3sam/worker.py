"""The worker that runs P3-SAM: a script for the environment of Hunyuan3D-Part, and of nothing else.

It imports the standard library, numpy, trimesh and `auto_mask` of P3-SAM/demo; nothing of simart-kit, which
is not installed there. It runs in P3-SAM/demo, for paths in P3-SAM are relative to that. Its argument is a
folder with a request; docs/p3sam.md has the protocol.
"""

from __future__ import annotations

import importlib
import inspect
import json
import random
import sys
import traceback
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

PROTOCOL = 1
# What P3-SAM's own defaults are; it takes these whatever it is given.
POINTS, PROMPTS = 100_000, 400


def main() -> None:
    """Answer the request in the folder that is named last."""
    place = Path(sys.argv[-1]).resolve()
    try:
        request = json.loads((place / "request.json").read_text(encoding="utf-8"))
        if request["protocol"] != PROTOCOL:
            raise ValueError(f"the request is of protocol {request['protocol']}")
        _write(place, _segmented(place, request))
        answer = {"protocol": PROTOCOL, "status": "ok"}
    except Exception as error:
        traceback.print_exc()
        message = f"{type(error).__name__}: {error}"
        answer = {"protocol": PROTOCOL, "status": "error", "message": message}
    (place / "result.json").write_text(json.dumps(answer), encoding="utf-8")


def _segmented(place: Path, request: dict[str, Any]) -> dict[str, NDArray[Any]]:
    """Face ids, and the mesh that they are of."""
    options = request["options"]
    auto_mask = _import_from(Path(request["folder"]))
    _seed(options["seed"])
    model = auto_mask.AutoMask(
        options["checkpoint"] or None,
        point_num=POINTS,
        prompt_num=PROMPTS,
        threshold=options["threshold"],
        post_process=options["post_process"],
    )
    wanted = {
        "save_path": str(place),
        "save_mid_res": False,
        "show_info": True,
        "clean_mesh_flag": False,
        "seed": options["seed"],
        "is_parallel": False,
        "prompt_bs": options["prompt_batch"],
    }
    known = inspect.signature(model.predict_aabb).parameters  # versions differ
    _, face_ids, mesh = model.predict_aabb(
        _mesh(place), **{name: value for name, value in wanted.items() if name in known}
    )
    return {"face_ids": face_ids, "vertices": mesh.vertices, "faces": mesh.faces}


def _import_from(folder: Path) -> Any:
    """P3-SAM's module, as if its own script was run; this script's folder must not hide what it imports."""
    sys.path[0] = str(folder / "P3-SAM" / "demo")
    sys.path += [str(folder / "P3-SAM"), str(folder / "XPart" / "partgen")]
    return importlib.import_module("auto_mask")


def _seed(seed: int) -> None:
    import numpy as np

    random.seed(seed)
    np.random.seed(seed)  # noqa: NPY002, TID251 (what P3-SAM draws from)
    torch = sys.modules.get("torch")
    if torch is not None:
        torch.manual_seed(seed)


def _mesh(place: Path) -> Any:
    import numpy as np
    import trimesh

    with np.load(place / "mesh.npz") as arrays:
        return trimesh.Trimesh(arrays["vertices"], arrays["faces"], process=False)


def _write(place: Path, arrays: dict[str, NDArray[Any]]) -> None:
    import numpy as np

    whole: dict[str, Any] = {name: np.asarray(array) for name, array in arrays.items()}
    np.savez(place / "result.npz", **whole)


if __name__ == "__main__":
    main()
