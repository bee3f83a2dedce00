#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rules that watch a tree of Nav2 while it runs, as a node of ROS 2.

    python3 btcheck_watch.py --ros-args -p tree:=nav.xml -p rules:=rules.ltl

Each message of /behavior_tree_log goes to `btcheck monitor`, which answers with a
verdict. A rule that is violated is an error in the log of ROS, and the topic
/btcheck/violated has its name.
"""

import json
import subprocess

import rclpy
from nav2_msgs.msg import BehaviorTreeLog
from rclpy.node import Node
from rosidl_runtime_py import message_to_ordereddict
from std_msgs.msg import String


class Watch(Node):
    def __init__(self):
        super().__init__("btcheck_watch")
        tree = self.declare_parameter("tree", "").value
        rules = self.declare_parameter("rules", "").value
        program = self.declare_parameter("btcheck", "btcheck").value
        if not tree or not rules:
            raise SystemExit("btcheck_watch: set the parameters tree and rules")
        self.told = set()
        self.oracle = subprocess.Popen(
            [program, "monitor", tree, "--prop", rules],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
        self.violated = self.create_publisher(String, "/btcheck/violated", 10)
        self.create_subscription(
            BehaviorTreeLog, "/behavior_tree_log", self.hear, 100)

    def hear(self, message):
        event = message_to_ordereddict(message)
        event["topic"] = "/behavior_tree_log"
        event["time"] = self.get_clock().now().nanoseconds / 1e9
        self.oracle.stdin.write(json.dumps(event) + "\n")
        line = self.oracle.stdout.readline()
        if not line:  # btcheck has said why on standard error
            raise SystemExit("btcheck_watch: btcheck has ended")
        answer = json.loads(line)
        if "error" in answer:
            self.get_logger().warning(answer["error"])
        if answer["verdict"] != "false":
            return
        for rule in answer["spec"].split(", "):
            if rule not in self.told:
                self.told.add(rule)
                self.get_logger().error(f"rule {rule} is violated")
                self.violated.publish(String(data=rule))


def main():
    rclpy.init()
    node = Watch()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.oracle.stdin.close()
        node.oracle.wait()


if __name__ == "__main__":
    main()
