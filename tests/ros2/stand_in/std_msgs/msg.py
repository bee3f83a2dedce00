# SPDX-License-Identifier: MIT
class String:
    def __init__(self, data=""):
        self.data = data
