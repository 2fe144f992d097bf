"""LinuxCNC's processes are killed and stopped while a program runs."""

from fault import (
    HEAD,
    OFF,
    TOLERANCE,
    Fault,
    Peaks,
    at_rest_from,
    from_route,
    operated,
    recovered,
    require,
    said,
    trial_was_right,
    without_failure,
)

SECTION = "Processes"
#: Some seconds of corners, and few enough that all of them are queued.
POINTS = [(12.0 * n, 8.0 * (n % 2), 0.0) for n in range(1, 25)]
LONG = "\n".join([HEAD, *(f"G1 X{x} Y{y}" for x, y, _ in POINTS), "M2"]) + "\n"
#: The same in a frame: what is programmed as X is Y of the machine.
TURNED = [(-y, x, 0.0) for x, y, _ in POINTS]
FRAMED = "\n".join([HEAD, "o<rot> call [0] [0] [90]", *(f"G1 X{x} Y{y}" for x, y, _ in POINTS), "M2"]) + "\n"
PROGRAMS = {"long.ngc": LONG, "framed.ngc": FRAMED}
START = [["start", "PROGRAMS/long.ngc"], ["wait_moving"], ["sleep", 1.0]]
START_IN_FRAME = [["start", "PROGRAMS/framed.ngc"], ["expect", "framekins.active", "TRUE"], ["wait_moving"], ["sleep", 1.0]]
NEXT = [["run", "PROGRAMS/trial.ngc"], ["note", "trial"]]
#: Seconds within which a machine in a frame is at rest once its guard does not live any more.
GUARDED_WITHIN = 2.0


def on_its_path(result, points=POINTS, until=None):
    """That X Y Z of the joints stayed on the route."""
    places = list(zip(*(result.commanded(joint)[:until] for joint in range(3)), strict=True))
    off = from_route(places, [(0.0, 0.0, 0.0), *points])
    require(off <= TOLERANCE + OFF, f"{off:.3f} mm off the path")
    return f"{off:.3f} mm off the program"


class ProcessFault(Fault):
    section = SECTION


class Suspended(ProcessFault):
    """The program goes on within all limits, on its path, and comes to its end; the next one is right"""

    who, seconds = "", 2.0

    def run(self):
        result = operated([*START, ["suspend", self.who, self.seconds], ["sleep", 0.5], ["finish", 60], ["note", "end"], *NEXT],
                          PROGRAMS)
        without_failure(result)
        require(not result.errors, f"LinuxCNC says: {result.errors[:1]}")
        trial_was_right(result)
        require(abs(result.answers["end"]["joints"][0] - POINTS[-1][0]) < 1e-6, "the program did not come to its end")
        return f"{Peaks(result).require()}"


class TaskStopped(Suspended):
    __doc__ = Suspended.__doc__
    done = "`kill -STOP` of task (milltask) in a program, 2 s later `-CONT`"
    who = "task"


class IoStopped(Suspended):
    __doc__ = Suspended.__doc__
    done = "`kill -STOP` of io in a program, 2 s later `-CONT`"
    who = "io"


class GuiStopped(Suspended):
    __doc__ = Suspended.__doc__
    done = "`kill -STOP` of the GUI in a program, 2 s later `-CONT`"
    who = "GUI"


class Killed(ProcessFault):
    """What is queued is run within all limits, on its path, to a rest; LinuxCNC ends in order, and starts again"""

    who = ""

    def run(self):
        result = operated([*START, ["kill", self.who], ["wait_for_rest"]], PROGRAMS)
        without_failure(result)
        peaks, off = Peaks(result).require(), on_its_path(result)
        recovered()
        return f"rest after {result.answers['rest']['seconds']:.1f} s, {peaks}, {off}"


class TaskKilled(Killed):
    __doc__ = Killed.__doc__
    done = "`kill -9` of task in a program"
    who = "task"


class IoKilled(Killed):
    __doc__ = Killed.__doc__
    done = "`kill -9` of io in a program"
    who = "io"


class GuiKilled(ProcessFault):
    """LinuxCNC ends, which turns the machine off: the joints stop where they are, on their path, and none jumps; it starts
    again"""

    done = "`kill -9` of the GUI in a program"

    def run(self):
        result = operated([*START, ["kill", "GUI"]], PROGRAMS)
        without_failure(result)
        # the last periods are cut off, so that the commands behind the interpolator are not known
        until = len(result.rows) - 50
        peaks, off = Peaks(result, until=until).require((0,)), on_its_path(result, until=until)
        recovered()
        return f"v {peaks.shares[0]:.3f}, {off}"


class GuardKilled(ProcessFault):
    """Within 2 s the machine is at rest on its path, within all limits; it says so; nothing moves in the frame from
    then on"""

    done = "`kill -9` of frame_guard in a program with a frame"

    def run(self):
        result = operated([*START_IN_FRAME, ["kill", "frame_guard"], ["wait_for_rest"], ["refused_mdi", "G0 X-5 Y-5"],
                           ["getp", "active", "framekins.active"]], PROGRAMS)
        without_failure(result)
        rest = result.answers["rest"]["seconds"]
        require(rest <= GUARDED_WITHIN, f"at rest after {rest:.1f} s")
        said(result, "guard")
        moved = result.answers["moved"]
        require(moved == 0 or result.answers["active"] == "FALSE", f"a joint moves by {moved:.3f} mm in the frame")
        peaks = Peaks(result).require()
        off = on_its_path(result, TURNED, at_rest_from(result))
        recovered()
        return f"rest after {rest:.2f} s, {peaks}, {off}"


class GuardStopped(ProcessFault):
    """The same; it switches the machine off, and when that is on again the next program is right"""

    done = "`kill -STOP` of frame_guard in a program with a frame, 4 s later `-CONT`"

    def run(self):
        result = operated([*START_IN_FRAME, ["suspend", "frame_guard", 4.0], ["wait_for_rest"], ["sleep", 4.5], ["abort"],
                           ["expect", "framekins.active", "FALSE"], ["sleep", 0.5], ["on"], *NEXT], PROGRAMS)
        without_failure(result)
        rest = result.answers["rest"]["seconds"]
        require(rest <= GUARDED_WITHIN, f"at rest after {rest:.1f} s")
        said(result, "guard")
        trial_was_right(result)
        return f"rest after {rest:.2f} s, {Peaks(result).require()}"


class GuardKilledAtRest(ProcessFault):
    """A line of MDI is not run in the frame; it says so"""

    done = "`kill -9` of frame_guard at rest, with a frame of MDI"

    def run(self):
        result = operated([["mdi", "G61 G21 G90 F3000"], ["mdi", "o<rot> call [0] [0] [90]"], ["kill", "frame_guard"],
                           ["sleep", 2.0], ["refused_mdi", "G1 X5"], ["getp", "active", "framekins.active"]], PROGRAMS)
        without_failure(result)
        moved = result.answers["moved"]
        require(moved == 0 or result.answers["active"] == "FALSE", f"a joint moves by {moved:.3f} mm in the frame")
        said(result, "guard")
        Peaks(result).require()
        return f"moved by {moved:.3g} mm"
