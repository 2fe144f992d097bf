//! The words of the dialect by kind: which are commands, which only tune the control, which are
//! refused.

use super::syntax::FrameKeyword;
use crate::dialects::spelling::nearest;

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
    matches!(
        name,
        "CR" | "RPL"
            | "AR"
            | "TURN"
            | "RND"
            | "RNDM"
            | "CHF"
            | "CHR"
            | "ANG"
            | "AP"
            | "RP"
            | "ADIS"
            | "ADISPOS"
            | "CTOL"
            | "OFFN"
            | "LIMS"
            | "SPOS"
            | "SPOSA"
            | "FRC"
            | "FRCM"
            | "I1"
            | "J1"
            | "K1"
    )
}

/// Whether a name is a word without a value that may stand among others.
pub fn is_flag(name: &str) -> bool {
    matches!(name, "SUPA" | "CIP" | "CT" | "DIAMON" | "DIAMOF" | "DIAM90")
}

/// Whether a command tunes the other control and cannot change the part.
pub fn is_noted(name: &str) -> bool {
    matches!(
        name,
        "SOFT"
            | "BRISK"
            | "DRIVE"
            | "FFWON"
            | "FFWOF"
            | "COMPON"
            | "COMPCURV"
            | "COMPCAD"
            | "COMPSURF"
            | "COMPOF"
            | "FNORM"
            | "FLIN"
            | "FIFOCTRL"
            | "CFC"
            | "CFTCP"
            | "CFIN"
            | "UPATH"
            | "SPATH"
            | "NORM"
            | "ORIMKS"
            | "ORIWKS"
            | "WORKPIECE"
            | "GROUP_BEGIN"
            | "GROUP_END"
            | "TRAFOOF"
            | "EXTERN"
            | "WALIMON"
            | "STARTFIFO"
            | "STOPFIFO"
            | "DISPLOF"
            | "DISPLON"
    )
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
        "EXECSTRING" | "READ" | "WRITE" | "DELETE" | "ISFILE" | "EXTCALL" => {
            "file access and text that is run as program are not supported"
        }
        "POS" | "POSA" | "POSP" | "WAITP" | "FA" => {
            "positioning axes apart from the path are not supported: name the axis in the block instead"
        }
        "MEAS" | "MEAW" | "MEASA" | "MEAWA" | "MEAC" => {
            "measuring cannot be evaluated ahead of time"
        }
        "TOFRAME" | "TOROT" | "TOROTOF" | "PAROT" | "PAROTOF" | "MEAFRAME" => {
            "frames from tool or table orientation are not supported: write the angles with ROT"
        }
        "CTRANS" | "CROT" | "CSCALE" | "CMIRROR" | "CFINE" | "FRAME" => {
            "frame variables are not supported: write TRANS, ROT, SCALE and MIRROR"
        }
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
        || matches!(
            name,
            "IF" | "ELSE"
                | "ENDIF"
                | "WHILE"
                | "ENDWHILE"
                | "FOR"
                | "TO"
                | "ENDFOR"
                | "LOOP"
                | "ENDLOOP"
                | "REPEAT"
                | "REPEATB"
                | "UNTIL"
                | "CASE"
                | "OF"
                | "DEFAULT"
                | "GOTO"
                | "GOTOF"
                | "GOTOB"
                | "GOTOC"
                | "GOTOS"
                | "DEF"
                | "PROC"
                | "RET"
                | "MSG"
                | "AND"
                | "OR"
                | "XOR"
                | "NOT"
                | "DIV"
                | "MOD"
                | "CALL"
                | "MCALL"
                | "PCALL"
                | "SAVE"
                | "STOPRE"
                | "SETAL"
        )
}

/// The known name nearest to a misspelt one, if it is near enough to be meant.
pub fn similar(name: &str) -> Option<&'static str> {
    const NAMES: [&str; 30] = [
        "TRANS", "ATRANS", "ROT", "AROT", "ROTS", "AROTS", "SCALE", "ASCALE", "MIRROR", "AMIRROR",
        "SUPA", "GOTOF", "GOTOB", "GOTO", "ENDIF", "ELSE", "WHILE", "ENDWHILE", "ENDFOR", "LOOP",
        "ENDLOOP", "REPEAT", "UNTIL", "STOPRE", "MSG", "RET", "PROC", "MCALL", "CASE", "DEF",
    ];
    nearest(name, &NAMES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_recognised() {
        assert_eq!(similar("TRANZ"), Some("TRANS"));
        assert_eq!(similar("MIROR"), Some("MIRROR"));
        assert_eq!(similar("POCKET"), None);
    }
}
