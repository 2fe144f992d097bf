//! A drawing of the plan: the path in space coloured by speed, and the speed over time.

use super::collector::{Collected, SPEED};
use super::figures::Figures;
use crate::format::{duration, significant};
use crate::page::escape;
use std::fmt::{self, Write};

const WIDTH: f64 = 1200.0;
const HEIGHT: f64 = 900.0;

/// Where the path is drawn: left, top, right, bottom.
const PATH_FRAME: [f64; 4] = [40.0, 90.0, 1160.0, 590.0];

/// Where the speed is drawn.
const SPEED_FRAME: [f64; 4] = [90.0, 690.0, 1160.0, 840.0];

/// Steps of the speed scale.
const STEPS: usize = 24;

/// Slow to fast, light and dark.
const COLOURS: [[[u8; 3]; 5]; 2] = [
    [
        [55, 39, 122],
        [43, 102, 176],
        [21, 154, 140],
        [116, 179, 59],
        [237, 164, 11],
    ],
    [
        [131, 116, 230],
        [77, 151, 227],
        [43, 185, 168],
        [154, 208, 80],
        [255, 203, 71],
    ],
];

/// The drawing.
///
/// # Errors
/// Those of the writer; a `String` has none.
pub fn render(figures: &Figures, collected: &Collected) -> Result<String, fmt::Error> {
    let mut out = String::new();
    let svg = &mut out;
    writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"system-ui, 'Noto Sans', 'Liberation Sans', sans-serif\" font-size=\"14\">"
    )?;
    style(svg)?;
    writeln!(
        svg,
        "<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" class=\"ground\"/>"
    )?;
    let title = escape(&figures.program);
    writeln!(
        svg,
        "<text x=\"40\" y=\"46\" font-size=\"26\">{title}</text>"
    )?;
    let u = figures.length_unit;
    let about = format!(
        "{}, {} {u} of path, at most {} {}/s",
        duration(figures.time),
        significant(figures.path_length, 5),
        significant(figures.greatest_speed.value, 4),
        figures.greatest_speed.unit
    );
    writeln!(
        svg,
        "<text x=\"40\" y=\"72\" class=\"quiet\">{}</text>",
        escape(&about)
    )?;
    path(svg, figures, collected)?;
    legend(svg, figures)?;
    speed(svg, figures, collected)?;
    writeln!(svg, "</svg>")?;
    Ok(out)
}

fn style(svg: &mut String) -> fmt::Result {
    let colours = |svg: &mut String, stops: &[[u8; 3]; 5]| {
        for step in 0..STEPS {
            let at = 4.0 * step as f64 / (STEPS - 1) as f64;
            let low = (at as usize).min(3);
            let share = at - low as f64;
            let mixed = [0, 1, 2].map(|k| {
                let (a, b) = (f64::from(stops[low][k]), f64::from(stops[low + 1][k]));
                (a + share * (b - a)).round() as u8
            });
            let [r, g, b] = mixed;
            write!(svg, ".s{step}{{stroke:#{r:02x}{g:02x}{b:02x};fill:none}}")?;
        }
        Ok(())
    };
    svg.push_str(
        "<style>.ground{fill:#fff}text{fill:#1b1f24}.quiet{fill:#646c76}\
         .rule{stroke:#dde1e5;fill:none}.curve{fill:#2458c5}",
    );
    colours(svg, &COLOURS[0])?;
    svg.push_str(
        "@media(prefers-color-scheme:dark){.ground{fill:#14171a}text{fill:#e6e9ec}\
         .quiet{fill:#99a2ac}.rule{stroke:#30363d}.curve{fill:#82aaff}",
    );
    colours(svg, &COLOURS[1])?;
    svg.push_str("}</style>\n");
    Ok(())
}

/// Turn and tilt of the view, radians: from the front right and above.
const VIEW: [f64; 2] = [-0.6, 0.55];

/// Across and up, of a direction in space.
fn project([x, y, z]: [f64; 3]) -> [f64; 2] {
    let [(turn_sine, turn_cosine), (tilt_sine, tilt_cosine)] = VIEW.map(f64::sin_cos);
    let deep = turn_sine * x + turn_cosine * y;
    [
        turn_cosine * x - turn_sine * y,
        tilt_cosine * z + tilt_sine * deep,
    ]
}

fn path(svg: &mut String, figures: &Figures, collected: &Collected) -> fmt::Result {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let points: Vec<[f64; 2]> = collected.path.iter().map(|p| project(p.point)).collect();
    for point in &points {
        for k in 0..2 {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
    let [left, top, right, bottom] = PATH_FRAME;
    let size = |k: usize| (high[k] - low[k]).max(1e-9);
    let scale = ((right - left) / size(0)).min((bottom - top) / size(1));
    let place = |[across, up]: [f64; 2]| {
        [
            (left + right) / 2.0 + scale * (across - (low[0] + high[0]) / 2.0),
            (top + bottom) / 2.0 - scale * (up - (low[1] + high[1]) / 2.0),
        ]
    };
    let greatest = figures.drawn_speed.greatest.max(1e-9);
    let mut strokes = vec![String::new(); STEPS];
    let mut last = [usize::MAX; STEPS];
    for (index, pair) in points.windows(2).enumerate() {
        let speeds = [collected.path[index].speed, collected.path[index + 1].speed];
        let share = f64::from(speeds[0] + speeds[1]) / 2.0 / greatest;
        let step = ((share * STEPS as f64) as usize).min(STEPS - 1);
        let [from, to] = [place(pair[0]), place(pair[1])];
        if last[step] != index {
            write!(strokes[step], "M{:.1} {:.1}", from[0], from[1])?;
        }
        write!(strokes[step], "L{:.1} {:.1}", to[0], to[1])?;
        last[step] = index + 1;
    }
    // The slow ones on top.
    for (step, stroke) in strokes.iter().enumerate().rev() {
        if !stroke.is_empty() {
            writeln!(
                svg,
                "<path class=\"s{step}\" stroke-width=\"1.6\" stroke-linejoin=\"round\" d=\"{stroke}\"/>"
            )?;
        }
    }
    axes_cross(svg, figures, collected)
}

fn axes_cross(svg: &mut String, figures: &Figures, collected: &Collected) -> fmt::Result {
    let origin = [70.0, 626.0];
    let directions = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (letter, direction) in ["X", "Y", "Z"].iter().zip(directions) {
        let [across, up] = project(direction);
        let end = |length: f64| [origin[0] + length * across, origin[1] - length * up];
        let ([x, y], [tx, ty]) = (end(26.0), end(36.0));
        let [ox, oy] = origin;
        writeln!(
            svg,
            "<path class=\"rule\" stroke-width=\"1.5\" d=\"M{ox} {oy}L{x:.1} {y:.1}\"/>\
             <text x=\"{tx:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{letter}</text>",
            ty + 5.0
        )?;
    }
    let x_is = match figures.is_lathe {
        true => ", X is a radius",
        false => "",
    };
    let extents = [0, 1, 2].map(|k| {
        let size = collected.axes.high[k] - collected.axes.low[k];
        significant(size, 5)
    });
    writeln!(
        svg,
        "<text x=\"130\" y=\"630\" class=\"quiet\">box {} {}{x_is}</text>",
        extents.join(" × "),
        figures.length_unit
    )
}

fn legend(svg: &mut String, figures: &Figures) -> fmt::Result {
    let (left, top, width) = (840.0, 610.0, 320.0);
    let part = width / STEPS as f64;
    for step in 0..STEPS {
        let x = left + part * step as f64;
        writeln!(
            svg,
            "<path class=\"s{step}\" stroke-width=\"9\" d=\"M{x:.2} {top}h{:.2}\"/>",
            part + 0.8
        )?;
    }
    for quarter in 0..=4 {
        let share = f64::from(quarter) / 4.0;
        let anchor = ["start", "middle", "middle", "middle", "end"][quarter as usize];
        writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"{anchor}\" class=\"quiet\">{}</text>",
            left + share * width,
            top + 22.0,
            significant(share * figures.drawn_speed.greatest, 3)
        )?;
    }
    writeln!(
        svg,
        "<text x=\"{left}\" y=\"{}\" class=\"quiet\">speed along the path ({})</text>",
        top + 42.0,
        figures.drawn_speed.unit
    )
}

/// Round numbers that divide 0 to `high` into about `count` parts.
fn ticks(high: f64, count: f64) -> Vec<f64> {
    let raw = (high / count).max(1e-12);
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= 0.999 * raw)
        .unwrap_or(10.0 * power);
    (0..=(high / step * (1.0 + 1e-9)) as usize)
        .map(|k| step * k as f64)
        .collect()
}

fn speed(svg: &mut String, figures: &Figures, collected: &Collected) -> fmt::Result {
    let [left, top, right, bottom] = SPEED_FRAME;
    let profiles = &collected.profiles;
    let bucket = profiles.cycles as f64 * figures.servo_period;
    let end = (bucket * profiles.buckets() as f64).max(1e-9);
    let greatest = 1.05 * figures.drawn_speed.greatest.max(1e-9);
    let x = |time: f64| left + (right - left) * time / end;
    let y = |value: f64| bottom - (bottom - top) * value / greatest;
    for value in ticks(greatest, 4.0) {
        let level = y(value);
        writeln!(
            svg,
            "<path class=\"rule\" d=\"M{left} {level:.1}H{right}\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\" class=\"quiet\">{}</text>",
            left - 8.0,
            level + 5.0,
            significant(value, 4)
        )?;
    }
    for time in ticks(end, 12.0) {
        writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\" class=\"quiet\">{}</text>",
            x(time),
            bottom + 20.0,
            significant(time, 5)
        )?;
    }
    let middle = (top + bottom) / 2.0;
    writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" class=\"quiet\">time (s)</text>\
         <text transform=\"translate(30 {middle}) rotate(-90)\" text-anchor=\"middle\" \
         class=\"quiet\">speed ({})</text>",
        (left + right) / 2.0,
        bottom + 42.0,
        figures.drawn_speed.unit
    )?;
    // The range of each span of time as one band.
    let ranges: Vec<[f32; 2]> = profiles.channel(SPEED).collect();
    let mut band = String::new();
    let at = |k: usize| x(bucket * (k as f64 + 0.5));
    for (k, [_, high]) in ranges.iter().enumerate() {
        let command = if k == 0 { 'M' } else { 'L' };
        write!(
            band,
            "{command}{:.1} {:.1}",
            at(k),
            y(f64::from(*high)) - 0.9
        )?;
    }
    for (k, [low, _]) in ranges.iter().enumerate().rev() {
        write!(band, "L{:.1} {:.1}", at(k), y(f64::from(*low)) + 0.9)?;
    }
    writeln!(svg, "<path class=\"curve\" d=\"{band}Z\"/>")
}
