"""Put files before a judge. Readings that cost much are kept for as long as nothing about them changes."""

from __future__ import annotations

import hashlib
import json
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from simart_kit.asset import Asset
from simart_kit.asset_io import load_asset

from .comparing import Verdict, compare, positions_of
from .homes import command
from .panel import HERE, Judge, file_of

TIMEOUT, TIMEOUT_FILE = 300, 60  # to start, when some compile their kernels, and a file more [s]
Job = dict[str, Any]
Readings = dict[str, dict[str, Any]]


def verdicts(judge: Judge, folders: Mapping[str, Path], build: Path) -> dict[str, Verdict]:
    """What a judge makes of each folder that has a file for it, by name.

    Args:
        judge: is asked.
        folders: output folders of conversions, by a name that is unique.
        build: environments, and readings of heavy judges, are kept here.

    Raises:
        NotInstalledError, subprocess.CalledProcessError: as `homes.command`.
    """
    assets = {name: load_asset(folder) for name, folder in folders.items()}
    jobs = [job for name, folder in folders.items() if (job := _job(judge, name, folder, assets[name]))]
    if not jobs:
        return {}
    kept = {} if judge.light else _kept(judge, jobs, build)
    waiting = [job for job in jobs if job["asset"] not in kept]
    read = dict(_read(command(judge, build), waiting)) if waiting else {}
    if not judge.light:
        _keep(judge, waiting, read, build)
    return {
        job["asset"]: _plain(compare(assets[job["asset"]], (kept | read)[job["asset"]]), job) for job in jobs
    }


def _job(judge: Judge, name: str, folder: Path, asset: Asset) -> Job | None:
    path = file_of(folder, judge.format, asset.name)
    return path and {"asset": name, "path": str(path.resolve()), "positions": positions_of(asset)}


def _plain(verdict: Verdict, job: Job) -> Verdict:
    """Errors without the paths of a file, so that the same one reads the same of all."""
    path = Path(job["path"])
    errors = (
        text.replace(f"{path.parent}/", "").replace(path.name, f"NAME{path.suffix}")
        for text in verdict.errors
    )
    return replace(verdict, errors=tuple(errors))


def _read(words: list[str], jobs: list[Job]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Readings by name. A file that ends the judge's process is named, and the rest is read without it."""
    while jobs:
        answers, ending = _run(words, jobs)
        yield from answers.items()
        jobs = [job for job in jobs if job["asset"] not in answers]
        if jobs:
            yield jobs.pop(0)["asset"], {"errors": [ending], "seconds": 0.0}


def _run(words: list[str], jobs: list[Job]) -> tuple[Readings, str]:
    """Readings up to where the process ended, and how it did."""
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "jobs.json"
        table.write_text(json.dumps(jobs), encoding="utf-8")
        with (Path(folder) / "log").open("w+", encoding="utf-8", errors="replace") as log:
            with (Path(folder) / "answers").open("w+", encoding="utf-8") as out:
                code = _call([*words, str(table)], out, log, TIMEOUT + TIMEOUT_FILE * len(jobs))
                out.seek(0)
                lines = [json.loads(line) for line in out]
            log.seek(0)
            last = (log.read().strip().splitlines() or [""])[-1]
    return {line["asset"]: line for line in lines}, f"{code}: {last}"


def _call(words: list[str], out: Any, log: Any, timeout: float) -> str:
    """Run a judge; returns how it ended."""
    try:
        run = subprocess.run(words, stdout=out, stderr=log, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return f"no answer in {timeout} s"
    return f"exit code {run.returncode}"


def _kept(judge: Judge, jobs: list[Job], build: Path) -> Readings:
    found = {}
    for job in jobs:
        path = _kept_path(judge, job, build)
        if path.exists():
            found[job["asset"]] = json.loads(path.read_text(encoding="utf-8"))
    return found


def _keep(judge: Judge, jobs: list[Job], read: Readings, build: Path) -> None:
    for job in jobs:
        path = _kept_path(judge, job, build)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(read[job["asset"]]), encoding="utf-8")


def _kept_path(judge: Judge, job: Job, build: Path) -> Path:
    """Named by all that a reading depends on."""
    digest = hashlib.sha256(json.dumps([job["path"], job["positions"]]).encode())
    helper = HERE / "scripts" / "verdict.py"
    beside = sorted(path for path in Path(job["path"]).parent.rglob("*") if path.is_file())
    own = [path for path in (judge.script_path, helper, judge.requirements) if path]
    for path in [*own, *beside]:
        digest.update(path.name.encode() + path.read_bytes())
    return build / "readings" / judge.name / f"{digest.hexdigest()[:32]}.json"
