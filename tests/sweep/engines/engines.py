"""Runs a study on an engine, kills one of its workers at a third of the points and the engine at two
thirds, and holds the table against that of a serial run.

    python engines.py dask|hyperqueue|slurm [--points N] [--chunk N] [--drape PROGRAM]
"""

import argparse
import pathlib
import sys
import tempfile
import time

from dask_engine import Dask
from hyperqueue_engine import HyperQueue
from slurm_engine import Slurm
from study import ROOT, Study

ENGINES = {"dask": Dask, "hyperqueue": HyperQueue, "slurm": Slurm}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("engine", choices=ENGINES)
    parser.add_argument("--points", type=int, default=60)
    parser.add_argument("--chunk", type=int, default=5)
    parser.add_argument("--drape", type=pathlib.Path, default=ROOT / "target/release/drape")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="drape-", ignore_cleanup_errors=True) as folder:
        study = Study(folder, arguments.points, arguments.drape.resolve())
        engine = ENGINES[arguments.engine](study, arguments.chunk)
        begin = time.monotonic()
        engine.start()
        try:
            if engine.kill_worker:
                study.wait_for(1 / 3)
                engine.kill_worker()
            study.wait_for(2 / 3)
            engine.kill()
            at_kill = study.records()
            engine.start()
            engine.finish()
        finally:
            engine.kill()
        wall = time.monotonic() - begin
        serial = study.verify()
    print(
        f"{arguments.engine}: {arguments.points} points, each once, {at_kill} done when the engine was killed; "
        f"{wall:.1f} s with two workers, {serial:.1f} s one by one"
    )


if __name__ == "__main__":
    sys.exit(main())
