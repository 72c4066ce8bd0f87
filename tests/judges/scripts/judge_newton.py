"""Newton: URDF or USD, finalised on the CPU, posed, and stepped 200 times."""

import warnings
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import newton
import numpy as np
import warp
from verdict import Positions, Reading, inertial, main, pose, rows, turn

# Limits are springs of 1e4 N*m/rad here, and the solver is explicit: light handles need short steps.
STEPS, TIME_STEP = 200, 1e-4
FREE = 1e6  # Newton's stand-in for a limit that is none is larger


def read(path: Path, positions: Positions) -> Reading:
    """What the model says, and what is warned of while it is built."""
    builder = newton.ModelBuilder()
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always", UserWarning)
        if path.suffix == ".urdf":
            builder.add_urdf(str(path), floating=False)
        else:
            builder.add_usd(str(path))
        model = builder.finalize(device="cpu")
    solid = model.shape_flags.numpy() & int(newton.ShapeFlags.COLLIDE_SHAPES) != 0
    links = last_names(model.body_label)
    masses, centers, inertias = (a.numpy() for a in (model.body_mass, model.body_com, model.body_inertia))
    return {
        "errors": [f"warns: {w.message}" for w in warned if w.category is UserWarning] + unstable(model),
        "poses": [poses(model, at) for at in positions],
        "inertials": {
            link: inertial(*values) for link, *values in zip(links, masses, centers, inertias, strict=True)
        },
        "limits": limits(model),
        "colliders": Counter(links[body] for body in model.shape_body.numpy()[solid]),
    }


def last_names(labels: list[str]) -> list[str]:
    """The names that the file has: labels are paths."""
    return [label.rpartition("/")[2] for label in labels]


def poses(model: newton.Model, positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every link at joint positions."""
    q = model.joint_q.numpy().copy()
    for name, start in zip(last_names(model.joint_label), model.joint_q_start.numpy(), strict=False):
        if name in positions:
            q[start] = positions[name]
    state = model.state()
    newton.eval_fk(model, warp.array(q, dtype=float, device="cpu"), model.joint_qd, state)
    placed = zip(last_names(model.body_label), rows(state.body_q.numpy()), strict=True)
    return {link: pose(turn(*values[3:]), values[:3]) for link, values in placed}


def limits(model: newton.Model) -> dict[str, list[float] | None]:
    """Range by joint with one axis, or None where it turns for ever."""
    lower, upper = rows(model.joint_limit_lower.numpy()), rows(model.joint_limit_upper.numpy())
    one_axis = (int(newton.JointType.REVOLUTE), int(newton.JointType.PRISMATIC))
    return {
        name: None if abs(lower[start]) > FREE else [lower[start], upper[start]]
        for name, kind, start in zip(
            last_names(model.joint_label),
            model.joint_type.numpy(),
            model.joint_qd_start.numpy(),
            strict=False,
        )
        if int(kind) in one_axis
    }


def unstable(model: newton.Model) -> list[str]:
    """Whether it stays finite when left alone."""
    solver = newton.solvers.SolverFeatherstone(model)
    before, after = model.state(), model.state()
    for _ in range(STEPS):
        before.clear_forces()
        solver.step(before, after, model.control(), None, TIME_STEP)
        before, after = after, before
    return [] if np.isfinite(before.body_q.numpy()).all() else ["not finite when simulated"]


if __name__ == "__main__":
    main(read)
