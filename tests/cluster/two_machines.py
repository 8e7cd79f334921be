"""Two machines: network namespaces of their own, whose only link is a relay that delays frames and loses some of them. Needs root and
/dev/net/tun."""
import fcntl
import os
import struct
import subprocess
import unittest

TUNSETIFF = 0x400454CA
IFF_TAP = 0x0002
IFF_NO_PI = 0x1000


def possible():
    return os.geteuid() == 0 and os.path.exists("/dev/net/tun")


def require():
    if not possible():
        raise unittest.SkipTest("network namespaces with a relay need root and /dev/net/tun")


def ip(*words):
    subprocess.run(["ip", *words], check=True, capture_output=True)


class TwoMachines:
    """`names`: of the namespaces, to run programs there: ip netns exec NAME. Each has the interface link0, addresses 10.78.0.1 and .2."""

    def __init__(self, build):
        self.relay_program = os.path.join(build, "bin", "tests", "relay")
        self.names = [f"swt{os.getpid()}a", f"swt{os.getpid()}b"]
        self.taps = []
        try:
            for number, name in enumerate(self.names):
                self.make(number, name)
        except BaseException:
            self.remove()
            raise

    def make(self, number, name):
        ip("netns", "add", name)
        tap = os.open("/dev/net/tun", os.O_RDWR)
        self.taps.append(tap)
        link = f"swt{number}p{os.getpid()}"[:15]
        fcntl.ioctl(tap, TUNSETIFF, struct.pack("16sH", link.encode(), IFF_TAP | IFF_NO_PI))
        ip("link", "set", link, "netns", name, "name", "link0")
        ip("-n", name, "link", "set", "lo", "up")
        ip("-n", name, "addr", "add", f"10.78.0.{number + 1}/24", "dev", "link0")
        ip("-n", name, "link", "set", "link0", "up")
        ip("-n", name, "route", "add", "224.0.0.0/4", "dev", "link0")

    def forget_multicast(self):
        for name in self.names:
            ip("-n", name, "route", "del", "224.0.0.0/4", "dev", "link0")
            ip("-n", name, "link", "set", "link0", "multicast", "off")

    def hosts(self, options="--lease 60"):
        """A file for --hosts: space server and controller hosts on the first machine, engines on the second. No process is given up, however
        long this machine is busy with something else."""
        return ("command = ip netns exec {host} {command}\n"
                f"options = --interface link0 {options}\n"
                f"space_server = {self.names[0]}\ncontroller_host = {self.names[0]}\nengine = {self.names[1]}\n")

    def connect(self, loss, delay_ms):
        self.relay = subprocess.Popen([self.relay_program, *map(str, self.taps), str(loss), str(delay_ms)], pass_fds=self.taps,
                                      stdout=subprocess.PIPE, text=True)

    def disconnect(self):
        """Frames carried, frames lost, bytes of the largest."""
        self.relay.terminate()
        return [int(word) for word in self.relay.communicate()[0].split()]

    def remove(self):
        for tap in self.taps:
            os.close(tap)
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], capture_output=True)
