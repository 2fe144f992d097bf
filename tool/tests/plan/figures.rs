//! Times where they are known, and what limits the machine.

use crate::support::{Bench, MILL, number, time_of};

/// The least time from rest to rest within velocity, acceleration and jerk (Biagiotti and Melchiorri,
/// chapter 3).
fn rest_to_rest(length: f64, velocity: f64, acceleration: f64, jerk: f64) -> f64 {
    let delay = acceleration / jerk;
    let ramp = if acceleration * delay >= velocity {
        2.0 * (velocity / jerk).sqrt()
    } else {
        velocity / acceleration + delay
    };
    if length >= velocity * ramp {
        return length / velocity + ramp;
    }
    let square = acceleration * delay;
    let peak = ((square * square + 4.0 * acceleration * length).sqrt() - square) / 2.0;
    if peak >= square {
        2.0 * (peak / acceleration + delay)
    } else {
        4.0 * (length / (2.0 * jerk)).cbrt()
    }
}

/// The plan ends within a cycle, and begins at one.
const CYCLES: f64 = 0.0021;

#[test]
fn lines_take_the_least_time() {
    let bench = Bench::new();
    for length in [0.01, 0.3, 5.0, 200.0] {
        let program = format!("G21 G61.1 F60000\nG1 X{length}\nM2\n");
        let figures = bench.figures(&program, &[]);
        let expected = rest_to_rest(length, 100.0, 1000.0, 20_000.0);
        assert!(
            (number(&figures["time"]) - expected).abs() < CYCLES,
            "{length}"
        );
    }
    let changed = [
        "--limits",
        "V=50,A=400",
        "--jerk",
        "5000",
        "--period",
        "0.0005",
    ];
    let figures = bench.figures("G21 G61.1 F60000\nG1 Y20\nM2\n", &changed);
    let expected = rest_to_rest(20.0, 50.0, 400.0, 5000.0);
    assert!((number(&figures["time"]) - expected).abs() < CYCLES);
    assert_eq!(figures["axes"][0]["letter"], "Y");
}

#[test]
fn limits_start_and_startup_code_come_from_the_ini_file() {
    let bench = Bench::new();
    // The machine starts at Z 10 in G61.1.
    let ini = format!("{MILL}HOME = 10\n");
    let figures = bench.figures_on(&ini, "F60000\nG1 Z30\nZ10\nM2\n");
    let expected = 2.0 * rest_to_rest(20.0, 50.0, 500.0, 5000.0);
    assert!((number(&figures["time"]) - expected).abs() < 3.0 * CYCLES);
    let axis = &figures["axes"][0];
    assert_eq!(
        (axis["letter"].as_str(), number(&axis["to"])),
        (Some("Z"), 30.0)
    );
    assert!((number(&axis["from"]) - 10.0).abs() < 1e-6);
    for peak in axis["peaks"].as_array().expect("peaks") {
        let share = number(&peak["share"]);
        assert!((0.99..1.05).contains(&share), "{peak}");
    }
}

#[test]
fn a_machine_in_inches() {
    let bench = Bench::new();
    let mut inches = MILL.replace("LINEAR_UNITS = mm", "LINEAR_UNITS = inch");
    for (mm, inch) in [
        ("= 100\n", "= 4\n"),
        ("= 1000\n", "= 40\n"),
        ("= 20000\n", "= 800\n"),
    ] {
        inches = inches.replace(mm, inch);
    }
    let figures = bench.figures_on(&inches, "G20\nF6000\nG1 X8\nM2\n");
    let expected = rest_to_rest(8.0, 4.0, 40.0, 800.0);
    assert!((number(&figures["time"]) - expected).abs() < CYCLES);
    assert_eq!(figures["length_unit"], "in");
    assert!((number(&figures["path_length"]) - 8.0).abs() < 1e-9);
    assert!((number(&figures["axes"][0]["peaks"][0]["peak"]) - 4.0).abs() < 1e-3);
    // F is of length also where an arc ends at its start, which no axis shows.
    let circle = bench.figures_on(&inches, "G20\nF60\nG2 I1\nM2\n");
    let time = number(&circle["time"]);
    assert!((time - std::f64::consts::TAU).abs() < 0.1, "{time}");
    assert!((number(&circle["greatest_speed"]["value"]) - 1.0).abs() < 0.01);
}

#[test]
fn tool_table_and_parameters_count() {
    let bench = Bench::new();
    bench.write("tools.tbl", "T1 P1 Z5 ;short\nT7 P2 Z40 D6 ;long\n");
    bench.write("mill.var", "5221\t100.0\n5222\t0.0\n5223\t0.0\n");
    let ini = MILL.replace("[RS274NGC]\n", "[RS274NGC]\nPARAMETER_FILE = mill.var\n")
        + "[EMCIO]\nTOOL_TABLE = tools.tbl\n";
    let figures = bench.figures_on(&ini, "F6000\nT7 M6 G43\nG0 Z0\nG1 X-50\nM2\n");
    let axis = |index: usize| {
        let axis = &figures["axes"][index];
        [number(&axis["from"]), number(&axis["to"])]
    };
    assert_eq!(axis(0), [0.0, 50.0], "G54 is at X 100");
    assert_eq!(axis(1), [0.0, 40.0], "the tool is 40 long");
    assert_eq!(
        bench.read("mill.var").lines().next(),
        Some("5221\t100.0"),
        "left alone"
    );
}

/// Where tools change places, pocket 0 is the spindle.
#[test]
fn the_tool_that_the_spindle_holds_counts() {
    let bench = Bench::new();
    bench.write("tools.tbl", "T3 P2 Z20\nT5 P0 Z30\n");
    let rise = |changer: &str| {
        let ini = format!("{MILL}[EMCIO]\nTOOL_TABLE = tools.tbl\n{changer}");
        let figures = bench.figures_on(&ini, "F6000\nG43\nG0 X1 Z0\nT3 M6 G43\nG0 X2 Z0\nM2\n");
        let axes = figures["axes"].as_array().expect("axes").iter();
        let z = axes.clone().find(|axis| axis["letter"] == "Z");
        z.map(|z| [number(&z["from"]), number(&z["to"])])
    };
    assert_eq!(rise("RANDOM_TOOLCHANGER = 1\n"), Some([0.0, 30.0]));
    assert_eq!(rise(""), Some([0.0, 20.0]));
}

#[test]
fn what_limits_a_plain_program() {
    let bench = Bench::new();
    let slow = bench.figures("G21 G61.1 F600\nG1 X50\nM2\n", &[]);
    assert!(time_of(&slow["limited_by"], "programmed feed") > 4.9);
    assert!(time_of(&slow["phases"], "at feed") > 4.9);
    let fast = bench.figures("G21 G61.1\nG0 X300\nM2\n", &[]);
    assert!(time_of(&fast["limited_by"], "velocity of X") > 2.8);
    assert!(time_of(&fast["limited_by"], "acceleration of X") > 0.08);
    assert!(time_of(&fast["limited_by"], "jerk of X") > 0.08);
    let capped = bench.figures("G21 G61.1 F6000\nG1 X50\nM2\n", &["--velocity-limit", "20"]);
    assert!(time_of(&capped["limited_by"], "greatest path velocity") > 2.3);
    let waiting = bench.figures("G21 G61.1 F6000\nG1 X5\nG4 P1.5\nX0\nM2\n", &[]);
    let dwell = time_of(&waiting["limited_by"], "dwell (G4)");
    assert!((dwell - 1.5).abs() < 0.01, "{dwell}");
    for figures in [slow, fast, capped, waiting] {
        for shares in ["phases", "limited_by"] {
            let shares = figures[shares].as_array().expect("shares");
            let all: f64 = shares.iter().map(|share| number(&share["time"])).sum();
            assert!((all - number(&figures["time"])).abs() < 1e-6);
        }
    }
}

#[test]
fn how_even_the_speed_of_cutting_is() {
    let bench = Bench::new();
    // 50 mm/s after 1.25 mm on both sides, with rapids before and behind.
    let program = "G21 G61.1\nG0 X30\nF3000\nG1 X80\nF600\nX90\nG0 X0\nM2\n";
    let figures = bench.figures(program, &[]);
    let evenness = &figures["evenness"];
    let feeds = evenness["feeds"].as_array().expect("feeds");
    let named: Vec<f64> = feeds.iter().map(|feed| number(&feed["feed"])).collect();
    assert_eq!(named, [3000.0, 600.0], "{evenness}");
    // From rest to 95 % of 50 mm/s it takes .1 s less the end of the last jerk: sqrt(2 * 2.5 / 20000).
    let below = 2.0 * (0.1 - (5.0_f64 / 20_000.0).sqrt());
    let fast = &feeds[0];
    let found = number(&fast["time"]) - number(&fast["near"]);
    assert!((found - below).abs() < 0.004, "{found} {below}");
    let times: f64 = feeds.iter().map(|feed| number(&feed["time"])).sum();
    assert!((times - number(&evenness["total"]["time"])).abs() < 1e-9);
    let stretches = evenness["below"].as_array().expect("stretches");
    // Braking for the stop between both feeds, and starting from it.
    let lines = &stretches[0]["lines"];
    assert_eq!([&lines[0], &lines[1]], [4, 6], "{evenness}");
    assert!(
        stretches[0]["cause"]
            .as_str()
            .expect("text")
            .ends_with("of X")
    );
    let rapid = bench.figures("G21\nG0 X30\nM2\n", &[]);
    assert!(rapid["evenness"]["total"]["share"].is_null());
}

#[test]
fn a_plan_names_the_options_that_changed_it() {
    let bench = Bench::new();
    let program = "G21 G64 P0.05 F600\nG1 X5\nM2\n";
    let plain = bench.figures(program, &[]);
    let limits = |figures: &serde_json::Value| figures["limits_from"].to_string();
    assert!(!limits(&plain).contains("changed by"), "{plain}");
    let handed_over = plain["handed_over"].as_str().expect("text");
    assert!(handed_over.starts_with("one in each cycle"), "{plain}");
    let options = [
        "--feed-at-least=3000",
        "--rotary-tolerance=0.5",
        "--default-tolerance=0.1",
        "--corners-inside",
        "--fill-queue",
    ];
    let changed = bench.figures(program, &options);
    let named = "changed by --feed-at-least 3000 (not of G95) --rotary-tolerance 0.5 --default-tolerance 0.1 \
                 --corners-inside";
    assert!(limits(&changed).contains(named), "{changed}");
    let handed_over = changed["handed_over"].as_str().expect("text");
    assert!(
        handed_over.contains("until the queue was full"),
        "{changed}"
    );
}

#[test]
fn corners_are_slow_places_within_p() {
    let bench = Bench::new();
    let program = "G21 G64 P0.05 F3000\nG1 X40\nX40 Y40\nX0 Y40\nM2\n";
    let figures = bench.figures(program, &[]);
    assert!(time_of(&figures["phases"], "in corners and curves") > 0.005);
    let slowest = figures["slowest"].as_array().expect("places");
    let corners: Vec<&serde_json::Value> = slowest
        .iter()
        .filter(|place| number(&place["least_share"]) > 0.01)
        .collect();
    assert_eq!(corners.len(), 2, "{slowest:?}");
    let mut lines: Vec<i64> = corners.iter().filter_map(|p| p["line"].as_i64()).collect();
    lines.sort_unstable();
    assert!(lines[0] == 2 || lines[0] == 3, "{lines:?}");
    assert!(
        corners
            .iter()
            .all(|p| !p["text"].as_str().expect("text").is_empty())
    );
    let tightest = &figures["deviation"]["tightest"];
    let share = number(&tightest["distance"]) / number(&tightest["tolerance"]);
    assert!((0.5..1.01).contains(&share), "{tightest}");
    // The path crosses the corner at the tolerance from its point.
    assert_eq!(
        tightest["distance"],
        figures["deviation"]["programmed"]["distance"]
    );
}

#[test]
fn exact_modes_are_exact() {
    let bench = Bench::new();
    let figures = bench.figures("G21 G61 F3000\nG1 X40\nG3 X40 Y20 J10\nG1 X0\nM2\n", &[]);
    assert!(number(&figures["deviation"]["exact"]["distance"]) < 2e-3);
    assert!(number(&figures["deviation"]["planned"]["distance"]) < 2e-3);
    let stops = bench.figures("G21 G61.1 F3000\nG1 X40\nG3 X40 Y20 J10\nG1 X0\nM2\n", &[]);
    assert!(number(&stops["deviation"]["planned"]["distance"]) < 1e-9);
}

#[test]
fn a_thread_and_a_tap_follow_the_spindle() {
    let bench = Bench::new();
    let program = "G21 G61.1 F600\nM3 S600\nG33 Z-20 K1\nG0 Z5\nG33.1 Z-5 K1\nM5\nM2\n";
    let figures = bench.figures(program, &[]);
    // 20 mm and twice 10 mm at 10 mm/s
    let time = number(&figures["time"]);
    assert!((4.0..6.0).contains(&time), "{time}");
}

/// The spindle goes on while it turns back, and the tap with it.
#[test]
fn a_tap_beyond_its_ends_is_on_the_path() {
    let bench = Bench::new();
    let program = "G21 G90 G61 F600\nG0 Z5\nM3 S600\nG33.1 Z-5 K1\nM5\nG1 X5\nM2\n";
    let ini = format!("{MILL}[SPINDLE_0]\nMAX_FORWARD_VELOCITY = 3000\n");
    let figures = bench.figures_on(&ini, program);
    assert_eq!(figures["findings"], serde_json::json!([]), "{figures}");
    let lowest = number(&figures["axes"][1]["from"]);
    assert!(lowest < -5.1, "{figures}");
}

#[test]
fn speeds_of_rotary_axes_are_degrees() {
    let bench = Bench::new();
    let speed = |program: &str| {
        let figures = bench.figures(program, &[]);
        let speed = &figures["greatest_speed"];
        (speed["unit"].to_string(), number(&speed["value"]))
    };
    let (unit, value) = speed("G20 G61 F3000\nG1 A90\nM2\n");
    assert_eq!(unit, "\"deg\"");
    assert!((45.0..50.1).contains(&value), "{value}");
    // Degrees and millimetres are not compared with each other.
    let (unit, value) = speed("G21 G61 F3000\nG1 A90\nG1 X50 F600\nM2\n");
    assert_eq!(unit, "\"mm\"");
    assert!((value - 10.0).abs() < 0.1, "{value}");
    let text = bench.plan(&["part.ngc"]);
    let text = String::from_utf8_lossy(&text.stdout).into_owned();
    assert!(
        text.contains("mm/s (") && !text.contains("deg/s ("),
        "{text}"
    );
}

/// [TRAJ]MAX_LINEAR_VELOCITY, in inches here: 4 in/s are no 4 degrees/s.
#[test]
fn the_greatest_path_velocity_is_none_of_rotary_axes() {
    let bench = Bench::new();
    let inches = MILL
        .replace(
            "LINEAR_UNITS = mm",
            "LINEAR_UNITS = inch\nMAX_LINEAR_VELOCITY = 4",
        )
        .replace(
            "COORDINATES = XYZ",
            "COORDINATES = XYZA\nANGULAR_UNITS = degree",
        )
        .replace("coordinates=XYZ", "coordinates=XYZA");
    let limits = "MAX_VELOCITY = 100\nMAX_ACCELERATION = 1000\n";
    let ini = format!("{inches}[AXIS_A]\n{limits}MAX_JERK = 20000\n[JOINT_3]\n{limits}");
    let seconds = |program: &str, name: &str| {
        let figures = bench.figures_on(&ini, program);
        time_of(&figures["limited_by"], name)
    };
    let turn = "G20 F3000\nG1 A90\nM2\n";
    assert_eq!(seconds(turn, "greatest path velocity"), 0.0);
    assert!(seconds(turn, "programmed feed") > 1.5);
    let line = "G20\nF3000\nG1 X20\nM2\n";
    assert!(seconds(line, "greatest path velocity") > 4.0);
}

#[test]
fn slow_places_and_distances_of_rotary_axes_are_degrees() {
    let bench = Bench::new();
    for (units, length_unit) in [("mm", "mm"), ("inch", "in")] {
        let table = MILL
            .replace("LINEAR_UNITS = mm", &format!("LINEAR_UNITS = {units}"))
            .replace("COORDINATES = XYZ", "COORDINATES = XYA")
            .replace("coordinates=XYZ", "coordinates=XYA")
            .replace("AXIS_Z", "AXIS_A");
        // There and back: the point of return is missed by as many degrees as P has millimetres, at most.
        let figures = bench.figures_on(&table, "G21 G64 P0.01\nG1 A90 F360\nG1 A0\nM2\n");
        let deviation = &figures["deviation"];
        assert_eq!(deviation["unit"], "deg");
        assert!(
            (number(&deviation["tightest"]["tolerance"]) - 0.01).abs() < 1e-9,
            "{figures}"
        );
        let missed = number(&deviation["programmed"]["distance"]);
        assert!((0.002..0.0102).contains(&missed), "{figures}");
        for place in figures["slowest"].as_array().expect("places") {
            assert_eq!(place["speed_unit"], "deg", "{figures}");
            assert_ne!(place["phase"], "at feed", "{figures}");
        }
        let text = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
        let text = String::from_utf8_lossy(&text.stdout).into_owned();
        assert!(
            text.contains("s lost       deg/s    of F")
                && text.contains("of the tolerance 0.010000 deg"),
            "{text}"
        );
        assert!(
            !text.contains(&format!("{length_unit}/s")) && !text.contains(" um"),
            "{text}"
        );
        // Beside lengths they count as such, and rows say which is which.
        let figures = bench.figures_on(&table, "G21 G61.1\nG1 A90 F360\nG1 X1\nM2\n");
        assert_eq!(figures["deviation"]["unit"], length_unit);
        let text = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
        let text = String::from_utf8_lossy(&text.stdout).into_owned();
        assert!(
            text.contains(&format!("{length_unit}/s    of F")) && text.contains(" deg     0 %"),
            "{text}"
        );
    }
}

/// Facing at a constant surface speed takes the time in which the spiral of the feed is as long as the surface has run.
#[test]
fn with_g96_the_spindle_follows_the_diameter() {
    let bench = Bench::new();
    let time = |turning: &str| {
        let program = format!(
            "G21 G64 P0.01 G18\nG43.1 X7\nG0 X50\n{turning} M3\nG95 F0.2\nG1 X10\nM5 G49\nM2\n"
        );
        number(&bench.figures(&program, &[])["time"])
    };
    // the rapid, and what the spindle takes to be known
    let before = 0.8;
    let surface = |speed: f64, from: f64, to: f64| {
        60.0 * std::f64::consts::PI * (from * from - to * to) / (0.2 * 1000.0 * speed)
    };
    let metres = time("G96 D3000 S100");
    let expected = before + surface(100.0, 50.0, 10.0);
    assert!((metres - expected).abs() < 0.2, "{metres}");
    let feet = time(&format!("G20\nG96 D3000 S{}\nG21", 100.0 / 0.3048));
    assert!((feet - metres).abs() < CYCLES, "{feet}");
    // from 500 turns a minute on it is the greatest speed
    let radius = 100_000.0 / (2.0 * std::f64::consts::PI * 500.0);
    let limited = time("G96 D500 S100");
    let expected = before + surface(100.0, 50.0, radius) + 60.0 * (radius - 10.0) / (0.2 * 500.0);
    assert!((limited - expected).abs() < 0.2, "{limited}");
    let turns = time("G97 S500");
    assert!((turns - before - 24.0).abs() < 0.2, "{turns}");
}

#[test]
fn the_speeds_of_g96_are_told() {
    let bench = Bench::new();
    let speeds = |greatest: &str| {
        let program =
            format!("G21 G61.1 G18\nG0 X50\nG96 {greatest} S100 M3\nG95 F0.2\nG1 X10\nM5\nM2\n");
        bench.figures(&program, &[])["surface_speed"].take()
    };
    let at_50 = 2000.0 / (2.0 * std::f64::consts::PI);
    let found = speeds("D1000");
    assert!((number(&found["least"]) - at_50).abs() < 0.01, "{found}");
    assert!(
        (number(&found["greatest"]) - 1000.0).abs() < 1e-6,
        "{found}"
    );
    assert!(bench.figures("G21 S500 M3 F600\nG1 X1\nM2\n", &[])["surface_speed"].is_null());
    bench.write(
        "part.ngc",
        "G21 G18 F600\nG0 X50\nG96 S100 M3\nG1 X-1\nM5\nM2\n",
    );
    let text = String::from_utf8(bench.plan(&["part.ngc"]).stdout).expect("text");
    assert!(text.contains("without an end: G96 has no D"), "{text}");
}

#[test]
fn the_ini_file_limits_the_spindle() {
    let bench = Bench::new();
    let time = |limit: &str| {
        let ini = format!("{MILL}[SPINDLE_0]\n{limit}\n");
        number(&bench.figures_on(&ini, "G21 G61.1 S1000 M3\nG95 F0.2\nG1 X20\nM5\nM2\n")["time"])
    };
    // 20 mm with 0.2 mm a turn
    assert!((time("") - 6.0).abs() < 0.1);
    assert!((time("MAX_FORWARD_VELOCITY = 500") - 12.0).abs() < 0.1);
}

/// The last two passes of the cycle run along each other.
#[test]
fn a_threading_cycle_is_where_it_is_programmed() {
    let bench = Bench::new();
    let program = "G21 G18 G64 P0.01\nG0 X20 Z5\nG97 S600 M3\nG0 X11 Z6\n\
                   G76 P1.5 Z-15.5 I-1 J0.3 K0.92 R1.5 Q29.5 H1\nG0 X20 Z5\nM5\nM2\n";
    let figures = bench.figures(program, &[]);
    for what in ["planned", "programmed", "tightest"] {
        let found = &figures["deviation"][what];
        assert!(number(&found["distance"]) < 0.0101, "{what}: {found}");
    }
}
