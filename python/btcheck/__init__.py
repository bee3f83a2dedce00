# SPDX-License-Identifier: MIT
"""btcheck, a model checker for Behavior Trees.

    >>> import btcheck
    >>> report = btcheck.check("patrol.xml", "never dock.failure")
    >>> report.ok
"""

from ._calls import (
    Cancellation,
    RequestError,
    check,
    describe,
    explain,
    lint,
    simulate,
)
from ._library import LibraryError
from ._report import (
    Answer,
    Change,
    Description,
    Entry,
    Explanation,
    Finding,
    InternalError,
    Node,
    NodeFacts,
    Outcome,
    Place,
    Port,
    Related,
    Reply,
    Report,
    Run,
    Simulation,
    Step,
    Verdict,
)
from ._version import VERSION as __version__

__all__ = [
    "Answer", "Cancellation", "Change", "Description", "Entry", "Explanation",
    "Finding", "InternalError", "LibraryError", "Node", "NodeFacts", "Outcome",
    "Place", "Port", "Related", "Reply", "Report", "RequestError", "Run",
    "Simulation", "Step", "Verdict", "__version__", "check", "describe", "explain",
    "lint", "simulate",
]
