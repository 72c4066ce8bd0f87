"""A process a job: what ends one of them, and that nothing is left of those that are given up."""

import os
import resource
import subprocess
import sys
import textwrap
import time
from collections import deque
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from simart_kit.bench.pool import run_each

JOBS = """
import os, signal, subprocess, sys, time
from pathlib import Path

def work(job):
    if job == "exit":
        os._exit(3)
    if job == "segfault":
        os.kill(os.getpid(), signal.SIGSEGV)
    if job == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if job == "raise":
        raise RuntimeError("out of ideas")
    if job == "hang":
        while True:
            pass
    if job == "print":
        print("from python", flush=True)
        os.write(1, b"from native code\\n")

def fill(job):
    list(range(2_000_000))

def tell_threads(folder, job):
    (folder / job).write_text(os.environ.get("OMP_NUM_THREADS", "-"))

def tell_and_sleep(folder, job):
    helper = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    (folder / f"{job}.pids").write_text(f"{os.getpid()} {helper.pid}")
    time.sleep(60)
"""


@pytest.fixture(scope="module")
def jobs(tmp_path_factory):
    """A module that children can import, as they can those of a package."""
    home = tmp_path_factory.mktemp("jobs")
    (home / "bench_pool_jobs.py").write_text(JOBS)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(home)
        import bench_pool_jobs

        yield bench_pool_jobs


@pytest.fixture
def log(tmp_path) -> Callable[[str], Path]:
    return lambda job: tmp_path / f"{job}.log"


def test_every_way_to_end_is_told_and_ends_no_other_job(jobs, log):
    names = ["one", "exit", "segfault", "kill", "raise", "two"]

    ended = dict(run_each(jobs.work, deque(names), log=log))

    assert ended == {
        "one": "",
        "exit": "ended with exit status 3",
        "segfault": "crashed (signal 11)",
        "kill": "crashed (signal 9: killed, perhaps for want of memory)",
        "raise": "ended with exit status 1",
        "two": "",
    }
    assert "RuntimeError: out of ideas" in log("raise").read_text()
    assert "Segmentation fault" in log("segfault").read_text()


def test_a_job_that_hangs_is_given_up_while_others_go_on(jobs, log):
    ended = list(run_each(jobs.work, deque(["hang", "one", "two"]), log=log, workers=2, timeout=1.0))

    assert ended == [("one", ""), ("two", ""), ("hang", "took longer than 1 s")]


def test_jobs_may_be_added_while_the_queue_is_worked_off(jobs, log):
    queue, seen = deque(["exit"]), []

    for job, reason in run_each(jobs.work, queue, log=log):
        seen.append(job)
        if reason:
            queue.append("another")

    assert seen == ["exit", "another"]


def test_what_a_child_prints_is_in_its_log_and_nowhere_else(jobs, log, capfd):
    list(run_each(jobs.work, deque(["print"]), log=log))

    assert log("print").read_text() == "from python\nfrom native code\n"
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("workers", "threads"), [(1, None), (2, "1")])
def test_children_beside_each_other_compute_in_one_thread(jobs, log, tmp_path, monkeypatch, workers, threads):
    before = os.environ.get("OMP_NUM_THREADS", "-")  # which children get that have nobody beside them
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)

    list(run_each(partial(jobs.tell_threads, tmp_path), deque(["a", "b"]), log=log, workers=workers))

    assert [(tmp_path / job).read_text() for job in "ab"] == [threads or before] * 2
    assert "OPENBLAS_NUM_THREADS" not in os.environ


@pytest.mark.slow
def test_the_memory_of_the_parent_does_not_grow_with_the_jobs(jobs, log):
    list(run_each(jobs.fill, deque(["first"]), log=log))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    list(run_each(jobs.fill, deque(map(str, range(30))), log=log, workers=2))

    # Kilobytes. A list of 2 million numbers takes 70 MB where it is made.
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 20_000


def test_leaving_the_loop_ends_children_and_what_they_started(jobs, log, tmp_path):
    work = partial(jobs.tell_and_sleep, tmp_path)
    children = run_each(work, deque(["short", "long"]), log=log, workers=2, timeout=1.0)

    next(children)
    children.close()

    pids = [int(pid) for job in ("short", "long") for pid in (tmp_path / f"{job}.pids").read_text().split()]
    assert len(pids) == 4
    wait_until_gone(*pids)


@pytest.mark.slow
def test_children_and_what_they_started_end_with_a_parent_that_is_killed(jobs, tmp_path):
    script = f"""
        import sys
        sys.path.insert(0, {str(Path(jobs.__file__).parent)!r})
        from collections import deque
        from functools import partial
        from pathlib import Path
        import bench_pool_jobs
        from simart_kit.bench.pool import run_each

        if __name__ == "__main__":
            folder = Path({str(tmp_path)!r})
            work = partial(bench_pool_jobs.tell_and_sleep, folder)
            list(run_each(work, deque(["one"]), log=lambda job: folder / "log"))
    """
    (tmp_path / "script.py").write_text(textwrap.dedent(script))
    parent = subprocess.Popen([sys.executable, tmp_path / "script.py"])
    told = tmp_path / "one.pids"
    while not (told.exists() and told.read_text()):
        assert parent.poll() is None
        time.sleep(0.02)
    child, helper = map(int, told.read_text().split())
    assert alive(child)

    parent.kill()
    parent.wait()

    wait_until_gone(child, helper)


def wait_until_gone(*pids: int) -> None:
    deadline = time.monotonic() + 10
    while any(alive(pid) for pid in pids):
        assert time.monotonic() < deadline
        time.sleep(0.02)


def alive(pid: int) -> bool:
    """Whether a process runs; one that nobody has waited for yet does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False
