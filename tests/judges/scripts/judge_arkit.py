"""Apple's rules for AR, as OpenUSD's ComplianceChecker holds them up to 26.5."""

from pathlib import Path

from pxr import UsdUtils
from verdict import Positions, Reading, main


def read(path: Path, _: Positions) -> Reading:
    """What the checker finds, the root layer included."""
    checker = UsdUtils.ComplianceChecker(arkit=True, skipARKitRootLayerCheck=False)
    checker.CheckCompliance(str(path))
    return {"errors": [*checker.GetErrors(), *checker.GetFailedChecks()]}


if __name__ == "__main__":
    main(read)
