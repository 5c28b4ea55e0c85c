"""An external method for the tests of the report that stands still and calls that a success:

    odd_method.py [TICK [STEP]]

At the step of TICK, if one is given, it is killed by a signal; or it moves its first joint by STEP, if that is given too.
"""
import json
import os
import signal
import sys

TICK = int(sys.argv[1]) if len(sys.argv) > 1 else None
STEP = float(sys.argv[2]) if len(sys.argv) > 2 else None

for line in sys.stdin:
    request = json.loads(line)
    if request["request"] == "describe":
        answer = {"protocol": "bqsa-method/1", "kind": "reactive", "summary": "stands still", "source": "tests",
                  "capabilities": {"planar": True, "spatial": True, "prismatic": True, "link_radius": True,
                                   "margin": True}}
    elif request["request"] == "prepare":
        answer = {}
    elif request["request"] == "step":
        if request["tick"] == TICK:
            if STEP is None:
                os.kill(os.getpid(), signal.SIGSEGV)
            request["q"][0] += STEP
        answer = {"tick": request["tick"], "q": request["q"], "state": "free"}
    else:
        break
    print(json.dumps(answer), flush=True)
