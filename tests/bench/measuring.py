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
from swarm import FINISHED, diffusion, diffusion_of_argos3  # noqa: E402


def load_scenes():
    loader = SourceFileLoader("scenes", str(HERE / "scenes"))
    module = module_from_spec(spec_from_loader("scenes", loader))
    loader.exec_module(module)
    return module.SCENES


class Bench:
    """Makes the experiments, and runs them."""

    def __init__(self, folder):
        self.folder = folder
        self.runs = 0
        self.scenes = {scene.name: scene for scene in load_scenes()}

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

    def finish(self, words):
        """Ticks a second."""
        with open(self.folder / "said", "w+", encoding="utf-8") as said:
            process = subprocess.Popen([*words, "--quiet"], stdout=said, stderr=subprocess.STDOUT,
                                       env=os.environ | {"SWARMANOID_SHARED_FOLDER": str(self.folder)})
            try:
                _, status, usage = os.wait4(process.pid, 0)
            except BaseException:  # interrupted: nothing stays behind
                process.send_signal(signal.SIGINT)
                process.wait()
                raise
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            text = said.read()
        shutil.rmtree(self.folder / f"run_{self.runs}", ignore_errors=True)
        finished = FINISHED.search(text)
        if process.returncode != 0 or not finished:
            sys.exit(f"{' '.join(words)} failed:\n{text}")
        self.memory = usage.ru_maxrss * 1024 / 1e6
        return int(finished.group(1)) / float(finished.group(4))

    def single(self, file, ticks, *options):
        return lambda build: self.finish(self.words(build, file(build), ticks, "--single-process", *options))

    def single_memory(self, file, ticks):
        def measure(build):
            self.finish(self.words(build, file(build), ticks, "--single-process", "--threads", 1))
            return self.memory
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

    def start(self, build):
        """From the start of the command until it says, on standard error, that the experiment is running."""
        started = time.monotonic()
        process = subprocess.Popen(self.words(build, self.swarm(10), 2000), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
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

    def argos3(self, examples, robots, ticks):
        """ARGoS3's ticks a second: what a run of several ticks takes more than one of a single tick, since starts are long."""
        def measure(build):
            seconds = []
            for length in (1, ticks + 1):
                path = self.folder / f"argos3_{robots}.argos"
                path.write_text(diffusion_of_argos3(robots, length, examples))
                started = time.monotonic()
                run = subprocess.run(["argos3", "-n", "-z", "-c", path], capture_output=True, text=True)
                seconds.append(time.monotonic() - started)
                if run.returncode != 0:
                    sys.exit(f"argos3 failed:\n{run.stdout}{run.stderr}")
            if seconds[1] <= seconds[0]:
                sys.exit(f"argos3: {ticks} ticks of {robots} robots took no longer than one")
            return ticks / (seconds[1] - seconds[0])
        return measure
