"""The run in words: what was made, checks, modifiers, timings, recipe, and why a run failed. Markdown."""

from __future__ import annotations

import traceback
from collections.abc import Iterable, Sequence

from simart_kit.assemble import Articulation
from simart_kit.asset import Asset, Joint
from simart_kit.loading import Source
from simart_kit.recipe import Recipe
from simart_kit.stages import Segmentation
from simart_kit.toml_text import recipe_text

from .changes import changes, said
from .history import Event, Failure, History
from .joints import travel


def summary(history: History) -> str:
    """The object, its parts and its joints; checks and warnings once the run is finished."""
    asset = history.asset
    lines = [f"## {history.name}"]
    if asset is None:
        return "\n\n".join([*lines, *(describe(e.value) for e in history.events[-1:])])
    lines.append(f"{describe(asset)} {_verdict(history)}")
    lines += [_joints_table(asset), _parts_table(asset)]
    warnings = [note for note in asset.notes if note.level == "warning"]
    return "\n\n".join([*lines, _bullets(f"**{n.stage}**: {n.text}" for n in warnings)])


def checks(history: History) -> str:
    """Every check with its verdict, then what the stages decided and what exports could not express."""
    rows = [("✓" if c.passed else "**failed**", c.name, c.text) for c in history.checks]
    lines = ["## Checks", _table(("verdict", "check", "finding"), rows)]
    if history.report is not None:
        lost = [f"**{name}**: {t}" for name, texts in history.report.unsupported.items() for t in texts]
        lines += ["### What exports could not express", _bullets(lost) or "Nothing."]
        lines += ["### Notes", _bullets(f"**{n.stage}** ({n.level}): {n.text}" for n in history.report.notes)]
    return "\n\n".join(lines)


def modifiers(history: History) -> str:
    """A line for what each modifier changed, and what it said about it."""
    lines, before = ["## Modifiers"], history.predicted
    for step in history.steps:
        assert before is not None
        found = changes(before, step.asset)
        lines += [
            f"### {step.name}",
            "; ".join(found) or "changed nothing",
            _bullets(said(before, step.asset)),
        ]
        before = step.asset
    return "\n\n".join(line for line in lines if line)


def timings(events: Sequence[Event]) -> str:
    """Wall time of every stage, in the order of the bar chart."""
    rows = [(str(i), e.stage, e.name, f"{e.seconds:.3f} s") for i, e in enumerate(events, start=1)]
    total = sum(e.seconds for e in events)
    return f"{total:.2f} s in all\n\n" + _table(("bar", "stage", "by", "time"), rows)


def recipe(used: Recipe) -> str:
    """The resolved recipe as TOML."""
    return f"## Recipe\n\n```toml\n{recipe_text(used)}```"


def failure_text(failure: Failure, events: Sequence[Event]) -> str:
    """The failing stage, its error, what it was given, and the traceback."""
    error = failure.error
    given = describe(events[-1].value) if events else "nothing: this is the first stage"
    trace = "".join(traceback.format_exception(error))
    return "\n\n".join(
        [
            f"# Failed in stage: {failure.stage}",
            f"**{error}**",
            f"**Given:** {given}",
            f"### Traceback\n\n```text\n{trace}```",
        ]
    )


def describe(value: object) -> str:
    """A stage's value in one sentence."""
    if isinstance(value, Source):
        mesh = value.mesh
        look = (
            "textured" if mesh.uv is not None and any(m.base_color_image for m in mesh.materials) else "plain"
        )
        size = " x ".join(f"{v:.3g}" for v in mesh.bounds[1] - mesh.bounds[0])
        return f"A {look} mesh of {len(mesh.faces)} faces, {len(mesh.vertices)} vertices, {size} m."
    if isinstance(value, Segmentation):
        return f"A mesh in {len(value.parts)} parts: {', '.join(p.name for p in value.parts)}."
    value = value.asset if isinstance(value, Articulation) else value
    if isinstance(value, Asset):
        size = " x ".join(f"{v:.3g}" for v in value.mesh.bounds[1] - value.mesh.bounds[0])
        parts, moving = len(value.parts), sum(j.moves for j in value.joints)
        count = f"{parts} part{'s' * (parts != 1)}, {moving} moving joint{'s' * (moving != 1)}"
        return f"{count}, {len(value.mesh.faces)} faces, {size} m (width x depth x height)."
    return f"A value of type {type(value).__name__}."


def _verdict(history: History) -> str:
    if not history.checks:
        return ""
    failed = [c.name for c in history.checks if not c.passed]
    return (
        f"**Failed checks: {', '.join(failed)}.**" if failed else f"All {len(history.checks)} checks passed."
    )


def _parts_table(asset: Asset) -> str:
    rows = [
        (
            p.name,
            p.label,
            p.material.name,
            f"{p.mass.mass:.3g} kg" if p.mass else "",
            str(int((asset.face_part == i).sum())),
        )
        for i, p in enumerate(asset.parts)
    ]
    return _table(("part", "label", "material", "mass", "faces"), rows)


def _joints_table(asset: Asset) -> str:
    rows = [
        (j.name, j.kind, f"{j.parent} → {j.child}", travel(j), f"{j.confidence:.0%}") for j in asset.joints
    ]
    if not rows:
        return "No joints: nothing moves."
    reasons = [f"**{j.name}**: {'; '.join((*j.evidence, *_flags(j)))}" for j in asset.joints]
    return _table(("joint", "kind", "moves", "travel", "sure"), rows) + "\n\n" + _bullets(reasons)


def _flags(joint: Joint) -> tuple[str, ...]:
    return tuple(f"**{flag}**" for flag in joint.flags)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "/") for cell in line) + " |" for line in lines)


def _bullets(texts: Iterable[str]) -> str:
    return "\n".join(f"- {text}" for text in texts)
