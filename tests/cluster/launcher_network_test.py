#!/usr/bin/env python3
"""A run over two machines whose link loses packets. The hash must be that of one process, and what is lost is all that is sent again.
Needs root and /dev/net/tun; skipped otherwise."""
import os
import signal
import time

import two_machines
from harness import CONFIGS, LauncherTest

setUpModule = two_machines.require

TICKS = 60
REPLACED = "another process takes its place"
FRAME_BYTES = 1514  # the largest of a link whose packets have 1,500


class Network(LauncherTest):
    def setUp(self):
        super().setUp()
        self.machines = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(self.machines.remove)

    def run_over(self, loss, options="--lease 60", experiment="diffusion_10.xml", ticks=TICKS):
        """Frames carried, and those lost."""
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts(options))
        self.machines.connect(loss, 1)
        try:
            run = self.run_it("run", CONFIGS / experiment, "--ticks", ticks, "--no-visualisers", "--hosts", hosts, timeout=90)
        finally:
            carried, lost, largest = self.machines.disconnect()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        one = self.run_it("run", CONFIGS / experiment, "--ticks", ticks, "--no-visualisers", "--single-process")
        self.assertEqual(self.assert_finished(run, ticks), self.assert_finished(one, ticks))
        self.assertLessEqual(largest, FRAME_BYTES)
        return carried, lost

    def test_same_hash_with_delay(self):
        # The engine is on the other machine: its traffic went over the link.
        self.assertGreater(self.run_over(0)[0], TICKS)

    def test_same_hash_with_delay_and_loss(self):
        self.assertGreater(self.run_over(0.05)[1], 0)

    def test_large_messages_are_mended_packet_by_packet(self):
        """1,000 robots: 32 kB of poses each way in a tick, 16 kB of commands; some 70 packets, and few more for what is lost."""
        ticks = 40
        carried, lost = self.run_over(0.02, experiment="diffusion_1000.xml", ticks=ticks)
        self.assertGreater(lost, ticks / 2)
        self.assertLess(carried / ticks, 200)

    def test_hosts_that_are_told_their_surroundings(self):
        """Three hosts on the other machine: alone each is told of all 1,000 robots, together hardly more. One of them dies, and its place is
        taken."""
        experiment, ticks = CONFIGS / "diffusion_1000.xml", 300
        hosts = self.folder / "hosts.txt"
        one = self.run_it("run", experiment, "--ticks", ticks, "--no-visualisers", "--single-process", "--hash-log", "one")
        carried = {}
        for number in (1, 3):
            hosts.write_text(self.machines.hosts() + "".join(f"controller_host {k} = {self.machines.names[1]}\n" for k in range(number)))
            self.machines.connect(0, 0.1)
            try:
                run = self.run_it("run", experiment, "--ticks", ticks, "--no-visualisers", "--hosts", hosts, "--controller-hosts", number,
                                  "--hash-log", "cluster", timeout=90)
            finally:
                carried[number] = self.machines.disconnect()[0]
            self.assertEqual(run.process.returncode, 0, run.stderr)
            self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        # Each further host would be told 32 kB in a tick if it were told all: 23 packets, and what confirms them, some 20,000 for both.
        self.assertLess(carried[3] - carried[1], 2 * 23 * ticks)

        self.machines.connect(0.01, 1)
        (self.folder / "cluster").unlink()
        run = self.start("run", experiment, "--ticks", ticks, "--no-visualisers", "--hosts", hosts, "--controller-hosts", 3, "--real-time", 3,
                         "--hash-log", "cluster")
        try:
            self.wait_for_tick("cluster", 20, run)
            os.kill(run.find("controller_host"), signal.SIGKILL)
            run.read_until(REPLACED)
            run.wait()
        finally:
            self.machines.disconnect()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assertEqual(self.assert_finished(run, ticks), self.assert_finished(one, ticks))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)

    def test_engines_that_are_told_of_others(self):
        """Entities that several engines see, those that functions move, and groups that hold one another."""
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts() + f"controller_host 1 = {self.machines.names[1]}\n")
        self.machines.connect(0, 0.1)
        self.addCleanup(self.machines.disconnect)
        for name in ("mirrors", "prey_supply", "gripped_chain"):
            with self.subTest(name):
                words = ("run", CONFIGS / f"{name}.xml", "--ticks", 150, "--no-visualisers")
                one = self.run_it(*words, "--single-process")
                run = self.run_it(*words, "--hosts", hosts, "--controller-hosts", 2, timeout=90)
                self.assertEqual(self.assert_finished(run, 150), self.assert_finished(one, 150), run.stderr)

    def test_without_multicast_by_peers(self):
        self.machines.forget_multicast()
        self.run_over(0, "--lease 60 --peers 10.78.0.1 10.78.0.2")

    def cut(self, lease):
        """A run whose link carries nothing for ten seconds in its midst."""
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts(f"--lease {lease}"))
        experiment = CONFIGS / "diffusion_10.xml"
        one = self.run_it("run", experiment, "--ticks", 300, "--no-visualisers", "--single-process", "--hash-log", "one")
        self.machines.connect(0, 1)
        run = self.start("run", experiment, "--ticks", 300, "--no-visualisers", "--hosts", hosts, "--real-time", 1, "--hash-log", "cluster")
        self.wait_for_tick("cluster", 20, run)
        self.machines.disconnect()
        time.sleep(10)
        self.machines.connect(0, 1)
        run.wait()
        self.machines.disconnect()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assertEqual(self.assert_finished(run, 300), self.assert_finished(one, 300))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)
        return run.stderr

    def test_a_link_that_is_cut_for_less_than_the_lease(self):
        self.assertNotIn(REPLACED, self.cut(60))

    def test_a_link_that_is_cut_for_longer_than_the_lease(self):
        self.assertIn(REPLACED, self.cut(3))
