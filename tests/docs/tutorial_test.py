"""Follows a tutorial in an empty directory: writes its files (a block after a line "File `NAME`:"), runs its commands (blocks of bash),
and looks for every line of the block of text after them in what they print."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"(?:^File `(?P<file>[^`]+)`:\n\n)?^```(?P<kind>\w+)\n(?P<body>.*?)^```$", re.M | re.S)


def main() -> int:
    blocks = list(BLOCK.finditer(pathlib.Path(sys.argv[1]).read_text()))
    program = pathlib.Path(os.environ["BQSA_BENCH"])
    environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}")
    commands = 0
    expected = 0
    with tempfile.TemporaryDirectory() as directory:
        printed = ""
        for block in blocks:
            body = block["body"]
            if block["file"]:
                (pathlib.Path(directory) / block["file"]).write_text(body)
            elif block["kind"] == "bash":
                done = subprocess.run(["bash", "-euc", body], cwd=directory, env=environment, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
                printed = done.stdout
                commands += 1
                if done.returncode != 0:
                    print(f"{body}status {done.returncode}:\n{printed}")
                    return 1
            else:
                for line in body.splitlines():
                    expected += 1
                    if line not in printed:
                        print(f"expected {line!r} in\n{printed}")
                        return 1
    if commands < 6 or expected < 10:
        print(f"expected a tutorial, got {commands} commands and {expected} lines of what they print")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
