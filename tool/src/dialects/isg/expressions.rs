//! Parsing arithmetic. Brackets are `[ ]`, because parentheses are comments. From the strongest to the
//! weakest: signs and NOT; `**`; `* / MOD`; `+ -`; comparisons; AND; XOR; OR. (ISG and Beckhoff TF5200,
//! Programming Manual, "Arithmetic expressions".)

use super::reader::{Parsed, Reader};
use crate::diagnostics::Diagnostic;
use crate::dialects::expression::{Binary, Expression, ExpressionKind, FUNCTIONS, Function, Unary};
use crate::dialects::operators::{Arithmetic, DEPTH_LIMIT, climb};
use crate::dialects::spelling::did_you_mean;
use crate::source::Span;

/// Operators from the weakest level to the strongest; longer symbols before their beginnings.
const SYMBOLS: [(&str, Binary, usize); 14] = [
    ("||", Binary::Or, 0),
    ("&&", Binary::And, 2),
    ("==", Binary::Equal, 3),
    ("!=", Binary::NotEqual, 3),
    ("<>", Binary::NotEqual, 3),
    ("<=", Binary::LessOrEqual, 3),
    (">=", Binary::GreaterOrEqual, 3),
    ("<", Binary::Less, 3),
    (">", Binary::Greater, 3),
    ("**", Binary::Power, 6),
    ("+", Binary::Add, 4),
    ("-", Binary::Subtract, 4),
    ("*", Binary::Multiply, 5),
    ("/", Binary::Divide, 5),
];

const NAMED: [(&str, Binary, usize); 4] = [
    ("OR", Binary::Or, 0),
    ("XOR", Binary::ExclusiveOr, 1),
    ("AND", Binary::And, 2),
    ("MOD", Binary::Remainder, 5),
];

const LEVELS: usize = 7;

/// All functions; angles in degrees.
fn functions() -> impl Iterator<Item = (&'static str, Function)> {
    let own = [
        ("ATAN2", Function::Atan2),
        ("SQR", Function::Square),
        ("INT", Function::Truncate),
        ("EXP", Function::Exponential),
        ("MIN", Function::Minimum),
    ];
    FUNCTIONS.into_iter().chain(own)
}

fn function_named(name: &str) -> Option<Function> {
    let found = functions().find(|(known, _)| *known == name);
    found.map(|(_, function)| function)
}

/// Names that begin a value besides P parameters and V variables.
const OTHER_NAMES: [&str; 7] = ["MAX", "FRACT", "DEXP", "NOT", "TRUE", "FALSE", "PI"];

/// Whether a name is that of a P parameter: `P`, `P10`, `PP10`.
pub fn is_parameter(name: &str) -> bool {
    name.strip_prefix('P').is_some_and(|rest| {
        let rest = rest.trim_start_matches('P');
        rest.is_empty() || rest.starts_with(|c: char| c.is_ascii_digit())
    })
}

/// Whether a name begins a value.
pub fn begins_value(name: &str) -> bool {
    is_parameter(name)
        || name == "V"
        || OTHER_NAMES.contains(&name)
        || function_named(name).is_some()
}

/// Parses one expression.
pub fn expression(reader: &mut Reader) -> Parsed<Expression> {
    climb(reader, 0)
}

impl Arithmetic for Reader<'_> {
    fn levels(&self) -> usize {
        LEVELS
    }

    fn take_operator(&mut self, level: usize) -> Option<Binary> {
        self.blanks();
        let name = self.name_ahead();
        if let Some((_, binary, _)) = NAMED
            .into_iter()
            .find(|(known, _, its_level)| *known == name && *its_level == level)
        {
            self.name();
            return Some(binary);
        }
        let rest = self.rest();
        let (symbol, binary, its_level) = SYMBOLS
            .into_iter()
            .find(|(symbol, ..)| rest.starts_with(symbol))?;
        (its_level == level && self.take(symbol)).then_some(binary)
    }

    fn taken_operators(&mut self) -> &mut u32 {
        &mut self.operators
    }

    fn error_with_help(&self, message: String, help: &str) -> Diagnostic {
        Reader::error_with_help(self, message, help)
    }

    fn check(&self, operator: Binary, left: &Expression, _: &Expression) -> Parsed<()> {
        let signed = matches!(left.kind, ExpressionKind::Unary(Unary::Negate, _));
        match operator == Binary::Power && signed {
            false => Ok(()),
            true => Err(Diagnostic::error(
                left.span,
                "a sign before a power can be read in two ways",
            )
            .help("write [-2]**2 or -[2**2]")),
        }
    }

    fn operand(&mut self) -> Parsed<Expression> {
        unary(self)
    }
}

fn unary(reader: &mut Reader) -> Parsed<Expression> {
    let start = reader.word_span();
    reader.depth += 1;
    if reader.depth > DEPTH_LIMIT {
        return Err(reader.error("brackets or signs are nested too deep"));
    }
    let result = if reader.take("-") {
        negated(Unary::Negate, start, unary(reader)?)
    } else if reader.take("+") {
        unary(reader)?
    } else if reader.keyword("NOT") {
        negated(Unary::Not, start, unary(reader)?)
    } else {
        primary(reader)?
    };
    reader.depth -= 1;
    Ok(result)
}

fn negated(sign: Unary, start: Span, operand: Expression) -> Expression {
    Expression {
        span: start.to(operand.span),
        kind: ExpressionKind::Unary(sign, Box::new(operand)),
    }
}

fn primary(reader: &mut Reader) -> Parsed<Expression> {
    reader.blanks();
    let start = reader.position();
    let kind = match reader.peek() {
        Some('0'..='9' | '.') => number(reader)?,
        Some('[') => {
            reader.advance();
            let inner = climb(reader, 0)?;
            reader.expect("]")?;
            ExpressionKind::Group(Box::new(inner))
        }
        Some('"') => {
            return Err(reader.error_with_help(
                "macros are not supported",
                "write the value itself, or use a P parameter",
            ));
        }
        Some('A'..='Z') => named(reader)?,
        _ => return Err(reader.error("a value is missing here")),
    };
    Ok(Expression {
        kind,
        span: reader.span_from(start),
    })
}

fn number(reader: &mut Reader) -> Parsed<ExpressionKind> {
    let start = reader.position();
    let number = reader.decimal().and_then(|text| text.parse::<f64>().ok());
    let again = reader.peek() == Some('.');
    match number.filter(|number| number.is_finite() && !again) {
        Some(number) => Ok(ExpressionKind::Number(number)),
        None => {
            reader.take_while(|c| c.is_ascii_digit() || c == '.');
            Err(Diagnostic::error(
                reader.span_from(start),
                match again {
                    true => "a number with two decimal points",
                    false => "this is not a number",
                },
            ))
        }
    }
}

fn named(reader: &mut Reader) -> Parsed<ExpressionKind> {
    let name = reader.name_ahead();
    if is_parameter(&name) {
        return p_parameter(reader);
    }
    let span = reader.word_span();
    if name == "V" {
        let (name, index) = v_variable(reader)?;
        return Ok(ExpressionKind::Variable(name, index));
    }
    reader.name();
    let constant = match name.as_str() {
        "TRUE" => Some(1.0),
        "FALSE" => Some(0.0),
        "PI" => Some(std::f64::consts::PI),
        _ => None,
    };
    if let Some(constant) = constant {
        return Ok(ExpressionKind::Number(constant));
    }
    if !begins_value(&name) {
        return Err(unknown_name(&name, span));
    }
    let arguments = arguments(reader)?;
    function(&name, arguments, span)
}

fn unknown_name(name: &str, span: Span) -> Diagnostic {
    let error = Diagnostic::error(
        span,
        format!("`{name}` is not a function that can be used here"),
    );
    let known = functions().map(|(known, _)| known);
    match did_you_mean(name, known.chain(OTHER_NAMES), str::to_string) {
        Some(similar) => error.help(similar),
        None => error,
    }
}

/// `[a, b]`.
fn arguments(reader: &mut Reader) -> Parsed<Vec<Expression>> {
    reader.expect("[")?;
    let mut list = vec![climb(reader, 0)?];
    while reader.take(",") {
        list.push(climb(reader, 0)?);
    }
    reader.expect("]")?;
    Ok(list)
}

fn function(name: &str, arguments: Vec<Expression>, span: Span) -> Parsed<ExpressionKind> {
    let of = |function, arguments| ExpressionKind::Function(function, arguments);
    let number = |number| Expression {
        kind: ExpressionKind::Number(number),
        span,
    };
    let wanted = match name {
        "MAX" => 2,
        "FRACT" | "DEXP" => 1,
        _ => function_named(name).map_or(1, Function::arguments),
    };
    if arguments.len() != wanted {
        return Err(Diagnostic::error(
            span,
            format!(
                "{name} needs {wanted} value{}",
                if wanted == 1 { "" } else { "s" }
            ),
        ));
    }
    if name == "MAX" {
        return Ok(of(Function::Maximum, arguments));
    }
    let Some(first) = arguments.first().cloned() else {
        return Ok(ExpressionKind::Number(0.0));
    };
    Ok(match name {
        "FRACT" => {
            let whole = Expression {
                kind: of(Function::Truncate, arguments),
                span,
            };
            ExpressionKind::Binary(Binary::Subtract, Box::new(first), Box::new(whole))
        }
        "DEXP" => ExpressionKind::Binary(Binary::Power, Box::new(number(10.0)), Box::new(first)),
        _ => match function_named(name) {
            Some(function) => of(function, arguments),
            None => return Err(unknown_name(name, span)),
        },
    })
}

/// `P10`, `P[expression]`, `PP10`: the parameter whose number is in P10.
fn p_parameter(reader: &mut Reader) -> Parsed<ExpressionKind> {
    reader.advance();
    reader.depth += 1;
    if reader.depth > DEPTH_LIMIT {
        return Err(reader.error("parameters are nested too deep"));
    }
    let start = reader.position();
    let kind = match reader.peek() {
        Some('P') => p_parameter(reader)?,
        Some('[') => {
            reader.advance();
            let inner = climb(reader, 0)?;
            reader.expect("]")?;
            inner.kind
        }
        Some('0'..='9') => {
            let digits = reader.take_while(|c| c.is_ascii_digit());
            ExpressionKind::Number(digits.parse().unwrap_or(f64::MAX))
        }
        _ => return Err(reader.error("the number of the P parameter is missing")),
    };
    reader.depth -= 1;
    let number = Expression {
        kind,
        span: reader.span_from(start),
    };
    Ok(ExpressionKind::Variable("P".to_string(), vec![number]))
}

/// `V.P.NAME`, `V.L.NAME[2]`: the name in upper case and its indices.
pub fn v_variable(reader: &mut Reader) -> Parsed<(String, Vec<Expression>)> {
    let start = reader.position();
    let name = reader
        .take_while(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.')
        .to_ascii_uppercase();
    let scope = name.split('.').nth(1).unwrap_or("");
    if !matches!(scope, "P" | "L" | "S") || name.split('.').any(str::is_empty) {
        return Err(Diagnostic::error(
            reader.span_from(start),
            format!("{name} cannot be evaluated ahead of time"),
        )
        .help("only variables of the program (V.P., V.L., V.S.) and P parameters are supported"));
    }
    let mut index = Vec::new();
    while reader.peek() == Some('[') {
        index.extend(arguments(reader)?);
    }
    Ok((name, index))
}

/// A variable that is written to: a P parameter or a V variable.
pub fn variable(reader: &mut Reader) -> Parsed<(String, Vec<Expression>, Span)> {
    reader.blanks();
    let start = reader.position();
    let name = reader.name_ahead();
    if name != "V" && !is_parameter(&name) {
        return Err(reader.error("the name of a variable is missing"));
    }
    match named(reader)? {
        ExpressionKind::Variable(name, index) => Ok((name, index, reader.span_from(start))),
        _ => Err(reader.error("the name of a variable is missing")),
    }
}
