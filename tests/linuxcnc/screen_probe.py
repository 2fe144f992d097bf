"""What answers the questions of screen_driver.py within a screen. probe_axis.py and its siblings, each the
[DISPLAY]USER_COMMAND_FILE of its screen in tests, install what users have and hand it over."""

import json
import os
import traceback

from canon_moves import keep_moves

#: ms between two looks for a question
PERIOD = 20

QUESTION, ANSWER = "question.json", "answer.json"


class Probe:
    """One method for each question."""

    def __init__(self, window, read, show, may_run=lambda: True, panel=lambda: None):
        """window: frame_window.FrameWindow. read(program): opens a program. show(relative): X, Y and Z of the position
        display, in mm. may_run(): the machine is homed, and the screen knows it. panel(): brings the panel to the front."""
        self.frames = window
        self.window = window.window
        self.read = read
        self.show = show
        self.may_run = may_run
        #: answers None
        self.panel = panel
        keep_moves()
        #: what the operator was told, and what has gone wrong where screens say nothing
        self.told: list[str] = []
        #: how often frames and live plot have been drawn
        self.plots = 0
        self.watch(self.window, "user_plot")
        # 2.10 asks for the points of the live plot and draws them itself
        self.watch(self.window.lp, "points" if hasattr(self.window, "frame_context") else "call")

    def watch(self, of, name):
        """Screens swallow errors of what draws."""
        stock = getattr(of, name)

        def draw():
            try:
                drawn = stock()
                self.plots += 1
                return drawn
            except Exception:
                self.told.append(traceback.format_exc())
                raise

        setattr(of, name, draw)

    def open(self, program):
        """Opens a program."""
        self.read(program)
        return self.drawn()

    def drawn(self):
        """The places of the preview in millimetres, where the axes are."""
        return [[25.4 * (place + part) for place, part in zip(end[:3], tool, strict=True)]
                for _, _, _, end, tool in self.window.canon.kept_moves]

    def trail(self):
        """The points of the live plot."""
        return self.window.lp.places[:self.window.lp.npts].tolist()

    def display(self, relative):
        """The numbers of the position display, and the line that names the frame."""
        self.window.stat.poll()
        return [self.show(relative), self.frames.line()]

    def warned(self):
        """What the operator is told of limits."""
        return self.frames.warnings()

    def notes(self):
        """What the operator was told."""
        return self.told

    def plotted(self):
        """How often frames and live plot have been drawn."""
        return self.plots

    def ready(self):
        """Is answered when the screen lets a program run."""

    def look(self):
        """Answers a question, if there is one."""
        if not os.path.exists(QUESTION):
            return
        with open(QUESTION, encoding="utf-8") as file:
            question, *arguments = json.load(file)
        if question == "ready" and not self.may_run():
            return
        os.remove(QUESTION)
        try:
            answer = {"answer": getattr(self, question)(*arguments)}
        except Exception:
            answer = {"error": traceback.format_exc()}
        with open(f"{ANSWER}.new", "w", encoding="utf-8") as file:
            json.dump(answer, file)
        os.replace(f"{ANSWER}.new", ANSWER)
