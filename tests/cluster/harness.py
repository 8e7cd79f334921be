"""What tests of the command share: starting it in a folder of its own, finding its processes, and looking for leftovers."""
import contextlib
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import sys
import time
import unittest

from world.case import controller, experiment, shared_folder, temporary_folder

SWARMANOID = os.environ["SWARMANOID"]
CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
DIFFUSION = CONFIGS / "diffusion_10.xml"
TEST_CONTROLLERS = os.environ["TEST_CONTROLLERS"]
FINISHED = re.compile(r"^finished: (\d+) ticks, (\d+) entities, hash ([0-9a-f]{16}), [0-9.]+ s, [0-9.]+x real time$")
# For what comes within moments, on a machine that is busy with much else.
GENEROUS_S = 100
# A run prints the first when one of its processes has died, and the second when its space server has.
REPLACED = "another process takes its place"
AGAIN = "all processes start again where the journal ends"


def stat_of(pid):
    """Parent, group and state of a process, or None if there is none."""
    try:
        text = pathlib.Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return None
    state, parent, group = text[text.rindex(")") + 2:].split()[:3]
    return int(parent), int(group), state


def children_of(pid):
    """Of a launcher these are the processes of its cluster."""
    return [int(entry) for entry in os.listdir("/proc") if entry.isdigit() and (stat_of(entry) or (0,))[0] == pid]


def words_of(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")[:-1]
    except OSError:
        return []


def end(process):
    """Kills a process, if it still runs, with all that it started."""
    if process.poll() is None:
        started = children_of(process.pid)
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if os.getpgid(process.pid) == process.pid:
                os.killpg(process.pid, signal.SIGKILL)
        process.kill()
        for pid in started:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
    process.communicate(timeout=GENEROUS_S)


class Run:
    """One `swarmanoid run`, in the folder of the test."""

    def __init__(self, folder, arguments, environment=None, before=()):
        self.folder = folder
        self.process = subprocess.Popen([*before, SWARMANOID, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, env={**os.environ, **(environment or {})}, start_new_session=True)
        self.pids = {}

    def find(self, program, *words, lacks=None, dead=(), timeout=GENEROUS_S):
        """The process id of a program of the run, as soon as it is there. Its command line has these words, and lacks that one."""
        wanted = " ".join(map(str, words))
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            for pid in children_of(self.process.pid):
                found = words_of(pid)
                if found and os.path.basename(found[0]) == program and wanted in " ".join(found) and lacks not in found and pid not in dead:
                    self.pids[program] = pid
                    return pid
            if self.process.poll() is not None:
                raise AssertionError(f"the run ended before {program} was there: {self.process.stderr.read()}")
            time.sleep(0.002)
        raise AssertionError(f"no {program} after {timeout} s")

    def read_until(self, text):
        """What the run says on its way to this text; it is not among what wait() keeps."""
        said = ""
        while text not in said:
            line = self.process.stderr.readline()
            if not line:
                raise AssertionError(f"the run ended without '{text}': {said}")
            said += line
        return said

    def newest_words(self):
        """Returns the unread text of the run's stderr. Later reads of stderr return nothing of it."""
        said = b""
        while select.select([self.process.stderr], [], [], 0)[0]:
            some = os.read(self.process.stderr.fileno(), 1 << 16)
            if not some:
                break
            said += some
        return said.decode(errors="replace")

    def wait(self, timeout=GENEROUS_S):
        self.stdout, self.stderr = self.process.communicate(timeout=timeout)
        return self.process.returncode


class LauncherTest(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self)
        self.runs = []
        self.mounts = []
        self.shared = shared_folder(self)
        os.environ["SWARMANOID_SHARED_FOLDER"] = str(self.shared)
        self.memory_before = self.memory()

    def tearDown(self):
        for run in self.runs:
            end(run.process)
        for place in self.mounts:
            subprocess.run(["umount", "-l", place], check=False)

    def memory(self):
        """The shared memory of this test's runs, and files of Fast DDS outside their folders that no process uses."""
        used = set()
        for maps in pathlib.Path("/proc").glob("[0-9]*/maps"):
            with contextlib.suppress(OSError):
                used |= {line.split()[-1] for line in maps.read_text().splitlines() if "/dev/shm/" in line}
        outside = set()
        for path in pathlib.Path("/dev/shm").iterdir():
            with contextlib.suppress(FileNotFoundError):
                if path.name.startswith(("fast", "sem.fast")) and path.lstat().st_uid == os.geteuid() and str(path) not in used:
                    outside.add(str(path))
        return outside | {str(path) for path in self.shared.rglob("*")}

    def start(self, *arguments, environment=None, before=()):
        """`before`: words of a program that starts the command, such as `ip netns exec NAME`."""
        run = Run(self.folder, [str(a) for a in arguments], environment, before)
        self.runs.append(run)
        return run

    def run_it(self, *arguments, timeout=GENEROUS_S, environment=None, before=()):
        run = self.start(*arguments, environment=environment, before=before)
        run.wait(timeout)
        return run

    def start_paused(self, *options):
        """A run of DIFFUSION that waits before its first tick."""
        run = self.start("run", DIFFUSION, "--quiet", "--paused", "--hash-log", "hashes", "--no-visualisers", *options)
        self.wait_for_experiment("diffusion_10")
        return run

    def kill_all(self, run):
        """All processes of a run die at once, as with their machine."""
        pids = [run.process.pid, *children_of(run.process.pid)]
        # All stop before the first one dies, so that none sees another one die.
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for pid in pids:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, number)
        run.wait()

    def control(self, *words):
        """What a request that is obeyed says."""
        answer = self.run_it("control", *words, "--patience", GENEROUS_S, timeout=2 * GENEROUS_S)
        self.assertEqual(answer.process.returncode, 0, answer.stderr)
        return answer.stdout

    def assert_survives(self, program, says, tick, name, expected, experiment, *options):
        """A cluster whose `program` is killed at a tick, until it `says` so, has the hashes `expected`."""
        run = self.start("run", experiment, "--paused", "--hash-log", name, "--output", name + "_out", *options)
        self.wait_for_experiment(experiment.stem)
        self.control("step", tick)
        os.kill(run.find(program), signal.SIGKILL)
        said = run.read_until(says)
        self.wait_for_experiment(experiment.stem)
        self.control("resume")
        self.assertEqual(run.wait(), 0, said + run.stderr)
        self.assertEqual((self.folder / name).read_text(), expected)

    def assert_restored(self, hashes, tick):
        """A run in the folder one_out, with these hashes, goes on from its checkpoint with the same, in one process and as a cluster."""
        for name, options in (("restored", ("--single-process",)), ("hosts", ("--controller-hosts", 2))):
            run = self.run_it("run", self.folder / "one_out/experiment.xml", "--restore", f"one_out/checkpoint-{tick:08}", "--hash-log", name,
                              "--output", name + "_out", *options)
            self.assertEqual(run.process.returncode, 0, run.stderr)
            restored = (self.folder / name).read_text()
            self.assertTrue(hashes.endswith(restored[restored.index("\n") + 1:]), name)

    def wait_until(self, what, condition, run=None, timeout=GENEROUS_S):
        deadline = time.monotonic() + timeout
        while not condition():
            if run is not None and run.process.poll() is not None:
                self.fail(f"the run ended before {what}: {run.process.stderr.read()}")
            if time.monotonic() > deadline:
                self.fail(f"waited for {what}" + (f"; the run says:\n{run.newest_words()}" if run else ""))
            time.sleep(0.02)

    def has_table(self, table):
        """Whether a visualiser has written one that is complete as far as its last robot."""
        path = self.folder / table
        return path.exists() and "fb_9" in path.read_text()

    def wait_for_experiment(self, name):
        self.wait_until(f"the start of {name}", lambda: name in self.run_it("list", "experiments").stdout)

    def wait_for_tick(self, hashes, tick, run=None, timeout=GENEROUS_S):
        """Until the hash log has the tick; needs --hash-log."""
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            if run is not None and run.process.poll() is not None:
                raise AssertionError("the run ended early: " + run.process.stderr.read())
            with contextlib.suppress(OSError):
                lines = (self.folder / hashes).read_text().splitlines()
                if len(lines) > tick + 1:
                    return
            time.sleep(0.01)
        raise AssertionError(f"tick {tick} was not reached in {timeout} s")

    def assert_nothing_left(self, run, pids=()):
        for pid in pids:
            stat = stat_of(pid)
            self.assertTrue(stat is None or stat[2] == "Z", f"process {pid} is left: {words_of(pid)}")
        for entry in os.listdir("/proc"):
            if entry.isdigit() and any(str(self.folder) in word for word in words_of(entry)):
                self.fail(f"process {entry} is left: {words_of(entry)}")
        self.assertEqual(self.memory() - self.memory_before, set())

    def assert_finished(self, run, ticks=None):
        last = run.stdout.splitlines()[-1] if run.stdout else ""
        match = FINISHED.match(last)
        self.assertIsNotNone(match, f"the last line is {last!r}; errors: {run.stderr}")
        if ticks is not None:
            self.assertEqual(int(match[1]), ticks)
        return match[3]

    def one_process(self, experiment, ticks, *options, code=0, timeout=GENEROUS_S):
        """The hash of the experiment in one process, whose hash log is `one` and whose folder is `one_out`."""
        shutil.rmtree(self.folder / "one_out", ignore_errors=True)
        run = self.run_it("run", experiment, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out", *options,
                          timeout=timeout)
        self.assertEqual(run.process.returncode, code, run.stderr)
        return self.assert_finished(run, ticks)

    def assert_same(self, run, ticks, expected, said="", code=0):
        """A run with the hash log `cluster` ends, with the hashes of one_process."""
        if not hasattr(run, "stdout"):
            run.wait()
        self.assertEqual(run.process.returncode, code, said + run.stderr)
        self.assertEqual(self.assert_finished(run, ticks), expected)
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)

    def write_faulty(self, fault, tick=0, name="faulty"):
        """An experiment of one robot whose controller fails."""
        return experiment(self.folder / f"{name}.xml", f"<maxclock>300</maxclock><controller_path>{TEST_CONTROLLERS}</controller_path>",
                          controller("faulty_controller", parameters=f"<fault>{fault}</fault><tick>{tick}</tick>", library="faulty_controller"),
                          '<footbot id="robot_one" position="1,1,0" controller="c"/>', size="2,2,1")


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)
