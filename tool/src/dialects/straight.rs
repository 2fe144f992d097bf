//! Whether a program runs straight from its first line to its last: then it can be run while it is
//! read. What only looks like a jump or a subprogram makes no harm: the program is held as a whole.

use super::Dialect;

/// Words of Sinumerik-like programs that lead elsewhere, or to which something leads.
const SINUMERIK: [&str; 20] = [
    "IF", "ELSE", "ENDIF", "WHILE", "ENDWHILE", "FOR", "ENDFOR", "LOOP", "ENDLOOP", "REPEAT",
    "REPEATB", "UNTIL", "GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS", "CASE", "PROC", "ENDLABEL",
];

/// Statements of Fagor programs that do.
const FAGOR: [&str; 6] = ["SUB", "RET", "GOTO", "RPT", "IF", "ELSE"];

/// Commands of ISG programs that do not.
const ISG: [&str; 5] = ["MSG", "HSC", "SLOPE", "SET", "CONTOUR"];

/// Looks through the lines of a program.
#[derive(Clone, Debug)]
pub struct Survey {
    dialect: Dialect,
    /// Whether a block was there, or the name of the program.
    begun: bool,
    /// Whether a line with `%` ended the program.
    ended: bool,
}

impl Survey {
    /// Of a program in this language.
    pub fn new(dialect: Dialect) -> Survey {
        Survey {
            dialect,
            begun: false,
            ended: false,
        }
    }

    /// Looks at the next lines, in any encoding that ASCII is a part of; `false` when the program must
    /// be held as a whole.
    pub fn look(&mut self, lines: &[u8]) -> bool {
        let mut lines = lines.split(|byte| matches!(byte, b'\n' | b'\r'));
        lines.all(|line| self.line(line))
    }

    fn line(&mut self, line: &[u8]) -> bool {
        let mut plain = true;
        let mut blank = true;
        for byte in line {
            plain &= PLAIN[usize::from(*byte)];
            blank &= matches!(byte, b' ' | b'\t' | 0 | 0x1a | 0x11 | 0x13);
        }
        if blank {
            return true;
        }
        if plain {
            self.begun = true;
            return !self.ended;
        }
        let text = String::from_utf8_lossy(line).to_ascii_uppercase();
        let text = text.trim();
        if let Some(name) = text.strip_prefix('%') {
            return self.head(name);
        }
        if !text.starts_with(';') {
            self.begun = true;
        }
        !self.ended && !leads_elsewhere(self.dialect, text)
    }

    /// A line that begins with `%`.
    fn head(&mut self, name: &str) -> bool {
        if name.is_empty() {
            self.ended |= self.begun;
            return true;
        }
        let subprogram = match self.dialect {
            Dialect::Sinumerik => name.ends_with("_SPF") || name.starts_with("SPF"),
            Dialect::Isg => name.starts_with('L'),
            _ => false,
        };
        let first = !self.begun;
        self.begun = true;
        first && !subprogram
    }
}

/// Bytes of blocks that all dialects read as ordinary words. MEFI's subprograms are named with L.
const PLAIN: [bool; 256] = {
    let mut plain = [false; 256];
    let bytes = b" \t.+-0123456789NGXYZABCUVWIJKFSTDMngxyzabcuvwijkfstdm";
    let mut at = 0;
    while at < bytes.len() {
        plain[bytes[at] as usize] = true;
        at += 1;
    }
    plain
};

/// Whether a line, in upper case, needs others.
fn leads_elsewhere(dialect: Dialect, line: &str) -> bool {
    let code = match dialect {
        Dialect::Mefi => line.split('"').next(),
        _ => line.split(';').next(),
    };
    let code = code.unwrap_or("");
    let mut words = code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    match dialect {
        // The number of the block may stand right before it: N10GOTOF END.
        Dialect::Sinumerik => {
            words.any(|word| SINUMERIK.iter().any(|known| ends_with(word, known)))
        }
        // Blanks may be missing: (IFP1GT3GOTON10).
        Dialect::Fagor => code.contains('(') && FAGOR.iter().any(|word| code.contains(word)),
        Dialect::Mefi => code.contains('L'),
        Dialect::Isg => {
            let mut commands = code.split('#').skip(1).map(str::trim_start);
            let known = |command: &str| ISG.iter().any(|known| command.starts_with(known));
            code.contains('$') || line.ends_with('\\') || commands.any(|command| !known(command))
        }
        Dialect::Auto => true,
    }
}

/// Whether a word is a name, or a number with the name behind it.
fn ends_with(word: &str, name: &str) -> bool {
    let before = word.strip_suffix(name);
    before.is_some_and(|before| before.is_empty() || before.ends_with(|c: char| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_straight(dialect: Dialect, text: &str) -> bool {
        Survey::new(dialect).look(text.as_bytes())
    }

    #[test]
    fn programs_of_posts_run_straight() {
        for (dialect, text) in [
            (
                Dialect::Sinumerik,
                "%_N_PART_MPF\n;$PATH=/_N_MPF_DIR\nN10 G0 X1\nMSG(\"a\")\nM30\n%\n\n",
            ),
            (
                Dialect::Sinumerik,
                "; for the second side\nG1 X1\nCYCLE81(1,2)\nL10\n",
            ),
            (
                Dialect::Fagor,
                "%PART,MX--,\nG1 X1\n(MSG \"a\")\n(CALL 10)\nM30\n",
            ),
            (Dialect::Mefi, "%1\nN10 G1 X1 \"Loch\nM30\n%\n"),
            (
                Dialect::Isg,
                "%PART\nN10 G01 X1 (a)\n#HSC ON [CONTERROR 0.1]\nM30\n",
            ),
        ] {
            assert!(is_straight(dialect, text), "{text}");
        }
    }

    #[test]
    fn what_leads_elsewhere_is_found() {
        for (dialect, text) in [
            (Dialect::Sinumerik, "G1 X1\nIF R1>3 GOTOF A\n"),
            (Dialect::Sinumerik, "N10 REPEAT A P=2\n"),
            (Dialect::Sinumerik, "N10GOTOF A\n"),
            (Dialect::Sinumerik, "N5IF R1==0\n"),
            (Dialect::Sinumerik, "G1 X1\n%_N_L10_SPF\nM17\n"),
            (Dialect::Fagor, "( rpt N10,N20)\n"),
            (Dialect::Fagor, "(SUB 10)\n"),
            (Dialect::Mefi, "G1 X1\nM30\nG79 L100\n"),
            (Dialect::Mefi, "G1 X1\n%\nG1 X2\n"),
            (Dialect::Isg, "N10 $FOR P1=1,2,1\n"),
            (Dialect::Isg, "G1 X1 \\\n"),
            (Dialect::Isg, "#CS ON [1,2,3,0,0,0]\n"),
            (Dialect::Isg, "#COMMENT BEGIN\n"),
        ] {
            assert!(!is_straight(dialect, text), "{text}");
        }
    }
}
