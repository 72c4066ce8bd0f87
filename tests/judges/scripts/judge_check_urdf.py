"""check_urdf: the parser of ROS."""

import subprocess
from pathlib import Path

from verdict import Positions, Reading, main


def read(path: Path, _: Positions) -> Reading:
    """What it refuses."""
    run = subprocess.run(["check_urdf", str(path)], capture_output=True, text=True, check=False)
    complaints = [line for line in run.stderr.splitlines() if "Error" in line or "Warning" in line]
    return {"errors": complaints or ([f"exit code {run.returncode}"] if run.returncode else [])}


if __name__ == "__main__":
    main(read)
