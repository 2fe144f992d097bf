"""The samples of LinuxCNC that framekins and blendtp are tried with."""

from sample_machines import SampleMachine

#: a switch as the motion ends takes a pose on the way, and which one is a matter of time
REST = "G4 P.05"

FEEDBACK = tuple(f"joint.{n}.motor-pos-fb" for n in range(3))

TABLES = "vismach/5axis/table-rotary-tilting"


def tilting_table(letter):
    """The table that tilts about A or B: type 0 are the joints, type 1 is the tool centre point."""
    return SampleMachine(
        ini=f"xyz{letter}c-trt", folder=TABLES, kinematics=f"xyz{letter}c-trt-kins", joints=5, letters=f"XYZ{letter.upper()}C",
        program=(REST, "M428", f"G1 X5 Y0 Z0 {letter}10 C20", "G2 X10 Y5 I5 J0 C25", f"G1 X0 Y0 Z-5 {letter}0 C0", REST, "M429",
                 "G1 X3 Y2"),
        end={"X": 3, "Y": 2, "Z": -5}, before_frame=("M428", f"G1 {letter}-10 C30 F1200"), shift=(10, 5, -2), place=(3, 4, 1),
        picture=f"xyz{letter}c-trt-gui", tool_types="tool_types=1")


MACHINES = [
    tilting_table("a"),
    tilting_table("b"),
    SampleMachine(
        ini="xyzab-tdr", folder="vismach/5axis/table-dual-rotary", kinematics="xyzab_tdr_kins", joints=5, letters="XYZAB",
        program=(REST, "M428", "G1 X5 Y0 Z0 A10 B20", "G2 X10 Y5 I5 J0 B25", "G1 X0 Y0 Z-5 A0 B0", REST, "M429", "G1 X3 Y2"),
        end={"X": 3, "Y": 2, "Z": -5}, before_frame=("M428", "G1 A-10 B30 F1200"), shift=(10, 5, -2), place=(3, 4, 1),
        picture="xyzab-tdr-gui", tool_types="tool_types=1"),
    SampleMachine(
        ini="5axis", folder="vismach/5axis/bridgemill", kinematics="5axiskins", joints=7, letters="XYZBCW",
        program=("F6000", "G1 X60 Y10 Z-5 B20 C30", "G2 X40 Y40 R30 B-10", "G1 X0 Y0 Z-20 B0 C0", REST, "M429", "G1 X10 Y20",
                 REST, "M428", "G1 X3 Y2"),
        end={"X": 3, "Y": 2, "Z": -20}, before_frame=("G1 B15 C-40 F1200",), shift=(30, 10, -5), place=(5, 20, 10),
        picture="5axisgui", hal="sets :gui-pivot-len 250\n", tool_types="tool_types=0"),
    SampleMachine(
        ini="scara", folder="vismach/scara", kinematics="scarakins", joints=6, letters="XYZABC",
        # the arm is straight at home
        program=("G10 L2 P1 X0 Y0 Z0", REST, "M429", "G1 X30 Y60 Z100", REST, "M428", "G1 X300 Y400", "G2 X310 Y390 R20 C10",
                 "G91 G1 Z-5", "G90 G1 X290 Y390 C0"),
        end={"X": 290, "Y": 390, "C": 0}, before_frame=(), shift=(330, 360, 0), place=(20, 25), picture="scaragui"),
    SampleMachine(
        ini="ldelta", folder=".", kinematics="lineardeltakins", joints=4, letters="XYZA",
        program=("G1 X10 Y-5 Z25", "G2 X-5 Y10 R20", "G1 X0 Y0 Z20 A5"), end={"X": 0, "Y": 0, "Z": 20, "A": 5}, before_frame=(),
        shift=(8, 2, 5), place=(3, 4, 18), picture="lineardelta"),
    SampleMachine(
        ini="corexy_by_kins", folder="corexy", kinematics="corexykins", joints=3, letters="XYZ",
        program=("G1 X40 Y10 Z-5", "G2 X20 Y30 R25", "G1 X5 Y5 Z-10"), end={"X": 5, "Y": 5, "Z": -10}, before_frame=(),
        shift=(30, 10, -5), place=(5, 20, -3), unit=25.4,
        # its steps by software want a computer with real time
        left_out=("stepgen.0.position-fb", "stepgen.1.position-fb", "stepgen.2.position-fb", *FEEDBACK),
        hal="".join(f"net j{n}pos-cmd => {pin}\n" for n, pin in enumerate(FEEDBACK))),
    SampleMachine(
        ini="gantry", folder="gantry", kinematics="trivkins", joints=4, letters="XYZ",
        program=("F9000", "G1 X200 Y100 Z-50", "G2 X100 Y250 R120", "G1 X5 Y5 Z-10"), end={"X": 5, "Y": 5, "Z": -10},
        before_frame=(), shift=(30, 10, -5), place=(5, 20, -3), unit=25.4),
]


def machine(ini):
    return next(row for row in MACHINES if row.ini == ini)
