//! The words of the dialect by kind: which are commands, which only tune the control, which are
//! refused.

use super::syntax::FrameKeyword;
use crate::dialects::spelling::nearest_ones;

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

/// Statements and operators.
const KEYWORDS: [&str; 53] = [
    "B_AND", "B_OR", "B_XOR", "B_NOT", "SET", "REP", "TRANS", "ATRANS", "ROT", "AROT", "ROTS",
    "AROTS", "SCALE", "ASCALE", "MIRROR", "AMIRROR", "IF", "ELSE", "ENDIF", "WHILE", "ENDWHILE",
    "FOR", "TO", "ENDFOR", "LOOP", "ENDLOOP", "REPEAT", "REPEATB", "UNTIL", "CASE", "OF",
    "DEFAULT", "GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS", "DEF", "PROC", "RET", "MSG", "AND",
    "OR", "XOR", "NOT", "DIV", "MOD", "CALL", "MCALL", "PCALL", "SAVE", "STOPRE", "SETAL",
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

/// Why a command of the control is refused, if it is a known one.
pub fn refused(name: &str) -> Option<&'static str> {
    Some(match name {
        "TRAORI" | "TRANSMIT" | "TRACYL" | "TRAANG" | "TRACON" => {
            "transformations of the control are not translated: set the kinematics of the machine instead"
        }
        "ASPLINE" | "BSPLINE" | "CSPLINE" | "POLY" | "POLYPATH" | "INVCW" | "INVCCW" => {
            "splines, polynomials and involutes are not supported: post the program with lines and arcs"
        }
        "CUT3DC" | "CUT3DF" | "CUT3DFS" | "CUT3DFF" | "CUT3DCC" | "CUT3DCCD" => {
            "three-dimensional tool radius compensation is not supported"
        }
        "WHEN" | "WHENEVER" | "EVERY" | "FROM" | "DO" | "ID" | "IDS" | "CANCEL" => {
            "synchronised actions cannot be evaluated ahead of time"
        }
        "INIT" | "START" | "WAITM" | "WAITMC" | "WAITE" | "SETM" | "CLEARM" | "GET" | "GETD"
        | "RELEASE" => "there is only one channel",
        "EXECSTRING" | "READ" | "WRITE" | "DELETE" | "ISFILE" => {
            "file access and text that is run as program are not supported"
        }
        "POS" | "POSA" | "POSP" | "WAITP" | "FA" => {
            "positioning axes apart from the path are not supported: name the axis in the block instead"
        }
        "MEAS" | "MEAW" | "MEASA" | "MEAWA" | "MEAC" => {
            "measuring cannot be evaluated ahead of time"
        }
        "TOFRAME" | "TOROT" | "PAROT" | "MEAFRAME" => {
            "frames from tool or table orientation are not supported: write the angles with ROT"
        }
        "CTRANS" | "CROT" | "CSCALE" | "CMIRROR" | "CFINE" | "FRAME" => {
            "frame variables are not supported: write TRANS, ROT, SCALE and MIRROR"
        }
        "KONTC" | "KONTT" => "approach paths of other forms than KONT and NORM are not supported",
        "SETINT" | "ENABLE" | "DISABLE" | "CLRINT" | "PRIO" => {
            "interrupt routines are not supported"
        }
        "ORIEULER" | "ORIRPY" | "ORIVECT" | "ORIAXES" => "tool orientation is not supported",
        "OEMIPO1" | "OEMIPO2" | "COUPON" | "COUPOF" | "LEADON" | "LEADOF" | "TRAILON"
        | "TRAILOF" | "EGON" => "coupled axes are not supported",
        _ => return None,
    })
}

/// Names that cannot be those of subprograms or variables.
pub fn is_reserved(name: &str) -> bool {
    frame_keyword(name).is_some()
        || is_address(name)
        || is_flag(name)
        || is_noted(name)
        || refused(name).is_some()
        || KEYWORDS.contains(&name)
        || name == "EXTERN"
}

/// The known names nearest to a misspelt one, for a question: `TRANS`, `SOFT or SOFTA`. `None` where none
/// is near enough to be meant.
pub fn similar(name: &str) -> Option<String> {
    let known = [&KEYWORDS[..], &ADDRESSES, &FLAGS, &NOTED].concat();
    let nearest = nearest_ones(name, &known);
    (!nearest.is_empty()).then(|| nearest.join(" or "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_recognised() {
        let cases = [
            ("TRANZ", Some("TRANS")),
            ("MIROR", Some("MIRROR")),
            ("DYNFINISCH", Some("DYNFINISH")),
            ("DYNNROM", Some("DYNNORM")),
            ("COMPCAF", Some("COMPCAD")),
            ("POCKET", None),
        ];
        for (slip, meant) in cases {
            assert_eq!(similar(slip).as_deref(), meant, "{slip}");
        }
    }
}
