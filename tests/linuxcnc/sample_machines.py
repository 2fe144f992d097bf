"""LinuxCNC's own sample configurations, as they are, and with framekins before their kinematics and blendtp in place of
their planner: a table of machines, what each is asked to do, and how their files are changed for it."""

import dataclasses
import os
import shutil
import tempfile

import harness
import inner_machine

SAMPLES = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis"
#: where LinuxCNC looks for HAL files that are not beside the INI file
LIBRARY = "/usr/share/linuxcnc/hallib"

#: signals of LIB:basic_sim.tcl, which is no HAL file that could be read here
BASIC_SIM = {"motion.motion-enabled": "sample:enable",
             **{f"joint.{n}.motor-pos-cmd": f"J{n}:pos-cmd" for n in range(16)}}

#: the same program twice: where each move is planned by itself, every period is the same each time, whenever moves come;
#: in the recording it has the mark
PROGRAMS = {"exact": (1, "G61.1"), "rounded": (2, "G64 P.05")}

TYPES = "=> motion.switchkins-type"

#: the HAL file that links the picture of a machine, where there is a screen for it
PICTURE = "picture.hal"

ARROWS = ("=>", "<=", "<=>")

#: keys of the INI files
WANT_A_SCREEN = ("APP", "POSTGUI_HALFILE", "PYVCP")


@dataclasses.dataclass(frozen=True)
class SampleMachine:
    """A sample of LinuxCNC: its INI file, what is run on it, and a frame in which it goes to a place."""

    ini: str
    folder: str
    kinematics: str
    joints: int
    letters: str
    #: a program in millimetres; it ends at these places of its axes
    program: tuple[str, ...]
    end: dict[str, float]
    #: blocks of MDI before the frame, which is shifted so far and turned by 90 degrees, and a place in it
    before_frame: tuple[str, ...]
    shift: tuple[float, float, float]
    place: tuple[float, ...]
    #: the command that shows its picture
    picture: str = ""
    #: pins, by how they begin, that nothing is linked to here, and HAL lines in place of what they said
    left_out: tuple[str, ...] = ()
    hal: str = ""
    tool_types: str = ""
    #: millimetres
    unit: float = 1

    @property
    def inner(self):
        return f"inner={self.kinematics} {self.tool_types}".strip()

    def place_without_frame(self):
        x, y, *z = self.place
        return (self.shift[0] - y, self.shift[1] + x, *(self.shift[2] + value for value in z))

    def path(self):
        return os.path.join(SAMPLES, self.folder)

    def all_left_out(self):
        return (*self.left_out, *([f"{self.picture}."] if self.picture else []))

    def nets_of_picture(self, line):
        """What a line of HAL links to the picture; empty if nothing."""
        words = line.split()
        pins = [word for word in words[2:] if self.picture and word.startswith(f"{self.picture}.")]
        return " ".join(["net", words[1], *pins]) if words[:1] == ["net"] and pins else ""

    def without_left_out(self, line):
        """A line of HAL without the pins of the picture, which wants a screen, and others; empty where nothing is left."""
        left_out = self.all_left_out()
        words = line.split()
        kept = [word for word in words if not word.startswith(left_out)] if left_out else words
        starts_picture = words[:1] == ["loadusr"] and self.picture in words
        is_net = words[:1] == ["net"] and any(word not in ARROWS for word in kept[2:])
        return line if kept == words and not starts_picture else " ".join(kept) * is_net


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def signals_in(lines):
    """{pin: signal} of nets in lines of HAL."""
    found = {}
    for line in lines:
        words = line.split("#")[0].split()
        if words[:1] == ["net"]:
            found.update({pin: words[1] for pin in words[2:] if pin not in ARROWS})
    return found


def joined(text):
    """The lines of a text, those that a backslash goes on with as one."""
    return text.replace("\\\n", " ").splitlines()


class Configuration:
    """A copy of a sample that LinuxCNC runs without a screen, in a folder of its own."""

    def __init__(self, machine, framed, folder):
        self.machine, self.framed, self.folder = machine, framed, folder
        self.signals = {}
        #: lines of [HAL]HALCMD, which come behind the HAL files
        self.commands = []
        #: lines that link the picture of the machine
        self.picture: list[str] = []
        for entry in os.scandir(machine.path()):
            if entry.is_file():
                shutil.copy(entry.path, folder)
        remaps = os.path.join(machine.path(), "remap_subs")
        if os.path.isdir(remaps):
            shutil.copytree(remaps, os.path.join(folder, "remap_subs"))
        self.write(f"{machine.ini}.ini", self.ini())
        self.write(f"{machine.ini}.hal", self.behind())
        self.write("before.hal", f"loadrt framekins {machine.inner}\n")
        self.write(PICTURE, "\n".join(self.picture) + "\n")

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def ini(self):
        lines, last = [], 0
        for line in self.included(read(os.path.join(self.machine.path(), f"{self.machine.ini}.ini"))):
            key, _, value = (part.strip() for part in line.partition("="))
            if key == "HALCMD":
                self.commands += self.kept([value])
            elif key == "HALFILE":
                lines += self.hal_file(value)
                last = len(lines)
            elif key not in WANT_A_SCREEN and not (self.framed and key == "SUBROUTINE_PATH"):
                lines.append(self.changed(key, line, value))
        lines.insert(last, f"HALFILE = {self.machine.ini}.hal")
        return "\n".join(lines) + "\n" + inner_machine.SETTINGS * self.framed

    def kept(self, lines):
        self.picture += filter(None, map(self.machine.nets_of_picture, lines))
        return [self.machine.without_left_out(line) for line in lines]

    def included(self, text):
        for line in text.splitlines():
            if line.startswith("#INCLUDE"):
                yield from read(os.path.join(self.machine.path(), line.split()[1])).splitlines()
            else:
                yield line

    def changed(self, key, line, value):
        """A line of the INI file, where it is another one with framekins."""
        if self.framed and key == "EMCMOT" and value == "motmod":
            return "EMCMOT = motmod num_aio=16"
        if self.framed and line.strip() == "[RS274NGC]":
            return f"{line}\nOWORD_NARGS = 1\n{inner_machine.ABORT}SUBROUTINE_PATH = ./remap_subs:../../subroutines"
        return line

    def hal_file(self, value):
        """Lines of [HAL] for one of its HAL files."""
        before = ["HALFILE = before.hal"] * (self.framed and not self.signals)
        if value == "axis_manualtoolchange.hal":
            return []
        if value.startswith("LIB:basic_sim.tcl"):
            self.signals.update(BASIC_SIM)
            return [*before, f"HALFILE = {value} -no_use_hal_manualtoolchange"]
        beside = os.path.join(self.machine.path(), value)
        lines = joined(read(beside if os.path.exists(beside) else os.path.join(LIBRARY, value)))
        lines = self.kept(lines)
        self.signals.update(signals_in(lines))
        self.write(value, "\n".join(lines) + "\n")
        return [*before, f"HALFILE = {value}"]

    def behind(self):
        """The HAL file that comes last: the sample's own commands, and the nets of frames."""
        lines = [line for line in self.commands if not line.startswith("loadusr")]
        if self.framed:
            lines = [line.replace(TYPES, "=> framekins.inner-type") for line in lines]
        self.signals.update(signals_in(lines))
        text = "\n".join(lines) + "\n" + self.machine.hal
        if self.framed:
            text += "".join(self.with_known_signal(line) for line in inner_machine.FRAMES.splitlines(keepends=True))
        return text + inner_machine.GUARD * self.framed

    def with_known_signal(self, line):
        """A net with the signal that the sample has on its pin already."""
        words = line.split()
        signal = next((self.signals[pin] for pin in words[2:] if pin in self.signals), None)
        return f"net {signal} {words[-1]}\n" if words[0] == "net" and signal else line


class Recorder(harness.Recorder):
    """Records the joints, and a mark that the steps set."""

    def __init__(self, machine, signals):
        super().__init__(machine.joints, "")
        self.known = signals
        self.integers = {"mark": ""}
        self.header = ["time", "mark", *(f"joint.{n}" for n in range(machine.joints))]

    def hal(self):
        """As that of others, but of parts that none of the samples has."""
        count = len(self.signals)
        lines = [f"loadrt mult2 count={count}", f"loadrt sampler depth=16000 cfg={'f' * count}s"]
        for n, pin in enumerate(self.signals):
            lines += [f"setp mult2.{n}.in1 {harness.RECORDED_SCALE:.0f}", f"addf mult2.{n} servo-thread",
                      f"net {self.known.get(pin, f'joint-{n}')} {pin} => mult2.{n}.in0",
                      f"net record-{n} mult2.{n}.out => sampler.0.pin.{n}"]
        return "\n".join([*lines, f"net record-mark sampler.0.pin.{count}", "addf sampler.0 servo-thread"]) + "\n"


def run(machine, steps, planner="tpmod", framed=False, record=True, **options):
    """Runs steps on a sample, with this planner, and with framekins before its kinematics."""
    ini = {("TRAJ", "TPMOD"): planner} if planner != "tpmod" else {}
    with tempfile.TemporaryDirectory(prefix="framepath-sample.") as folder:
        configuration = Configuration(machine, framed, folder)
        programs = {f"{name}.ngc": "\n".join([f"G21 G17 G90 G94 {mode} F1200", *machine.program, "M2"]) + "\n"
                    for name, (_, mode) in PROGRAMS.items()}
        return harness.run(steps, programs, ini, sample=machine.ini, configuration=folder, record=record,
                           recorder=Recorder(machine, configuration.signals), **options)


def program_steps():
    """The programs, marked in the recording, and where they end."""
    steps = []
    for name, (mark, _) in PROGRAMS.items():
        steps += [["halcmd", "sets", "record-mark", str(mark)], ["run", f"PROGRAMS/{name}.ngc"],
                  ["halcmd", "sets", "record-mark", "0"], ["mdi", "G21"], ["note", name]]
    return steps


def words(place):
    return " ".join(f"{letter}{value:.6f}" for letter, value in zip("XYZ", place, strict=False))


def frame_steps(machine):
    """To the same place in a frame and without one."""
    shift = " ".join(f"[{value}]" for value in machine.shift)
    return [*(["mdi", line] for line in machine.before_frame), ["mdi", f"o<trans> call {shift}"],
            ["mdi", "o<arot_rpl> call [90]"], ["mdi", f"G1 {words(machine.place)} F1200"],
            ["getp", "active", "framekins.active"], ["note", "framed"],
            ["mdi", "o<frame_off> call"], ["mdi", f"G1 {words(machine.place_without_frame())} F1200"], ["note", "plain"]]


def way(machine, result, program):
    """The joints in each period of the program in which one of them moves: how long the machine stands is the computer's
    affair."""
    mark, _ = PROGRAMS[program]
    rows = result.columns("mark", *(f"joint.{number}" for number in range(machine.joints)))
    return [row[1:] for row, before in zip(rows[1:], rows, strict=False) if row[0] == mark and row[1:] != before[1:]]
