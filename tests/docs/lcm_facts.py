"""Shows what LCM really does, where users expect something else: docs/faq.md.

tools/netns.sh .venv/bin/python tests/docs/lcm_facts.py [FACT ...]
"""

import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import lcm

GROUP = "udpm://239.255.76.67:7667?ttl=0"
OTHER_GROUP = "udpm://239.255.76.99:7667?ttl=0"
START = 10_000_000  # us
STEP = 100_000


def _say(channels: list[str], url: str = GROUP) -> None:
    bus = lcm.LCM(url)
    for channel in channels:
        bus.publish(channel, b"12345678")
    time.sleep(0.2)


def _logged(path: Path, while_logging, *options: str) -> list:
    """What lcm-logger has in the log when `while_logging` has returned."""
    command = ["lcm-logger", "-q", f"--lcm-url={GROUP}", *options, path]
    logger = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(0.5)
    while_logging()
    time.sleep(0.3)
    logger.send_signal(signal.SIGINT)
    logger.wait(20)
    return list(lcm.EventLog(str(path)))


def _channels(events: list) -> str:
    return " ".join(event.channel for event in events)


def _write(path: Path, stamps: list[int], channel: str = "A") -> Path:
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for i, stamp in enumerate(stamps):
        log.write_event(stamp, channel, bytes([i]))
    log.close()
    return path


def pattern(folder: Path) -> str:
    """The channels A AX XA B BX XB XAX are sent; what the patterns A|B and (A|B) take."""
    names = ["A", "AX", "XA", "B", "BX", "XB", "XAX"]
    found = [_channels(_logged(folder / f"{i}.log", lambda: _say(names), "-c", text))
             for i, text in enumerate(("A|B", "(A|B)"))]  # fmt: skip
    return f"A|B takes {found[0]}; (A|B) takes {found[1]}"


def self_test(folder: Path) -> str:
    """Two programs subscribe to two channels each; what lcm-logger hears of it."""

    def subscribe():
        for _ in range(2):
            bus = lcm.LCM(GROUP)
            for channel in ("A", "B"):
                bus.subscribe(channel, lambda *_: None)
            time.sleep(0.3)

    found = _logged(folder / "log", subscribe)
    return ", ".join(f"{len(event.data)} bytes on {event.channel}" for event in found)


def groups(folder: Path) -> str:
    """A message is sent to another multicast group of the same port; who hears it."""
    bus, heard = lcm.LCM(GROUP), []
    bus.subscribe(".*", lambda channel, _: heard.append(channel))
    theirs = _logged(folder / "log", lambda: _say(["OTHER"], OTHER_GROUP), "-c", "OTHER")
    while bus.handle_timeout(300):
        pass
    return f"lcm-logger hears {len(theirs)}, the Python package {heard.count('OTHER')}"


def in_process(folder: Path) -> str:
    """100 messages for a subscription that holds 3, on memq:// and on the network."""
    counts = []
    for url in ("memq://", GROUP):
        bus, heard = lcm.LCM(url), []
        bus.subscribe("A", lambda _, data, heard=heard: heard.append(data)).set_queue_capacity(3)
        for i in range(100):
            bus.publish("A", bytes([i]))
        time.sleep(0.3)
        while bus.handle_timeout(300):
            pass
        counts.append(len(heard))
    return f"memq:// delivers {counts[0]}, udpm:// {counts[1]}"


def file_bus(folder: Path) -> str:
    """A log of stamps 1 s, 2 s .. 6 s as a bus that starts at 4 s."""
    log = _write(folder / "log", [1_000_000 * i for i in range(1, 7)])
    url = f"file://{log}?speed=0&start_timestamp=4000000"
    heard = []
    bus = lcm.LCM(url)
    bus.subscribe("A", lambda _, data: heard.append(data[0] + 1))
    try:
        while bus.handle_timeout(300):
            pass
    except OSError:  # the end of the log
        pass
    again = folder / "again"
    subprocess.run(["lcm-logger", "-q", f"--lcm-url={url}", again], timeout=20, check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    stamps = [event.timestamp for event in lcm.EventLog(str(again))]
    now = all(abs(stamp * 1e-6 - time.time()) < 60 for stamp in stamps)
    stamped = "the clock's" if now else "the log's"
    return f"delivers those of {' '.join(map(str, heard))} s; recv_utime is {stamped}"


def clock_set_back(folder: Path) -> str:
    """lcm-logplayer plays 10 messages a second, of which the last ten go back 5 s."""
    before = [START + STEP * i for i in range(10)]
    log = _write(folder / "log", before + [stamp - 5_000_000 for stamp in before])
    bus, times = lcm.LCM(GROUP), []
    bus.subscribe("A", lambda *_: times.append(time.monotonic()))
    player = subprocess.Popen(["lcm-logplayer", "-l", GROUP, log], stdout=subprocess.DEVNULL)
    end = time.monotonic() + 20
    while len(times) < 20 and time.monotonic() < end:
        bus.handle_timeout(200)
    player.wait(20)
    return (f"the first ten in {times[9] - times[0]:.1f} s,"
            f" the last ten in {times[19] - times[10]:.1f} s")  # fmt: skip


def increment(folder: Path) -> str:
    """lcm-logger --increment run.log, and -i run.log; the files that come of them."""
    names = []
    for option in ("--increment", "-i"):
        there = set(folder.iterdir())
        command = ["lcm-logger", "-q", f"--lcm-url={GROUP}", option, "run.log"]
        logger = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)  # fmt: skip
        time.sleep(0.5)
        logger.send_signal(signal.SIGINT)
        logger.wait(20)
        (new,) = set(folder.iterdir()) - there
        names.append(f"{option} makes {re.sub('[0-9]{4}-[0-9]{2}-[0-9]{2}', 'DATE', new.name)}")
    return ", ".join(names)


def byte_arrays(folder: Path) -> str:
    """A message of 4 bytes and a number, whose bytes are set too long and too short."""
    definition = folder / "bytes.lcm"
    definition.write_text("package facts; struct bytes_t { byte data[4]; int8_t number; }")
    subprocess.run(["lcm-gen", "-p", "--ppath", folder, definition], check=True)
    code = ("from facts import bytes_t\n"
            "for data in (b'abcdef', b'ab'):\n"
            "    one = bytes_t(); one.data, one.number = data, 7\n"
            "    print(data.decode(), 'becomes', one.encode()[8:])")  # fmt: skip
    said = subprocess.run([sys.executable, "-c", code], cwd=folder, check=True,
                          capture_output=True, text=True).stdout  # fmt: skip
    return "; ".join(said.splitlines())


def append(folder: Path) -> str:
    """Five messages of 8 bytes, the last torn; lcm-logger -a appends three; what can be read."""
    log = _write(folder / "log", [START + STEP * i for i in range(5)])
    log.write_bytes(log.read_bytes()[:-1])
    theirs = _logged(log, lambda: _say(["NEW"] * 3), "-a", "-c", "NEW")
    names = [event.channel for event in theirs]
    return f"LCM's reader finds {names.count('A')} of 5 old and {names.count('NEW')} of 3 new"


FACTS = {
    fact.__name__: fact
    for fact in (pattern, self_test, groups, in_process, file_bus, clock_set_back, increment,
                 byte_arrays, append)
}  # fmt: skip


def show(name: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        return FACTS[name](Path(folder))


if __name__ == "__main__":
    for fact in sys.argv[1:] or FACTS:
        print(f"{fact}: {show(fact)}", flush=True)
