"""Frames in AXIS. `install` replaces some of AXIS's own names; frame_axis.py calls it."""

from frame_canon import framed
from frame_window import FrameWindow, follow

#: ms until AXIS is up, behind which a program that it has opened by itself is read again
UP = 200


def install(axis):
    """Makes AXIS follow frames. axis: its global names. None if that cannot be, and the operator was told why."""
    found = follow(axis["inifile"], lambda text: axis["notifications"].add("error", text))
    return found and AxisFrames(axis, *found)


class AxisFrames(FrameWindow):
    """AXIS's window with frames."""

    def __init__(self, axis, state, rules):
        super().__init__(axis["o"], state, axis["inifile"])
        self.axis = axis
        #: the program that AXIS opens by itself has been read again
        self.is_up = False
        axis["AxisCanon"] = framed(axis["AxisCanon"], rules)
        axis["soft_limits"] = self.soft_limits
        self.stock_warning = axis["run_warn"]
        axis["run_warn"] = self.run_warn
        if not axis["foam"]:
            plotter = axis["live_plotter"]
            plotter.logger = self.replace_trail(plotter.logger, axis["geometry"])
        axis["root_window"].after(UP, self.read_again)

    def read_again(self):
        """AXIS has opened a program before it knew of frames."""
        if self.axis["running"]():
            # AXIS reads none while one runs
            self.axis["root_window"].after(UP, self.read_again)
            return
        # what a filter has refused was said once, and there is nothing to read
        if self.window.canon:
            if self.axis["loaded_file"]:
                self.axis["reload_file"](False)
            else:
                # 2.10 does not know by name what it has opened by itself; LinuxCNC has it as it was translated
                self.window.stat.poll()
                self.axis["open_file_guts"](self.window.stat.file, True, False)
            self.centre()
        self.is_up = True

    def centre(self):
        """Shows all of the program."""
        canon = self.window.canon
        if canon and not self.axis["lathe"]:
            ends = zip(canon.min_extents, canon.max_extents, strict=True)
            self.window.set_centerpoint(*((least + greatest) / 2 for least, greatest in ends))
            self.axis["commands"].set_view_p()

    def run_warn(self):
        """Asks whether a program is to be run although it goes beyond a limit. 0: it is."""
        texts = self.warnings()
        if texts is None:
            return self.stock_warning()
        if not texts:
            return 0
        return int(self.axis["root_window"].tk.call(
            "nf_dialog", ".error", "Program exceeds machine limits", "\n".join(texts), "warning", 1, "Run Anyway", "Cancel"))
