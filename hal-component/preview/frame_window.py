"""A window with a preview that follows frames: what AXIS, gmoccapy and the screens of qtvcp have in common.

All of them draw by rs274.glcanon.GlCanonDraw.
"""

import importlib
import threading

import linuxcnc

import frame_state
from frame_canon import FrameRules
from frame_commands import work_map
from frame_display import MachineStatus, axis_positions, describe, joints_of_axes
from frame_limits import exceeded, joint_limits
from frame_map import product
from frame_screen import turns_tool
from frame_text import fitting
from frame_trail import FrameTrail

MM_PER_INCH = 25.4

#: s between two points of the live plot
TRAIL_PERIOD = 0.01

#: inches: a triad of the program, and that of the frame in force
PROGRAM_TRIAD, ACTIVE_TRIAD = 0.35, 0.6


def follow(ini, tell):
    """The state of the machine's frame, and what a preview has to know. ini: LinuxCNC's INI file, linuxcnc.ini. tell(text):
    tells the operator. None, and the operator was told why, if frames cannot be followed."""
    try:
        state = frame_state.FrameState()
        return state, FrameRules(frame_state.k2(), lambda: turns_tool(state, ini), state.answer, tell)
    except RuntimeError as error:
        tell(f"framepath: no frames are drawn: {error}")
        return None


class FrameWindow:
    """A window that follows frames."""

    def __init__(self, window, state, ini):
        """window: of the screen. state: frame_state.FrameState. ini: LinuxCNC's INI file, linuxcnc.ini."""
        self.window = window
        self.state = state
        self.joints = joints_of_axes(ini)
        self.stock_limits = window.soft_limits
        window.soft_limits = self.soft_limits
        self.stock_positions = window.posstrs
        window.posstrs = self.positions
        # 2.9 and 2.10 draw by other means, which each of them alone has
        self.drawing = importlib.import_module("frame_scene" if hasattr(window, "frame_context") else "frame_lists")
        self.stock_plot = getattr(window, "user_plot", None)
        window.user_plot = self.plot

    def inches(self) -> float:
        """Inches in a machine unit: all windows draw in inches."""
        return 1 / (MM_PER_INCH * (self.window.stat.linear_units or 1))

    def replace_trail(self, stock, geometry: str):
        """The live plot that goes on behind the frame, in place of LinuxCNC's own."""
        stock.stop()
        trail = self.window.lp = FrameTrail(self.look, stock.get_colors(), geometry)
        self.status = linuxcnc.stat()
        # a screen that starts the plot itself when its window is up does nothing then
        threading.Thread(target=trail.start, args=(TRAIL_PERIOD,), daemon=True).start()
        return trail

    def look(self):
        """What the live plot wants to know."""
        try:
            self.status.poll()
        except linuxcnc.error:
            return None
        return self.state.tip(), self.status.motion_type

    def machine_differs(self) -> bool:
        """LinuxCNC's positions are not those of the machine's axes."""
        return self.state.active or self.state.tool_centre_point

    def machine_position(self, status, position):
        """Where the machine's own axes are, for a screen that shows `position` of LinuxCNC's status."""
        if not self.machine_differs():
            return position
        return axis_positions(position, status.joint_actual_position, self.joints)

    def shows_joints(self) -> bool:
        """The position display is one of joints, in which a line without a number of a joint has no place."""
        return bool(self.window.get_joints_mode() and not self.window.no_joint_display)

    def positions(self):
        """The position display. Relative positions are those of the program with its frame as they are."""
        window, status = self.window, self.window.stat
        if self.machine_differs() and not window.get_show_relative():
            window.stat = MachineStatus(status, self.joints)
        try:
            limit, homed, positions, offsets = self.stock_positions()
        finally:
            window.stat = status
        if self.state.active and not self.shows_joints():
            lines = fitting(window, self.line())
            positions, offsets = [*positions, *lines], [*offsets, *lines]
        return limit, homed, positions, offsets

    def line(self) -> str:
        """The frame in force, in the units of the display."""
        unit = self.inches() * (MM_PER_INCH if self.window.get_show_metric() else 1)
        return describe(self.state.frame(), self.work(), unit)

    def work(self):
        """The work offset in force, in machine units."""
        status = self.window.stat
        return work_map(status.g5x_offset[:3], status.rotation_xy, status.g92_offset[:3])

    def plot(self):
        """The triads of the frames, and which of them is in force where no position display says so."""
        window, canon = self.window, self.window.canon
        if canon and window.get_show_program():
            for axes in getattr(canon, "frames_seen", ()):
                self.drawing.draw_triad(window, axes, PROGRAM_TRIAD)
        if self.state.active:
            axes = product(self.state.frame(), self.work())
            self.drawing.draw_triad(window, [[*row[:3], row[3] * self.inches()] for row in axes], ACTIVE_TRIAD)
            if self.shows_joints() or not window.enable_dro:
                self.drawing.draw_text(window, self.line())
        if self.stock_plot:
            self.stock_plot()

    def soft_limits(self):
        """The box of the machine: the ends of its joints. Those of the axes hold in the coordinates of a frame."""
        limits = joint_limits(self.window.stat, self.joints)
        if limits is None or self.state.tool_centre_point:
            return self.stock_limits()
        return tuple([value * self.inches() for value in side] for side in limits)

    def warnings(self):
        """A sentence for each limit of a joint that the program exceeds; None where the table turns the axes."""
        limits = joint_limits(self.window.stat, self.joints)
        canon = self.window.canon
        if canon is None or limits is None or self.state.tool_centre_point:
            return None
        return exceeded(canon.frame_reach(), limits, self.inches())
