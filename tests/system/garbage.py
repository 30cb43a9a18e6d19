"""A sender of garbage, thousands of messages a second. Its arguments are messages a second and
channel, seconds, and channels; it prints how many it sent."""

import random
import socket
import struct
import sys
import time

from reach.messages import reach

CHANNELS = [
    "ROBOT_STATE", "ROBOT_COMMAND", "MARKER", "END_EFFECTOR", "STEREO_IMAGES", "REACH_REQUEST",
    "REACH_HELLO", "REACH_STATUS", "REACH_TRACE", "REACH_SAMPLE", "SIM_REQUEST", "SIM_TRUTH",
]  # fmt: skip
GROUP = ("239.255.76.67", 7667)
SHORT_MAGIC = 0x4C433032  # a message in one packet


WHOLE = {
    "ROBOT_STATE": reach.robot_state_t, "ROBOT_COMMAND": reach.robot_command_t,
    "MARKER": reach.marker_t, "END_EFFECTOR": reach.end_effector_t,
    "REACH_REQUEST": reach.request_t, "REACH_HELLO": reach.hello_t,
}  # fmt: skip
BURST = 400  # packets between two looks at the clock


def payloads(channel: str, rng: random.Random) -> list[bytes]:
    """Nonsense of many lengths, and whole messages with nonsense in them."""
    found = [rng.randbytes(length) for length in (0, 1, 7, 8, 9, 64, 300, 1000, 1400)]
    if channel in WHOLE:
        proper = WHOLE[channel]().encode()
        found += [proper[:8] + rng.randbytes(len(proper) - 8) for _ in range(9)]
    return found


def packets_of(channels: list[str], rng: random.Random) -> list[bytes]:
    """As LCM sends them."""
    packets = [
        struct.pack(">II", SHORT_MAGIC, rng.getrandbits(32)) + channel.encode() + b"\0" + payload
        for channel in channels
        for payload in payloads(channel, rng)
    ]
    rng.shuffle(packets)
    return packets


def flood(channels: list[str], rate: float, seconds: float) -> None:
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
    packets = packets_of(channels, random.Random(1))
    begin, sent = time.monotonic(), 0
    while (passed := time.monotonic() - begin) < seconds:
        due = int(passed * rate * len(channels)) - sent
        for _ in range(min(due, BURST)):
            sender.sendto(packets[sent % len(packets)], GROUP)
            sent += 1
        if due < BURST:
            time.sleep(0.0005)
    print(sent, flush=True)


if __name__ == "__main__":
    flood(sys.argv[3].split(","), float(sys.argv[1]), float(sys.argv[2]))
