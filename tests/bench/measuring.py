"""Makes the experiments of tests/bench/run, and runs them."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "cluster")]
import two_machines  # noqa: E402
from swarm import FINISHED, diffusion  # noqa: E402


def load_script(name):
    """The module of a script of this folder."""
    loader = SourceFileLoader(name, str(HERE / name))
    module = module_from_spec(spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


def memory_of_tree(root):
    """MB of a process and all that it started: pages that some share count once."""
    parents, tree = {}, {root}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parents[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except OSError:  # it has ended
            pass
    while more := {process for process, parent in parents.items() if parent in tree} - tree:
        tree |= more
    kilobytes = 0
    for process in tree:
        try:
            kilobytes += int(re.search(r"^Pss: +(\d+)", pathlib.Path(f"/proc/{process}/smaps_rollup").read_text(), re.MULTILINE)[1])
        except OSError:
            pass
    return kilobytes * 1024 / 1e6


class Bench:
    """Makes the experiments, and runs them."""

    def __init__(self, folder):
        self.folder = folder
        self.runs = 0
        self.checkpoints = {}
        self.scenes = {scene.name: scene for scene in load_script("scenes").SCENES}

    def file(self, name, text):
        """Writes the file again for each run, because builds load libraries of their own."""
        path = self.folder / (re.sub(r"[^a-z0-9]+", "_", f"bench_{os.getpid()}_{name.lower()}") + ".xml")
        path.write_text(text, encoding="utf-8")
        return path

    def swarm(self, robots, engine="dummy_engine"):
        text = diffusion(robots)
        if engine == "dynamics3d":
            text = re.sub(r"<dummy_engine id=\"(\w+)\">.*</dummy_engine>", r'<dynamics3d id="\1"/>', text, flags=re.DOTALL)
        text = text.replace("<dummy_engine ", f"<{engine} ").replace("</dummy_engine>", f"</{engine}>")
        return self.file(f"{engine}_{robots}", text)

    def scene(self, build, name):
        return self.file(name, self.scenes[name].xml(build / "tests" / "bench" / "controllers"))

    def words(self, build, file, ticks, *options):
        self.runs += 1
        return [str(word) for word in (build / "bin" / "swarmanoid", "run", file, "--ticks", ticks, "--no-visualisers",
                                       "--output", self.folder / f"run_{self.runs}", *options)]

    def finish(self, words, since=0, keep=False, last_line=False):
        """Ticks a second from tick `since` on. `keep`: the folder of the run stays. `last_line`: instead, what the command says last."""
        with open(self.folder / "said", "w+", encoding="utf-8") as said:
            process = subprocess.Popen([*words, "--quiet"], stdout=said, stderr=subprocess.STDOUT,
                                       env=os.environ | {"SWARMANOID_SHARED_FOLDER": str(self.folder)})
            try:
                process.wait()
            except BaseException:  # interrupted: nothing stays behind
                process.send_signal(signal.SIGINT)
                process.wait()
                raise
            said.seek(0)
            text = said.read()
        if not keep:
            shutil.rmtree(self.folder / f"run_{self.runs}", ignore_errors=True)
        finished = FINISHED.search(text)
        if process.returncode != 0 or not finished:
            sys.exit(f"{' '.join(words)} failed:\n{text}")
        if last_line:
            return text.splitlines()[-1]
        # Shorter times than the last digit are no time.
        return (int(finished.group(1)) - since) / max(float(finished.group(4)), 1e-6)

    def single(self, file, ticks, *options):
        return lambda build: self.finish(self.words(build, file(build), ticks, "--single-process", *options))

    def single_memory(self, file, ticks):
        """MB. A small program starts the run, because Linux counts also what the starting one had in memory."""
        starter = """import os, sys
_, status, usage = os.wait4(os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ), 0)
print(usage.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))"""

        def measure(build):
            words = self.words(build, file(build), ticks, "--single-process", "--threads", 1)
            return float(self.finish([sys.executable, "-S", "-E", "-c", starter, *words], last_line=True)) * 1024 / 1e6
        return measure

    def cluster_memory(self, file, ticks):
        """MB of all processes at the time when they take most."""
        def measure(build):
            before, most, ended = memory_of_tree(os.getpid()), 0, threading.Event()

            def watch():
                nonlocal most
                while not ended.wait(0.1):
                    most = max(most, memory_of_tree(os.getpid()) - before)
            watcher = threading.Thread(target=watch)
            watcher.start()
            try:
                self.finish(self.words(build, file(build), ticks))
            finally:
                ended.set()
                watcher.join()
            return most
        return measure

    def cluster(self, file, ticks, *options):
        return lambda build: self.finish(self.words(build, file(build), ticks, *options))

    def over_network(self, robots, ticks, loss, delay_ms=0, ahead=0, remote="engine"):
        """Space server and the other role on one machine, `remote` on the other one."""
        def measure(build):
            machines = two_machines.TwoMachines(str(build))
            try:
                hosts = self.folder / "hosts.txt"
                near, far = machines.names
                text = machines.hosts()
                hosts.write_text(text if remote == "engine" else
                                 text.replace(f"engine = {far}", f"engine = {near}").replace(f"{remote} = {near}", f"{remote} = {far}"))
                machines.connect(loss, delay_ms)
                rate = self.finish(self.words(build, self.swarm(robots), ticks, "--hosts", hosts, "--ahead", ahead))
                machines.disconnect()
                return rate
            finally:
                machines.remove()
        return measure

    def one_tick(self):
        """Seconds of a whole command."""
        def measure(build):
            words = self.words(build, self.swarm(10), 1, "--single-process")
            started = time.monotonic()
            self.finish(words)
            return time.monotonic() - started
        return measure

    def aged(self, file, name, age, ticks):
        """Ticks a second from a checkpoint of tick `age` on, which is made once for each build."""
        def measure(build):
            if (name, build) not in self.checkpoints:
                words = self.words(build, file(build), age, "--single-process", "--checkpoint-every", age)
                made = self.folder / f"run_{self.runs}"
                self.finish(words, keep=True)
                self.checkpoints[name, build] = made / "experiment.xml", made / f"checkpoint-{age:08}"
            experiment, checkpoint = self.checkpoints[name, build]
            return self.finish(self.words(build, experiment, age + ticks, "--single-process", "--threads", 1, "--restore", checkpoint), since=age)
        return measure

    def instructions(self, name):
        """Of a robot in a tick (callgrind)."""
        def measure(build):
            counts = []
            for ticks in (4, 12):
                words = self.words(build, self.scene(build, name), ticks, "--single-process", "--quiet", "--threads", 1)
                valgrind = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={self.folder}/callgrind.out"]
                done = subprocess.run([*valgrind, *words], capture_output=True, text=True, check=True,
                                      env=os.environ | {"SWARMANOID_SHARED_FOLDER": str(self.folder)})
                counts.append(int(re.search(r"Collected : (\d+)", done.stderr).group(1)))
            return (counts[1] - counts[0]) / 8 / self.scenes[name].robots
        return measure

    def start(self, build, hosts=1, robots=10):
        """From the start of the command until it says, on standard error, that the experiment is running."""
        started = time.monotonic()
        process = subprocess.Popen(self.words(build, self.swarm(robots), 100 if hosts > 1 else 2000, "--controller-hosts", hosts), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        running = next((time.monotonic() - started for line in process.stderr if "running" in line), None)
        process.stderr.read()
        if process.wait() != 0 or running is None:
            sys.exit("a cluster of 10 robots did not run")
        return running

    def attach(self, build):
        """From the start of `swarmanoid attach text` until its first line of an entity, while the experiment is paused."""
        file = self.swarm(10)
        run = subprocess.Popen(self.words(build, file, 0, "--paused"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            next(line for line in run.stderr if "paused" in line)
            threading.Thread(target=run.stderr.read, daemon=True).start()
            started = time.monotonic()
            watcher = subprocess.Popen([build / "bin" / "swarmanoid", "attach", "text", file.stem], stdout=subprocess.PIPE,
                                       stderr=subprocess.DEVNULL, text=True)
            shown = any(not line.startswith("#") for line in iter(watcher.stdout.readline, ""))
            seconds = time.monotonic() - started
            watcher.send_signal(signal.SIGINT)
            watcher.stdout.read()
            watcher.wait()
            if not shown:
                sys.exit("swarmanoid attach text showed nothing")
            return seconds
        finally:
            run.send_signal(signal.SIGINT)
            run.wait()
