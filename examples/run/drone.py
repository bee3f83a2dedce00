# SPDX-License-Identifier: MIT
"""The drone of the paper's survey mission, simulated, with random faults.

    btcheck run examples/drone3-fixed.btf --seed 7 \
        --leaves-exec 'python3 examples/run/drone.py'

The battery empties as the drone flies, and sometimes at once; now and then the
position is lost. The camera may find what it looks for. --seed chooses the
faults; without it every mission is another one.
"""
import random

from btcheck_leaves import Leaves

leaves = Leaves()

CHARGER = (-1.0, -1.0, 0.5)
SPEED = 1.5  # metres in a tick
TICKS_TO_START = 3


class Drone:
    def __init__(self):
        self.chance = random.Random()
        self.place = (0.0, 0.0, 0.0)
        self.charge = 100.0

    def begin(self):
        self.chance = random.Random(leaves.tree.get("seed"))
        self.charge = self.chance.uniform(60, 100)

    def step_towards(self, goal):
        """One tick of flight; True when it is there."""
        self.charge -= 0.4
        away = [to - at for to, at in zip(goal, self.place)]
        distance = sum(d * d for d in away) ** 0.5
        if distance <= SPEED:
            self.place = goal
            return True
        self.place = tuple(
            at + d * SPEED / distance for at, d in zip(self.place, away)
        )
        return False

    def fault(self, probability):
        return self.chance.random() < probability


drone = Drone()
leaves.on_begin(drone.begin)


@leaves.action("start_drone")
def start_drone(call):
    for _ in range(TICKS_TO_START):
        yield
    return True


@leaves.action("start_camera")
def start_camera(call):
    for _ in range(TICKS_TO_START - 1):
        yield
    return not drone.fault(0.02)


@leaves.action("takeoff")
def takeoff(call):
    x, y, _ = drone.place
    while not drone.step_towards((x, y, call.arguments["height"])):
        yield
    return True


@leaves.action("goto_waypoint")
def goto_waypoint(call):
    goal = tuple(call.arguments[axis] for axis in "xyz")
    while not drone.step_towards(goal):
        yield
    if goal == CHARGER:
        while drone.charge < 95:
            drone.charge += 10
            yield
    return True


@leaves.action("land")
def land(call):
    x, y, _ = drone.place
    while not drone.step_towards((x, y, 0.0)):
        yield
    return True


@leaves.action("camera_tracking")
def camera_tracking(call):
    while not drone.fault(0.01):
        yield
    return True


@leaves.action("shutdown_drone")
def shutdown_drone(call):
    yield
    return True


@leaves.condition("localization_ok")
def localization_ok(call):
    return not drone.fault(0.005)


@leaves.measure("measure_battery")
def measure_battery(call):
    if drone.fault(0.005):
        drone.charge = min(drone.charge, 5.0)  # a cell has failed
    if drone.charge < 15:
        return "Critical"
    return "Low" if drone.charge < 40 else "Good"


if __name__ == "__main__":
    leaves.serve()
