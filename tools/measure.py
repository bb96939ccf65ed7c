#!/usr/bin/env python3
"""measure.py COMMAND...: runs it without its output and prints its processor seconds, with those of all processes that it starts, the seconds by
the clock, and the MB of the largest of these processes. Where the command fails, what it printed."""
import resource
import subprocess
import sys
import tempfile
import time

with tempfile.TemporaryFile() as output:
    start = time.monotonic()
    done = subprocess.run(sys.argv[1:], stdin=sys.stdin, stdout=output, stderr=subprocess.STDOUT)
    took = time.monotonic() - start
    if done.returncode != 0:
        output.seek(0)
        sys.exit(output.read().decode(errors="replace"))
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"{used.ru_utime + used.ru_stime:.2f} {took:.2f} {used.ru_maxrss / 1024:.0f}")
