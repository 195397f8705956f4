"""Runs a test program's tests in several processes side by side.

    run_shards.py COUNT PROGRAM arguments...

Each process gets its share by GoogleTest's sharding. What they print follows one after the other; the exit code is the
largest of theirs.
"""

import os
import subprocess
import sys
import tempfile


def main():
    count, command = int(sys.argv[1]), sys.argv[2:]
    running = []
    for index in range(count):
        environment = dict(os.environ, GTEST_TOTAL_SHARDS=str(count), GTEST_SHARD_INDEX=str(index))
        output = tempfile.TemporaryFile()
        running.append((subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.STDOUT), output))
    codes = []
    for process, output in running:
        codes.append(abs(process.wait()))
        output.seek(0)
        sys.stdout.buffer.write(output.read())
        sys.stdout.buffer.flush()
    return max(codes)


if __name__ == "__main__":
    sys.exit(main())
