# SPDX-License-Identifier: MIT
def message_to_ordereddict(message):
    return dict(message.fields)
