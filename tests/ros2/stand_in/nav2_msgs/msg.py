# SPDX-License-Identifier: MIT
class BehaviorTreeLog:
    def __init__(self, fields):
        self.fields = fields
