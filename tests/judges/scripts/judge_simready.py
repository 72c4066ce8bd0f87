"""SimReady's profile for props that robots handle, with the feature for several bodies."""

import ast
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from pxr import Usd, UsdPhysics
from verdict import Positions, Reading, main

PROFILE, VERSION = "Robotics-Prop", "4.0.0"
# Optional in the profile, yet the one that looks at joints, where there are two bodies or more.
MULTI_BODY = "FET_004_STANDARD"
COMMAND = Path(sys.executable).with_name("simready-validate")


def read(path: Path, _: Positions) -> Reading:
    """The requirements that are not met."""
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        command = [
            str(COMMAND),
            "--profile",
            PROFILE,
            "--version",
            VERSION,
            "--output",
            str(answer),
            str(path),
        ]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if not answer.exists():
            return {"errors": [f"exit code {run.returncode}: {run.stderr[-300:]}"]}
        (found,) = json.loads(answer.read_text(encoding="utf-8")).values()
    features = found["features_summary"]
    failed = [text for name, row in features.items() if row["blocking_failure"] for text in told(name, row)]
    if bodies(path) > 1 and not features[MULTI_BODY]["passed"]:
        failed += told(MULTI_BODY, features[MULTI_BODY])
    if run.returncode and not failed:
        failed = [f"exit code {run.returncode}: {run.stdout[-300:]}"]
    return {"errors": failed}


def bodies(path: Path) -> int:
    """Number of rigid bodies."""
    stage = Usd.Stage.Open(str(path))
    return sum(prim.HasAPI(UsdPhysics.RigidBodyAPI) for prim in stage.Traverse())


def told(name: str, feature: dict[str, Any]) -> list[str]:
    """A line for each unmet requirement; lists are Python literals inside of strings."""
    messages = json.loads(feature.get("requirement_messages", "{}"))
    unmet = [
        code
        for key in ("failing requirements", "optional requirements")
        for code in ast.literal_eval(feature.get(key, "[]"))
    ]
    return [f"{name} {code}: {'; '.join(messages.get(code, ['not met']))}" for code in unmet] or [
        f"{name}: not passed"
    ]


if __name__ == "__main__":
    main(read)
