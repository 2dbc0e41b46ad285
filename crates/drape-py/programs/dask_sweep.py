# Runs a study on the workers of Dask: python FILE [SCHEDULER] [--store URL]. Without a scheduler the
# workers are processes of this machine. The results meet in the folder of the study, which all workers
# see, or in the folder or object store of a URL of fsspec, such as s3://bucket/study, from which the
# results are fetched at the end.
# Needs: pip install "dask[distributed]", and what fsspec needs for the store. What is done is not done
# again.
from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

import fsspec
from dask.distributed import Client, LocalCluster, as_completed


class Batch(NamedTuple):
    """Tasks of a study, each of which runs a part of the points."""

    command: list[str]
    """Command of a task, without the options that name the part."""
    folder: str
    """Folder in which the command is started."""
    output: str
    """Folder for the results."""
    tasks: int
    """Number of tasks."""


def drape(batch: Batch, task: int, *options: str) -> str:
    """Runs the command of a task and returns what it prints.

    A failure of the machine is an error, so that Dask tries the task again.
    """
    shard = ["--shard", f"{task}/{batch.tasks}", "--jobs", "1"]
    command = [*batch.command, *shard, *options]
    ended = subprocess.run(command, cwd=batch.folder, capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise RuntimeError(f"exit code {ended.returncode}: {ended.stderr[-2000:]}")
    return ended.stdout


def fetch(files: Any, source: str, target: Path) -> bool:
    """Copies `source` of the store `files` to `target`; returns whether `source` is there."""
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        target.write_bytes(files.cat_file(source))
    except FileNotFoundError:
        return False
    return True


def run(task: int, batch: Batch, store: str | None = None) -> int:
    """Runs a task; with a `store`, in a temporary folder whose results go to the store."""
    if store is None:
        drape(batch, task)
        return task
    files, root = fsspec.core.url_to_fs(store)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        results = ["--results", name]

        # Points that are done, so that the command leaves them out.
        for line in drape(batch, task, *results, "--list").splitlines():
            key = line.split("\t")[1]
            point = f"points/{key[:2]}/{key}"
            for file in (f"{point}.json", f"{point}/summary.json"):
                fetch(files, f"{root}/{file}", folder / file)
        before = set(folder.rglob("*"))
        drape(batch, task, *results)

        # Records come last: a point that has a record is whole.
        after = (path for path in folder.glob("points/**/*") if path.is_file())
        new = (path.relative_to(folder) for path in after if path not in before)
        for path in sorted(new, key=lambda path: len(path.parts), reverse=True):
            target = f"{root}/{path.as_posix()}"
            files.makedirs(target.rsplit("/", 1)[0], exist_ok=True)
            files.pipe_file(target, (folder / path).read_bytes())
    return task


def main(batch: Batch) -> None:
    """Runs all tasks of `batch` as the command line says, and ends the program."""
    parser = argparse.ArgumentParser()
    parser.add_argument("scheduler", nargs="?", help="address; a cluster on this machine if missing")
    parser.add_argument("--store", help="URL of fsspec where results meet")
    arguments = parser.parse_args()

    address = arguments.scheduler or LocalCluster(threads_per_worker=1)
    with Client(address) as client:
        tasks = range(1, batch.tasks + 1)
        shared = {"batch": batch, "store": arguments.store}
        futures = client.map(run, tasks, **shared, retries=3, pure=False)
        failed = 0
        for future in as_completed(futures):
            if future.status != "finished":
                failed += 1
                print(future.exception() or future.status, file=sys.stderr)
        print(f"{batch.tasks - failed} of {batch.tasks} tasks are done")

    if arguments.store:
        files, root = fsspec.core.url_to_fs(arguments.store)
        for path in files.find(f"{root}/points"):
            fetch(files, path, Path(batch.output) / path[len(root) + 1 :])
    sys.exit(6 if failed else 0)
