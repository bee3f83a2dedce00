# SPDX-License-Identifier: MIT
"""A tree to try the exporter with: docs/pytrees.md."""

from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Retry, Timeout


class BatteryOk(Behaviour):
    def update(self):
        return Status.SUCCESS


class Drive(Behaviour):
    def update(self):
        return Status.RUNNING


class Watch(Behaviour):
    def update(self):
        return Status.RUNNING


def create_root():
    search = Parallel("search", ParallelPolicy.SuccessOnOne())
    search.add_children([Timeout("in_time", Drive("patrol"), 3.0), Watch("watch")])
    mission = Sequence("mission", memory=True)
    mission.add_children(
        [BatteryOk("battery_ok"), Retry("again", search, 2), Drive("dock")]
    )
    robot = Selector("robot", memory=False)
    robot.add_children([mission, Drive("charge")])
    return robot
