//! The words of one block, evaluated and sorted by address.

use super::g_functions::unsupported_g;
use super::spindle::Diameter;
use super::syntax::{Way, Word, WordValue};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::words::{AXES, At, Dimension, MotionWords, set};
use crate::dialects::expression::{Value, Variables};
use crate::program::moves::Corner;
use crate::source::Span;

/// The tool word.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolWord {
    /// `T3`.
    Number(f64),
    /// `T="MILL_10"`.
    Name(String),
}

/// All words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockWords {
    /// G numbers times ten: 591 is G59.1.
    pub g: Vec<At<u32>>,
    pub m: Vec<At<u32>>,
    pub motion: MotionWords,
    pub feed: Option<At<f64>>,
    pub speed: Option<At<f64>>,
    pub tool: Option<At<()>>,
    pub tool_word: Option<ToolWord>,
    pub offset: Option<At<f64>>,
    /// I1 J1 K1: the intermediate point of CIP.
    pub middle: [Option<At<(f64, Dimension)>>; 3],
    /// AR: the angle of an arc, degrees.
    pub opening: Option<At<f64>>,
    /// DISR and DISCL, units of the program.
    pub approach_distance: Option<At<f64>>,
    pub approach_height: Option<At<(f64, Dimension)>>,
    /// FAD, units of the program.
    pub approach_feed: Option<At<f64>>,
    /// ANG: the angle of a line, degrees.
    pub contour_angle: Option<At<f64>>,
    /// AP and RP: polar coordinates.
    pub polar_angle: Option<At<(f64, Dimension)>>,
    pub polar_radius: Option<At<(f64, Dimension)>>,
    /// RND, CHF, CHR: lengths in units of the program, 0 for a corner that stays as it is.
    pub corner: Option<At<Corner>>,
    /// RNDM.
    pub rounding: Option<At<f64>>,
    /// CIP, CT.
    pub cip: Option<Span>,
    pub ct: Option<Span>,
    /// ADIS, units of the program.
    pub rounding_distance: Option<At<f64>>,
    /// CTOL, units of the program.
    pub contour_tolerance: Option<At<f64>>,
    pub supa: Option<Span>,
    pub end_of_routine: Option<Span>,
    /// Ways by which rotary axes turn to their angles.
    pub ways: [Option<Way>; 9],
    /// SPOS, SPOSA: the angle of the spindle, degrees.
    pub spindle_angle: Option<At<f64>>,
    /// The way of the spindle to that angle, where DC, ACP or ACN names one.
    pub spindle_way: Option<Way>,
    /// LIMS: revolutions per minute.
    pub most_speed: Option<At<f64>>,
    /// DIAMON, DIAMOF, DIAM90.
    pub diameter: Option<Diameter>,
    /// Commands that only tune the control.
    pub noted: Vec<At<String>>,
}

impl BlockWords {
    /// Evaluates the words in their order. `None` when something was wrong with one of them; that has
    /// been reported.
    pub fn collect(
        words: &[Word],
        variables: &dyn Variables,
        diagnostics: &mut Diagnostics,
    ) -> Option<BlockWords> {
        let before = diagnostics.errors();
        let mut block = BlockWords::default();
        let mut failed = false;
        if let Some(refusal) = words.iter().find_map(|word| machine_point(word, variables)) {
            diagnostics.push(refusal);
            return None;
        }
        for word in words {
            if let Err(diagnostic) = block.add(word, variables) {
                diagnostics.push(diagnostic);
                failed = true;
            }
        }
        (!failed && diagnostics.errors() == before).then_some(block)
    }

    fn add(&mut self, word: &Word, variables: &dyn Variables) -> Result<(), Diagnostic> {
        let span = word.span;
        let address = word.address.as_str();
        if let Some(axis) = AXES.iter().position(|axis| *axis == address) {
            if let WordValue::Angle(way, _) = &word.value {
                if !matches!(address, "A" | "B" | "C") {
                    return Err(error(span, "DC, ACP and ACN belong to rotary axes"));
                }
                self.ways[axis] = Some(*way);
            }
            return set(
                &mut self.motion.axes[axis],
                dimensioned(word, variables)?,
                span,
                address,
            );
        }
        if let Some(axis) = ["I", "J", "K"].iter().position(|axis| *axis == address) {
            return set(
                &mut self.motion.centre[axis],
                dimensioned(word, variables)?,
                span,
                address,
            );
        }
        match address {
            "G" => {
                let value = ten_times_code(number(word, variables)?, span)?;
                self.g.push(At { value, span });
                Ok(())
            }
            "M" | "M1" => {
                let value = ten_times_code(number(word, variables)?, span)?;
                if value % 10 != 0 {
                    return Err(error(span, "M numbers are whole"));
                }
                let value = value / 10;
                if address == "M1" && !matches!(value, 3..=5) {
                    return Err(error(span, "only M1=3, M1=4 and M1=5 are supported"));
                }
                self.m.push(At { value, span });
                Ok(())
            }
            "CR" => set(&mut self.motion.radius, number(word, variables)?, span, address),
            "TURN" => set(&mut self.motion.turns, number(word, variables)?, span, address),
            "F" => set(&mut self.feed, number(word, variables)?, span, address),
            "S" | "S1" => set(&mut self.speed, number(word, variables)?, span, "S"),
            "D" => set(&mut self.offset, number(word, variables)?, span, address),
            "ADIS" => set(&mut self.rounding_distance, number(word, variables)?, span, address),
            "CTOL" => set(&mut self.contour_tolerance, number(word, variables)?, span, address),
            "T" | "T1" => self.tool(word, variables),
            "I1" | "J1" | "K1" => {
                let axis = ["I1", "J1", "K1"].iter().position(|name| *name == address);
                let axis = axis.unwrap_or(0);
                set(&mut self.middle[axis], dimensioned(word, variables)?, span, address)
            }
            "AR" => set(&mut self.opening, number(word, variables)?, span, address),
            "DISR" => set(&mut self.approach_distance, number(word, variables)?, span, address),
            "DISCL" => set(&mut self.approach_height, dimensioned(word, variables)?, span, address),
            "FAD" => set(&mut self.approach_feed, number(word, variables)?, span, address),
            "ANG" => set(&mut self.contour_angle, number(word, variables)?, span, address),
            "AP" => set(&mut self.polar_angle, dimensioned(word, variables)?, span, address),
            "RP" => set(&mut self.polar_radius, dimensioned(word, variables)?, span, address),
            "RND" | "CHF" | "CHR" => {
                let length = number(word, variables)?;
                if length < 0.0 {
                    return Err(error(span, "a rounding or chamfer cannot be negative"));
                }
                let corner = match address {
                    "RND" => Corner::Round(length),
                    "CHF" => Corner::ChamferOf(length),
                    _ => Corner::ChamferFrom(length),
                };
                set(&mut self.corner, corner, span, "a rounding or chamfer")
            }
            "RNDM" => set(&mut self.rounding, number(word, variables)?, span, address),
            "SPOS" | "SPOSA" => {
                if let WordValue::Angle(way, _) = &word.value {
                    self.spindle_way = Some(*way);
                }
                set(&mut self.spindle_angle, angle(word, variables)?, span, "SPOS")
            }
            "LIMS" => set(&mut self.most_speed, number(word, variables)?, span, address),
            "DIAMON" | "DIAMOF" | "DIAM90" => {
                self.diameter = Some(match address {
                    "DIAMON" => Diameter::Always,
                    "DIAM90" => Diameter::Absolute,
                    _ => Diameter::Never,
                });
                Ok(())
            }
            "CIP" => {
                self.cip = Some(span);
                Ok(())
            }
            "CT" => {
                self.ct = Some(span);
                Ok(())
            }
            "SUPA" => {
                self.supa = Some(span);
                Ok(())
            }
            "SETMS" => {
                let spindle = match &word.value {
                    WordValue::Plain(value) => value.number(variables)?,
                    _ => 1.0,
                };
                if spindle != 1.0 {
                    return Err(Diagnostic::error(span, format!("SETMS({spindle}): only the first spindle is supported"))
                            .help("LinuxCNC's spindle 0 is that of SETMS(1)"));
                }
                let value = address.to_string();
                self.noted.push(At { value, span });
                Ok(())
            }
            "RET" => {
                self.end_of_routine = Some(span);
                Ok(())
            }
            _ if super::words::is_noted(address) => {
                let value = address.to_string();
                self.noted.push(At { value, span });
                Ok(())
            }
            "N" => Err(Diagnostic::error(span, "the block number stands at the beginning of the block")),
            "P" => Err(Diagnostic::error(span, "P has no meaning here")
                    .help("P gives the number of passes after a subprogram call: L10 P3")),
            "ADISPOS" => Err(Diagnostic::error(span, "ADISPOS is not supported: LinuxCNC rounds rapid motions as it does the others")
                    .help("leave it out; where rapid motions may not be rounded by ADIS, write G60 before them")),
            "RPL" => Err(Diagnostic::error(span, "RPL has no meaning here").help("it belongs to ROT and AROT")),
            // Of 0 they change nothing.
            "OFFN" | "FRC" | "FRCM" if number(word, variables)? == 0.0 => Ok(()),
            _ => Err(unsupported(address, span)),
        }
    }

    fn tool(&mut self, word: &Word, variables: &dyn Variables) -> Result<(), Diagnostic> {
        set(&mut self.tool, (), word.span, "T")?;
        let WordValue::Plain(value) = &word.value else {
            return Err(error(word.span, "a tool number or a name is needed here"));
        };
        self.tool_word = Some(match value.evaluate(variables)? {
            Value::Number(number) => ToolWord::Number(number),
            Value::Text(name) => ToolWord::Name(name),
        });
        Ok(())
    }
}

impl BlockWords {
    /// Whether there is anything to move.
    pub fn is_motion(&self) -> bool {
        self.motion.is_motion()
            || self.opening.is_some()
            || self.contour_angle.is_some()
            || self.polar_angle.is_some()
            || self.polar_radius.is_some()
            || self.middle.iter().any(Option::is_some)
    }
}

/// The error for an address that is not translated: `S2`, `FRC`, `X1`.
fn unsupported(address: &str, span: Span) -> Diagnostic {
    let refuse = |reason: String, help: &str| Diagnostic::error(span, reason).help(help);
    match (
        address,
        address.trim_end_matches(|c: char| c.is_ascii_digit()),
    ) {
        (_, "H") => refuse(
            "H functions are not supported".to_string(),
            "they switch something on this one machine: use an M function that LinuxCNC has",
        ),
        (_, "S" | "M" | "T") => refuse(
            format!("{address}: only the first spindle is supported"),
            "LinuxCNC's spindle 0 is that of S1, M1 and T1: write these, or leave the number out",
        ),
        ("FRC" | "FRCM", _) => refuse(
            format!("{address}: a feed of its own for a chamfer or rounding is not supported"),
            "leave it out, or write the corner as a line or an arc of its own with F beside it",
        ),
        ("OFFN", _) => refuse(
            "OFFN: a contour with an allowance is not supported".to_string(),
            "add twice the allowance to the diameter of the tool in the tool table of LinuxCNC",
        ),
        _ => refuse(
            format!("the address {address} is not supported"),
            "axes are X Y Z A B C U V W",
        ),
    }
}

/// The error for G74 and G75, which have axes of the machine beside them: X1, which is known nowhere else.
fn machine_point(word: &Word, variables: &dyn Variables) -> Option<Diagnostic> {
    let code = number(word, variables)
        .ok()
        .filter(|_| word.address == "G")?;
    let code = ten_times_code(code, word.span).ok()?;
    matches!(code, 740 | 750).then(|| unsupported_g(code, word.span))
}

fn error(span: Span, message: &str) -> Diagnostic {
    Diagnostic::error(span, message)
}

fn number(word: &Word, variables: &dyn Variables) -> Result<f64, Diagnostic> {
    match &word.value {
        WordValue::Plain(value) => value.number(variables),
        _ => Err(error(word.span, "AC and IC belong to axes and to I, J, K")),
    }
}

/// The angle of the spindle, by whatever way.
fn angle(word: &Word, variables: &dyn Variables) -> Result<f64, Diagnostic> {
    match &word.value {
        WordValue::Plain(value) | WordValue::Absolute(value) | WordValue::Angle(_, value) => {
            value.number(variables)
        }
        _ => Err(error(
            word.span,
            "an angle from zero of the spindle is needed here",
        )),
    }
}

fn dimensioned(word: &Word, variables: &dyn Variables) -> Result<(f64, Dimension), Diagnostic> {
    let (value, dimension) = match &word.value {
        WordValue::Plain(value) => (value, Dimension::Modal),
        WordValue::Absolute(value) => (value, Dimension::Absolute),
        WordValue::Incremental(value) => (value, Dimension::Incremental),
        WordValue::Angle(_, value) => (value, Dimension::Absolute),
        WordValue::None => return Err(error(word.span, "a value is missing here")),
    };
    Ok((value.number(variables)?, dimension))
}

/// Numbers of G and M functions have at most one decimal.
fn ten_times_code(number: f64, span: Span) -> Result<u32, Diagnostic> {
    let tenfold = (number * 10.0).round();
    if !(0.0..=99990.0).contains(&tenfold) || (tenfold - number * 10.0).abs() > 1e-9 {
        return Err(error(span, "this is not the number of a function"));
    }
    Ok(tenfold as u32)
}
