"""NVIDIA's validator of USD, by category: without them, rules for robots and for Isaac run as well."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

from verdict import Positions, Reading, main

CATEGORIES = ("Basic", "Geometry", "Layer", "Layout", "Material", "Physics", "Other", "Units")
COMMAND = Path(sys.executable).with_name("nvidia_usd_validate")


def read(path: Path, _: Positions) -> Reading:
    """What it calls a failure or an error; warnings are advice.

    The answer is taken as CSV: its JSON breaks off at warnings that name a requirement.
    """
    chosen = [word for category in CATEGORIES for word in ("-c", category)]
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.csv"
        command = [str(COMMAND), "--no-init-rules", *chosen, "--csv-output", str(answer), str(path)]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if not answer.exists():
            return {"errors": [f"exit code {run.returncode}: {run.stderr[-300:]}"]}
        with answer.open(encoding="utf-8", newline="") as file:
            issues = list(csv.DictReader(file))
    if run.returncode and not issues:
        return {"errors": [f"exit code {run.returncode}: {run.stderr[-300:]}"]}
    bad = [issue for issue in issues if issue["Severity"] != "Warning"]
    return {"errors": [f"{issue['Rule']}: {issue['Message']} {issue['Location']}" for issue in bad]}


if __name__ == "__main__":
    main(read)
