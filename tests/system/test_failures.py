"""What goes wrong with the real programs in real time, and that the others hold and recover."""

import math
import signal
import threading
import time
import unittest

from reach.messages import reach as types
from robot_in_trouble import (
    GO,
    PERIOD,
    ROBOT_URL,
    STEP,
    STOP,
    Frozen,
    Relay,
    Trouble,
    assert_brakes,
)

STATE = types.status_t


class Failures(unittest.TestCase):
    def test_the_robot_stops_answering(self):
        with Trouble() as trouble:
            trouble.set_moving()
            trouble.signal("simrobot", STOP)
            took = trouble.until(lambda: trouble.status_is(STATE.HOLD, STATE.SUSPENDED), "holding")
            self.assertLess(took, 1)
            trouble.until(lambda: trouble.status_is(STATE.SUSPENDED), "suspended")
            trouble.until(lambda: trouble.speed() == 0, "at rest")
            trouble.watch(0.5)
            self.assertEqual(trouble.speed(), 0)
            trouble.signal("simrobot", GO)
            trouble.assert_active_again()
            trouble.processes.kill("simrobot")
            trouble.until(lambda: trouble.status_is(STATE.SUSPENDED), "suspended")
            trouble.start_simrobot()
            trouble.assert_active_again()
            self.assertEqual(trouble.bus.status.fault, STATE.FAULT_NONE)

    def test_the_daemon_is_stopped_and_killed(self):
        with Trouble() as trouble:
            trouble.set_moving()
            trouble.signal("reachd", STOP)
            trouble.until(lambda: trouble.true_speed() < 0.02, "held by the robot's driver", 3)
            trouble.watch(0.5)
            self.assertLess(trouble.true_speed(), 0.02)
            before = len(trouble.commands)
            trouble.signal("reachd", GO)
            trouble.until(lambda: len(trouble.commands) > before + 2, "commanding again")
            first = trouble.commands[before][1].velocity[:4]
            self.assertLessEqual(max(map(abs, first)), STEP + 1e-9)  # from rest
            trouble.assert_active_again()
            trouble.set_moving()
            trouble.processes.kill("reachd")
            trouble.until(lambda: trouble.true_speed() < 0.02, "held by the robot's driver", 3)
            trouble.bus.status = None
            trouble.start_reachd()
            trouble.until(lambda: trouble.status_is(STATE.IDLE), "idle")
            trouble.set_moving()

    def test_the_loop_stands_still(self):
        """The watchdog's thread brakes the arm; then a fault until the reset."""
        with Trouble() as trouble:
            trouble.set_moving()
            with Frozen(trouble.processes.pid("reachd"), "reachd-loop"):
                trouble.watch(0.02)
                before = len(trouble.commands)
                trouble.until(lambda: len(trouble.commands) > before + 8, "braked", 2)
                assert_brakes(trouble, before - 1)
                self.assertIn("the loop stands still", trouble.log("reachd"))
            trouble.until(lambda: trouble.status_is(STATE.FAULT), "a fault")
            self.assertEqual(trouble.bus.status.fault, STATE.FAULT_STALL)
            trouble.watch(0.3)
            self.assertEqual(trouble.speed(), 0)
            trouble.reset()
            trouble.set_moving()

    def test_the_loop_is_late_again_and_again(self):
        with Trouble() as trouble:
            trouble.set_moving()
            pid = trouble.processes.pid("reachd")
            overruns = trouble.bus.status.overruns
            phase = trouble.bus.status.utime * 1e-6  # of the grid
            for _ in range(40):
                # Each tick is late by more than a period, none by as much as a standstill. Let go
                # a little after the grid, the loop cannot catch up before it is frozen again.
                with Frozen(pid, "reachd-loop"):
                    time.sleep(2 * PERIOD + (phase + 0.005 - time.time()) % PERIOD)
                trouble.watch(0.002)
                if trouble.status_is(STATE.FAULT):
                    break
            trouble.until(lambda: trouble.status_is(STATE.FAULT), "a fault")
            self.assertEqual(trouble.bus.status.fault, STATE.FAULT_OVERRUNS)
            self.assertGreaterEqual(trouble.bus.status.overruns, overruns + 10)
            trouble.until(lambda: trouble.speed() == 0, "at rest")
            trouble.reset()

    def test_an_emergency(self):
        with Trouble() as trouble:
            for stop in (
                lambda: trouble.signal("reachd", signal.SIGUSR1),
                lambda: trouble.ask(types.request_t.EMERGENCY),
            ):
                trouble.set_moving()
                first, start = len(trouble.commands), time.monotonic()
                stop()
                trouble.until(lambda: trouble.status_is(STATE.FAULT), "a fault", 2)
                self.assertEqual(trouble.bus.status.fault, STATE.FAULT_EMERGENCY)
                trouble.until(lambda: trouble.speed() == 0, "at rest", 2)
                rest = next(t for t, c in trouble.commands[first:] if not any(c.velocity[:4]))
                print(f"at rest {1e3 * (rest - start):.0f} ms after the emergency")
                trouble.reset()
            trouble.until(lambda: trouble.said("reachd", "fault: emergency stop") == 2, "said", 2)
            trouble.until(lambda: trouble.said("reachd", "the fault was reset") == 2, "said", 2)

    def test_vision_is_stopped_and_killed(self):
        with Trouble(vision=True) as trouble:
            trouble.ask(types.request_t.BABBLE, count=1000, seed=3, learn=1)
            trouble.until(lambda: trouble.bus.status.progress > 0, "a first sample", 30)
            for stop, go in (
                (lambda: trouble.signal("vision", STOP), lambda: trouble.signal("vision", GO)),
                (lambda: trouble.processes.kill("vision"), trouble.start_vision),
            ):
                stop()
                trouble.until(lambda: not trouble.bus.status.marker_seen, "blind")
                learned = trouble.bus.status.samples
                trouble.until(lambda: trouble.bus.status.phase == STATE.SEARCH, "searching")
                trouble.watch(0.2)
                self.assertLess(trouble.speed(), 0.01)  # the head searches, the arm holds
                self.assertLessEqual(trouble.bus.status.samples, learned + 1)
                go()
                seen = trouble.bus.status.progress
                trouble.until(lambda n=seen: trouble.bus.status.progress > n, "learning again", 30)

    def test_states_are_late_and_corrupt(self):
        relay = Relay()
        thread = threading.Thread(target=relay.run)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(relay.end)
        with Trouble(robot_url=ROBOT_URL) as trouble:
            trouble.set_moving()
            self.corrupt(trouble, relay, lambda data: [data[:-3]])
            self.corrupt(trouble, relay, not_a_number)
            held: list[bytes] = []
            relay.spoil = lambda data: held.append(data) or []
            trouble.until(lambda: trouble.status_is(STATE.SUSPENDED), "suspended")
            relay.spoil = lambda data: held[::-1]  # all at once, the newest first
            trouble.watch(0.1)
            relay.spoil = lambda data: [data]
            trouble.assert_active_again()

    def corrupt(self, trouble: Trouble, relay: Relay, spoil) -> None:
        """What is wrong is dropped and counted; the last good state grows old all the same."""
        bad = trouble.bus.status.bad_inputs
        relay.spoil = spoil
        trouble.until(lambda: trouble.status_is(STATE.SUSPENDED), "suspended")
        trouble.until(lambda: trouble.speed() == 0, "at rest")
        self.assertGreater(trouble.bus.status.bad_inputs, bad)
        relay.spoil = lambda data: [data]
        trouble.assert_active_again()


def not_a_number(data: bytes) -> list[bytes]:
    state = types.robot_state_t.decode(data)
    state.position = [math.nan, *state.position[1:]]
    return [state.encode()]


if __name__ == "__main__":
    unittest.main()
