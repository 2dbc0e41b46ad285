"""Study of short runs for the tests of engines, and the table that it must have."""

import csv
import pathlib
import shutil
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]

# Columns that hold times and what differs with them.
TIMES = {"seconds", "wall_seconds", "cpu_seconds", "threads", "retries"}


class Study:
    """Study of so many points, one of which is refused by the check, in a folder of its own."""

    def __init__(self, folder, points, drape):
        self.folder, self.points, self.drape = pathlib.Path(folder), points, str(drape)
        shutil.copy(ROOT / "tests/fabrics/plain-weave.toml", self.folder / "plain.toml")
        shutil.copy(ROOT / "tests/sweep/drape.toml", self.folder / "scene.toml")
        lengths = [round(80 + 120 * k / points, 3) for k in range(points - 1)] + [-100]
        for name in ["serial", "study"]:
            (self.folder / f"{name}.toml").write_text(
                f'scene = "scene.toml"\noutput = "{name}"\nkeep = "measures"\n'
                f'[[axis]]\nname = "length"\nkey = "panel.0.rectangle.1"\nvalues = {lengths}\n'
            )

    def sweep(self, *arguments):
        """Runs `drape sweep` in the folder; returns what it prints."""
        command = [self.drape, "sweep", *arguments]
        ended = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        assert ended.returncode == 0, (arguments, ended.returncode, ended.stdout, ended.stderr)
        return ended.stdout

    def export(self, engine, chunk):
        """Writes the file for an engine; returns its path."""
        path = self.folder / f"tasks-{engine}"
        self.sweep("export", "study.toml", f"--{engine}", "--chunk", str(chunk), "-o", str(path))
        return path

    def records(self):
        """Counts the points that have a record."""
        return sum(1 for _ in (self.folder / "study" / "points").glob("*/*.json"))

    def wait_for(self, part, limit=600):
        """Waits until a part of the points has records."""
        deadline = time.monotonic() + limit
        while self.records() < part * self.points:
            assert time.monotonic() < deadline, f"{self.records()} points after {limit} s"
            time.sleep(0.05)

    def table(self, name):
        """Collects the table of a study; returns its rows without times."""
        self.sweep("collect", f"{name}.toml")
        with open(self.folder / name / "table.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return [{key: text for key, text in row.items() if key not in TIMES} for row in rows]

    def verify(self):
        """Holds the table of the study against that of a serial run: every point there once."""
        found = self.table("study")
        assert len(found) == self.points, len(found)
        assert len({row["key"] for row in found}) == self.points
        begin = time.monotonic()
        self.sweep("run", "serial.toml", "--jobs", "1")
        serial = time.monotonic() - begin
        assert found == self.table("serial")
        failed = [row for row in found if row["outcome"] != "ok"]
        assert len(failed) == 1 and failed[0]["length"] == "-100", failed
        return serial

    def seconds(self, name="study"):
        """Returns the time of all runs in the table of a study, in s."""
        with open(self.folder / name / "table.csv", newline="") as file:
            return sum(float(row["seconds"]) for row in csv.DictReader(file))
