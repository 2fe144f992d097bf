//! Words of the control that are not translated, by kind, each with what to write instead: what public grammars of
//! its language know as reserved. None of them is ever the name of a variable or of a subprogram, also where the
//! program declares one: on the control they act.

/// A kind of words: what to write instead, and the words.
type Kind = (&'static str, &'static [&'static str]);

/// Motions of the path.
const PATH: [Kind; 9] = [
    (
        "transformations of the control are not translated: set the kinematics of the machine instead",
        &[
            "TRAORI", "TRANSMIT", "TRACYL", "TRAANG", "TRACON", "TRAFOON", "PTP", "PTPWOC", "STAT",
            "TU",
        ],
    ),
    (
        "splines, polynomials and involutes are not supported: post the program with lines and arcs",
        &[
            "ASPLINE",
            "BSPLINE",
            "CSPLINE",
            "POLY",
            "POLYPATH",
            "INVCW",
            "INVCCW",
            "SPLINEPATH",
            "PW",
            "SD",
            "PL",
            "PO",
            "BAUTO",
            "BNAT",
            "BTAN",
            "EAUTO",
            "ENAT",
            "ETAN",
        ],
    ),
    (
        "three-dimensional tool radius compensation is not supported",
        &[
            "CUT3DC", "CUT3DF", "CUT3DFS", "CUT3DFF", "CUT3DCC", "CUT3DCCD", "CUT3DCD", "CUT3DFD",
            "ISD",
        ],
    ),
    (
        "tool orientation is not supported: post the moves of the rotary axes",
        &[
            "ORIEULER",
            "ORIRPY",
            "ORIRPY2",
            "ORIVECT",
            "ORIAXES",
            "ORIAXESFR",
            "ORIAXPOS",
            "ORIANGLE",
            "ORIC",
            "ORICONCCW",
            "ORICONCW",
            "ORICONIO",
            "ORICONTO",
            "ORICURINV",
            "ORICURVE",
            "ORID",
            "ORIPATH",
            "ORIPATHS",
            "ORIPLANE",
            "ORIRESET",
            "ORIROTA",
            "ORIROTC",
            "ORIROTR",
            "ORIROTT",
            "ORIS",
            "ORIVIRT1",
            "ORIVIRT2",
            "ORIVIRT3",
            "LEAD",
            "TILT",
            "THETA",
            "NUT",
            "PHI",
            "PSI",
        ],
    ),
    (
        "approach paths of other forms than KONT and NORM are not supported",
        &["KONTC", "KONTT"],
    ),
    (
        "LinuxCNC goes round outer corners in arcs, as the control does with DISC=0: leave it out",
        &["DISC"],
    ),
    (
        "frames from tool or table orientation are not supported: write the angles with ROT",
        &[
            "TOFRAME", "TOFRAMEX", "TOFRAMEY", "TOFRAMEZ", "TOROT", "TOROTX", "TOROTY", "TOROTZ",
            "PAROT", "MEAFRAME",
        ],
    ),
    (
        "frame variables are not supported: write TRANS, ROT, SCALE and MIRROR",
        &[
            "CTRANS", "CROT", "CROTS", "CRPL", "CSCALE", "CMIRROR", "CFINE", "FRAME", "ADDFRAME",
            "INVFRAME", "GFRAME",
        ],
    ),
    (
        "it tunes the other control: leave it out",
        &[
            "ATOL", "CTOLG0", "OTOLG0", "COMPPATH", "PACCLIM", "FENDNORM", "FLIM", "CADAPTON",
            "CADAPTOF", "JERKA", "SCPARA", "ADISPOSA", "AFISON", "AFISOF",
        ],
    ),
];

/// Feeds, spindles, threads.
const SPEEDS: [Kind; 10] = [
    (
        "overrides are the operator's: work it into F and S",
        &["OVR", "OVRRAP", "OVRA"],
    ),
    (
        "a feed for one block is not supported: write F in this block, and F once more in the next",
        &["FB"],
    ),
    (
        "a feed per tooth is not supported: write G95 and F, which is FZ times the number of teeth",
        &["FZ"],
    ),
    (
        "handwheels do not act beside a program here",
        &["FD", "FDA", "DRFOF"],
    ),
    (
        "feeds of single axes are not supported: write F, which is that of the path",
        &["FL", "FMA", "FPO", "FPR", "FPRAON", "FPRAOF"],
    ),
    (
        "it is not supported: write S, and G96 or G97",
        &["SVC", "SCC", "GWPSON", "GWPSOF", "SETMTH"],
    ),
    (
        "the program waits by itself until the spindle has come to its place: write SPOS, and leave WAITS out",
        &["WAITS"],
    ),
    (
        "the angle where a thread begins is not supported: move its beginning along it by that part of the pitch",
        &["SF"],
    ),
    (
        "the run-in and run-out of threads are not supported: let the motion begin and end far enough from them",
        &["DITS", "DITE"],
    ),
    (
        "lifting the tool fast is not supported: write the motion away from the part",
        &[
            "LFON", "LFTXT", "LFWP", "LFPOS", "DILF", "ALF", "POLF", "POLFA", "POLFMASK",
            "POLFMLIN", "LIFTFAST", "ESRR", "ESRS",
        ],
    ),
];

/// Tools.
const TOOLS: [Kind; 5] = [
    (
        "offsets of the tool from the program are not supported: enter them in the tool table of LinuxCNC, or move the \
         zero with TRANS",
        &["TOFF", "TOFFL", "TOFFR", "TOFFLR", "TOFFON", "TOFFOF", "DL"],
    ),
    (
        "tool carriers are not supported: write the plane with CYCLE800 or ROT",
        &["TCARR", "TCOABS", "TCOFR", "TCOFRX", "TCOFRY", "TCOFRZ"],
    ),
    (
        "it is not supported: the tool table of LinuxCNC has the lengths and radii as they act",
        &[
            "CUT2DD",
            "CUT2DFD",
            "CUTCONON",
            "CUTCONOF",
            "CUTMOD",
            "CUTMODK",
            "TOWSTD",
            "TOWBCS",
            "TOWKCS",
            "TOWMCS",
            "TOWTCS",
            "TOWWCS",
            "DZERO",
            "DELDL",
            "CHKDM",
            "CHKDNO",
            "GETDNO",
            "SETDNO",
            "SETTCOR",
            "GETTCOR",
            "LENTOAX",
            "TOOLENV",
            "DELTOOLENV",
            "GETTENV",
            "CORRTC",
        ],
    ),
    (
        "the tools of the other control are not managed here: write T, M6 and D",
        &[
            "TCA",
            "TCI",
            "TML",
            "TMON",
            "TMOF",
            "GETT",
            "GETACTT",
            "GETACTTD",
            "GETEXET",
            "GETFREELOC",
            "GETSELT",
            "MVTOOL",
            "MOVT",
            "NEWT",
            "NEWMT",
            "DELT",
            "DELTC",
            "DELMT",
            "DELMLOWNER",
            "DELMLRES",
            "POSM",
            "POSMT",
            "RESETMON",
            "SETPIECE",
            "SETTA",
            "SETTIA",
            "TOOLGNT",
            "TOOLGT",
            "TLIFT",
        ],
    ),
    (
        "it cannot be evaluated ahead of time",
        &["FTOC", "FTOCON", "FTOCOF", "PUTFTOC", "PUTFTOCF", "FCTDEF"],
    ),
];

/// Axes and spindles beside the path.
const AXES: [Kind; 7] = [
    (
        "positioning axes apart from the path are not supported: name the axis in a rapid motion of its own, as G0 X100",
        &[
            "POS", "POSA", "POSP", "POSRANGE", "WAITP", "FA", "IPOBRKA", "IPOENDA", "FINEA",
            "COARSEA",
        ],
    ),
    (
        "coded positions are not supported: write the positions",
        &["CAC", "CACN", "CACP", "CDC", "CIC"],
    ),
    (
        "oscillating axes and motions against a stop are not supported",
        &[
            "OS", "OSB", "OSC", "OSCILL", "OSCTRL", "OSD", "OSE", "OSNSC", "OSOF", "OSP1", "OSP2",
            "OSS", "OSSE", "OST", "OST1", "OST2", "SR", "SRA", "ST", "STA", "FXS", "FXST", "FXSW",
            "FOC", "FOCON", "FOCOF",
        ],
    ),
    (
        "coupled axes are not supported",
        &[
            "OEMIPO1", "OEMIPO2", "COUPON", "COUPONC", "COUPOF", "COUPOFS", "COUPDEF", "COUPDEL",
            "COUPRES", "LEADON", "LEADOF", "TRAILON", "TRAILOF", "EGON", "EGONSYN", "EGONSYNE",
            "EGOFC", "EGOFS", "EGDEF", "EGDEL", "TANG", "TANGON", "TANGOF", "TANGDEL", "MASLON",
            "MASLOF", "MASLOFS", "MASLDEF", "MASLDEL", "CPDEF", "CPDEL", "CPON", "CPOF", "CPLON",
            "CPLOF", "CPLDEF", "CPLDEL", "CPLNUM", "CPLDEN", "WAITC", "CTAB", "CTABDEF", "CTABEND",
            "CTABDEL", "CTABINV",
        ],
    ),
    (
        "axes cannot be exchanged: they are X Y Z A B C U V W as LinuxCNC has them",
        &[
            "GEOAX", "AXTOCHAN", "AXCTSWE", "AXCTSWEC", "AXCTSWED", "AXNAME", "AXSTRING",
            "AXTOSPI", "SPI", "ISAXIS", "MODAXVAL", "AXIS",
        ],
    ),
    (
        "diameters of single axes are not supported: write DIAMON, DIAM90 or DIAMOF, and values to match",
        &[
            "DIAMONA",
            "DIAMOFA",
            "DIAM90A",
            "DIAMCHAN",
            "DIAMCHANA",
            "DIAMCYCOF",
            "DIACYCOFA",
            "RAC",
            "RIC",
            "DAC",
            "DIC",
        ],
    ),
    (
        "punching and nibbling are not supported",
        &[
            "PON", "PONS", "SON", "SONS", "SPOF", "SPN", "SPP", "PDELAYON", "PDELAYOF", "PUNCHACC",
            "SPIF1", "SPIF2",
        ],
    ),
];

/// What a program knows or does while it runs on the other control.
const RUNNING: [Kind; 9] = [
    (
        "synchronised actions cannot be evaluated ahead of time",
        &[
            "WHEN",
            "WHENEVER",
            "EVERY",
            "FROM",
            "DO",
            "ID",
            "IDS",
            "CANCEL",
            "CANCELSUB",
            "SYNFCT",
            "LOCK",
            "UNLOCK",
            "STOPREOF",
            "DELDTG",
            "RDISABLE",
            "ICYCON",
            "ICYCOF",
            "MOV",
        ],
    ),
    (
        "measuring cannot be evaluated ahead of time",
        &[
            "MEAS", "MEAW", "MEASA", "MEAWA", "MEAC", "MEASF", "MEASURE", "CALCDAT", "CALCPOSI",
        ],
    ),
    (
        "there is only one channel",
        &[
            "INIT", "START", "WAITM", "WAITMC", "WAITE", "WAITENC", "SETM", "CLEARM", "GET",
            "GETD", "RELEASE", "CHANDATA",
        ],
    ),
    (
        "file access and text that is run as program are not supported",
        &[
            "EXECSTRING",
            "READ",
            "WRITE",
            "DELETE",
            "ISFILE",
            "FILEDATE",
            "FILETIME",
            "FILESIZE",
            "FILESTAT",
            "FILEINFO",
            "EXTOPEN",
            "EXTCLOSE",
            "EXECTAB",
            "EXECUTE",
            "CONTPRON",
            "CONTDCON",
            "INTERSEC",
            "MMC",
            "WRTPR",
        ],
    ),
    (
        "interrupt routines are not supported",
        &[
            "SETINT",
            "ENABLE",
            "DISABLE",
            "CLRINT",
            "PRIO",
            "BLSYNC",
            "IPTRLOCK",
            "IPTRUNLOCK",
        ],
    ),
    (
        "returning to a contour is not supported: write the motion there",
        &[
            "REPOSA", "REPOSH", "REPOSHA", "REPOSL", "REPOSQ", "REPOSQA", "RMB", "RME", "RMI",
            "RMN", "DISPR",
        ],
    ),
    (
        "the places of G75 are those of the other control: write the motion there, G0 SUPA Z0 D0",
        &["FP"],
    ),
    (
        "it changes what the control knows of its machine: set that up in LinuxCNC",
        &[
            "PRESETON",
            "PRESETONS",
            "NEWCONF",
            "CPROT",
            "CPROTDEF",
            "NPROT",
            "NPROTDEF",
            "PROTA",
            "PROTD",
            "PROTS",
            "CORROF",
            "CORRTRAFO",
            "AUXFUDEL",
            "AUXFUDELG",
            "AUXFUMSEQ",
            "AUXFUSYNC",
            "WALCS3",
            "WALCS4",
            "WALCS5",
            "WALCS6",
            "WALCS7",
            "WALCS8",
            "WALCS9",
            "WALCS10",
            "OMA1",
            "OMA2",
            "OMA3",
            "OMA4",
            "OMA5",
            "DRVPRD",
            "DRVPWR",
        ],
    ),
    (
        "texts and names are not taken apart: write the value",
        &[
            "STRLEN",
            "SPRINT",
            "STRINGIS",
            "SUBSTR",
            "INDEX",
            "RINDEX",
            "MINDEX",
            "MATCH",
            "NUMBER",
            "ISNUMBER",
            "TOLOWER",
            "TOUPPER",
            "ISVAR",
            "GETVARTYP",
            "GETVARDIM",
            "GETVARLIM",
        ],
    ),
];

/// Words that lead through a program.
const FLOW: [Kind; 3] = [
    (
        "the program would begin anew without an end: repeat what is meant with LOOP, FOR or REPEAT",
        &["GOTOS"],
    ),
    (
        "subprograms are not called with their folder: write CALL, and give the folder with --subprograms",
        &["PCALL", "CALLPATH", "ISOCALL"],
    ),
    (
        "macros and declarations that are changed are not supported: write out what they stand for",
        &["DEFINE", "REDEF"],
    ),
];

/// All kinds.
const KINDS: [&[Kind]; 6] = [&PATH, &SPEEDS, &TOOLS, &AXES, &RUNNING, &FLOW];

/// What to write instead of a word of the control that is refused; `None` for any other.
pub fn refused(name: &str) -> Option<&'static str> {
    let found = KINDS
        .into_iter()
        .flatten()
        .find(|(_, names)| names.contains(&name));
    found.map(|(instead, _)| *instead)
}

/// All of them.
#[cfg(test)]
pub fn all() -> impl Iterator<Item = &'static str> {
    KINDS
        .into_iter()
        .flatten()
        .flat_map(|(_, names)| *names)
        .copied()
}
