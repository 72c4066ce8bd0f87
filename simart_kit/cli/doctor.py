"""`simart-kit doctor`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import typer

from .common import print_json, print_rows, stdout_kept
from .options import Json, PluginFiles, Verbose

if TYPE_CHECKING:
    from ..doctor import Diagnosis, PluginFindings
    from ..findings import Finding

_SHOWN = {"ok": "ok", "missing": "MISSING", "broken": "BROKEN"}


def doctor(plugin: PluginFiles = None, json: Json = False, verbose: Verbose = False) -> None:
    """Say what is installed, what each plugin needs, and which recipes can run.

    Nothing is loaded or run: libraries are looked up, weights by their files' headers. The exit code is 1 if
    the default recipe cannot run.
    """
    from ..doctor import examine
    from ..plugins import Plugins

    with stdout_kept(json):
        diagnosis = examine(Plugins(files=plugin or (), strict=False))
    if json:
        print_json(_document(diagnosis))
    else:
        _print(diagnosis, verbose)
    if not diagnosis.ok:
        raise typer.Exit(1)


def _print(diagnosis: Diagnosis, verbose: bool) -> None:
    print(f"simart-kit {diagnosis.version}")
    _section("machine", diagnosis.machine)
    _section("libraries", diagnosis.libraries)
    print("\nplugins")
    for plugin in diagnosis.plugins:
        if plugin.findings or verbose:
            print(f"  {plugin.owner}{_stages(plugin)}")
            _lines(plugin.findings, "    ")
    quiet = sum(not plugin.findings for plugin in diagnosis.plugins)
    if quiet and not verbose:
        print(f"  and {quiet} that need nothing more; -v lists them")
    _section("recipes", diagnosis.recipes)


def _section(title: str, findings: Iterable[Finding]) -> None:
    print(f"\n{title}")
    _lines(tuple(findings), "  ")


def _lines(findings: tuple[Finding, ...], indent: str) -> None:
    if findings:
        print_rows([(_state(f), f.subject, _told(f)) for f in findings], indent)


def _state(finding: Finding) -> str:
    """What nothing depends on is not shouted about."""
    optional = finding.stages == () and finding.state == "missing"
    return "-" if optional else _SHOWN[finding.state]


def _told(finding: Finding) -> str:
    return f"{finding.detail}; {finding.remedy}" if finding.remedy else finding.detail


def _stages(plugin: PluginFindings) -> str:
    names = ", ".join(f"{kind} {name}" for kind, name in plugin.stages)
    return f": {names}" if names else ""


def _document(diagnosis: Diagnosis) -> dict[str, Any]:
    return {
        "ok": diagnosis.ok,
        "version": diagnosis.version,
        "machine": [_row(finding) for finding in diagnosis.machine],
        "libraries": [_row(finding) for finding in diagnosis.libraries],
        "plugins": [
            {
                **vars(plugin.owner),
                "stages": [{"kind": kind, "name": name} for kind, name in plugin.stages],
                "findings": [_row(finding) for finding in plugin.findings],
            }
            for plugin in diagnosis.plugins
        ],
        "recipes": [_row(finding) for finding in diagnosis.recipes],
    }


def _row(finding: Finding) -> dict[str, Any]:
    stages = None if finding.stages is None else list(finding.stages)
    told = {"subject": finding.subject, "state": finding.state, "detail": finding.detail}
    return {**told, "remedy": finding.remedy, "stages": stages}
