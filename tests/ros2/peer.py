"""Programs of another vendor's DDS that the tests of ROS 2 talk to. Each wait has a limit, behind which they say where they hang."""
import subprocess
import threading

import stacks


class Peer:
    """Says "ready", then a line for each message, until its input ends."""

    def __init__(self, command, environment=None):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)
        self.begun = threading.Event()
        self.thread = threading.Thread(target=self._listen, daemon=True)
        self.thread.start()
        if not self.begun.wait(stacks.LIMIT_S):
            stacks.fail_for_hanging(self.process)

    def hear(self, words):
        raise NotImplementedError

    def _listen(self):
        for line in self.process.stdout:
            if self.begun.is_set():
                self.hear(line.split())
            else:
                assert line == "ready\n", line
                self.begun.set()
        self.begun.set()

    def stop(self):
        self.process.stdin.close()
        code = stacks.wait_for(self.process)
        self.thread.join(stacks.LIMIT_S)
        assert code == 0 and not self.thread.is_alive(), code
        self.process.stdout.close()
