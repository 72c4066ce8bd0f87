"""Building data sets: shards, resuming, and what stops a build."""

from __future__ import annotations

import errno
import tarfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from simart_kit_plugins.simart.dataset import building
from simart_kit_plugins.simart.dataset.jobs import find_jobs
from simart_kit_plugins.simart.dataset.making import Made, Order
from simart_kit_plugins.simart.dataset.manifest import MANIFEST
from simart_kit_plugins.simart.dataset.progress import FOLDER
from simart_kit_plugins.simart.dataset.reading import read_records
from simart_kit_plugins.simart.dataset.seen import SeenHashes
from simart_kit_plugins.simart.dataset.shards import Entry, ShardWriter
from simart_kit_plugins.simart.dataset.statistics import Statistics, skip

from simart_kit.bench.importing import write_case
from simart_kit.errors import BadInputError, OutputError

from .bench_objects import cabinet, truth
from .dataset_objects import built, few


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Objects whose records are made of nothing, so that thousands take no time: what a build is about."""

    def make(order: Order, job: Any) -> Made:
        number = job.number
        if number % 7 == 3:
            return Made(job.key, 0, (), skip("too ugly"), f"too ugly: {job.key}")
        entries = tuple(
            Entry(
                f"{job.key}-{state}", f"{job.key} {state}".encode() * (1 + number), b"png" if state else None
            )
            for state in range(order.records.states)
        )
        counts = Statistics(objects=1, records=len(entries), pairs={"urdf": len(entries)})
        # The numbers 20, 21 and 22 look alike.
        return Made(job.key, 20 if number in (21, 22) else number, entries, counts)

    monkeypatch.setattr(building, "make", make)


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def keys(folder: Path) -> list[str]:
    """Keys of all records, by reading the shards as any program does."""
    found = []
    for path in sorted(folder.glob("*.tar")):
        with tarfile.open(path) as tar:
            found += [name.removesuffix(".json") for name in tar.getnames() if name.endswith(".json")]
    return found


def test_shards_are_plain_tar_files_without_a_trace_of_the_machine(tmp_path: Path) -> None:
    for name in ("one.tar", "two.tar"):
        writer = ShardWriter(tmp_path / name, tmp_path / "partial")
        writer.add([Entry("a" * 120, b"{}", b"png"), Entry("b", b"[1]" * 200, None)])
        shard = writer.close()
        assert (shard.records, shard.bytes) == (2, (tmp_path / name).stat().st_size)
    assert (tmp_path / "one.tar").read_bytes() == (tmp_path / "two.tar").read_bytes()
    assert not (tmp_path / "partial").exists()
    with tarfile.open(tmp_path / "one.tar") as tar:
        assert tar.getnames() == ["a" * 120 + ".json", "a" * 120 + ".png", "b.json"]
        assert {(m.mtime, m.uid, m.gid, m.uname, m.gname, m.mode) for m in tar} == {(0, 0, 0, "", "", 0o644)}
        file = tar.extractfile("b.json")
        assert file is not None
        assert file.read() == b"[1]" * 200


@pytest.mark.usefixtures("quick")
def test_a_build_leaves_out_what_cannot_be_used_and_what_it_has_already(tmp_path: Path) -> None:
    manifest = built(tmp_path / "out", few(["chest"], 30), states=2, shard_size=10)
    counts = manifest.statistics
    # Of 0..29 the numbers 3, 10, 17 and 24 are ugly; 21 and 22 look like 20.
    assert counts.skipped == {"equal to an earlier object": 2, "too ugly": 4}
    assert (counts.objects, counts.records) == (24, 48)
    assert manifest.skipped[0] == ("generated-chest-0-00003", "too ugly: generated-chest-0-00003")
    kept = [n for n in range(30) if n % 7 != 3 and n not in (21, 22)]
    assert keys(tmp_path / "out") == [f"generated-chest-0-{n:05d}-{s}" for n in kept for s in range(2)]
    assert [shard.records for shard in manifest.shards] == [10, 10, 10, 10, 8]


@pytest.mark.usefixtures("quick")
def test_a_limit_counts_objects_that_were_written(tmp_path: Path) -> None:
    manifest = built(tmp_path / "out", few(["chest"], 100), limit=10, states=3, shard_size=6)
    assert (manifest.statistics.objects, len(keys(tmp_path / "out"))) == (10, 30)
    assert [shard.records for shard in manifest.shards] == [6] * 5


class KilledError(BaseException):
    """Stands for a kill: nothing that the build catches."""


def killing(after: int, real: Callable[..., Any]) -> Callable[..., Any]:
    """A function that does its work `after` times and then no more."""
    calls = iter(range(after))

    def work(*args: Any) -> Any:
        if next(calls, None) is None:
            raise KilledError
        return real(*args)

    return work


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("where", ["make", "saved", "write_whole", "SeenHashes.save", "ShardWriter.close"])
def test_a_killed_build_goes_on_to_the_same_bytes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, where: str
) -> None:
    jobs = few(["chest", "cabinet"], 15)
    built(tmp_path / "whole", jobs, shard_size=7)
    name, _, method = where.partition(".")
    for after in (0, 1, 2, 3, 5):
        owner = getattr(building, name) if method else building
        with monkeypatch.context() as patch:
            patch.setattr(owner, method or name, killing(after, getattr(owner, method or name)))
            try:
                built(tmp_path / "killed", jobs, shard_size=7)
            except KilledError:
                assert not (tmp_path / "killed" / MANIFEST).exists()
    # What a real kill leaves behind besides.
    unfinished = tmp_path / "killed" / FOLDER
    if unfinished.exists():
        (unfinished / "shard").write_bytes(b"half a shard")
        with (unfinished / "hashes").open("ab") as file:
            file.write(b"12345678")
    built(tmp_path / "killed", jobs, shard_size=7)
    assert files(tmp_path / "killed") == files(tmp_path / "whole")


@pytest.mark.usefixtures("quick")
def test_a_finished_data_set_is_left_as_it_is_and_other_options_are_refused(tmp_path: Path) -> None:
    out = tmp_path / "out"
    first = built(out, few(["chest"], 8))
    before = files(out)
    assert built(out, few(["chest"], 8)) == first
    assert files(out) == before
    for jobs, states, told in (
        (few(["chest"], 8), 3, "made with --states 2, not 3"),
        (few(["chest"], 9), 2, "made with -n 8, not 9"),
        (few(["chest", "desk"], 8), 2, "made with --generate chest, not chest, desk"),
        (few(["chest"], 8, seed=1), 2, "made with --seed 0, not 1"),
    ):
        with pytest.raises(BadInputError, match=told):
            built(out, jobs, states=states)
    assert files(out) == before
    (out / "shard-000000.tar").unlink()
    with pytest.raises(BadInputError, match=r"shard-000000\.tar is missing or was changed"):
        built(out, few(["chest"], 8))


@pytest.mark.usefixtures("quick")
def test_folders_of_others_and_missing_shards_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.jpg").write_bytes(b"")
    with pytest.raises(BadInputError, match=r"holds other things, such as cat\.jpg"):
        built(tmp_path / "photos", few(["chest"], 8))
    with pytest.raises(OutputError, match="cannot write to"):
        built(tmp_path / "photos" / "cat.jpg", few(["chest"], 8))
    out = tmp_path / "out"
    with monkeypatch.context() as patch:
        patch.setattr(building, "make", killing(9, building.make))
        with pytest.raises(KilledError):
            built(out, few(["chest"], 20), shard_size=4)
    (out / "shard-000000.tar").unlink()
    with pytest.raises(BadInputError, match=r"shard-000000\.tar is missing or was changed"):
        built(out, few(["chest"], 20), shard_size=4)


@pytest.mark.usefixtures("quick")
def test_a_full_disk_is_told_and_the_build_goes_on_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    jobs, out = few(["chest"], 20), tmp_path / "out"
    built(tmp_path / "whole", jobs, shard_size=4)

    def full(*args: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(ShardWriter, "close", full)
        with pytest.raises(OutputError, match="is full: make room and run the same command again"):
            built(out, jobs, shard_size=4)
    assert sorted(path.name for path in (out / FOLDER).iterdir()) == ["hashes", "progress.json"]
    built(out, jobs, shard_size=4)
    assert files(out) == files(tmp_path / "whole")


def test_nothing_usable_is_an_error_with_reasons_and_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match=r"none of 1 objects can be used: too many parts \(1\)"):
        built(tmp_path / "out", few(["cabinet"]), max_parts=1)
    assert list((tmp_path / "out").iterdir()) == []


def test_objects_of_folders_come_first_and_equal_ones_once(tmp_path: Path) -> None:
    for name in ("a", "b"):
        write_case(truth(cabinet("cabinet"), "cabinet"), tmp_path / "data" / name)
    write_case(truth(cabinet("cabinet"), "cabinet"), tmp_path / "more" / "a")
    jobs = find_jobs([tmp_path / "data", tmp_path / "more"], ["chest"], 1, seed=0)
    assert [job.key for job in jobs.starting(0)] == [
        "simart-bench-a",
        "simart-bench-b",
        "simart-bench-a_2",
        "generated-chest-0-00000",
    ]
    assert [job.key for job in jobs.starting(2)] == ["simart-bench-a_2", "generated-chest-0-00000"]
    manifest = built(tmp_path / "out", jobs, states=2)
    assert manifest.statistics.skipped == {"equal to an earlier object": 2}
    assert [folder.name for folder in manifest.options.data] == ["data", "more"]
    found = [record.key for record in read_records(tmp_path / "out")]
    assert found[:2] == ["simart-bench-a-00", "simart-bench-a-01"]
    assert len(found) == 4


def test_a_damaged_object_is_left_out_and_told(tmp_path: Path) -> None:
    for name in ("good", "bad"):
        write_case(truth(cabinet("cabinet")), tmp_path / "data" / name)
    (tmp_path / "data" / "bad" / "input.glb").write_bytes(b"junk")
    manifest = built(tmp_path / "out", find_jobs([tmp_path / "data"], [], 1, 0), states=1)
    assert manifest.statistics.skipped == {"cannot be read": 1}
    assert manifest.skipped[0][0] == "simart-bench-bad"
    assert "input.glb" in manifest.skipped[0][1]


def test_missing_folders_and_unknown_categories_are_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="no such folder"):
        find_jobs([tmp_path / "nowhere"], [], 1, 0)
    with pytest.raises(BadInputError, match="holds no object with ground truth"):
        find_jobs([tmp_path], [], 1, 0)
    with pytest.raises(BadInputError, match="unknown category 'dragon'"):
        find_jobs([], ["dragon"], 1, 0)


def test_hashes_are_kept_in_a_file_that_only_grows(tmp_path: Path) -> None:
    path = tmp_path / "hashes"
    seen = SeenHashes(path, 0)
    values = [5, 2**64 - 1, 0]
    assert [seen.add(value) for value in [*values, 5, 0]] == [True, True, True, False, False]
    seen.save()
    assert seen.add(9)
    again = SeenHashes(path, 3)
    assert [again.add(value) for value in [*values, 9]] == [False, False, False, True]
    again.save()
    assert path.stat().st_size == 4 * 8
    assert SeenHashes(path, 2).add(0)
    assert path.stat().st_size == 2 * 8
    with pytest.raises(BadInputError, match="is damaged"):
        SeenHashes(path, 3)


def test_many_hashes_are_all_found_again(tmp_path: Path) -> None:
    seen = SeenHashes(tmp_path / "hashes", 0)
    values = [(number * 0x9E3779B97F4A7C15) % 2**64 for number in range(70_000)]
    assert all(seen.add(value) for value in values)
    assert not any(seen.add(value) for value in values[::97])
