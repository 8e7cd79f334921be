"""Slurm on this machine, for tests: a real slurmctld, slurmd and munged with a configuration, a key, ports and folders of their own."""
import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

from harness import GENEROUS_S, end, skip, words_of
from world.case import free_ports, temporary_folder

DAEMONS = {name: shutil.which(name, path="/usr/sbin:" + os.environ["PATH"]) for name in ("munged", "slurmctld", "slurmd")}
NODE = socket.gethostname().split(".")[0]


class Slurm:
    """One node of four processors, without a database of accounts."""

    def __init__(self, folder):
        self.folder = folder
        for name in ("state", "spool"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        control, node = free_ports(2)
        user = getpass.getuser()
        (folder / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={NODE}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={control}
SlurmdPort={node}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
MinJobAge=300
NodeName={NODE} NodeAddr=127.0.0.1 CPUs=4
PartitionName=short Nodes={NODE} Default=YES MaxTime=60 State=UP
""")
        self.environment = {"SLURM_CONF": str(folder / "slurm.conf")}
        self.processes = {}
        self.start("munged", "-F", f"--key-file={key}", f"--socket={folder}/munge.socket", f"--log-file={folder}/munged.log",
                   f"--pid-file={folder}/munged.pid", f"--seed-file={folder}/munged.seed")
        self.wait("munge", lambda: (folder / "munge.socket").exists())
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        self.wait("the node", lambda: "idle" in self.ask("sinfo", "--noheader", "--format=%T"))

    def start(self, name, *options):
        with (self.folder / f"{name}.out").open("w") as log:
            self.processes[name] = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", DAEMONS[name], *options], stdin=subprocess.DEVNULL, stdout=log,
                                                    stderr=subprocess.STDOUT, start_new_session=True, env={**os.environ, **self.environment})

    def wait(self, what, condition):
        deadline = time.monotonic() + GENEROUS_S
        while not condition():
            for name, process in self.processes.items():
                if process.poll() is not None:
                    raise AssertionError(f"{name}: " + (self.folder / f"{name}.out").read_text())
            assert time.monotonic() < deadline, f"in vain for {what}"
            time.sleep(0.1)

    def ask(self, *words):
        return subprocess.run(words, capture_output=True, text=True, env={**os.environ, **self.environment}).stdout

    def hold(self):
        """What runs goes on; nothing else begins."""
        self.ask("scontrol", "update", f"NodeName={NODE}", "State=DRAIN", "Reason=test")

    def release(self):
        self.ask("scontrol", "update", f"NodeName={NODE}", "State=RESUME")

    def live(self):
        return self.ask("squeue", "--noheader", "--array", "--format=%i").split()

    def workers(self):
        """Processes of Slurm's that run a study."""
        return [int(pid) for pid in os.listdir("/proc") if pid.isdigit() and "--study-worker" in words_of(pid) and
                str(self.folder.parent) in " ".join(words_of(pid))]

    def stop(self):
        self.ask("scancel", "--user", getpass.getuser(), "--signal=KILL")
        for name in ("slurmd", "slurmctld", "munged"):
            if name in self.processes:
                end(self.processes[name])
        # slurmd's steps are not its children.
        for pid in os.listdir("/proc"):
            if pid.isdigit() and words_of(pid)[:1] and words_of(pid)[0].startswith("slurmstepd") and self.is_mine(pid):
                os.kill(int(pid), signal.SIGKILL)

    def is_mine(self, pid):
        try:
            return str(self.folder).encode() in pathlib.Path(f"/proc/{pid}/environ").read_bytes()
        except OSError:
            return False


def require():
    """Leaves the test if there is no Slurm."""
    missing = [name for name, path in DAEMONS.items() if path is None]
    if missing or shutil.which("sbatch") is None:
        skip(f"there is no {', '.join(missing) or 'sbatch'} (packages slurmctld, slurmd, slurm-client and munge)")


def running_for(case):
    """A folder for a class of tests, and Slurm, which runs in it until they end."""
    top = temporary_folder(case, "slurm")
    # Others reach the socket of munge.
    top.chmod(0o755)
    (top / "slurm").mkdir()
    running = Slurm(top / "slurm")
    case.addClassCleanup(running.stop)
    return top, running
