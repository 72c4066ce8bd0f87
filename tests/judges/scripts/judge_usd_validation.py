"""OpenUSD's own validators, all that the wheel holds."""

from pathlib import Path

from pxr import Usd, UsdValidation
from verdict import Positions, Reading, main

VALIDATORS = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()


def read(path: Path, _: Positions) -> Reading:
    """What they call an error."""
    stage = Usd.Stage.Open(str(path))
    found = UsdValidation.ValidationContext(VALIDATORS).Validate(stage)
    errors = [e for e in found if e.GetType() == UsdValidation.ValidationErrorType.Error]
    return {"errors": [f"{e.GetName()}: {e.GetMessage()}" for e in errors]}


if __name__ == "__main__":
    main(read)
