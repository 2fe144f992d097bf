//! The HTML page: the executed path beside the programmed one, and the curves of each joint.

use serde::Serialize;

use super::decimation::{bucket_starts, derivative_envelope, envelope, keep_rows};
use super::recording::Recording;
use super::summary::{Analysis, Report};
use crate::page::{EnvelopeData, Page, distance_factor, floats, integers};
use crate::path::pieces::{Point, distance};
use crate::path::rates::Quantity;
use crate::program::contour::{ContourMove, Shape};

/// Points of a drawn path at most. All these bounds together keep a page below 5 MB.
const PATH_POINTS: usize = 30_000;
/// Points in time of a profile at most.
const PROFILE_POINTS: usize = 3_000;
/// Bytes of a program that is listed at most.
const LISTING_BYTES: usize = 1_000_000;
/// The drawn path is right to this share of its extent.
const PATH_SHARE: f64 = 5e-5;

/// The program that is listed on the page.
pub struct Listing {
    /// Its file name.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Whether the lines are those of the contour (a part program) or those of the recording (the
    /// program that LinuxCNC ran).
    pub by_source: bool,
}

/// What the script of the page reads.
#[derive(Serialize)]
struct PageData<'a> {
    report: &'a Report,
    recording: &'a str,
    path: PathData,
    programmed: ProgrammedData,
    profiles: ProfileData,
    listing: Option<ListingData<'a>>,
    /// Whether Z is drawn across and X up, a radius.
    lathe: bool,
}

/// The executed path, shape (samples), 32-bit numbers in base64.
#[derive(Serialize)]
struct PathData {
    time: String,
    x: String,
    y: String,
    z: String,
    speed: String,
    line: String,
    source: String,
    /// Of the stroke that ends here: 1 rapid, 0 feed, and what the comparison with the program does not know.
    rapid: String,
}

/// The programmed path; `rapid` of the stroke that ends here: 1 rapid, 0 feed, -1 no stroke.
#[derive(Serialize)]
struct ProgrammedData {
    x: String,
    y: String,
    z: String,
    rapid: String,
}

#[derive(Serialize)]
struct ProfileData {
    time: String,
    end: f64,
    /// Shape (joints, 3).
    joints: Vec<Vec<EnvelopeData>>,
    distance: Option<EnvelopeData>,
    distance_factor: f64,
}

#[derive(Serialize)]
struct ListingData<'a> {
    note: String,
    by_source: bool,
    lines: Vec<&'a str>,
}

/// Writes the page. `recording_name` is shown in its headline; `text` is the report as text, for
/// readers without JavaScript.
///
/// # Errors
/// Those of `serde_json`, which do not occur with finite numbers.
pub fn render(
    analysis: &Analysis,
    recording: &Recording,
    recording_name: &str,
    text: &str,
    contour: &[ContourMove],
    listing: Option<&Listing>,
) -> Result<String, serde_json::Error> {
    let data = PageData {
        report: &analysis.report,
        recording: recording_name,
        path: path_data(analysis, recording, contour),
        programmed: programmed_data(contour),
        profiles: profile_data(analysis, recording),
        listing: listing.map(listing_data),
        lathe: analysis.report.is_lathe,
    };
    Page {
        kind: "report",
        title: &analysis.report.title,
        sections: include_str!("page/report.html"),
        style: "",
        script: include_str!("page/report.js"),
        text,
    }
    .render(&data)
}

fn path_data(analysis: &Analysis, recording: &Recording, contour: &[ContourMove]) -> PathData {
    let points = &analysis.points;
    let period = analysis.report.servo_period;
    let speeds: Vec<f64> = (0..points.len())
        .map(|row| {
            if row == 0 || analysis.breaks.binary_search(&row).is_ok() {
                return 0.0;
            }
            distance(points[row - 1], points[row]) / period
        })
        .collect();
    // The line of the source where the comparison knows it: only of the program itself.
    let programmed = |row: usize| {
        let following = analysis.following.as_ref()?;
        contour.get(*following.moves.get(row)? as usize)
    };
    let source = |row: usize| {
        programmed(row)
            .filter(|m| m.file == 0)
            .map_or(0, |m| i32::try_from(m.line).unwrap_or(0))
    };
    let marks: Vec<i64> = (0..points.len())
        .map(|row| recording.lines[row] << 32 | i64::from(source(row)))
        .collect();
    let rows = keep_rows(
        points,
        &speeds,
        &marks,
        PATH_SHARE * extent(points),
        0.01 * analysis.report.greatest_speed.value,
        PATH_POINTS,
    );
    let column = |axis: usize| floats(rows.iter().map(|row| points[*row][axis] as f32));
    PathData {
        time: floats(rows.iter().map(|row| recording.times[*row] as f32)),
        x: column(0),
        y: column(1),
        z: column(2),
        speed: floats(rows.iter().map(|row| speeds[*row] as f32)),
        line: integers(
            rows.iter()
                .map(|row| i32::try_from(recording.lines[*row]).unwrap_or(0)),
        ),
        source: integers(rows.iter().map(|row| source(*row))),
        rapid: integers(
            rows.iter()
                .map(|row| i32::from(programmed(*row).is_some_and(|m| m.rapid))),
        ),
    }
}

/// The greatest side of the box around the points.
fn extent(points: &[Point]) -> f64 {
    (0..3)
        .map(|axis| {
            let values = points.iter().map(|point| point[axis]);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            values.fold(f64::NEG_INFINITY, f64::max) - least
        })
        .fold(0.0, f64::max)
}

/// The programmed path as strokes; arcs become chords of about 2 degrees.
fn programmed_data(contour: &[ContourMove]) -> ProgrammedData {
    let mut points: Vec<Point> = Vec::new();
    let mut kinds: Vec<i32> = Vec::new();
    for programmed in contour {
        let start = programmed.shape.point(0.0);
        if points.last() != Some(&start) {
            points.push(start);
            kinds.push(-1);
        }
        let count = match &programmed.shape {
            Shape::Line { .. } => 1,
            Shape::Arc { sweep, .. } => (sweep / 0.035).ceil().clamp(1.0, 2000.0) as u32,
        };
        for index in 1..=count {
            points.push(programmed.shape.point(f64::from(index) / f64::from(count)));
            kinds.push(i32::from(programmed.rapid));
        }
    }
    let speeds = vec![0.0; points.len()];
    let marks: Vec<i64> = kinds.iter().copied().map(i64::from).collect();
    let rows = if points.len() > PATH_POINTS {
        let tolerance = PATH_SHARE * extent(&points);
        keep_rows(&points, &speeds, &marks, tolerance, 1.0, PATH_POINTS)
    } else {
        (0..points.len()).collect()
    };
    let column = |axis: usize| floats(rows.iter().map(|row| points[*row][axis] as f32));
    ProgrammedData {
        x: column(0),
        y: column(1),
        z: column(2),
        rapid: integers(rows.iter().map(|row| kinds[*row])),
    }
}

fn profile_data(analysis: &Analysis, recording: &Recording) -> ProfileData {
    let rows = recording.rows();
    let period = analysis.report.servo_period;
    let starts = bucket_starts(rows, PROFILE_POINTS);
    let joints = recording
        .joints
        .iter()
        .map(|positions| {
            Quantity::ALL
                .into_iter()
                .map(|quantity| {
                    derivative_envelope(&starts, positions, &recording.gaps, quantity, period)
                        .into()
                })
                .collect()
        })
        .collect();
    let distance_factor = distance_factor(analysis.report.length_unit);
    let distance = analysis.following.as_ref().map(|following| {
        envelope(&starts, rows, |row| {
            Some(distance_factor * f64::from(following.distances[row]))
        })
        .into()
    });
    ProfileData {
        time: floats(starts.iter().map(|row| recording.times[*row] as f32)),
        end: recording.times[rows - 1],
        joints,
        distance,
        distance_factor,
    }
}

fn listing_data(listing: &Listing) -> ListingData<'_> {
    let count = listing.text.lines().count();
    let too_long = listing.text.len() > LISTING_BYTES;
    let note = if too_long {
        format!(
            "{}: {count} lines, too long to be listed here",
            listing.name
        )
    } else {
        listing.name.clone()
    };
    ListingData {
        note,
        by_source: listing.by_source,
        lines: listing
            .text
            .lines()
            .take(if too_long { 0 } else { count })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::recording::tests::recording_of;
    use super::super::summary::analyse;
    use super::super::summary::tests::circle_run;
    use super::*;
    use crate::machine::configuration::tests::{MILL, machine};
    use base64::Engine;
    use base64::engine::general_purpose::STANDARD;

    fn page(title: &str, listing: Option<&Listing>) -> String {
        let mill = machine(MILL).expect("a machine");
        let (recording, contour) = circle_run(50.0, 0.005);
        let analysis = analyse(title, &mill, &recording, &contour, Some(0.01));
        render(
            &analysis,
            &recording,
            "run.csv",
            "Result: <text>",
            &contour,
            listing,
        )
        .expect("a page")
    }

    /// What stands between two marks.
    fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
        let (_, rest) = text.split_once(from).expect("the first mark");
        rest.split_once(to).expect("the second mark").0
    }

    #[test]
    fn every_element_is_closed() {
        let page = page("Circle", None);
        let html = between(&page, "<body>", "<script");
        for tag in [
            "main", "script", "style", "section", "figure", "div", "span",
        ] {
            let opened = html.matches(&format!("<{tag}>")).count()
                + html.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }

    #[test]
    fn nothing_in_the_input_becomes_html_or_script() {
        let listing = Listing {
            name: "</script><b>.mpf".to_owned(),
            text: "N10 </script>\nN20 {{style}}".to_owned(),
            by_source: true,
        };
        let page = page("<b>\"A & B\"</b>", Some(&listing));
        assert!(page.contains("<pre>Result: &lt;text&gt;</pre>"));
        assert!(page.contains("<title>&lt;b&gt;&quot;A &amp; B&quot;&lt;/b&gt;</title>"));
        assert_eq!(page.matches("</script>").count(), 2);
        let json = between(&page, "id=\"data\">", "</script>");
        let data: serde_json::Value = serde_json::from_str(json).expect("valid JSON");
        assert_eq!(data["listing"]["lines"][0], "N10 </script>");
        assert_eq!(data["listing"]["lines"][1], "N20 {{style}}");
        assert_eq!(data["report"]["title"], "<b>\"A & B\"</b>");
    }

    #[test]
    fn the_columns_of_the_path_agree_in_length_and_end() {
        let page = page("Circle", None);
        let json = between(&page, "id=\"data\">", "</script>");
        let data: serde_json::Value = serde_json::from_str(json).expect("valid JSON");
        let column = |name: &str| {
            let text = data["path"][name].as_str().expect("a column");
            STANDARD.decode(text).expect("base64")
        };
        let times = column("time");
        for name in ["x", "y", "z", "speed", "line", "source", "rapid"] {
            assert_eq!(column(name).len(), times.len(), "{name}");
        }
        let last: [u8; 4] = times[times.len() - 4..].try_into().expect("four bytes");
        let end = data["profiles"]["end"].as_f64().expect("a number");
        assert!((f64::from(f32::from_le_bytes(last)) - end).abs() < 1e-6);
    }

    #[test]
    fn strokes_of_rapid_moves_are_marked() {
        let mill = machine(MILL).expect("a machine");
        let (recording, mut contour) = circle_run(50.0, 0.005);
        let marked = |contour: &[ContourMove]| {
            let analysis = analyse("circle", &mill, &recording, contour, Some(0.01));
            let column = path_data(&analysis, &recording, contour).rapid;
            let numbers = STANDARD.decode(column).expect("base64");
            let mut numbers = numbers.chunks(4).map(|number| number[0]);
            numbers.any(|number| number == 1)
        };
        assert!(!marked(&contour));
        contour[0].rapid = true;
        assert!(marked(&contour));
    }

    #[test]
    fn the_page_of_a_long_run_stays_small() {
        let points: Vec<Point> = (0..200_000)
            .map(|row| {
                let t = f64::from(row) * 0.001;
                let wave = (37.0 * t).sin() + 0.3 * (151.0 * t).cos();
                [50.0 * t.cos() + wave, 50.0 * t.sin(), 0.01 * t * wave]
            })
            .collect();
        let recording = recording_of(&points, |row| row as i64 / 3);
        let mill = machine(MILL).expect("a machine");
        let analysis = analyse("long", &mill, &recording, &[], None);
        let page = render(&analysis, &recording, "run.csv", "", &[], None).expect("a page");
        assert!(page.len() < 5_000_000, "{}", page.len());
    }
}
