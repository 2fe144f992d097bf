"""Servo periods from a tenth of a millisecond to ten of them."""

from fault import PERIOD, Fault, Peaks, operated, require, trial_was_right, without_failure
from rows_motion import SHAPES

SECTION = "Servo period"
NANOSECONDS = 1e9
#: ms
PERIODS = (0.1, 0.25, 0.5, 1, 2, 5, 10)


class Period(Fault):
    """Programs of blends, arcs and dense code run to their ends within all limits, without an error"""

    section = SECTION
    period = PERIOD

    def run(self):
        steps = []
        for name in ("blends", "arcs", "dense"):
            steps += [["run", f"PROGRAMS/{name}.ngc"], ["note", name]]
        result = operated([*steps, ["run", "PROGRAMS/trial.ngc"], ["note", "trial"]],
                          {f"{name}.ngc": text for name, (text, _) in SHAPES.items()},
                          ini={("EMCMOT", "SERVO_PERIOD"): round(self.period * NANOSECONDS),
                               ("TASK", "CYCLE_TIME"): max(self.period, PERIOD)})
        without_failure(result)
        require(not result.errors, f"LinuxCNC says: {result.errors[:1]}")
        trial_was_right(result)
        return f"{Peaks(result, period=self.period).require()}"


ROWS = [type(f"Period_{period}".replace(".", "_"), (Period,),
             {"__doc__": Period.__doc__, "done": f"`[EMCMOT]SERVO_PERIOD` of {period} ms", "period": period * 1e-3})
        for period in PERIODS]
