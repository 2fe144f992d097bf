"""[DISPLAY]USER_COMMAND_FILE of AXIS in tests: what users have, and answers to the questions of screen_driver.py."""

import json
import os
import sys
import traceback

sys.path.insert(0, os.path.abspath("../../preview"))

import axis_frames

AXIS = globals()

#: ms between two looks for a question
PERIOD = 20

QUESTION, ANSWER = "question.json", "answer.json"


class Probe:
    """One method for each question."""

    def __init__(self, frames):
        self.frames = frames
        #: what the operator was told
        self.told: list[str] = []
        self.stock_add = AXIS["notifications"].add
        AXIS["notifications"].add = self.tell

    def tell(self, kind, text):
        self.told.append(text)
        self.stock_add(kind, text)

    def open(self, program):
        """Opens a program."""
        AXIS["open_file_guts"](program, False, False)
        return self.drawn()

    def drawn(self):
        """The places of the preview in millimetres, where the axes are."""
        canon = AXIS["o"].canon
        return [[25.4 * (place + tool) for place, tool in zip(end[:3], rest[-1], strict=True)]
                for moves in (canon.traverse, canon.feed, canon.arcfeed) for _, _, end, *rest in moves]

    def trail(self):
        """The points of the live plot."""
        return AXIS["o"].lp.points[:AXIS["o"].lp.npts].tolist()

    def display(self, relative):
        """The lines of the position display."""
        AXIS["vars"].coord_type.set(relative)
        AXIS["vars"].metric.set(1)
        AXIS["o"].stat.poll()
        return AXIS["o"].posstrs()[2]

    def warned(self):
        """What AXIS says before it runs the program."""
        return self.frames.warnings()

    def notes(self):
        """What the operator was told."""
        return self.told


def look(probe):
    """Answers a question."""
    if probe.frames.is_up and os.path.exists(QUESTION):
        with open(QUESTION, encoding="utf-8") as file:
            question, *arguments = json.load(file)
        os.remove(QUESTION)
        try:
            answer = {"answer": getattr(probe, question)(*arguments)}
        except Exception:
            answer = {"error": traceback.format_exc()}
        with open(f"{ANSWER}.new", "w", encoding="utf-8") as file:
            json.dump(answer, file)
        os.replace(f"{ANSWER}.new", ANSWER)
    AXIS["root_window"].after(PERIOD, lambda: look(probe))


FRAMES = axis_frames.install(AXIS)
PROBE = Probe(FRAMES)
AXIS["root_window"].after(PERIOD, lambda: look(PROBE))
