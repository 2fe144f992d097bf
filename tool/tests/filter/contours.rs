//! The contour of programs, against numbers worked out by hand.

use crate::shop::Shop;
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::part_program::contour;
use framepath_tool::program::contour::{ContourMove, Shape};
use framepath_tool::program::trace::Setup;

fn contour_of(program: &str) -> Vec<ContourMove> {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let path = shop.path("part.mpf");
    contour(
        Dialect::Sinumerik,
        &path,
        &Settings::default(),
        &Setup::default(),
    )
    .expect("a contour")
}

fn ends(program: &str) -> Vec<[f64; 3]> {
    contour_of(program)
        .iter()
        .map(|step| step.shape.point(1.0))
        .collect()
}

fn assert_near(given: [f64; 3], wanted: [f64; 3], what: &str) {
    for axis in 0..3 {
        assert!(
            (given[axis] - wanted[axis]).abs() < 6e-5,
            "{what}: {given:?}, not {wanted:?}"
        );
    }
}

/// Where frames take points: the examples of the control's manual.
#[test]
fn frames_take_points_where_the_manual_says() {
    for (frame, point, image) in [
        (
            "TRANS X55 Y35\nAROT RPL=45",
            [10., 0., 0.],
            [62.0711, 42.0711, 0.],
        ),
        (
            "TRANS X55 Y35\nAROT RPL=45",
            [0., 10., 0.],
            [47.9289, 42.0711, 0.],
        ),
        (
            "TRANS X20 Y40\nAROT RPL=60",
            [10., 0., 0.],
            [25., 48.6603, 0.],
        ),
        (
            "TRANS X20 Y40\nAROT RPL=60",
            [0., 10., 0.],
            [11.3397, 45., 0.],
        ),
        ("G18\nROT RPL=-50", [10., 0., 0.], [6.4279, 0., 7.6604]),
        ("G18\nROT RPL=-50", [0., 0., 10.], [-7.6604, 0., 6.4279]),
        ("ROT X30 Y20 Z10", [10., 0., 0.], [9.2542, 1.6318, -3.4202]),
        ("ROT X30 Y20 Z10", [0., 10., 0.], [0.1803, 8.8256, 4.6985]),
        ("ROT X30 Y20 Z10", [0., 0., 10.], [3.7852, -4.4097, 8.1380]),
        ("ROT X90 Y90 Z90", [10., 0., 0.], [0., 0., -10.]),
        ("ROT X90 Y90 Z90", [0., 0., 10.], [10., 0., 0.]),
        (
            "ROT X30\nAROT Z-50\nAROT Y15",
            [10., 0., 0.],
            [6.2089, -5.1140, -5.9411],
        ),
        (
            "ROT X30\nAROT Z-50\nAROT Y15",
            [0., 0., 10.],
            [1.6637, -6.5467, 7.3738],
        ),
        (
            "TRANS X10 Y10\nATRANS X35\nAROT Y30\nATRANS X5",
            [0., 0., 0.],
            [49.3301, 10., -2.5],
        ),
        (
            "TRANS X10 Y10\nATRANS X35\nAROT Y30\nATRANS X5",
            [10., 0., 0.],
            [57.9904, 10., -7.5],
        ),
        ("ROTS X30 Y20", [10., 0., 0.], [8.6603, 0., -5.]),
        ("ROTS X30 Y20", [0., 10., 0.], [1.5031, 9.5374, 2.6035]),
        (
            "TRANS X40 Y20\nAROT RPL=35\nASCALE X.7 Y.7",
            [10., 0., 0.],
            [45.7341, 24.0150, 0.],
        ),
        ("SCALE X2 Y2\nATRANS X2.5 Y18", [0., 0., 0.], [5., 36., 0.]),
        ("MIRROR X0\nATRANS X10", [5., 0., 0.], [-15., 0., 0.]),
        ("TRANS X10\nAMIRROR X0", [5., 0., 0.], [5., 0., 0.]),
        ("MIRROR X0\nAROT RPL=30", [10., 0., 0.], [-8.6603, 5., 0.]),
        (
            "SCALE X2\nAROT RPL=45",
            [10., 0., 0.],
            [14.1421, 7.0711, 0.],
        ),
        ("ROT RPL=30\nTRANS", [10., 0., 0.], [10., 0., 0.]),
        ("TRANS X1\nASCALE X2\nASCALE", [10., 0., 0.], [11., 0., 0.]),
    ] {
        let [x, y, z] = point;
        // By way of somewhere else, so that the move is never left out.
        let program = format!("{frame}\nG0 X=1000 Y=1000 Z=1000\nG0 X={x} Y={y} Z={z}\nM30\n");
        assert_near(ends(&program)[1], image, frame);
    }
}

#[test]
fn arcs_are_mirrored_and_become_ellipses() {
    let part = "G0 X10 Y0 Z0\nG3 X0 Y10 I-10 J0 F100\nM30\n";
    let middle = |frame: &str| contour_of(&format!("{frame}\n{part}"))[1].shape.point(0.5);
    let half = 10.0 * 0.5_f64.sqrt();
    assert_near(middle("TRANS"), [half, half, 0.0], "as it is");
    assert_near(middle("MIRROR X0"), [-half, half, 0.0], "mirrored");
    assert_near(middle("SCALE X2"), [2.0 * half, half, 0.0], "stretched");
    assert_near(middle("ROT X90"), [half, 0.0, half], "tilted");
}

#[test]
fn moves_know_their_line_and_feed() {
    let moves = contour_of("G0 X1\nG1 X2 F150\nS600 M3\nG95 F0.5\nX3\nG93\nX13 F2\nM30\n");
    let told: Vec<(u32, bool, f64)> = moves
        .iter()
        .map(|step| (step.line, step.rapid, step.feed))
        .collect();
    assert_eq!(
        told,
        [
            (1, true, 0.0),
            (2, false, 150.0),
            (5, false, 300.0),
            (7, false, 20.0)
        ]
    );
}

#[test]
fn missing_axes_stay_where_the_tool_is() {
    // X stays at 10 on the machine when the frame moves: it is X5 in the new frame.
    let program = "G0 X10 Y10 Z10\nTRANS X5\nG0 Y0\nX0\nG92 Y100\nM30\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    assert!(!shop.run("part.mpf", &[]).status.success());
    let program = program.replace("G92 Y100\n", "");
    assert_eq!(
        ends(&program),
        [[10.0, 10.0, 10.0], [10.0, 0.0, 10.0], [5.0, 0.0, 10.0]]
    );
}

#[test]
fn presets_shift_what_follows() {
    let program = "G0 X10\nG92 X3\nG0 X4\nM30\n";
    assert_eq!(ends(program), [[10.0, 0.0, 0.0], [11.0, 0.0, 0.0]]);
}

#[test]
fn full_circles_and_turns_have_their_sweep() {
    let moves = contour_of("G0 X10 Y0 Z0\nG2 I-10 F100\nG3 X0 Y10 Z6 I-10 TURN=2\nM30\n");
    let sweeps: Vec<f64> = moves
        .iter()
        .filter_map(|step| match step.shape {
            Shape::Arc { sweep, .. } => Some(sweep / std::f64::consts::TAU),
            Shape::Line { .. } => None,
        })
        .collect();
    assert!((sweeps[0] - 1.0).abs() < 1e-12);
    assert!((sweeps[1] - 2.25).abs() < 1e-12);
    assert_near(moves[2].shape.point(1.0), [0.0, 10.0, 6.0], "helix");
}
