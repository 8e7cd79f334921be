"""Signals for processes of tests."""
import pathlib
import re
import time


def send_and_wait(process, number, timeout=100):
    """Sends a signal and waits until the process has taken it: two that are pending at once are one."""
    process.send_signal(number)
    deadline = time.monotonic() + timeout
    while process.poll() is None:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        pending = int(re.search(r"^ShdPnd:\s*([0-9a-f]+)$", status, re.MULTILINE)[1], 16)
        if not pending >> (number - 1) & 1:
            return
        if time.monotonic() > deadline:
            raise AssertionError(f"process {process.pid} does not take signal {number}")
        time.sleep(0.001)
