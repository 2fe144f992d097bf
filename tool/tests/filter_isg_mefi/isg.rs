//! The rest of the language of ISG kernels.

use crate::machine::{self, Machine};
use crate::path::{Step, assert_same, clockwise, counterclockwise, line};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

fn shop(program: &str) -> Shop {
    Shop::with(Dialect::Isg, program)
}

/// The path of a program, which both backends must give.
fn path(program: &str) -> Vec<Step> {
    machine::path_of(&shop(program))
}

/// X of each step.
fn ends(program: &str) -> Vec<f64> {
    path(program).iter().map(|step| step.end()[0]).collect()
}

/// Mirrors, offsets and rotations: where each takes (10, 20).
#[test]
fn frames_take_points_where_the_manual_says() {
    for (frame, [x, y]) in [
        ("G21", [-10.0, 20.0]),
        ("G22", [10.0, -20.0]),
        ("G23", [-10.0, -20.0]),
        ("G23\nG20", [10.0, 20.0]),
        ("G21\nG22", [10.0, -20.0]),
        ("G351 X-1", [-10.0, 20.0]),
        ("G351 X-1\nG351 Y-1", [-10.0, -20.0]),
        ("G351 X-1 Y-1\nG351 X1", [10.0, -20.0]),
        ("G92 X60 Y40", [70.0, 60.0]),
        ("G92 X60\nG92 Y40", [70.0, 60.0]),
        ("G92 X60\nG91 G92 X5\nG90", [75.0, 20.0]),
        ("G92 X60\nG92 X0", [10.0, 20.0]),
        // The plane's mirror leaves the offset alone, that of the axes does not.
        ("G92 X60 Y40\nG21", [50.0, 60.0]),
        ("G21\nG92 X60 Y40", [50.0, 60.0]),
        ("G92 X60 Y40\nG351 X-1", [-70.0, 60.0]),
        ("G351 X-1\nG21", [10.0, 20.0]),
        ("#ROTATION ON [ANGLE=90]", [-20.0, 10.0]),
        ("#ROTATION ON [ANGLE 90]\nG21", [20.0, 10.0]),
        ("#ROTATION ON [ANGLE=90]\n#ROTATION OFF", [10.0, 20.0]),
        ("#CS ON [5,6]", [15.0, 26.0]),
        ("#CS ON [5,6,0,0,0,90]", [-15.0, 16.0]),
        ("#CS ON [5,6,0,0,0,90]\nG21", [-15.0, -4.0]),
        ("#CS ON [5,,,,,90]\n#CS ON [0,1,0]\n#CS OFF", [-15.0, 10.0]),
        ("#CS DEF [2] [5,6]\n#CS ON [2]", [15.0, 26.0]),
        ("#CS DEF [2] [5,6]\n#CS ON\n#CS OFF", [10.0, 20.0]),
        ("#CS ON [5,6]\n#CS ON [1,1]\n#CS OFF ALL", [10.0, 20.0]),
        ("G92 X1 Y2\n#CS ON [5,6,0,0,0,90]", [-14.0, 18.0]),
    ] {
        let program = format!("{frame}\nG01 G90 X10 Y20 F100\nM30\n");
        assert_same(&path(&program), &[line(x, y)], frame);
    }
}

/// `#CS` turns about Z, then about the new Y, then about the new X: as `ROT X30 Y20 Z10` does.
#[test]
fn tilted_systems_go_to_the_kinematics() {
    let program = "#CS ON [0,0,0,30,20,10]\nG01 X10 Y0 Z0 F100\nX0 Y10\nY0 Z10\nM30\n";
    let output = shop(program).accepted(&["--backend", "auto"]);
    assert!(output.contains("o<rot> call [30] [20] [10]"), "{output}");
    let ends = machine::run(&output);
    for (end, wanted) in ends.iter().zip([
        [9.2542, 1.6318, -3.4202],
        [0.1803, 8.8256, 4.6985],
        [3.7852, -4.4097, 8.1380],
    ]) {
        for (given, wanted) in end.end().iter().zip(wanted) {
            assert!((given - wanted).abs() < 6e-5, "{end:?}");
        }
    }
    let shown = shop(program).refused(&["--backend", "program"]);
    assert!(shown.contains("tilts the tool"), "{shown}");
}

#[test]
fn arcs_change_their_direction_under_a_mirror() {
    let part = "G01 X10 Y0 F100\nG03 X0 Y10 I-10\nG02 X10 Y20 R10\nG161 G03 X0 Y10 I10 J10\nM30\n";
    assert_same(
        &path(part),
        &[
            line(10.0, 0.0),
            counterclockwise(0.0, 10.0, [0.0, 0.0]),
            clockwise(10.0, 20.0, [10.0, 10.0]),
            counterclockwise(0.0, 10.0, [10.0, 10.0]),
        ],
        "as it is",
    );
    assert_same(
        &path(&format!("G21\n{part}")),
        &[
            line(-10.0, 0.0),
            clockwise(0.0, 10.0, [0.0, 0.0]),
            counterclockwise(-10.0, 20.0, [-10.0, 10.0]),
            clockwise(0.0, 10.0, [-10.0, 10.0]),
        ],
        "mirrored",
    );
}

#[test]
fn radii_hold_on() {
    assert_same(
        &path("G01 X0 Y0 F100\nG02 R50\nX100\nX200\nG03 X100 I-50 J0\nX0\nM30\n"),
        &[
            clockwise(100.0, 0.0, [50.0, 0.0]),
            clockwise(200.0, 0.0, [150.0, 0.0]),
            counterclockwise(100.0, 0.0, [150.0, 0.0]),
            counterclockwise(0.0, 0.0, [50.0, 0.0]),
        ],
        "radii",
    );
}

/// The start of a circle is where the tool is: only the centre is mirrored.
#[test]
fn a_circle_with_an_absolute_centre_right_after_a_mirror() {
    let program = "G01 X10 Y0 F100\nG21\nG161 G02 I20 J0\nM30\n";
    let shown = shop(program).refused(&[]);
    assert!(
        shown.contains("only the centre of this circle is mirrored"),
        "{shown}"
    );
    assert!(shown.contains("part.nc:3:10"), "{shown}");
    let output = shop(program).accepted(&["--mirrored-circle", "warn", "--backend", "program"]);
    assert_same(
        &machine::run(&output),
        &[
            line(10.0, 0.0),
            // r = 30 about (-20, 0), counterclockwise as seen after the mirror
            counterclockwise(10.0, 0.0, [-20.0, 0.0]),
        ],
        "a new radius",
    );
    assert!(output.contains("it would get another radius"));
    // With the start programmed there is nothing to warn of.
    path("G01 X10 Y0 F100\nG21\nX10 Y0\nG161 G02 I20 J0\nM30\n");
}

#[test]
fn mirrors_outside_of_g17() {
    let program = "G18\nG21\nG01 X10 Y20 Z30 F100\nM30\n";
    let shown = shop(program).refused(&[]);
    assert!(shown.contains("outside of G17"), "{shown}");
    for (setting, end) in [("plane", [10.0, 20.0, -30.0]), ("xy", [-10.0, 20.0, 30.0])] {
        let output = shop(program).accepted(&["--mirror-outside-xy", setting]);
        // The machine of the tests moves in straight lines here: the plane does not matter to it.
        let text = output.replace("G18", "");
        assert_same(&machine::run(&text), &[Step::Line(end)], setting);
    }
    let later = "G21\nG19\nM30\n";
    assert!(shop(later).refused(&[]).contains("part.nc:2:1"));
}

#[test]
fn values_are_worked_out() {
    for (value, wanted) in [
        ("2+3*4", 14.0),
        ("[2+3]*4", 20.0),
        ("2**3+1", 9.0),
        ("-[2**2]", -4.0),
        ("7 MOD 4", 3.0),
        ("10/4", 2.5),
        ("SIN[30]+COS[60]", 1.0),
        ("TAN[45]", 1.0),
        ("ASIN[1]", 90.0),
        ("ACOS[0]", 90.0),
        ("ATAN[1]", 45.0),
        ("ATAN2[1,-1]", 135.0),
        ("SQRT[16]", 4.0),
        ("SQR[3]", 9.0),
        ("ABS[-3]", 3.0),
        ("INT[3.9]", 3.0),
        ("FRACT[3.75]", 0.75),
        ("ROUND[3.5]", 4.0),
        ("LN[EXP[2]]", 2.0),
        ("LOG[1000]", 3.0),
        ("DEXP[2]", 100.0),
        ("MIN[3,4]+MAX[3,4]", 7.0),
        ("[1 < 2] + [2 == 2.0] + [1 != 1]", 2.0),
        ("TRUE AND FALSE OR TRUE", 1.0),
        ("[1 && 0] + [1 || 0] + [1 XOR 1]", 1.0),
        ("NOT 0", 1.0),
        ("PI", std::f64::consts::PI),
        ("P1", 5.0),
        ("-P1", -5.0),
        ("PP2", 5.0),
        ("P[1+1]", 1.0),
        ("V.P.WIDTH", 7.0),
        ("V.L.LIST[1]", 11.0),
    ] {
        let program = format!(
            "#VAR\nV.L.LIST[2] : REAL64 = [10, 11]\n#ENDVAR\nP1=5 P2=1\nV.P.WIDTH = P1 + 2\n\
             G00 X1000 Y1000 Z1000\nX={value}\nM30\n"
        );
        let end = ends(&program)[1];
        assert!((end - wanted).abs() < 1e-6, "{value} = {end}, not {wanted}");
    }
    let end = ends("P1=1\nP1 += 4\nP1 *= 2\nP1 -= 1\nP1 /= 2\nG00XP1YP1\nM30\n");
    assert_eq!(end, [4.5]);
}

#[test]
fn the_flow_follows_conditions_and_loops() {
    for (program, wanted) in [
        ("P1=0.5\n$IF P1\nX1\n$ELSE\nX2\n$ENDIF\n", vec![1.0]),
        ("P1=0.4\n$IF P1\nX1\n$ELSE\nX2\n$ENDIF\n", vec![2.0]),
        (
            "P1=2\n$IF P1==1\nX1\n$ELSEIF P1==2\nX2\n$ELSEIF P1==2\nX3\n$ELSE\nX4\n$ENDIF\n",
            vec![2.0],
        ),
        ("$IF 0\nX1\n$ENDIF\nX5\n", vec![5.0]),
        ("$FOR P1=1,3,1\nXP1\n$ENDFOR\n", vec![1.0, 2.0, 3.0]),
        ("$FOR P1=3,1,-1\nXP1\n$ENDFOR\n", vec![3.0, 2.0, 1.0]),
        ("$FOR P1=0.1,0.35,0.1\nXP1\n$ENDFOR\n", vec![0.1, 0.2, 0.3]),
        ("$FOR P1=5,1\nXP1\n$ENDFOR\nX9\n", vec![9.0]),
        (
            "$FOR P1=1,9\n$IF P1==2\n$CONTINUE\n$ENDIF\n$IF P1==4\n$BREAK\n$ENDIF\nXP1\n$ENDFOR\n",
            vec![1.0, 3.0],
        ),
        (
            "P1=3\n$WHILE P1>1\nXP1\nP1=P1-1\n$ENDWHILE\n",
            vec![3.0, 2.0],
        ),
        ("P1=3\n$DO\nXP1\nP1=P1+1\n$ENDDO P1<5\n", vec![3.0, 4.0]),
        ("P1=3\n$REPEAT\nXP1\nP1=P1+1\n$UNTIL P1>4\n", vec![3.0, 4.0]),
        (
            "P1=2\n$SWITCH P1*2\n$CASE 3\nX3\n$BREAK\n$CASE 4.0001\nX4\n$BREAK\n$DEFAULT\nX5\n$ENDSWITCH\n",
            vec![4.0],
        ),
        (
            "$SWITCH 7\n$DEFAULT\nX5\n$BREAK\n$CASE 3\nX3\n$BREAK\n$ENDSWITCH\n",
            vec![5.0],
        ),
        (
            "$SWITCH 7\n$CASE 3\nX3\n$BREAK\n$ENDSWITCH\nX6\n",
            vec![6.0],
        ),
        ("$GOTO N30\nN20 X1\nN30 X2\n", vec![2.0]),
        (
            "P1=0\nN10: P1=P1+1\nXP1\n$IF P1<3 $GOTO N10\n",
            vec![1.0, 2.0, 3.0],
        ),
        ("$GOTO [AWAY]\nX1\n[AWAY] X2\n", vec![2.0]),
        (
            "/X1\nX2 ; comment\n(X3)\nX4 (a (b) c)\n",
            vec![1.0, 2.0, 4.0],
        ),
        (
            "#COMMENT BEGIN\nX1\n#COMMENT END\nX2 \\\nN20 Y0\n",
            vec![2.0],
        ),
    ] {
        let whole = format!("G00 G90\n{program}M30\n");
        let given = ends(&whole);
        let same = given.len() == wanted.len()
            && given.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(same, "{program}: {given:?}, not {wanted:?}");
    }
}

#[test]
fn subprograms_are_found_in_the_file_and_beside_it() {
    let shop = Shop::new(
        Dialect::Isg,
        &[
            (
                "main.nc",
                "%L ONE\nN10 X1\nV.L.A = 5\nN20 M29\n%L two\nX2\nLL ONE\nM17\n% MAIN\nG00\nLL ONE\nLL TWO\n\
                 L outside.nc\nL \"OUTSIDE.NC\"\nM30\n",
            ),
            ("Outside.nc", "%L ONE\nX8\nM17\n%OUTSIDE\nLL ONE\nX9\nM17\n"),
        ],
    );
    let output = shop.accepted(&["--backend", "program"]);
    let ends: Vec<f64> = machine::run(&output)
        .iter()
        .map(|step| step.end()[0])
        .collect();
    assert_eq!(ends, [1.0, 2.0, 1.0, 8.0, 9.0, 8.0, 9.0]);
    assert!(output.contains("(--- ONE in Outside.nc ---)"), "{output}");
}

#[test]
fn feeds_belong_to_their_mode() {
    let program = "S1000 M3\nG01 X10 F300\nG95 F0.1 X20\nG94 X30\nG95 X40\nG93 F20 X50\nX60\nG94 F50 X70\nM30\n";
    let mut machine = Machine::new();
    machine.run(&shop(program).accepted(&["--backend", "program"]));
    assert_eq!(machine.feeds, [300.0, 0.1, 300.0, 0.1, 3.0, 3.0, 50.0]);
    let output = shop(program).accepted(&[]);
    assert!(
        output.contains("G93 G1 X50 F3") && output.contains("G1 X60 F3"),
        "{output}"
    );
}

#[test]
fn corners_are_rounded_as_the_program_says() {
    let program = "G01 X1 F100\n#HSC ON [CONTERROR 0.01]\nX2\n#HSC OFF\nX3\n#HSC ON [OPMODE 1 CONTERROR=0.02]\nX4\n\
                   #HSC OFF\n#HSC ON [BSPLINE PATH_DEV=0.3 MERGE=1]\nG260\nX5\n#CONTOUR MODE [DEV PATH_DEV=0.5]\n\
                   G261\nX6\nG260\nG60 X7\nG61 X8\nX9\nG360 X10\nX11\nG359 X12\n#SLOPE [TYPE=TRAPEZ]\n\
                   #SET SLOPE PROFIL [1]\n#FLUSH WAIT\nM30\n";
    let output = shop(program).accepted(&["--backend", "program"]);
    let lines: Vec<&str> = output
        .lines()
        .filter(|line| line.starts_with('G') && !line.starts_with("G21"))
        .map(|line| line.split(" (").next().unwrap_or(""))
        .collect();
    assert_eq!(
        lines,
        [
            "G1 X1 F100",
            "G64 P0.01",
            "G1 X2",
            "G61",
            "G1 X3",
            "G64 P0.02",
            "G1 X4",
            "G61",
            "G64 P0.3",
            "G61",
            "G1 X5",
            "G64 P0.5",
            "G1 X6",
            "G61",
            "G61.1 G1 X7",
            "G61",
            "G64 P0.5 G1 X8",
            "G61",
            "G1 X9",
            "G61.1 G1 X10",
            "G61",
            "G61.1 G1 X11",
            "G61",
            "G1 X12",
        ]
    );
    for noted in ["#SLOPE", "#SET SLOPE PROFIL", "#HSC MERGE", "#FLUSH"] {
        assert!(
            output.contains(&format!("{noted} tunes the other control")),
            "{noted}"
        );
    }
    // What is carried out is not said to be left out.
    assert!(!output.contains("CONTOUR MODE tunes"), "{output}");
    for more in ["DEV PATH_DEV=0.5 TRACK_DEV 1", "DEV PATH_DEV=0.5 RATIO"] {
        let more = shop(&format!("#CONTOUR MODE ON [{more}]\nG01 X1 F100\nM30\n")).accepted(&[]);
        assert!(
            more.contains("all of #CONTOUR MODE but PATH_DEV tunes"),
            "{more}"
        );
    }
    let default = shop("#HSC ON\nG01 X1 F100\nM30\n").accepted(&[]);
    assert!(default.contains("G64 P0.1 "), "{default}");
}

/// G70 and G71 are the unit of what is written behind them: what is in force keeps its size.
#[test]
fn what_holds_on_keeps_its_size_in_another_unit() {
    for (program, wanted) in [
        (
            "G94 F254 G01 X10\nG95 F0.1 S100 M3 X20\nG70\nG94 X1\nG95 X2",
            vec!["F254", "F0.1", "G94 G1 X25.4 F254", "G95 G1 X50.8 F0.1"],
        ),
        (
            "G95 F0.01 S100 M3 G01 X1\nG70 G94 F10 X1\nG71\nG95 X2\nG94 X3",
            vec!["F0.01", "F254", "G95 G1 X2 F0.01", "G94 G1 X3 F254"],
        ),
        (
            "#CONTOUR MODE [DEV PATH_DEV 0.1]\nG70\nG261\nG01 X1 F10",
            vec!["G64 P0.1"],
        ),
        (
            "G70\n#HSC ON [CONTERROR 0.005]\nG01 X1 F10\n#HSC OFF\nG71\n#HSC ON\nX2",
            vec!["G64 P0.127", "G64 P0.127"],
        ),
        ("G70\n#HSC ON\nG01 X1 F10", vec!["G64 P0.1 "]),
        ("G33 K2\nG70\nS100 M3\nG33 Z-1", vec!["G33 Z-25.4 K2 "]),
    ] {
        let output = shop(&format!("G90 G71 G00 X0 Y0 Z0\n{program}\nM30\n")).accepted(&[]);
        let mut rest = output.as_str();
        for wanted in wanted {
            let at = rest.find(wanted);
            assert!(at.is_some(), "{program}: {wanted}\n{output}");
            rest = &rest[at.unwrap_or(0) + wanted.len()..];
        }
        assert!(!output.contains("PATH_DEV is taken"), "{output}");
    }
    let radius = "G00 X0 Y0\nG02 X101.6 R50.8 F100\nG70\nX8\nM30\n";
    assert_same(
        &path(radius),
        &[
            clockwise(101.6, 0.0, [50.8, 0.0]),
            clockwise(203.2, 0.0, [152.4, 0.0]),
        ],
        "a radius",
    );
    let alone = "G00 X0 Y0\nG02 R50.8 F100\nG70\nX4\nM30\n";
    assert_same(&path(alone), &path(radius)[..1], "a radius alone");
}

/// PATH_DEV counts millimetres under G70 too.
#[test]
fn a_path_deviation_is_in_millimetres() {
    for (command, wanted) in [
        ("#CONTOUR MODE [DEV PATH_DEV 0.1]\nG261", "G64 P0.1 "),
        ("#CONTOUR MODE ON [DEV PATH_DEV 0.1]", "G64 P0.1 "),
        ("#HSC ON [BSPLINE PATH_DEV 0.05]", "G64 P0.05 "),
        ("#HSC ON [BSPLINE]", "G64 P0.2 "),
    ] {
        let output = shop(&format!("G70\n{command}\nG01 X1 F10\nM30\n")).accepted(&[]);
        assert!(output.contains(wanted), "{command}\n{output}");
        let said = output.contains("PATH_DEV is taken in millimetres under G70 too");
        assert_eq!(said, command.contains("PATH_DEV"), "{output}");
    }
    for below in ["#HSC [CONTERROR=-1]", "#CONTOUR MODE [PATH_DEV=-1]"] {
        let shown = shop(&format!("{below}\nM30\n")).refused(&[]);
        assert!(shown.contains("cannot be negative"), "{shown}");
    }
}

#[test]
fn words_of_all_kinds() {
    let program = "N10 G17 G71 G90 G54 G94\nT3 D3 M06\nS=200 M3 M8\nG04 X4.5\nG04 3.0\nP1=2\nG04 P1\nG04 S10\n\
                   #TIME P1\n#MSG [\"depth %f of %d%%\", 2.5, 7]\n#MSG [\"plain\"]\nG159=2\nG01 X1 F=P1*100\nM40\nM01\n\
                   G25 G52\nG08 G10 G13\nG09 X2\nM9 M5\nM30\n";
    let output = shop(program).accepted(&[]);
    for wanted in [
        "T3 M6 G43 H3 (line 2)",
        "S200 M3 M8",
        "G4 P4.5",
        "G4 P3",
        "G4 P2",
        "(MSG, depth 2.5 of 7%%)",
        "(MSG, plain)",
        "G55",
        "G1 X1 F200",
        "M1 (line",
        "M40 tunes the other control",
        "G25 tunes the other control",
        "G8 tunes the other control",
        "G9 tunes the other control",
        "G13 tunes the other control",
    ] {
        assert!(output.contains(wanted), "{wanted}\n{output}");
    }
    let inch = shop("G70 G01 X1 F10\nG71 X1 F10\nM30\n").accepted(&[]);
    assert!(
        inch.contains("G1 X25.4 F254") && inch.contains("G1 X1 F10"),
        "{inch}"
    );
}

/// `--set` gives parameters of the control their values.
#[test]
fn parameters_may_come_from_outside() {
    let shop = shop("G00 XP7 Y=V.P.DEPTH\nM30\n");
    assert!(shop.refused(&[]).contains("--set P7=VALUE"));
    let output = shop.accepted(&["--set", "P7=12.5", "--set", "V.P.DEPTH=3"]);
    assert!(output.contains("G0 X12.5 Y3"), "{output}");
}

/// LinuxCNC would take G64 P0 for no limit at all.
#[test]
fn a_tolerance_that_rounds_to_nothing_keeps_the_path_exact() {
    let program = "#HSC ON [CONTERROR 0.0000001]\nG01 X1 F100\nX2 Y2\n#HSC OFF\nM30\n";
    let output = Shop::with(Dialect::Isg, program).accepted(&[]);
    assert!(!output.contains("G64"), "{output}");
    assert_eq!(output.matches("G61").count(), 3, "{output}");
}
