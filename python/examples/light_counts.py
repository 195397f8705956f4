"""A sweep of light counts: what a frame of each technique costs as a scene gets more lights, as a table of CSV.

    ./run python python/examples/light_counts.py SCENE TABLE.csv [COUNT ...]
"""

import csv
import sys
import time

import tessera

TECHNIQUES = ["forward", "deferred", "tiled_deferred", "clustered_forward"]


def millisecondsOf(scene, technique, frames=5):
    """The median of some frames, read back, without the first, which prepares programs and lists."""
    took = []
    for _ in range(frames + 1):
        begin = time.perf_counter()
        picture = tessera.render(scene, technique=technique)
        took.append(1000 * (time.perf_counter() - begin))
    return sorted(took[1:])[frames // 2], picture


def main():
    name, path, *counts = sys.argv[1:]
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["lights", *TECHNIQUES, "mean radiance"])
        for count in map(int, counts or [16, 64, 256]):
            scene = tessera.load(name, lights=count, size=(320, 180))
            results = [millisecondsOf(scene, technique) for technique in TECHNIQUES]
            # All techniques render the same image, so the last one's mean stands for all.
            row = [count, *(round(ms, 2) for ms, _ in results), float(results[-1][1].rgb.mean())]
            table.writerow(row)
            print(*row, sep="\t")


if __name__ == "__main__":
    main()
