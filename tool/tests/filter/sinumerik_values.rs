//! Angles of lines, values for arrays, bits, and values for work offsets.

use crate::expected::Path;
use crate::pairs::assert_pair;
use crate::shop::{Shop, accepted, commands, refused, translate};
use framepath_tool::dialects::Dialect;

fn written(program: &str) -> Vec<String> {
    commands(&translate(program, &["--backend", "program"]))
}

fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &["--backend", "program"]))
}

#[test]
fn lines_by_their_angle() {
    let check = |program: &str, path: &Path| {
        let program = format!("G0 X0 Y0 Z0\nF100\n{program}\nM30\n");
        path.check(Dialect::Sinumerik, &[("part.mpf", &program)], &program);
    };
    let start = || Path::from([0.; 3]).feed(100.);
    let root = 3_f64.sqrt();
    check("G1 X10 ANG=45", &start().lines(&[(10., 10.)]));
    check("G1 Y-10 ANG=-90", &start().lines(&[(0., -10.)]));
    check("G1 X=IC(-3) ANG=150", &start().lines(&[(-3., root)]));
    check("G91 G1 Y1 ANG=30", &start().lines(&[(root, 1.)]));
    check(
        "G1 ANG=0\nX10 Y5 ANG=90",
        &start().lines(&[(10., 0.), (10., 5.)]),
    );
    check(
        "G1 ANG=45\nX20 Y0 ANG=-45\nX30",
        &start().lines(&[(10., 10.), (20., 0.), (30., 0.)]),
    );
    check(
        "G91 G1 ANG=0\nX=AC(10) Y=AC(5) ANG=90",
        &start().lines(&[(10., 0.), (10., 5.)]),
    );
    check(
        "G1 ANG=0 RND=2\nX10 Y5 ANG=90",
        &start()
            .lines(&[(8., 0.)])
            .ccw([10., 2., 0.], (8., 2.))
            .lines(&[(10., 5.)]),
    );
    check(
        "G1 ANG=0 CHR=2\nX10 Y5 ANG=90",
        &start().lines(&[(8., 0.), (10., 2.), (10., 5.)]),
    );
    // Along Z and X.
    check("G18 G1 Z10 ANG=45", &start().line([10., 0., 10.]));
    let turned = start().lines(&[(-10., 10.)]);
    check("ROT RPL=90\nG1 X10 ANG=45", &turned);
    for (program, words) in [
        ("G1 X-10 ANG=45", "does not lead there"),
        ("G1 X10 ANG=90", "does not lead there"),
        ("G1 X10 Y10 ANG=45", "beside one coordinate"),
        ("G2 X10 ANG=45 I5", "belongs to straight lines"),
        ("G1 ANG=45\nX10", "has no end"),
        ("G1 ANG=45\nM30", "has no end"),
        ("G1 ANG=45\nX10 Y10 ANG=45", "do not meet"),
        ("G1 ANG=0\nX=IC(20) Y10 ANG=45", "an increment as the end"),
        ("G91 G1 ANG=0\nX20 Y10 ANG=45", "an increment as the end"),
        (
            "G1 ANG=0\nX10 Y5 ANG=90 F50",
            "a feed for the second line only",
        ),
    ] {
        let shown = errors(&format!("G0 X0 Y0 Z0\nF100\n{program}\nM30\n"));
        assert!(shown.contains(words), "{program}\n{shown}");
    }
}

#[test]
fn arrays_get_values_by_lists() {
    let program = "\
DEF REAL AA[6]=(1,2,3), BB[2,3]=SET(1,2,3,4,5,6), CC[4]=REP(7)
AA[3]=SET(4,,6)
BB[1,1]=REP(9)
CC[1]=REP(8,2)
R10=SET(11,12)
R20=REP(5,2)
G0 X=AA[0] Y=AA[3] Z=AA[4]
G0 X=AA[5] Y=BB[1,0] Z=BB[1,2]
G0 X=CC[0] Y=CC[2] Z=CC[3]
G0 X=R11 Y=R20 Z=R21
M30
";
    assert_eq!(
        written(program),
        [
            "G0 X1 Y4 Z0",
            "G0 X6 Y4 Z9",
            "G0 X7 Y8 Z7",
            "G0 X12 Y5 Z5",
            "M30"
        ]
    );
    for (program, words) in [
        ("DEF REAL AA[2]=SET(1,2,3)", "3 values, and 2 elements"),
        ("DEF REAL AA[2]\nAA[1]=REP(1,2)", "2 values, and 1 elements"),
        ("DEF REAL AA[2]\nAA[2]=SET(1)", "outside 0 to 1"),
        ("R1=REP(1)", "needs a number of them"),
        ("DEF REAL AA[2]\nAA[0]=REP()", "REP needs a value"),
        ("DEF STRING AA[2]\nAA[0]=SET(1)", ""),
    ] {
        let shown = errors(&format!("{program}\nM30\n"));
        assert!(shown.contains(words), "{program}\n{shown}");
    }
}

#[test]
fn bits_bind_between_sums_and_truths() {
    for (expression, value) in [
        ("6 B_AND 3", "2"),
        ("6 B_OR 3", "7"),
        ("6 B_XOR 3", "5"),
        ("B_NOT 0", "-1"),
        ("B_NOT 5 B_AND 7", "2"),
        ("1 B_OR 2 B_AND 0", "1"),
        ("1 + 2 B_AND 2", "2"),
        ("(4 B_AND 4) == 4", "1"),
        ("4 B_AND 4 == 4", "1"),
        ("8 B_OR 1 AND 0", "0"),
    ] {
        let lines = written(&format!("R1={expression}\nG0 X=R1\nM30\n"));
        assert_eq!(lines[0], format!("G0 X{value}"), "{expression}");
    }
    assert!(errors("R1=1.5 B_AND 1\nM30\n").contains("1.5 has no bits"));
}

#[test]
fn work_offsets_are_set_where_the_control_takes_them() {
    let offset = "$P_UIFR[1]=CTRANS(X,10,Y,20):CFINE(X,0.5):CROT(Z,30)\nG54\nG0 X1\nM30\n";
    assert_eq!(
        written(offset),
        ["G10 L2 P1 X10.5 Y20 Z0 R30", "G54", "G0 X1", "M30"]
    );
    // What stands before a part of the chain turns it.
    for (chain, wanted) in [
        ("CROT(Z,90):CTRANS(X,10)", "X0 Y10 Z0 R90"),
        ("CROT(Z,90):CTRANS(Y,10,Z,3)", "X-10 Y0 Z3 R90"),
        ("CROT(Z,30):CROT(Z,15)", "X0 Y0 Z0 R45"),
        ("CTRANS(X,10):CROT(Z,90):CFINE(X,1)", "X10 Y1 Z0 R90"),
    ] {
        let program = format!("$P_UIFR[1]={chain}\nG54\nM30\n");
        assert_eq!(
            written(&program)[0],
            format!("G10 L2 P1 {wanted}"),
            "{chain}"
        );
    }
    // One in force changes with the next G54, one that is not at once.
    let program =
        "G54\nG0 X1\n$P_UIFR[1,X,TR]=R1+5\nG0 X2\n$P_UIFR[2,C,TR]=90\nG0 X3\nG54\nG0 X4\nM30\n";
    assert_eq!(
        written(&format!("R1=2\n{program}")),
        [
            "G54",
            "G0 X1",
            "G0 X2",
            "G10 L2 P1 X7",
            "G10 L2 P2 C90",
            "G0 X3",
            "G54",
            "G0 X4",
            "M30"
        ]
    );
    assert_eq!(
        written("G700\n$P_UIFR[6]=CTRANS(X,1)\nG0 X1\nM30\n"),
        ["G0 X25.4", "G10 L2 P6 X25.4 Y0 Z0 R0", "M30"]
    );
    assert_pair(
        "$P_UIFR[1]=CTRANS(X,10,Y,20)\nG54 G0 X1 Y1 Z1\nG1 X5 F100\nM30\n",
        "G21 G10 L2 P1 X10 Y20 Z0 R0\nG54 G0 X1 Y1 Z1\nG1 X5 F100\nM2\n",
    );
    let shop = Shop::new(&[(
        "part.mpf",
        b"G54\nROT RPL=30\n$P_UIFR[2]=CTRANS()\nG0 X1 Y1\nM30\n",
    )]);
    let kinematics = accepted(&shop.run("part.mpf", &["--backend", "kinematics"]));
    let at = |words: &str| {
        kinematics
            .find(words)
            .unwrap_or_else(|| panic!("{kinematics}"))
    };
    assert!(
        at("o<frame_off> call (line 3)\nG10 L2 P2") < at("o<rot> call"),
        "{kinematics}"
    );
    for (program, words) in [
        ("$P_UIFR[0]=CTRANS(X,1)", "no work offset for $P_UIFR[0]"),
        ("$P_UIFR[10]=CTRANS(X,1)", "no work offset for $P_UIFR[10]"),
        ("$P_UIFR[1]=CMIRROR(X)", "CMIRROR in a settable offset"),
        ("$P_UIFR[1,X,SC]=2", "SC in a settable offset"),
        ("$P_UIFR[1]=CROT(X,30)", "turns about X or Y"),
        ("$P_UIFR[1,X,FI]=2", "the fine part"),
        ("$P_UIFR[1]=CTRANS(Q,3)", "the name of an axis is missing"),
        ("R1=$P_UIFR[1,X,TR]", "cannot be evaluated ahead of time"),
    ] {
        let shown = errors(&format!("{program}\nM30\n"));
        assert!(shown.contains(words), "{program}\n{shown}");
    }
}
