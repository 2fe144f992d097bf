//! The parameters of the cycles in their order. (Siemens, SINUMERIK 840D sl, Programming Manual Job
//! Planning, "External programming of cycles"; Programming Guide Cycles.)

/// How a parameter is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The cycle asks for it.
    Used,
    /// It cannot change the part: marks of the editor of the control, tuning.
    Any,
    /// Another value than 0 is refused, with what to do instead. A parameter that is left out and an empty
    /// text are 0 too.
    Zero(&'static str),
}

/// A parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name in the manuals.
    pub name: &'static str,
    /// How it is taken.
    pub rule: Rule,
}

/// The parameters of a cycle; `None` for one that is not supported.
pub fn table(cycle: &str) -> Option<Vec<Parameter>> {
    let parameter = |word: &'static str| match (word.strip_suffix('?'), word.strip_suffix("=0")) {
        (Some(name), _) => Parameter {
            name,
            rule: Rule::Any,
        },
        (_, Some(name)) => Parameter {
            name,
            rule: Rule::Zero(instead(cycle, name)),
        },
        _ => Parameter {
            name: word,
            rule: Rule::Used,
        },
    };
    Some(words(cycle)?.split_whitespace().map(parameter).collect())
}

/// The names of the parameters of a cycle. Behind those that cannot change the part stands `?`, behind those
/// that must be left out `=0`.
fn words(cycle: &str) -> Option<&'static str> {
    Some(match cycle {
        "CYCLE81" => "RTP RFP SDIS DP DPR DTB _GMODE=0 _DMODE _AMODE",
        "CYCLE82" => {
            "RTP RFP SDIS DP DPR DTB _GMODE=0 _DMODE _AMODE _VARI=0 S_ZA=0 S_FA=0 S_ZD=0 S_FD=0"
        }
        "CYCLE83" => {
            "RTP RFP SDIS DP DPR FDEP FDPR DAM DTB DTS FRF VARI _AXN _MDEP _VRT _DTD _DIS1 _GMODE=0 \
             _DMODE _AMODE"
        }
        "CYCLE84" => {
            "RTP RFP SDIS DP DPR DTB SDAC MPIT PIT POSS SST SST1 _AXN _PITA _TECHNO? _VARI _DAM _VRT? \
             _PITM? _PTAB? _PTABA? _GMODE? _DMODE _AMODE"
        }
        "CYCLE840" => {
            "RTP RFP SDIS DP DPR DTB SDR SDAC ENC MPIT PIT _AXN _PITA _TECHNO? _PITM? _PTAB? _PTABA? \
             _GMODE? _DMODE _AMODE"
        }
        "CYCLE85" => "RTP RFP SDIS DP DPR DTB FFR RFF _GMODE? _DMODE _AMODE",
        "CYCLE86" => "RTP RFP SDIS DP DPR DTB SDIR RPA RPO RPAP POSS _GMODE=0 _DMODE _AMODE",
        "CYCLE87" => "RTP RFP SDIS DP DPR SDIR",
        "CYCLE88" => "RTP RFP SDIS DP DPR DTB SDIR",
        "CYCLE89" => "RTP RFP SDIS DP DPR DTB",
        "HOLES1" => "SPCA SPCO STA1 FDIS DBH NUM _VARI=0 _UMODE? _HIDE=0 _NSP? _DMODE",
        "HOLES2" => "CPA CPO RAD STA1 INDA NUM _VARI _UMODE? _HIDE=0 _NSP? _DMODE",
        "CYCLE801" => {
            "_SPCA _SPCO _STA _DIS1 _DIS2 _NUM1 _NUM2 _VARI _UMODE? _ANG1=0 _ANG2=0 _HIDE=0 _NSP? _DMODE"
        }
        "CYCLE802" => {
            "_XA _YA _X0 _Y0 _X1 _Y1 _X2 _Y2 _X3 _Y3 _X4 _Y4 _X5 _Y5 _X6 _Y6 _X7 _Y7 _X8 _Y8 _VARI=0 \
             _UMODE? _DMODE"
        }
        "POCKET3" => {
            "_RTP _RFP _SDIS _DP _LENG _WID _CRAD _PA _PO _STA _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _MIDA \
             _AP1=0 _AP2=0 _AD=0 _RAD1? _DP1? _UMODE? _FS? _ZFS? _GMODE _DMODE _AMODE"
        }
        "POCKET4" => {
            "_RTP _RFP _SDIS _DP _PRAD _PA _PO _MID _FAL _FALD _FFP1 _FFD _CDIR _VARI _MIDA _AP1=0 _AD=0 \
             _RAD1? _DP1? _UMODE? _FS? _ZFS? _GMODE _DMODE _AMODE"
        }
        "SLOT1" => {
            "RTP RFP SDIS DP DPR NUM LENG WID CPA CPO RAD STA1 INDA FFD FFP1 MID CDIR FAL VARI MIDF FFP2 \
             SSF _FALD _STA2? _DP1? _UMODE? _FS? _ZFS? _GMODE=0 _DMODE _AMODE"
        }
        "CYCLE72" => {
            "_KNAME _RTP _RFP _SDIS _DP _MID _FAL _FALD _FFP1 _FFD _VARI _RL _AS1 _LP1 _FF3 _AS2 _LP2 \
             _UMODE? _FS? _ZFS? _GMODE=0 _DMODE _AMODE=0"
        }
        "LONGHOLE" => "RTP RFP SDIS DP DPR NUM LENG CPA CPO RAD STA1 INDA FFD FFP1 MID",
        _ => return None,
    })
}

/// What to do where a parameter that must be left out is given.
fn instead(cycle: &str, name: &str) -> &'static str {
    match (cycle, name) {
        ("CYCLE81", "_GMODE") => {
            "the depth from the diameter of a centre: give the depth as DP and write 0"
        }
        ("CYCLE82" | "CYCLE83", "_GMODE") => {
            "depths count to the tip of the tool: give the depth of the tip as DP and write 0"
        }
        ("CYCLE86", "_GMODE") => "0 lifts the tool off by RPA, RPO and RPAP",
        (_, "_AP1" | "_AP2" | "_AD") => {
            "a pocket that has been roughed before is milled as a whole: write 0"
        }
        (_, "_HIDE") => "leave positions out of the pattern by writing the others one by one",
        (_, "_ANG1" | "_ANG2") => {
            "a grid of right angles is supported: write the rows one by one with HOLES1"
        }
        _ => "post the program with the moves of the cycle, or write 0",
    }
}
