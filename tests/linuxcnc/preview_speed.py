#!/usr/bin/python3
"""How long a preview takes to load with the hook, over the time without it: 100,000 lines, both in turn in one run."""

import harness

LINES = 100_000
TIMES = 5

CASES = {"no frame": (), "a frame": ("o<trans> call [1] [2] [3]", "o<arot> call [15] [20] [30]")}


def lines(frames):
    moves = [f"X{number % 97}.{number % 89:03} Y{number % 83}.5 Z{number % 7}" for number in range(LINES)]
    return "\n".join(["G21 G61.1 G17 G90 G94 G54 F500", *frames, "G1 X0", *moves, "M2"]) + "\n"


def measure(frames):
    """Seconds of the processor without the hook, and with it, in turn: [(without, with), ..]."""
    result = harness.run([["time_previews", "seconds", "PROGRAMS/part.ngc", TIMES]], {"part.ngc": lines(frames)},
                         display="preview_driver.py", files=("preview_driver.py", "canon_moves.py"), record=False)
    if result.failure:
        raise RuntimeError(result.failure)
    return [tuple(pair) for pair in result.answers["seconds"]]


def main():
    for name, frames in CASES.items():
        stock, hook = (min(column) for column in zip(*measure(frames), strict=True))
        print(f"{name}: {stock:.3f} s without the hook, {hook:.3f} s with it, {hook / stock:.3f}")


if __name__ == "__main__":
    main()
