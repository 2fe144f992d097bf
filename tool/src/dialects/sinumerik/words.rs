//! The words of the dialect by kind: which are commands, which only tune the control.

use super::refusals::refused;
use super::syntax::FrameKeyword;
use crate::diagnostics::Diagnostic;
use crate::dialects::spelling::nearest_ones;
use crate::source::Span;

/// Addresses of several letters, with their value after `=`.
const ADDRESSES: [&str; 26] = [
    "DISR", "DISCL", "FAD", "CR", "RPL", "AR", "TURN", "RND", "RNDM", "CHF", "CHR", "ANG", "AP",
    "RP", "ADIS", "ADISPOS", "CTOL", "OFFN", "LIMS", "SPOS", "SPOSA", "FRC", "FRCM", "I1", "J1",
    "K1",
];

/// Words without a value that may stand among others.
const FLAGS: [&str; 7] = ["SUPA", "CIP", "CT", "DIAMON", "DIAMOF", "DIAM90", "SETMS"];

/// Commands that tune the other control and cannot change the part; some with values in parentheses,
/// some with the name of an axis in brackets and a value.
const NOTED: [&str; 78] = [
    "SOFT",
    "SOFTA",
    "BRISK",
    "BRISKA",
    "DRIVE",
    "DRIVEA",
    "FFWON",
    "FFWOF",
    "COMPON",
    "COMPCURV",
    "COMPCAD",
    "COMPSURF",
    "COMPOF",
    "FNORM",
    "FLIN",
    "FCUB",
    "FIFOCTRL",
    "CFC",
    "CFTCP",
    "CFIN",
    "UPATH",
    "SPATH",
    "NORM",
    "KONT",
    "CUT2D",
    "CUT2DF",
    "ORIMKS",
    "ORIWKS",
    "ORISON",
    "ORISOF",
    "WORKPIECE",
    "GROUP_BEGIN",
    "GROUP_END",
    "TRAFOOF",
    "TOROTOF",
    "PAROTOF",
    "WALIMON",
    "WALIMOF",
    "STARTFIFO",
    "STOPFIFO",
    "DISPLOF",
    "DISPLON",
    "SBLON",
    "SBLOF",
    "DYNNORM",
    "DYNPOS",
    "DYNROUGH",
    "DYNSEMIFIN",
    "DYNFINISH",
    "DYNPREC",
    "FGROUP",
    "FGREF",
    "ACC",
    "ACCLIM",
    "ACCLIMA",
    "VELOLIM",
    "VELOLIMA",
    "JERKLIM",
    "JERKLIMA",
    "OTOL",
    "STOLF",
    "CDON",
    "CDOF",
    "CDOF2",
    "CPRECON",
    "CPRECOF",
    "SPCON",
    "SPCOF",
    "RTLION",
    "RTLIOF",
    "DELAYFSTON",
    "DELAYFSTOF",
    "LFOF",
    "WALCS0",
    "WALCS1",
    "WALCS2",
    "PTPG0",
    "CP",
];

/// Words that stand alone in their block, or begin it.
const STATEMENTS: [&str; 38] = [
    "TRANS", "ATRANS", "ROT", "AROT", "ROTS", "AROTS", "SCALE", "ASCALE", "MIRROR", "AMIRROR",
    "IF", "ELSE", "ENDIF", "WHILE", "ENDWHILE", "FOR", "ENDFOR", "LOOP", "ENDLOOP", "REPEAT",
    "REPEATB", "UNTIL", "CASE", "GOTO", "GOTOF", "GOTOB", "GOTOC", "DEF", "PROC", "RET", "MSG",
    "CALL", "EXTCALL", "MCALL", "STOPRE", "SETAL", "EXTERN", "ENDPROC",
];

/// Words that stand within others: operators, parts of statements, types, values and functions.
const PARTS: [&str; 50] = [
    "B_AND",
    "B_OR",
    "B_XOR",
    "B_NOT",
    "AND",
    "OR",
    "XOR",
    "NOT",
    "DIV",
    "MOD",
    "SET",
    "REP",
    "TO",
    "OF",
    "DEFAULT",
    "SAVE",
    "ENDLABEL",
    "PREPRO",
    "ACTBLOCNO",
    "VAR",
    "INT",
    "REAL",
    "BOOL",
    "CHAR",
    "STRING",
    "TRUE",
    "FALSE",
    "AC",
    "IC",
    "DC",
    "ACP",
    "ACN",
    "SIN",
    "COS",
    "TAN",
    "ASIN",
    "ACOS",
    "ATAN2",
    "SQRT",
    "ABS",
    "POT",
    "TRUNC",
    "ROUND",
    "ROUNDUP",
    "LN",
    "EXP",
    "MINVAL",
    "MAXVAL",
    "BOUND",
    "QU",
];

/// The command of the programmable frame with this name.
pub fn frame_keyword(name: &str) -> Option<FrameKeyword> {
    Some(match name {
        "TRANS" => FrameKeyword::Trans,
        "ATRANS" => FrameKeyword::Atrans,
        "ROT" => FrameKeyword::Rot,
        "AROT" => FrameKeyword::Arot,
        "ROTS" => FrameKeyword::Rots,
        "AROTS" => FrameKeyword::Arots,
        "SCALE" => FrameKeyword::Scale,
        "ASCALE" => FrameKeyword::Ascale,
        "MIRROR" => FrameKeyword::Mirror,
        "AMIRROR" => FrameKeyword::Amirror,
        _ => return None,
    })
}

/// Whether a name of several letters is an address, with its value after `=`.
pub fn is_address(name: &str) -> bool {
    ADDRESSES.contains(&name)
}

/// Whether a name is a word without a value that may stand among others.
pub fn is_flag(name: &str) -> bool {
    FLAGS.contains(&name)
}

/// Whether a command tunes the other control and cannot change the part.
pub fn is_noted(name: &str) -> bool {
    NOTED.contains(&name)
}

/// Whether a word stands alone in its block, or begins it.
pub fn is_statement(name: &str) -> bool {
    STATEMENTS.contains(&name)
}

/// Names that cannot be those of subprograms or variables.
pub fn is_reserved(name: &str) -> bool {
    is_address(name)
        || is_flag(name)
        || is_noted(name)
        || is_statement(name)
        || PARTS.contains(&name)
        || refused(name).is_some()
}

/// An error for a word of the control that stands where a variable should.
pub fn no_variable(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        format!("{name} is a word of the control and cannot be a variable"),
    )
    .help("give the variable a name that is no command, address or function of the control")
}

/// The known names nearest to a misspelt one, for a question: `TRANS`, `SOFT or SOFTA`. `None` where none
/// is near enough to be meant.
pub fn similar(name: &str) -> Option<String> {
    let known = [&STATEMENTS[..], &ADDRESSES, &FLAGS, &NOTED].concat();
    let nearest = nearest_ones(name, &known);
    (!nearest.is_empty()).then(|| nearest.join(" or "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialects::sinumerik::refusals;

    #[test]
    fn slips_of_the_pen_are_recognised() {
        let cases = [
            ("TRANZ", Some("TRANS")),
            ("MIROR", Some("MIRROR")),
            ("DYNFINISCH", Some("DYNFINISH")),
            ("DYNNROM", Some("DYNNORM")),
            ("COMPCAF", Some("COMPCAD")),
            ("POCKET", None),
            ("MCALL", None),
        ];
        for (slip, meant) in cases {
            assert_eq!(similar(slip).as_deref(), meant, "{slip}");
        }
    }

    #[test]
    fn each_word_is_of_one_kind() {
        let known = [&STATEMENTS[..], &PARTS, &ADDRESSES, &FLAGS, &NOTED].concat();
        let mut words: Vec<&str> = known.into_iter().chain(refusals::all()).collect();
        words.sort_unstable();
        let twice = words.windows(2).find(|two| two[0] == two[1]);
        assert_eq!(twice, None);
        assert!(words.iter().all(|word| is_reserved(word)));
    }
}
