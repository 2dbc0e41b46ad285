"""Slurm: a controller and two daemons on this machine, as root, with the packages `slurm-wlm` and
`munge` of Debian."""

import os
import shutil
import socket
import subprocess
import time

CONFIGURATION = """ClusterName=test
SlurmctldHost={host}
SlurmUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=10
KillWait=5
SlurmctldPort=16817
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmdLogFile={folder}/slurmd-%n.log
SlurmdSpoolDir={folder}/spool-%n
StateSaveLocation={folder}/state
MaxArraySize=1001
MaxJobCount={most}
NodeName=node1 NodeHostname={host} NodeAddr=127.0.0.1 Port=16821 CPUs=1 RealMemory=1000
NodeName=node2 NodeHostname={host} NodeAddr=127.0.0.1 Port=16822 CPUs=1 RealMemory=1000
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Slurm:
    """Controller with two daemons, and the exported array of jobs."""

    def __init__(self, study, chunk):
        self.study, self.file = study, study.export("slurm", chunk)
        # Below /tmp, since names of sockets are short.
        self.folder = study.folder / "slurm"
        (self.folder / "state").mkdir(parents=True)
        for node in ["node1", "node2"]:
            (self.folder / f"spool-{node}").mkdir()
        text = CONFIGURATION.format(host=socket.gethostname(), folder=self.folder, most=2000)
        (self.folder / "slurm.conf").write_text(text)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.processes, self.job = {}, None
        self._munge()

    def _munge(self):
        """Begins the daemon that signs messages, unless it is there."""
        if shutil.which("munge") and subprocess.run(["munge", "-n"], capture_output=True).returncode == 0:
            return
        os.makedirs("/run/munge", exist_ok=True)
        shutil.chown("/run/munge", "munge", "munge")
        subprocess.run(["runuser", "-u", "munge", "--", "munged"], check=True)

    def _begin(self, name, *command):
        log = open(self.folder / f"{name}.out", "a")
        self.processes[name] = subprocess.Popen(
            command, env=self.environment, stdout=log, stderr=log, start_new_session=True
        )

    def _node(self, node):
        self._begin(node, "slurmd", "-D", "-N", node)

    def _ask(self, *command):
        ended = subprocess.run(command, env=self.environment, capture_output=True, text=True, cwd=self.study.folder)
        return ended.stdout.strip() if ended.returncode == 0 else None

    def start(self):
        """Begins the daemons, and submits the array unless it is in the queue already."""
        self._begin("controller", "slurmctld", "-D")
        self._node("node1")
        self._node("node2")
        deadline = time.monotonic() + 60
        while self.job is None:
            assert time.monotonic() < deadline, "no job was taken after a minute"
            taken = self._ask("sbatch", "--parsable", "--output=%x-%a.log", str(self.file))
            self.job = taken and taken.split(";")[0]
            time.sleep(0.5)

    def kill_worker(self):
        """Kills a daemon and all that it has started, as when its machine fails; it begins again."""
        session = str(os.getsid(self.processes["node1"].pid))
        self.processes["node1"].kill()
        self.processes["node1"].wait()
        subprocess.run(["pkill", "-KILL", "-s", session])
        # Its steps have sessions of their own.
        subprocess.run(["pkill", "-KILL", "slurmstepd"])
        self._node("node1")

    def kill(self):
        """Kills the controller and the daemons."""
        for process in self.processes.values():
            process.kill()
            process.wait()
        self.processes.clear()

    def finish(self):
        """Waits until the array has left the queue."""
        deadline = time.monotonic() + 1800
        while (left := self._ask("squeue", "-h", "-j", self.job)) is None or left:
            assert time.monotonic() < deadline, left
            time.sleep(0.5)
        self.kill()
