# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole Slurm cluster on this one machine: munge, slurmctld and slurmd as child processes."""

import os
import shutil
import signal
import socket
import subprocess
import time

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol", "sinfo")
# Daemons live where users' PATH does not lead.
PATH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"


def missing():
    """Why there can be no cluster here, or an empty text."""
    absent = [name for name in NEEDED if not shutil.which(name, path=PATH)]
    if absent:
        return "not installed: " + ", ".join(absent)
    if os.geteuid() != 0:
        return "slurmctld and slurmd of a test need root"
    return ""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class SmallSlurm:
    """With its daemons stopped at the end, whatever happens."""

    def __init__(self, folder, processors):
        self.folder, self.processors, self.daemons = folder, processors, []
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith(("SLURM_", "SBATCH_", "PMI", "OMPI_"))}
        self.environment.update(PATH=PATH, SLURM_CONF=self.path("slurm.conf"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def __enter__(self):
        try:
            self.configure()
            self.start("munged", "--foreground", "--force", "--num-threads=2",
                       *(f"--{word}={self.path('munge/' + file)}" for word, file in
                         (("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"),
                          ("log-file", "log"), ("seed-file", "seed"))))
            self.wait_for(lambda: os.path.exists(self.path("munge/socket")), "munged")
            self.start("slurmctld", "-D", "-f", self.path("slurm.conf"))
            self.start("slurmd", "-D", "-f", self.path("slurm.conf"))
            self.wait_for(lambda: "idle" in self.ask("sinfo", "--noheader", "--format=%t"), "an idle node")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if len(self.daemons) > 1:
            self.ask("scancel", "--user=root")
            self.wait_quietly(lambda: not self.ask("squeue", "--noheader"), 15)
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self.daemons = []

    def configure(self):
        for name in ("state", "spool", "munge"):
            os.makedirs(self.path(name))
        # munged insists on folders that others cannot write to, and can pass through.
        for name in (self.folder, self.path("munge")):
            os.chmod(name, 0o755)
        with open(self.path("munge/key"), "wb") as key:
            key.write(os.urandom(1024))
        os.chmod(self.path("munge/key"), 0o600)
        host = socket.gethostname().split(".")[0]
        # cred_expire: how long a requeued job waits before it starts again, 2 min by default.
        # config_overrides: as many processors as the test wants, whatever the machine has.
        with open(self.path("slurm.conf"), "w") as file:
            file.write(f"""ClusterName=sunload
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
AuthType=auth/munge
AuthInfo=socket={self.path("munge/socket")},cred_expire=5
SlurmUser=root
SlurmdUser=root
StateSaveLocation={self.path("state")}
SlurmdSpoolDir={self.path("spool")}
SlurmctldPidFile={self.path("slurmctld.pid")}
SlurmdPidFile={self.path("slurmd.pid")}
SlurmctldLogFile={self.path("slurmctld.log")}
SlurmdLogFile={self.path("slurmd.log")}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
KillWait=10
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs={self.processors} RealMemory=100000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")

    def start(self, *words):
        log = open(self.path(words[0] + ".out"), "w")
        self.daemons.append(subprocess.Popen(words, stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                                             env=self.environment, start_new_session=True))

    def ask(self, *words):
        """What a command of Slurm prints; empty where it fails."""
        ran = subprocess.run(words, env=self.environment, stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, text=True, timeout=60)
        return ran.stdout.strip() if ran.returncode == 0 else ""

    def state(self, job):
        """RUNNING, PENDING, COMPLETED, …; empty where the job is not known (any more)."""
        text = self.ask("scontrol", "show", "job", "--oneliner", job)
        return text.split("JobState=")[1].split()[0] if "JobState=" in text else ""

    def wait_for(self, happened, what, seconds=60):
        if not self.wait_quietly(happened, seconds):
            raise TimeoutError(f"{what} did not come within {seconds} s\n" + self.logs())

    @staticmethod
    def wait_quietly(happened, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if happened():
                return True
            time.sleep(0.1)
        return False

    def logs(self):
        text = ""
        for name in ("munged.out", "slurmctld.out", "slurmd.out", "slurmctld.log", "slurmd.log"):
            if os.path.exists(self.path(name)):
                with open(self.path(name), errors="replace") as file:
                    text += f"--- {name}\n" + "".join(file.readlines()[-15:])
        return text
