# SPDX-License-Identifier: MIT
"""As much of rclpy as contrib/ros2 uses: messages come from standard input, one
as JSON on each line; what is published or logged goes to standard output."""

import json
import sys

_node = None


def init():
    pass


def spin(node):
    from nav2_msgs.msg import BehaviorTreeLog

    for line in sys.stdin:
        for topic, kind, callback in node.subscriptions:
            assert kind is BehaviorTreeLog and topic == "/behavior_tree_log"
            callback(BehaviorTreeLog(json.loads(line)))
