"""What a modifier changed, in words."""

from __future__ import annotations

from simart_kit.asset import Asset, Joint, Part

from .joints import travel

# Attributes of a joint or a part that a person wants named when they change.
_JOINT_FIELDS = ("kind", "parent", "child", "origin", "axis", "damping", "friction", "effort", "velocity")


def changes(before: Asset, after: Asset) -> tuple[str, ...]:
    """A phrase a change, in the order size, parts, joints; empty when the two are alike."""
    return (*_size(before, after), *_parts(before, after), *_joints(before, after))


def said(before: Asset, after: Asset) -> tuple[str, ...]:
    """The notes that the modifier added."""
    return tuple(note.text for note in after.notes[len(before.notes) :])


def _size(before: Asset, after: Asset) -> list[str]:
    old, new = before.mesh.diagonal, after.mesh.diagonal
    found = (
        [] if abs(new / old - 1.0) < 1e-9 else [f"size times {new / old:.4g} ({old:.3g} m to {new:.3g} m)"]
    )
    if (len(before.mesh.faces), len(before.mesh.vertices)) != (
        len(after.mesh.faces),
        len(after.mesh.vertices),
    ):
        found.append(f"{len(before.mesh.faces)} faces became {len(after.mesh.faces)}")
    return found


def _parts(before: Asset, after: Asset) -> list[str]:
    old, new = ({p.name: p for p in asset.parts} for asset in (before, after))
    found = [f"part **{name}** removed" for name in old if name not in new]
    found += [f"part **{name}** added" for name in new if name not in old]
    for name in (n for n in new if n in old):
        found += [f"**{name}**: {text}" for text in _part(old[name], new[name])]
    return found


def _part(old: Part, new: Part) -> list[str]:
    found = [f"label {new.label or 'none'}"] if old.label != new.label else []
    if old.material != new.material:
        found.append(f"material {new.material.name}")
    if new.mass is not None and old.mass != new.mass:
        found.append(f"mass {new.mass.mass:.3g} kg ({new.mass.method})")
    if old.collision is not new.collision and (old.collision or new.collision):
        found.append(f"{len(new.collision)} collision shapes")
    return found


def _joints(before: Asset, after: Asset) -> list[str]:
    old, new = ({j.name: j for j in asset.joints} for asset in (before, after))
    found = [f"joint **{name}** removed" for name in old if name not in new]
    found += [
        f"joint **{name}** added: {new[name].kind} {travel(new[name])}" for name in new if name not in old
    ]
    for name in (n for n in new if n in old):
        found += [f"**{name}**: {text}" for text in _joint(old[name], new[name])]
    return found


def _joint(old: Joint, new: Joint) -> list[str]:
    found = []
    if old.limits != new.limits:
        found.append(f"travel {travel(old) or 'none'} → {travel(new) or 'none'}")
    for field in _JOINT_FIELDS:
        was, now = getattr(old, field), getattr(new, field)
        if was != now:
            found.append(f"{field} {_told(was)} → {_told(now)}")
    found += [f"flagged: {flag}" for flag in new.flags if flag not in old.flags]
    return found


def _told(value: str | float | tuple[float, ...]) -> str:
    if isinstance(value, tuple):
        return "(" + ", ".join(f"{v:.3g}" for v in value) + ")"
    return value if isinstance(value, str) else f"{value:.3g}"
