# SPDX-License-Identifier: MIT
"""Threads, signals, ends before the end, forks, memory."""

import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import btcheck
import pytest
from btcheck import Outcome
from trees import ENDLESS, NAV2, SMALL, comparable


def told():
    return [comparable(btcheck.check(SMALL, "never CloseDoor.failure").json()),
            comparable(btcheck.lint(NAV2).json())]


def test_eight_threads_tell_what_one_tells():
    alone = told()
    different = []

    def work():
        for _ in range(5):
            if told() != alone:
                different.append(threading.get_ident())

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not different


def test_others_go_on_while_it_searches():
    ends = btcheck.Cancellation()
    threading.Timer(0.3, ends.cancel).start()
    thread = threading.Thread(target=lambda: btcheck.check(ENDLESS, cancel=ends))
    thread.start()
    count = 0
    while thread.is_alive():
        count += 1
        time.sleep(0.001)
    assert count > 50


def soon(began):
    """Within a tenth of a second, and as much again on a busy machine."""
    assert time.monotonic() - began < 0.2


def test_an_interrupt_ends_a_check():
    for _ in range(2):
        began = []

        def interrupt():
            began.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(0.2, interrupt).start()
        with pytest.raises(KeyboardInterrupt):
            btcheck.check(ENDLESS)
        soon(began[0])
    assert btcheck.check(SMALL).ok


def test_handlers_of_the_host_stay_and_are_called():
    calls = []
    old = signal.signal(signal.SIGALRM, lambda *_: calls.append(time.monotonic()))
    interrupt = signal.getsignal(signal.SIGINT)
    try:
        began = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        report = btcheck.check(ENDLESS, timeout=0.4)
        assert report.outcome is Outcome.UNDECIDED and report.stopped == "timeout"
        assert 0.1 <= calls[0] - began < 0.3
        assert signal.getsignal(signal.SIGINT) is interrupt
    finally:
        signal.signal(signal.SIGALRM, old)


def test_a_handler_may_check_itself():
    inner = []
    old = signal.signal(signal.SIGALRM, lambda *_: inner.append(btcheck.check(SMALL).ok))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        assert btcheck.check(ENDLESS, timeout=0.4).stopped == "timeout"
    finally:
        signal.signal(signal.SIGALRM, old)
    assert inner == [True]


def test_no_thread_stays():
    assert btcheck.check(SMALL).ok
    deadline = time.monotonic() + 5
    while len(os.listdir("/proc/self/task")) > 1 and time.monotonic() < deadline:
        time.sleep(0.02)
    assert len(os.listdir("/proc/self/task")) == 1
    assert btcheck.check(SMALL).ok


def test_cancelled_from_elsewhere_twice_and_before():
    ends = btcheck.Cancellation()
    began = []

    def cancel():
        began.append(time.monotonic())
        ends.cancel()
        ends.cancel()

    threading.Timer(0.2, cancel).start()
    report = btcheck.check(ENDLESS, cancel=ends)
    soon(began[0])
    assert report.outcome is Outcome.UNDECIDED and report.states > 0
    assert report.stopped == "interrupted"
    assert btcheck.check(SMALL, cancel=ends).outcome is Outcome.UNDECIDED
    assert btcheck.check(SMALL).ok


def test_a_program_that_ends_meanwhile():
    code = (
        "import threading, time, btcheck\n"
        "threading.Thread(target=btcheck.check, args=(%r,), daemon=True).start()\n"
        "time.sleep(0.2)" % ENDLESS)
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", code], capture_output=True,
                              text=True, timeout=60)
        assert (done.returncode, done.stderr) == (0, "")


def test_a_limit_leaves_it_undecided():
    report = btcheck.check(ENDLESS, "never a1.failure and b1.success", states=1000)
    assert report.outcome is Outcome.UNDECIDED
    assert report.verdicts[0].verdict == "UNDECIDED" and report.verdicts[0].met is None
    assert report.stopped == "max-states"


def in_child(threads):
    report = btcheck.check(ENDLESS, states=20000, threads=threads)
    return int(report.outcome), report.stopped


@pytest.mark.parametrize("threads", [1, 2])
def test_a_fork_after_a_check_can_check(threads):
    alone = in_child(threads)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(in_child, [threads] * 4).get(timeout=60) == [alone] * 4
    assert in_child(threads) == alone


def test_a_fork_during_a_check_can_check():
    ends = btcheck.Cancellation()
    thread = threading.Thread(target=lambda: btcheck.check(ENDLESS, cancel=ends))
    thread.start()
    try:
        for _ in range(5):
            with multiprocessing.get_context("fork").Pool(1) as pool:
                assert pool.apply_async(in_child, [1]).get(timeout=60)[0] == 3
    finally:
        ends.cancel()
        thread.join()


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_memory_stays_flat():
    def many(count):
        for _ in range(count):
            report = btcheck.check(SMALL, repairs=False)
            assert report.findings
        gc.collect()

    many(200)
    before = resident()
    many(400)
    # 400 reports that are not freed take 40 MB.
    assert resident() - before < 6 << 20
