"""An external method that moves a two-link arm as the quiet scenario of the tests asks for, and does
one thing wrong:

    faulty_method.py FAULT PLACE [MARK]

PLACE is the request at which it does: describe, prepare, step (of tick 4), plan, or start, before any
request. If MARK is given, it behaves the first time it is started, and leaves a file there.
"""
import json
import math
import mmap
import os
import signal
import sys
import time

TICK = 4
FOREVER = 300  # seconds: longer than any limit, and nothing is left for long if a test is broken off


def say(answer):
    print(json.dumps(answer), flush=True)


def say_raw(text):
    sys.stdout.write(text)
    sys.stdout.flush()


def description():
    return {"protocol": "bqsa-method/1", "kind": "planning" if PLACE == "plan" else "reactive",
            "summary": "for tests", "source": "tests", "capabilities": {"planar": True}}


def motion(t):
    return [0.6 * t, 0.5]


def changed(answer, **changes):
    answer = dict(answer, **changes)
    return {key: value for key, value in answer.items() if value != "left out"}


def spin(seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        pass


def spin_in_others(leave):
    """Starts processes, in sessions of their own, that work until they are killed; if `leave`, orphans."""
    for _ in range(16):
        if os.fork() == 0:
            os.setsid()
            if leave and os.fork() != 0:
                os._exit(0)
            spin(30)
            os._exit(0)


def grow(in_child):
    if in_child and os.fork() != 0:
        time.sleep(FOREVER)
    kept = []
    for _ in range(250):
        kept.append(b"x" * (4 << 20))
        time.sleep(0.002)
    time.sleep(FOREVER)


def flood_stderr(answer):
    for _ in range(100):
        sys.stderr.write("noise " * 1000 + "\n")
    say(answer)


def endless_line(_):
    while True:
        say_raw("x" * 65536)


def die(how):
    sys.stderr.write("some line\nthe elbow fell off\n")
    sys.stderr.flush()
    how()


def late(answer, seconds):
    time.sleep(seconds)
    say(answer)


def close_stdout(_):
    os.close(1)
    time.sleep(FOREVER)


def reserve_memory(answer):
    reserved = mmap.mmap(-1, 1 << 32)  # address space that is not resident
    say(answer)
    reserved.close()


FAULTS = {
    "none": say,
    "garbage": lambda _: say_raw("hello\n"),
    "binary": lambda _: say_raw("\x07\x1b[31m\n"),
    "a_list": lambda _: say([1, 2]),
    "other_tick": lambda answer: say(changed(answer, tick=5)),
    "missing_key": lambda answer: say(changed(answer, q="left out")),
    "wrong_type": lambda answer: say(changed(answer, q="straight on")),
    "three_joints": lambda answer: say(changed(answer, q=[0, 0, 0])),
    "null": lambda answer: say(changed(answer, q=[None, 0.5])),
    "not_a_number": lambda answer: say(changed(answer, q=[math.nan, 0.5])),
    "text_for_number": lambda answer: say(changed(answer, q=["0.1", 0.5])),
    "unknown_key": lambda answer: say(changed(answer, Q=[0, 0])),
    "unknown_state": lambda answer: say(changed(answer, state="fine")),
    "fails": lambda _: say({"error": "lost my way"}),
    "exits": lambda _: die(lambda: os._exit(3)),
    "killed": lambda _: die(lambda: os.kill(os.getpid(), signal.SIGSEGV)),
    "closes_stdout": close_stdout,
    "closes_stdin": lambda answer: (os.close(0), say(answer), time.sleep(FOREVER)),
    "hangs": lambda _: time.sleep(FOREVER),
    "late": lambda answer: late(answer, 1.5),
    "floods_stderr": flood_stderr,
    "endless_line": endless_line,
    "long_line": lambda _: say_raw("x" * 100_000_000 + "\n"),
    "two_lines": lambda answer: say_raw(json.dumps(answer) + "\n" + json.dumps(answer) + "\n"),
    "two_lines_apart": lambda answer: (say(answer), time.sleep(0.1), say(answer)),
    "other_protocol": lambda answer: say(changed(answer, protocol="bqsa-method/2")),
    "other_kind": lambda answer: say(changed(answer, kind="telepathic")),
    "works_alone": lambda answer: (spin(0.5), say(answer)),
    "works_in_others": lambda answer: (spin_in_others(leave=False), spin(1.0), say(answer)),
    "works_in_orphans": lambda answer: (spin_in_others(leave=True), time.sleep(1.0), say(answer)),
    "grows": lambda _: grow(in_child=False),
    "grows_in_child": lambda _: grow(in_child=True),
    "reserves_memory": reserve_memory,
}

FAULT, PLACE = sys.argv[1], sys.argv[2]


def behaves():
    if len(sys.argv) < 4:
        return False
    first = not os.path.exists(sys.argv[3])
    with open(sys.argv[3], "a", encoding="ascii") as mark:
        mark.write(f"{os.getpid()}\n")
    return first


def main():
    fault = say if behaves() else FAULTS[FAULT]
    if PLACE == "start" and fault is not say:
        fault({})
    problem = None
    for line in sys.stdin:
        request = json.loads(line)
        kind = request["request"]
        if kind == "describe":
            answer = description()
        elif kind == "prepare":
            problem, answer = request["problem"], {}
        elif kind == "step":
            answer = {"tick": request["tick"], "q": motion(request["t"]), "state": "free"}
        elif kind == "plan":
            times = [k * problem["dt"] for k in range(problem["ticks"] + 1)]
            answer = {"solved": True, "trajectory": {"t": times, "q": [motion(t) for t in times]}}
        else:
            break
        here = kind == PLACE and request.get("tick", TICK) == TICK
        (fault if here else say)(answer)


main()
