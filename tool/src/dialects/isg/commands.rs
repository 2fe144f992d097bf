//! Parsing commands that begin with `#`, and the declarations of variables.

use super::expressions::{expression, v_variable};
use super::reader::{Parsed, Reader};
use super::syntax::{Command, Declaration, Parameter};
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::Expression;
use crate::dialects::spelling::did_you_mean;

/// Commands that only tune the control, by their first words.
const NOTED: [&str; 3] = ["SLOPE", "SET SLOPE PROFIL", "FLUSH"];

/// Commands that are refused, with the reason.
const REFUSED: [(&str, &str); 12] = [
    ("TRAFO", KINEMATICS),
    ("RTCP", KINEMATICS),
    ("KIN", KINEMATICS),
    ("ECS", KINEMATICS),
    (
        "ACS",
        "use #CS ON [..], which is carried out by the frame kinematics",
    ),
    ("BCS", "set the work offset of the machine instead"),
    ("PSET", "use G92, or set the work offset of the machine"),
    ("MCS", "use G53 to move without work offset"),
    ("PUT", "axes belong to one channel in LinuxCNC"),
    ("CALL", "axes belong to one channel in LinuxCNC"),
    ("SPLINE", "post the program with lines and arcs"),
    ("AKIMA", "post the program with lines and arcs"),
];

const KINEMATICS: &str = "kinematic transformations are not switched by programs here: post the \
                          program for three axes, or use #CS ON [..]";

/// All that are understood, for guesses.
pub(super) const KNOWN: [&str; 12] = [
    "MSG",
    "HSC",
    "CS",
    "ROTATION",
    "TIME",
    "SLOPE",
    "SET SLOPE PROFIL",
    "FLUSH",
    "CONTOUR MODE",
    "VAR",
    "ENDVAR",
    "COMMENT",
];

/// A command after its `#`, which stands at `start`.
pub fn command(reader: &mut Reader, start: usize) -> Parsed<Command> {
    reader.blanks();
    let name = reader.name_ahead();
    for noted in NOTED {
        if begins_with(reader, noted) {
            reader.take_while(|_| true);
            return Ok(Command::Noted(format!("#{noted}")));
        }
    }
    if begins_with(reader, "CONTOUR MODE") {
        return Ok(contouring(reader));
    }
    reader.name();
    let span = reader.span_from(start);
    match name.as_str() {
        "MSG" => message(reader),
        "HSC" => smoothing(reader),
        "CS" => system(reader),
        "ROTATION" => rotation(reader),
        "TIME" => Ok(Command::Dwell(expression(reader)?)),
        "COMMENT" => Err(Diagnostic::error(span, "#COMMENT without BEGIN or END").help(
            "write #COMMENT BEGIN in a line before the comment, and #COMMENT END in a line behind it",
        )),
        _ => {
            let refused = REFUSED.iter().find(|(known, _)| *known == name);
            if let Some((_, reason)) = refused {
                return Err(
                    Diagnostic::error(span, format!("#{name} is not supported")).help(*reason)
                );
            }
            let error = Diagnostic::error(span, format!("#{name} is not supported"));
            let similar = did_you_mean(&name, KNOWN.into_iter(), |known| format!("#{known}"));
            Err(error.help(similar.unwrap_or_else(|| {
                "look it up in the manual of the control, and write it with functions that are \
                 supported"
                    .to_string()
            })))
        }
    }
}

/// Whether these words come next; nothing is taken.
fn begins_with(reader: &Reader, words: &str) -> bool {
    let mut ahead = reader.clone();
    words.split(' ').all(|word| ahead.keyword(word))
}

/// `#MSG ["text %f", value]`.
fn message(reader: &mut Reader) -> Parsed<Command> {
    reader.expect("[")?;
    let Some(text) = reader.text()? else {
        return Err(reader.error_with_help("a text is missing here", "write #MSG [\"text\"]"));
    };
    let mut values = Vec::new();
    while reader.take(",") {
        values.push(expression(reader)?);
    }
    reader.expect("]")?;
    Ok(Command::Message(text, values))
}

/// `#HSC ON`, `#HSC OFF`, `#HSC [..]`, `#HSC ON [..]`.
fn smoothing(reader: &mut Reader) -> Parsed<Command> {
    let on = on_or_off(reader);
    Ok(Command::Smoothing(on, parameters(reader)?))
}

/// `#CONTOUR MODE ON [DEV PATH_DEV=0.1 ..]`. Its many other forms only tune the control.
fn contouring(reader: &mut Reader) -> Command {
    reader.keyword("CONTOUR");
    reader.keyword("MODE");
    let on = on_or_off(reader);
    let mut ahead = reader.clone();
    let given = parameters(&mut ahead).ok();
    ahead.blanks();
    let given = given.filter(|_| ahead.peek().is_none());
    reader.take_while(|_| true);
    Command::Contouring(on, given)
}

fn on_or_off(reader: &mut Reader) -> Option<bool> {
    if reader.keyword("ON") {
        Some(true)
    } else if reader.keyword("OFF") {
        Some(false)
    } else {
        None
    }
}

fn rotation(reader: &mut Reader) -> Parsed<Command> {
    match on_or_off(reader) {
        Some(true) => Ok(Command::RotationOn(parameters(reader)?)),
        Some(false) => Ok(Command::RotationOff),
        None => Err(reader.error_with_help(
            "ON or OFF is missing here",
            "write #ROTATION ON [ANGLE=30] or #ROTATION OFF",
        )),
    }
}

/// `[NAME=1 OTHER 2 FLAG]`, or nothing.
fn parameters(reader: &mut Reader) -> Parsed<Vec<Parameter>> {
    let mut list = Vec::new();
    if !reader.take("[") {
        return Ok(list);
    }
    while !reader.take("]") {
        reader.blanks();
        let start = reader.position();
        let name = reader.name();
        if name.is_empty() {
            return Err(reader.error("the name of a parameter, or `]`, is missing here"));
        }
        // A name with a number right behind it: CONTERROR0.1
        let letters = match name.as_str() {
            "CENTER1" | "CENTER2" => &name,
            _ => name.trim_end_matches(|c: char| c.is_ascii_digit()),
        };
        let span = reader.span_from(start);
        if letters.len() < name.len() {
            return Err(Diagnostic::error(
                span,
                format!("{name} is not a parameter that is known"),
            )
            .help(format!("write {letters}=value")));
        }
        reader.blanks();
        let value = match reader.peek() {
            Some('=') => {
                reader.take("=");
                Some(expression(reader)?)
            }
            Some('0'..='9' | '.' | '-' | '+' | '[') => Some(expression(reader)?),
            _ => None,
        };
        reader.take(",");
        list.push(Parameter { name, value, span });
    }
    Ok(list)
}

/// `#CS DEF [1] [..]`, `#CS ON`, `#CS ON [1]`, `#CS ON [..]`, `#CS ON [1] [..]`, `#CS OFF`.
fn system(reader: &mut Reader) -> Parsed<Command> {
    if reader.keyword("OFF") {
        let all = reader.keyword("ALL");
        return Ok(Command::SystemOff { all });
    }
    let define = reader.keyword("DEF");
    if !define && !reader.keyword("ON") {
        return Err(reader.error_with_help(
            "#CS needs ON, OFF or DEF",
            "write #CS ON [x,y,z,a,b,c] or #CS OFF",
        ));
    }
    let mut lists = Vec::new();
    while lists.len() < 2 && reader.take("[") {
        lists.push(components(reader)?);
    }
    let (identity, values) = match lists.len() {
        0 => (None, None),
        // One value is the number of a stored system.
        1 if lists[0].len() == 1 && !define => (lists.remove(0).remove(0), None),
        1 => (None, lists.pop()),
        _ => {
            let values = lists.pop();
            let mut first = lists.pop().unwrap_or_default();
            if first.len() != 1 {
                return Err(reader.error_with_help(
                    "the number of the system is one value",
                    "write #CS ON [1] [x,y,z,a,b,c]",
                ));
            }
            (first.pop().flatten(), values)
        }
    };
    match (define, values) {
        (true, Some(values)) => Ok(Command::DefineSystem(identity, values)),
        (true, None) => Err(reader.error_with_help(
            "the values of the system are missing",
            "write #CS DEF [1] [x,y,z,a,b,c]",
        )),
        (false, values) => Ok(Command::SystemOn(identity, values)),
    }
}

/// Values separated by commas up to `]`; some may be left out.
fn components(reader: &mut Reader) -> Parsed<Vec<Option<Expression>>> {
    let mut list = Vec::new();
    loop {
        reader.blanks();
        list.push(match reader.peek() {
            Some(',' | ']') => None,
            _ => Some(expression(reader)?),
        });
        if reader.take("]") {
            break;
        }
        reader.expect(",")?;
    }
    if list.len() > 6 {
        return Err(reader.error_with_help(
            "a coordinate system has six values",
            "write #CS ON [x,y,z,a,b,c]: shift, and angles about X, Y and Z",
        ));
    }
    Ok(list)
}

/// The least and the greatest value of a type for whole numbers, such as SGN16.
fn whole_range(kind: &str) -> Option<[f64; 2]> {
    if kind == "BOOLEAN" {
        return Some([0.0, 1.0]);
    }
    let signed = kind.starts_with("SGN");
    let bits = kind
        .strip_prefix("SGN")
        .or_else(|| kind.strip_prefix("UNS"))?;
    let bits: i32 = bits
        .parse()
        .ok()
        .filter(|bits| [8, 16, 32].contains(bits))?;
    Some(match signed {
        true => [-(2_f64.powi(bits - 1)), 2_f64.powi(bits - 1) - 1.0],
        false => [0.0, 2_f64.powi(bits) - 1.0],
    })
}

/// `V.L.NAME[3] : REAL64 = [1,2,3]`.
pub fn declaration(reader: &mut Reader) -> Parsed<Declaration> {
    reader.blanks();
    let start = reader.position();
    if reader.name_ahead() != "V" {
        return Err(reader.error_with_help(
            "only declarations can stand between #VAR and #ENDVAR",
            "write V.L.NAME : REAL64 = 5",
        ));
    }
    let (name, size) = v_variable(reader)?;
    let span = reader.span_from(start);
    let mut whole = None;
    if reader.take(":") {
        reader.blanks();
        let kind = reader.name_ahead();
        whole = whole_range(&kind);
        if whole.is_none() && kind != "REAL64" {
            return Err(reader.error_with_help(
                format!("variables of the type {kind} are not supported"),
                "declare numbers: REAL64, SGN32, UNS32, BOOLEAN",
            ));
        }
        reader.name();
    }
    let mut values = Vec::new();
    if reader.take("=") {
        reader.blanks();
        if !size.is_empty() && reader.take("[") {
            values.push(expression(reader)?);
            while reader.take(",") {
                values.push(expression(reader)?);
            }
            reader.expect("]")?;
        } else {
            values.push(expression(reader)?);
        }
    }
    Ok(Declaration {
        name,
        size,
        whole,
        values,
        span,
    })
}
