"""Dask: a scheduler and two workers, each a process that can be killed."""

import os
import signal
import socket
import subprocess
import sys
import time


def free_port():
    """Returns a port that nobody listens to."""
    with socket.socket() as own:
        own.bind(("127.0.0.1", 0))
        return own.getsockname()[1]


class Dask:
    """Scheduler with two workers, and the exported program that uses them."""

    options = []

    def __init__(self, study, chunk):
        self.study, self.file = study, study.export("dask", chunk)
        self.processes, self.client = {}, None

    def _begin(self, name, *command):
        log = open(self.study.folder / f"{name}.log", "a")
        self.processes[name] = subprocess.Popen(
            [sys.executable, "-m", *command], stdout=log, stderr=log, cwd=self.study.folder
        )

    def worker(self, name):
        """Begins a worker."""
        self._begin(name, "distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-nanny")

    def start(self):
        """Begins the scheduler, the workers and the program."""
        port = free_port()
        self.address = f"tcp://127.0.0.1:{port}"
        self._begin("scheduler", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        self.worker("worker-1")
        self.worker("worker-2")
        self.client = subprocess.Popen([sys.executable, self.file, self.address, *self.options], cwd=self.study.folder)

    def kill_worker(self):
        """Kills a worker; another one takes its place."""
        self.processes["worker-1"].send_signal(signal.SIGKILL)
        self.processes["worker-1"].wait()
        self.worker("worker-3")

    def kill(self):
        """Kills the scheduler, the workers and the program."""
        for process in [*self.processes.values(), self.client]:
            process.kill()
            process.wait()
        self.processes.clear()

    def finish(self):
        """Waits for the end of the program."""
        assert self.client.wait(timeout=1800) == 0
        self.kill()


class DaskStore(Dask):
    """Dask whose results meet in an object store: a server of S3 on this machine."""

    options = ["--store", "s3://drapes/study"]

    def __init__(self, study, chunk):
        super().__init__(study, chunk)
        port = str(free_port())
        keys = {"AWS_ACCESS_KEY_ID": "test", "AWS_SECRET_ACCESS_KEY": "test", "AWS_DEFAULT_REGION": "us-east-1"}
        os.environ.update(keys, AWS_ENDPOINT_URL=f"http://127.0.0.1:{port}")
        log = open(study.folder / "store.log", "a")
        command = [sys.executable, "-m", "moto.server", "--port", port]
        self.store = subprocess.Popen(command, stdout=log, stderr=log)
        self.files = self._bucket()
        study.records = self.records

    def _bucket(self):
        """Returns the file system of the store, with a bucket."""
        import s3fs

        deadline = time.monotonic() + 60
        while True:
            files = s3fs.S3FileSystem(use_listings_cache=False)
            try:
                files.mkdir("drapes")
                return files
            except OSError:
                assert time.monotonic() < deadline, "the store does not answer"
                time.sleep(0.2)

    def records(self):
        """Counts the points that have a record in the store."""
        return len(self.files.glob("drapes/study/points/*/*.json"))

    def finish(self):
        """Waits for the end of the program, which fetches what is in the store."""
        super().finish()
        self.store.kill()
        self.store.wait()
