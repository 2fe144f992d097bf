"""Frames in AXIS. `install` replaces some of AXIS's own names; frame_axis.py calls it."""

import threading

import frame_state
from frame_canon import FrameRules, framed
from frame_commands import work_map
from frame_display import MachineStatus, describe, joints_of_axes
from frame_limits import exceeded, joint_limits
from frame_map import product
from frame_screen import turns_tool
from frame_trail import FrameTrail
from frame_triad import draw_triad

#: AXIS draws in inches
MM_PER_INCH = 25.4

#: s between two points of the live plot
TRAIL_PERIOD = 0.01

#: the colours of AXIS in the order of motion's types of motion
COLOURS = ("jog", "traverse", "feed", "arc", "toolchange", "probing")

#: inches: a triad of the program, and that of the frame in force
PROGRAM_TRIAD, ACTIVE_TRIAD = 0.35, 0.6

#: ms until AXIS is up, behind which a program that it has opened by itself is read again
UP = 200


def install(axis):
    """Makes AXIS follow frames. axis: its global names. None if that cannot be, and the operator was told why."""
    try:
        state = frame_state.FrameState()
        rules = FrameRules(frame_state.k2(), lambda: turns_tool(state, axis["inifile"]), state.answer,
                           lambda text: axis["notifications"].add("error", text))
    except RuntimeError as error:
        axis["notifications"].add("error", f"framepath: no frames are drawn: {error}")
        return None
    return AxisFrames(axis, state, rules)


class AxisFrames:
    """AXIS's window with frames."""

    def __init__(self, axis, state, rules):
        self.axis = axis
        self.state = state
        self.window = axis["o"]
        self.joints = joints_of_axes(axis["inifile"])
        #: the program that AXIS opens by itself has been read again
        self.is_up = False
        axis["AxisCanon"] = framed(axis["AxisCanon"], rules)
        self.stock_limits = axis["soft_limits"]
        axis["soft_limits"] = self.window.soft_limits = self.soft_limits
        self.stock_warning = axis["run_warn"]
        axis["run_warn"] = self.run_warn
        self.stock_positions = self.window.posstrs
        self.window.posstrs = self.positions
        self.stock_plot = getattr(self.window, "user_plot", None)
        self.window.user_plot = self.plot
        if not axis["foam"]:
            self.replace_trail()
        axis["root_window"].after(UP, self.read_again)

    def read_again(self):
        """AXIS has opened a program before it knew of frames."""
        if self.axis["running"]():
            # AXIS reads none while one runs
            self.axis["root_window"].after(UP, self.read_again)
            return
        # what a filter has refused was said once, and there is nothing to read
        if self.axis["loaded_file"] and self.window.canon:
            self.axis["reload_file"](False)
            self.centre()
        self.is_up = True

    def centre(self):
        """Shows all of the program."""
        canon = self.window.canon
        if canon and not self.axis["lathe"]:
            ends = zip(canon.min_extents, canon.max_extents, strict=True)
            self.window.set_centerpoint(*((least + greatest) / 2 for least, greatest in ends))
            self.axis["commands"].set_view_p()

    def inches(self) -> float:
        """Inches in a machine unit."""
        return 1 / (MM_PER_INCH * (self.window.stat.linear_units or 1))

    def replace_trail(self):
        """The live plot goes on behind the frame."""
        plotter, colours = self.axis["live_plotter"], self.window.colors
        shades = [[int(part * 255) for part in (*colours[f"backplot{name}"], colours[f"backplot{name}_alpha"])]
                  for name in COLOURS]
        trail = FrameTrail(self.look, shades, self.axis["geometry"])
        plotter.logger.stop()
        plotter.logger = self.window.lp = trail
        self.status = self.axis["linuxcnc"].stat()
        # AXIS itself starts the plot when its window is up: whoever is second does nothing
        threading.Thread(target=trail.start, args=(TRAIL_PERIOD,), daemon=True).start()

    def look(self):
        """What the live plot wants to know."""
        try:
            self.status.poll()
        except self.axis["linuxcnc"].error:
            return None
        return self.state.tip(), self.status.motion_type

    def machine_differs(self) -> bool:
        """LinuxCNC's positions are not those of the machine's axes."""
        return self.state.active or self.state.tool_centre_point

    def positions(self):
        """AXIS's position display. Relative positions are those of the program with its frame as they are."""
        window, status = self.window, self.window.stat
        if self.machine_differs() and not window.get_show_relative():
            window.stat = MachineStatus(status, self.joints)
        try:
            limit, homed, positions, offsets = self.stock_positions()
        finally:
            window.stat = status
        if self.state.active:
            unit = self.inches() * (MM_PER_INCH if window.get_show_metric() else 1)
            line = describe(self.state.frame(), self.work(status), unit)
            positions, offsets = [*positions, line], [*offsets, line]
        return limit, homed, positions, offsets

    def work(self, status):
        """The work offset in force, in machine units."""
        return work_map(status.g5x_offset[:3], status.rotation_xy, status.g92_offset[:3])

    def plot(self):
        """The triads of the frames."""
        window, canon = self.window, self.window.canon
        letters = window.dlist(("axes", window.get_view()), gen=window.draw_axes)
        if canon and window.get_show_program():
            for axes in getattr(canon, "frames_seen", ()):
                draw_triad(axes, PROGRAM_TRIAD, letters)
        if self.state.active:
            axes = product(self.state.frame(), self.work(window.stat))
            draw_triad([[*row[:3], row[3] * self.inches()] for row in axes], ACTIVE_TRIAD, letters)
        if self.stock_plot:
            self.stock_plot()

    def soft_limits(self):
        """The box of the machine: the ends of its joints. Those of the axes hold in the coordinates of a frame."""
        limits = joint_limits(self.axis["s"], self.joints)
        if limits is None or self.state.tool_centre_point:
            return self.stock_limits()
        return tuple([value * self.inches() for value in side] for side in limits)

    def warnings(self):
        """A sentence for each limit of a joint that the program exceeds; None where the table turns the axes."""
        limits = joint_limits(self.axis["s"], self.joints)
        canon = self.window.canon
        if canon is None or limits is None or self.state.tool_centre_point:
            return None
        return exceeded(canon.frame_reach(), limits, self.inches())

    def run_warn(self):
        """Asks whether a program is to be run although it goes beyond a limit. 0: it is."""
        texts = self.warnings()
        if texts is None:
            return self.stock_warning()
        if not texts:
            return 0
        return int(self.axis["root_window"].tk.call(
            "nf_dialog", ".error", "Program exceeds machine limits", "\n".join(texts), "warning", 1, "Run Anyway", "Cancel"))
