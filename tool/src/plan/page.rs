//! The HTML page of a plan: its path, where its time goes, and the curves of each axis.

use super::cause::Cause;
use super::collector::{Collected, DISTANCE, SPEED};
use super::figures::Figures;
use super::listing::Listing;
use crate::machine::length_unit::INCH;
use crate::page::Envelope;
use crate::page::{EnvelopeData, Page, distance_factor, floats, integers};
use crate::path::rates::Quantity;
use serde::Serialize;

#[derive(Serialize)]
struct PageData<'a> {
    report: &'a Figures,
    path: PathData,
    /// A plan has no programmed path to be seen beside it.
    programmed: NoPath,
    profiles: ProfileData,
    /// By their number.
    causes: Vec<CauseData>,
    listing: &'a Listing,
    /// Whether Z is drawn across and X up, a radius.
    lathe: bool,
    /// Of the speed over time.
    speed_unit: &'a str,
    /// What to write where the path is far from the program.
    advice: Option<String>,
}

#[derive(Default, Serialize)]
struct NoPath {
    x: String,
    y: String,
    z: String,
    rapid: String,
}

/// 32-bit numbers in base64, shape (points).
#[derive(Serialize)]
struct PathData {
    time: String,
    x: String,
    y: String,
    z: String,
    speed: String,
    line: String,
    /// Of the stroke that ends here: 1 rapid, 0 feed.
    rapid: String,
    cause: String,
}

#[derive(Serialize)]
struct ProfileData {
    time: String,
    end: f64,
    /// Shape (axes, 3).
    axes: Vec<Vec<EnvelopeData>>,
    speed: EnvelopeData,
    distance: EnvelopeData,
    distance_factor: f64,
    /// Of what is no micrometre.
    distance_unit: &'static str,
}

#[derive(Serialize)]
struct CauseData {
    name: String,
    kind: &'static str,
}

/// The name of the colour of a cause.
pub fn kind(cause: Cause) -> &'static str {
    match cause {
        Cause::Feed => "feed",
        Cause::PathVelocity => "path",
        Cause::Between => "between",
        Cause::Dwell | Cause::Spindle | Cause::Rest | Cause::Program => "waiting",
        Cause::Axis(_, quantity) | Cause::Joint(_, quantity) => quantity.name(),
    }
}

/// Writes the page; `text` is for readers without JavaScript.
///
/// # Errors
/// Those of `serde_json`, which do not occur with finite numbers.
pub fn render(
    figures: &Figures,
    collected: &Collected,
    listing: &Listing,
    text: &str,
) -> Result<String, serde_json::Error> {
    let data = PageData {
        report: figures,
        path: path_data(collected),
        programmed: NoPath::default(),
        profiles: profile_data(figures, collected),
        causes: (0..Cause::COUNT)
            .map(|index| CauseData {
                name: Cause::at(index).name(),
                kind: kind(Cause::at(index)),
            })
            .collect(),
        listing,
        lathe: figures.is_lathe,
        speed_unit: &figures.drawn_speed.unit,
        advice: figures
            .deviation
            .planned
            .advice(figures.length_unit, figures.deviation.unit),
    };
    Page {
        kind: "plan",
        title: &figures.program,
        sections: include_str!("page/plan.html"),
        style: include_str!("page/plan.css"),
        script: include_str!("page/plan.js"),
        text,
    }
    .render(&data)
}

fn path_data(collected: &Collected) -> PathData {
    let path = &collected.path;
    let column = |axis: usize| floats(path.iter().map(|point| point.point[axis] as f32));
    PathData {
        time: floats(path.iter().map(|point| point.time as f32)),
        x: column(0),
        y: column(1),
        z: column(2),
        speed: floats(path.iter().map(|point| point.speed)),
        line: integers(path.iter().map(|point| point.line)),
        rapid: integers(path.iter().map(|point| i32::from(point.is_rapid))),
        cause: integers(path.iter().map(|point| i32::from(point.cause))),
    }
}

fn profile_data(figures: &Figures, collected: &Collected) -> ProfileData {
    let profiles = &collected.profiles;
    let period = figures.servo_period;
    let envelope = |channel: usize, factor: f64| {
        let scaled = |value: f32| (f64::from(value) * factor) as f32;
        let (low, high) = profiles
            .channel(channel)
            .map(|[low, high]| (scaled(low), scaled(high)))
            .unzip();
        EnvelopeData::from(Envelope { low, high })
    };
    // They were kept in machine units.
    let distance_unit = figures.deviation.unit;
    let distance_factor = match (distance_unit, figures.length_unit) {
        ("deg", "in") => INCH,
        _ => distance_factor(distance_unit),
    };
    let times = (0..profiles.buckets()).map(|bucket| (bucket * profiles.cycles) as f64 * period);
    ProfileData {
        time: floats(times.map(|time| time as f32)),
        end: collected.path.last().map_or(0.0, |point| point.time),
        axes: figures
            .axes
            .iter()
            .map(|axis| {
                let first = 3 * axis.index;
                let channels = first..first + Quantity::ALL.len();
                channels.map(|channel| envelope(channel, 1.0)).collect()
            })
            .collect(),
        speed: envelope(SPEED, 1.0),
        distance: envelope(DISTANCE, distance_factor),
        distance_factor,
        distance_unit,
    }
}
