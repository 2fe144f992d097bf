//! `tools.csv`: a tool on each line, its name and its number.
//!
//! Fields are parted by commas, semicolons or tabs, whichever the first line has; a field may stand
//! between double quotes. A first line with the words `name` and `number` says which fields they are,
//! and others are not looked at; without it they are the first two. Lines that begin with `#` are comments.

use super::{MOST, Tools, lines};
use crate::diagnostics::Diagnostic;
use crate::source::{Span, Text};

/// A field and where it stands.
struct Field {
    text: String,
    span: Span,
}

/// The tools of a list.
pub(super) fn parse(text: Text) -> Result<Tools, Diagnostic> {
    let mut tools = Tools::default();
    let mut separator = None;
    let mut columns = [0, 1];
    for (start, line) in lines(text.text) {
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let first = separator.is_none();
        let separator = *separator.get_or_insert_with(|| separator_of(line));
        let place = |from: usize, to: usize| Span {
            file: text.file,
            start: start + from,
            end: start + to,
        };
        let fields = fields(line, separator, place)?;
        if first && let Some(found) = header(&fields) {
            columns = found;
            continue;
        }
        let [name, number] = columns.map(|column| fields.get(column));
        let (Some(name), Some(number)) = (name, number) else {
            return Err(Diagnostic::error(
                place(0, line.len()),
                "a tool needs a name and a number",
            )
            .help(format!("write NAME{separator}3")));
        };
        if name.text.is_empty() {
            return Err(Diagnostic::error(
                name.span,
                "the name of the tool is missing",
            ));
        }
        tools.add(&name.text, whole(number)?);
    }
    Ok(tools)
}

fn separator_of(line: &str) -> char {
    let mut quoted = false;
    let mut found = line.chars().filter(|c| {
        quoted ^= *c == '"';
        !quoted && matches!(c, ',' | ';' | '\t')
    });
    found.next().unwrap_or(',')
}

/// The columns of name and number, where this line names them.
fn header(fields: &[Field]) -> Option<[usize; 2]> {
    let column = |wanted: &str| {
        let is_wanted = |field: &Field| field.text.eq_ignore_ascii_case(wanted);
        fields.iter().position(is_wanted)
    };
    Some([column("name")?, column("number")?])
}

/// The number of a tool, from 1.
fn whole(field: &Field) -> Result<u32, Diagnostic> {
    let digits = field.text.strip_prefix(['T', 't']).unwrap_or(&field.text);
    match digits.parse() {
        Ok(number) if (1..=MOST).contains(&number) => Ok(number),
        _ => Err(Diagnostic::error(
            field.span,
            format!("`{}` is not the number of a tool", field.text),
        )
        .help(format!("whole numbers from 1 to {MOST} are"))),
    }
}

/// The fields of a line; `place` makes a span of byte positions in it.
fn fields(
    line: &str,
    separator: char,
    place: impl Fn(usize, usize) -> Span,
) -> Result<Vec<Field>, Diagnostic> {
    let mut list = Vec::new();
    let mut at = 0;
    loop {
        let rest = line.get(at..).unwrap_or("");
        let blanks = rest.len() - rest.trim_start_matches(' ').len();
        let begin = at + blanks;
        let rest = line.get(begin..).unwrap_or("");
        let (text, length) = match rest.strip_prefix('"') {
            Some(quoted) => {
                let (text, length) = unquoted(quoted).ok_or_else(|| {
                    Diagnostic::error(place(begin, line.len()), "this name does not end")
                        .help("put a \" at its end, on the same line")
                })?;
                (text, 1 + length)
            }
            None => {
                let length = rest.find(separator).unwrap_or(rest.len());
                (rest[..length].trim_end().to_string(), length)
            }
        };
        let end = begin + length;
        list.push(Field {
            span: place(begin, end),
            text,
        });
        let rest = line.get(end..).unwrap_or("");
        let Some(next) = rest.find(separator) else {
            return behind(rest, end, &place).map(|()| list);
        };
        behind(&rest[..next], end, &place)?;
        at = end + next + separator.len_utf8();
    }
}

/// Refuses what stands behind the closing quote of a field.
fn behind(
    rest: &str,
    start: usize,
    place: &impl Fn(usize, usize) -> Span,
) -> Result<(), Diagnostic> {
    match rest.trim().is_empty() {
        true => Ok(()),
        false => Err(Diagnostic::error(
            place(start, start + rest.len()),
            "nothing may stand behind the closing quote",
        )),
    }
}

/// What stands before the closing quote, and how long it is with it; two quotes are one.
fn unquoted(text: &str) -> Option<(String, usize)> {
    let mut result = String::new();
    let mut characters = text.char_indices().peekable();
    while let Some((at, character)) = characters.next() {
        if character != '"' {
            result.push(character);
        } else if characters.next_if(|(_, next)| *next == '"').is_some() {
            result.push('"');
        } else {
            return Some((result, at + 1));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Vec<(String, Vec<u32>)> {
        let tools = parse(Text::from(text)).expect(text);
        tools.numbers.into_iter().collect()
    }

    #[test]
    fn lists_in_all_their_forms() {
        let wanted = [
            ("DRILL, 5".to_string(), vec![2]),
            ("MILL_10".to_string(), vec![1]),
        ];
        for text in [
            "mill_10,1\n\"Drill, 5\",2\n",
            "# tools\r\nname,number\r\nMILL_10 , T1\r\n\"drill, 5\" ,2",
            "Number;Length;Name\n1;80;Mill_10\n\n2;30;\"Drill, 5\"\n",
            "MILL_10\t1\nDrill, 5\t2\n",
        ] {
            assert_eq!(numbers(text), wanted, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_shown_at_its_place() {
        for (text, place, message) in [
            ("A,1\nB,x\n", 6..7, "`x` is not the number of a tool"),
            ("A,0\n", 2..3, "`0` is not the number of a tool"),
            ("A,1.5\n", 2..5, "`1.5` is not the number of a tool"),
            ("A,1\nB\n", 4..5, "a tool needs a name and a number"),
            (" ,1\n", 1..1, "the name of the tool is missing"),
            ("\"A,1\n", 0..4, "this name does not end"),
            (
                "\"A\"B,1\n",
                3..4,
                "nothing may stand behind the closing quote",
            ),
        ] {
            let error = parse(Text::from(text)).expect_err(text);
            assert_eq!(error.message, message, "{text}");
            assert_eq!(error.span.start..error.span.end, place, "{text}");
        }
    }
}
