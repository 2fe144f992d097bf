//! The HTML pages of `framepath report` and `framepath plan`: one file that needs nothing else, neither
//! fonts nor scripts nor a network. `page/` holds the frame and what the pages share: style, drawings,
//! tables, the cursor that links them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

const FRAME: &str = include_str!("page/frame.html");
const STYLE: &str = include_str!("page/page.css");
const SCRIPTS: [&str; 6] = [
    include_str!("page/data.js"),
    include_str!("page/views.js"),
    include_str!("page/profiles.js"),
    include_str!("page/parts.js"),
    include_str!("page/playback.js"),
    include_str!("page/linking.js"),
];

/// What is a page's own.
pub(crate) struct Page<'a> {
    /// The command that makes it.
    pub kind: &'static str,
    pub title: &'a str,
    /// HTML between the key figures and the listing.
    pub sections: &'static str,
    /// Comes after the style of all pages.
    pub style: &'static str,
    /// Runs after the scripts of all pages.
    pub script: &'static str,
    /// The same figures as text, for readers without JavaScript.
    pub text: &'a str,
}

impl Page<'_> {
    /// The whole page; `data` is what its scripts read.
    ///
    /// # Errors
    /// Those of `serde_json`, which do not occur with finite numbers.
    pub fn render(&self, data: &impl Serialize) -> Result<String, serde_json::Error> {
        // Inside a script element only "</script" and "<!--" would end the data.
        let json = serde_json::to_string(data)?.replace('<', "\\u003c");
        Ok(fill(
            FRAME,
            &[
                ("{{kind}}", self.kind),
                ("{{title}}", &escape(self.title)),
                ("{{sections}}", self.sections),
                ("{{style}}", &(STYLE.to_owned() + self.style)),
                ("{{text}}", &escape(self.text)),
                ("{{data}}", &json),
                ("{{script}}", &(SCRIPTS.concat() + self.script)),
            ],
        ))
    }
}

/// Least and greatest value in each bucket of time.
pub(crate) struct Envelope {
    /// Shape (buckets).
    pub low: Vec<f32>,
    /// Shape (buckets).
    pub high: Vec<f32>,
}

/// The same as 32-bit numbers in base64.
#[derive(Serialize)]
pub(crate) struct EnvelopeData {
    low: String,
    /// Left out if it is the same as `low`.
    #[serde(skip_serializing_if = "Option::is_none")]
    high: Option<String>,
}

impl From<Envelope> for EnvelopeData {
    fn from(envelope: Envelope) -> EnvelopeData {
        let high = (envelope.low != envelope.high).then(|| floats(envelope.high.into_iter()));
        EnvelopeData {
            low: floats(envelope.low.into_iter()),
            high,
        }
    }
}

/// What the distances of a profile are multiplied with: 1000 makes micrometres of millimetres.
pub(crate) fn distance_factor(length_unit: &str) -> f64 {
    if length_unit == "mm" { 1000.0 } else { 1.0 }
}

/// Text as HTML.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

pub(crate) fn floats(values: impl Iterator<Item = f32>) -> String {
    STANDARD.encode(values.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

pub(crate) fn integers(values: impl Iterator<Item = i32>) -> String {
    STANDARD.encode(values.flat_map(i32::to_le_bytes).collect::<Vec<u8>>())
}

/// Puts the values into the template, in one pass: a value is never searched for places itself.
fn fill(template: &str, values: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some(at) = rest.find("{{") {
        page.push_str(&rest[..at]);
        rest = &rest[at..];
        match values.iter().find(|(name, _)| rest.starts_with(name)) {
            Some((name, value)) => {
                page.push_str(value);
                rest = &rest[name.len()..];
            }
            None => {
                page.push_str("{{");
                rest = &rest[2..];
            }
        }
    }
    page.push_str(rest);
    page
}
