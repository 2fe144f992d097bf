"""The HAL component of a screen that knows frames: what framekins says of the machine, and the answers to a preview.

Its inputs are linked to framekins. They are read without HAL's lock: a screen that is killed while it holds that would stop
every other process that wants it.
"""

import hal

from frame_map import Map, Point

NAME = "frame-preview"

LETTERS = "xyzabcuvw"
ROWS = ("xx", "xy", "xz", "x", "yx", "yy", "yz", "y", "zx", "zy", "zz", "z")

#: pins of the component: (framekins' pin of the same name, kind)
INPUTS = {"active": hal.HAL_BIT, "tool-centre-point-active": hal.HAL_BIT,
          **{f"frame.{name}": hal.HAL_FLOAT for name in ROWS},
          **{f"position.{letter}": hal.HAL_FLOAT for letter in LETTERS},
          **{f"turned-tool.{letter}": hal.HAL_FLOAT for letter in LETTERS[:3]}}


#: how often a position is read until it is of one moment; a servo period is much longer than that takes
TRIES = 5


class FrameState:
    """The machine's frame, as HAL has it now. Lengths in machine units."""

    def __init__(self):
        """Makes the component. RuntimeError with what is to be done if that cannot be."""
        try:
            self.pins = hal.component(NAME)
        except hal.error as error:
            raise RuntimeError(f"HAL has a component {NAME} already: let only one screen follow frames") from error
        if "framekins.turned-tool.z" not in {pin["NAME"] for pin in hal.get_info_pins()}:
            self.pins.exit()
            raise RuntimeError("framekins is not loaded, or older than this screen's file for frames: write [KINS]KINEMATICS = "
                               "framekins coordinates=.., and install both from one version of framepath")
        for name, kind in INPUTS.items():
            self.pins.newpin(name, kind, hal.HAL_IN)
        self.pins.newpin("answer", hal.HAL_BIT, hal.HAL_OUT)
        for letter in LETTERS[:3]:
            self.pins.newpin(letter, hal.HAL_FLOAT, hal.HAL_OUT)
        self._link()
        self.pins.ready()

    def _link(self):
        signals = hal.get_info_signals()
        known = {signal["NAME"] for signal in signals}
        # a HAL file may have linked some of them for a panel
        linked = {signal["DRIVER"]: signal["NAME"] for signal in signals}
        for name, kind in INPUTS.items():
            theirs = f"framekins.{name}"
            signal = linked.get(theirs) or f"{NAME}-{name}"
            if signal not in known:
                hal.new_sig(signal, kind)
            if theirs not in linked:
                hal.connect(theirs, signal)
            hal.connect(f"{NAME}.{name}", signal)

    def answer(self, position: Point | None):
        """Tells o<frame_send> of a preview at which world position the program is; None: it has been heard."""
        for letter, value in zip(LETTERS, position or (), strict=False):
            self.pins[letter] = value
        self.pins["answer"] = position is not None

    @property
    def active(self) -> bool:
        """A frame is in force."""
        return self.pins["active"]

    @property
    def tool_centre_point(self) -> bool:
        """X Y Z are coordinates of the workpiece on a turning table."""
        return self.pins["tool-centre-point-active"]

    def frame(self) -> Map:
        """From the tip of the tool without the frame to where it is."""
        values = [self.pins[f"frame.{name}"] for name in ROWS]
        return [values[0:4], values[4:8], values[8:12]]

    def position(self) -> tuple[float, ...]:
        """The machine's nine axes behind the frame."""
        return tuple(self.pins[f"position.{letter}"] for letter in LETTERS)

    def tip(self) -> tuple[float, ...]:
        """The tip of the tool with the frame, and the six other axes."""
        # the machine goes on while they are read one by one
        for _ in range(TRIES):
            position, tool = self.position(), self._tool()
            if (position, tool) == (self.position(), self._tool()):
                break
        return (*(axis - part for axis, part in zip(position, tool, strict=False)), *position[3:])

    def _tool(self) -> Point:
        """From the tip of the tool to the axes."""
        return tuple(self.pins[f"turned-tool.{letter}"] for letter in LETTERS[:3])  # type: ignore[return-value]


def k2() -> bool:
    """[FRAMEPATH]ROTS_CONVENTION, as frame_guard shows it."""
    return bool(hal.get_value("frame-guard.rots-convention"))
