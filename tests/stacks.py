"""Waits with a limit for processes that tests start, and where their threads are if one hangs."""
import contextlib
import os
import pathlib
import shutil
import signal
import subprocess

LIMIT_S = 100  # far longer than a busy machine takes


def read(path):
    try:
        return path.read_text().strip()
    except OSError as error:
        return f"({error.strerror})"


def family(pid):
    """The process, and all that it and these have started."""
    children = (read(tasks) for tasks in pathlib.Path(f"/proc/{pid}/task").glob("*/children"))
    return [pid, *(one for text in children for child in text.split() if child.isdigit() for one in family(int(child)))]


def of_process(pid):
    name = read(pathlib.Path(f"/proc/{pid}/cmdline")).replace("\0", " ")
    if debugger := shutil.which("gdb"):
        try:
            done = subprocess.run([debugger, "--batch", "-p", str(pid), "-ex", "thread apply all backtrace"], stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=60, errors="replace")
            if "Thread 1 " in done.stdout:
                return f"--- {pid} {name}\n{done.stdout}"
        except subprocess.TimeoutExpired:
            pass
    threads = (f"{task.name} {read(task / 'comm')}: {read(task / 'wchan')}\n{read(task / 'stack')}"
               for task in sorted(pathlib.Path(f"/proc/{pid}/task").glob("*")))
    return f"--- {pid} {name}\n" + "\n".join(threads)


def fail_for_hanging(process, text=""):
    """Says where its threads are, and those of all that it started, and ends them."""
    pids = family(process.pid)
    told = "\n".join(of_process(pid) for pid in pids)
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    process.wait()
    raise AssertionError(f"{process.args} has not ended\n{text}\n{told}")


def wait_for(process, text=""):
    try:
        return process.wait(timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        fail_for_hanging(process, text)


def output_of(process, log=None):
    """What it says until it ends; `log` has more to say if it hangs."""
    try:
        return process.communicate(timeout=LIMIT_S)
    except subprocess.TimeoutExpired as hung:
        fail_for_hanging(process, f"{hung.stdout}\n{hung.stderr}\n{log() if log else ''}")


def run(command, log=None, **options):
    """As subprocess.run with its output."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    out, errors = output_of(process, log)
    return subprocess.CompletedProcess(command, process.returncode, out, errors)
