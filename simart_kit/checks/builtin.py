"""The checks that come with simart-kit, in the order in which they run."""

from __future__ import annotations

from ..hookspecs import Register, hookimpl
from .agreement import Agreement
from .collision import Collision
from .energy import Energy
from .files import Files
from .gravity import Gravity
from .joints import Joints
from .lint import Lint
from .mass import Mass
from .penetration import Penetration
from .push import Push
from .realtime import Realtime
from .settle import Settle
from .sweep import JointSweep
from .timestep import Timestep
from .travel import Travel

# First what is written, then how it behaves.
CHECKS = (
    Files,
    Lint,
    Agreement,
    Mass,
    Collision,
    Joints,
    Penetration,
    JointSweep,
    Travel,
    Settle,
    Gravity,
    Push,
    Energy,
    Timestep,
    Realtime,
)


@hookimpl
def register_checks(register: Register) -> None:
    """Register them all."""
    for check in CHECKS:
        register(check)
