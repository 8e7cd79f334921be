#!/usr/bin/env python3
"""A run over two machines: two network namespaces whose only link is a relay of this test, which delays each frame by 1 ms and loses some of
them. The hash must be that of one process, and what is lost is all that is sent again. Needs root and /dev/net/tun; skipped otherwise."""
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import sys
import threading
import time
import unittest

from harness import CONFIGS, LauncherTest

TUNSETIFF = 0x400454CA
IFF_TAP = 0x0002
IFF_NO_PI = 0x1000
DELAY_S = 0.001
PACKET_BYTES = 1514  # the largest frame of a link whose packets have 1,500
TICKS = 60


def ip(*words):
    subprocess.run(["ip", *words], check=True, capture_output=True)


class Relay(threading.Thread):
    """Carries frames between two taps: late, and not all of them."""

    def __init__(self, left, right, loss):
        super().__init__(daemon=True)
        self.other = {left: right, right: left}
        self.loss = loss
        self.random = random.Random(1)
        self.carried = 0
        self.lost = 0
        self.largest = 0
        self.stopped = False

    def run(self):
        waiting = []  # (due, number, tap, frame)
        while not self.stopped:
            pause = max(0.0, waiting[0][0] - time.monotonic()) if waiting else 0.05
            for tap in select.select(list(self.other), [], [], pause)[0]:
                frame = os.read(tap, 70000)
                self.carried += 1
                self.largest = max(self.largest, len(frame))
                if self.random.random() < self.loss:
                    self.lost += 1
                    continue
                heapq.heappush(waiting, (time.monotonic() + DELAY_S, self.carried, self.other[tap], frame))
            while waiting and waiting[0][0] <= time.monotonic():
                _, _, tap, frame = heapq.heappop(waiting)
                try:
                    os.write(tap, frame)
                except OSError:
                    pass  # the other end is gone


class Network(LauncherTest):
    def setUp(self):
        super().setUp()
        self.names = [f"swt{os.getpid()}a", f"swt{os.getpid()}b"]
        taps = []
        for number, name in enumerate(self.names):
            ip("netns", "add", name)
            self.addCleanup(ip, "netns", "del", name)
            tap = os.open("/dev/net/tun", os.O_RDWR)
            self.addCleanup(os.close, tap)
            link = f"swt{number}p{os.getpid()}"[:15]
            fcntl.ioctl(tap, TUNSETIFF, struct.pack("16sH", link.encode(), IFF_TAP | IFF_NO_PI))
            ip("link", "set", link, "netns", name, "name", "link0")
            ip("-n", name, "link", "set", "lo", "up")
            ip("-n", name, "addr", "add", f"10.78.0.{number + 1}/24", "dev", "link0")
            ip("-n", name, "link", "set", "link0", "up")
            ip("-n", name, "route", "add", "224.0.0.0/4", "dev", "link0")
            taps.append(tap)
        self.taps = taps

    def run_over(self, loss, *options, experiment="diffusion_10.xml", ticks=TICKS):
        relay = Relay(*self.taps, loss)
        relay.start()
        hosts = self.folder / "hosts.txt"
        hosts.write_text("command = ip netns exec {host} {command}\n"
                         f"options = --interface link0 {' '.join(options)}\n"
                         f"space_server = {self.names[0]}\ncontroller_host = {self.names[0]}\n"
                         f"engine = {self.names[1]}\n")
        run = self.run_it("run", CONFIGS / experiment, "--ticks", ticks, "--no-visualisers", "--hosts", hosts, timeout=90)
        relay.stopped = True
        relay.join()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        one = self.run_it("run", CONFIGS / experiment, "--ticks", ticks, "--no-visualisers", "--single-process")
        self.assertEqual(self.assert_finished(run, ticks), self.assert_finished(one, ticks))
        self.assertLessEqual(relay.largest, PACKET_BYTES)
        return relay

    def test_same_hash_with_delay(self):
        relay = self.run_over(0)
        # The engine is on the other machine: its traffic went over the link.
        self.assertGreater(relay.carried, TICKS)

    def test_same_hash_with_delay_and_loss(self):
        relay = self.run_over(0.05)
        self.assertGreater(relay.lost, 0)

    def test_large_messages_are_mended_packet_by_packet(self):
        """1,000 robots: 32 kB of poses each way in a tick, 8 to 16 kB of commands; some 80 packets, and few more for what is lost."""
        ticks = 40
        relay = self.run_over(0.02, experiment="diffusion_1000.xml", ticks=ticks)
        self.assertGreater(relay.lost, ticks / 2)
        self.assertLess(relay.carried / ticks, 200)

    def test_without_multicast_by_peers(self):
        for name in self.names:
            ip("-n", name, "route", "del", "224.0.0.0/4", "dev", "link0")
            ip("-n", name, "link", "set", "link0", "multicast", "off")
        self.run_over(0, "--peers", "10.78.0.1", "10.78.0.2")


if __name__ == "__main__":
    if os.geteuid() != 0 or not os.path.exists("/dev/net/tun"):
        print("skipped: network namespaces with a relay need root and /dev/net/tun")
        sys.exit(77)
    unittest.main()
