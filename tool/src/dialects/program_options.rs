//! The options that say how a part program is read, of each command that reads one.

use super::control::own_m::linuxcnc_m;
use super::ini;
use super::settings::{
    DecimalPoint, IncrementBase, MOST_BLOCKS, MirrorOutsideXy, MirroredCircle, Settings,
};
use super::tools::ToolFiles;
use crate::encoding::Encoding;
use crate::machine::IniError;
use crate::source::open::{LONGEST_WHOLE, MOST_BYTES, MOST_SECONDS, PIECE, Reading};
use clap::{Args, FromArgMatches, ValueEnum};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How a part program is read.
#[derive(Clone, Debug, PartialEq, Args)]
pub struct ProgramOptions {
    /// Folder with subprogram files; may be given several times. The folder of FILE comes first
    #[arg(long, value_name = "DIR")]
    pub subprograms: Vec<PathBuf>,
    /// What an increment counts from when the frame changed since the axis moved last
    #[arg(long, value_enum, default_value = "programmed")]
    pub increment_after_frame: IncrementBase,
    /// Leave out blocks that begin with /
    #[arg(long)]
    pub skip_blocks: bool,
    /// M function that is passed on to LinuxCNC, none of its own; may be given several times
    #[arg(long, value_name = "NUMBER", value_delimiter = ',', value_parser = passed_m)]
    pub pass_m: Vec<u32>,
    /// Value of a variable (R5, P5, #500, V.P.NAME) before the program begins; may be given several times
    #[arg(long, value_name = "R5=VALUE", value_parser = variable)]
    pub set: Vec<(String, f64)>,
    /// Row of the tool table that holds a further edge (D2 to D9) of a tool; may be given several times
    #[arg(long, value_name = "TOOL.EDGE=ROW", value_parser = edge)]
    pub edge: Vec<((u32, u32), u32)>,
    /// The feed in force when the program begins, machine units per minute
    #[arg(long, value_name = "FEED", value_parser = feed)]
    pub feed: Option<f64>,
    /// Where CYCLE800 with FR = 1 retracts to: Z of the machine itself, mm; without this option
    /// [FRAMEPATH]RETRACT_Z of the INI file of the LinuxCNC that runs the filter
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = place)]
    pub retract_z: Option<f64>,
    /// How many blocks the program may run, besides twice the lines that it has, before it is taken
    /// for one that never ends
    #[arg(long, value_name = "NUMBER", default_value_t = MOST_BLOCKS, value_parser = most_blocks)]
    pub most_blocks: usize,
    /// The longest file that is read as a program or subprogram, bytes
    #[arg(long, value_name = "BYTES", default_value_t = MOST_BYTES, value_parser = clap::value_parser!(u64).range(1..))]
    pub most_bytes: u64,
    /// How long the translation may take, and how long may be waited for a program that comes through a pipe,
    /// seconds
    #[arg(long, value_name = "SECONDS", default_value_t = MOST_SECONDS, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    pub most_seconds: u64,
    /// Number of a tool that the program calls by name; may be given several times
    #[arg(long, value_name = "NAME=NUMBER", value_parser = tool_name)]
    pub tool: Vec<(String, u32)>,
    /// What X100, without a decimal point, is in Fanuc-like programs. F is taken as it is written, with G93 too
    #[arg(long, value_enum, default_value = "calculator")]
    pub decimal_point: DecimalPoint,
    /// What G21, G22 and G23 of ISG programs mirror outside of G17
    #[arg(long, value_enum, default_value = "refuse")]
    pub mirror_outside_xy: MirrorOutsideXy,
    /// What becomes of a full circle with an absolute centre right after a mirror of an ISG program
    #[arg(long, value_enum, default_value = "refuse")]
    pub mirrored_circle: MirroredCircle,
    /// How the characters of the program and its subprograms are written: auto, utf-8, utf-16le, utf-16be,
    /// cp1252, cp1250, cp1251, cp850, cp852 or cp866
    #[arg(long, value_name = "ENCODING", default_value = "auto", value_parser = encoding)]
    pub encoding: EncodingChoice,
    /// Programs longer than this are read piece by piece if they can be, bytes
    #[arg(long, value_name = "BYTES", default_value_t = LONGEST_WHOLE, hide = true)]
    pub longest_whole: u64,
    /// How much is read at once then, bytes
    #[arg(long, value_name = "BYTES", default_value_t = PIECE, hide = true)]
    pub piece: usize,
}

impl ProgramOptions {
    /// The settings of the control that is imitated, with what the INI file of the machine says.
    ///
    /// # Errors
    ///
    /// What is wrong with the INI file.
    pub fn settings(
        &self,
        program: &Path,
        ini_file: Option<PathBuf>,
        machine_in_inch: bool,
    ) -> Result<Settings, IniError> {
        let millimetre = match machine_in_inch {
            true => 1.0 / 25.4,
            false => 1.0,
        };
        let retract_z = match (self.retract_z, &ini_file) {
            (None, Some(file)) => ini::retract_z(file)?,
            (place, _) => place,
        };
        let lathe = match &ini_file {
            Some(file) => ini::is_lathe(file)?,
            None => false,
        };
        let diameters_before = match &ini_file {
            Some(file) => lathe || ini::begins_in_diameters(file)?,
            None => false,
        };
        Ok(Settings {
            subprogram_folders: self.subprograms.clone(),
            reading: self.reading(),
            machine_in_inch,
            increment_after_frame: self.increment_after_frame,
            lathe,
            diameters_before,
            skip_blocks: self.skip_blocks,
            passed_m: self.pass_m.clone(),
            variables: self.set.iter().cloned().collect(),
            feed: self.feed,
            retract_z: retract_z.map(|place| place * millimetre),
            most_blocks: self.most_blocks,
            tool_edges: self.edge.iter().copied().collect(),
            tool_names: self.tool.iter().cloned().collect(),
            tool_files: ToolFiles::beside(program, ini_file),
            decimal_point: self.decimal_point,
            mirror_outside_xy: self.mirror_outside_xy,
            mirrored_circle: self.mirrored_circle,
            ..Settings::default()
        })
    }

    /// Whether none of them is given.
    pub fn is_default(&self) -> bool {
        let command = ProgramOptions::augment_args(clap::Command::new("program"));
        let none = command.try_get_matches_from(["program"]);
        let none = none.and_then(|matches| ProgramOptions::from_arg_matches(&matches));
        none.is_ok_and(|none| none == *self)
    }

    /// Options that say two things of the same, of which one would be settled in silence.
    ///
    /// # Errors
    ///
    /// The first of them.
    pub fn contradiction(&self) -> Result<(), String> {
        let twice = |option: &str, names: Vec<String>| {
            let repeated = names.iter().enumerate();
            let mut repeated = repeated.filter(|(index, name)| names[..*index].contains(name));
            match repeated.next() {
                Some((_, name)) => Err(format!("--{option} {name}= is given twice: write it once")),
                None => Ok(()),
            }
        };
        let named = |list: &[(String, f64)]| list.iter().map(|(name, _)| name.clone()).collect();
        twice("set", named(&self.set))?;
        twice(
            "tool",
            self.tool.iter().map(|(name, _)| name.clone()).collect(),
        )?;
        let edges = self.edge.iter();
        let edge = |((tool, edge), _): &((u32, u32), u32)| format!("{tool}.{edge}");
        twice("edge", edges.map(edge).collect())
    }

    /// That the folders with subprograms are there.
    ///
    /// # Errors
    ///
    /// The first that is not.
    pub fn folders(&self) -> Result<(), String> {
        match self.subprograms.iter().find(|folder| !folder.is_dir()) {
            Some(folder) => Err(format!(
                "--subprograms {}: there is no such folder",
                folder.display()
            )),
            None => Ok(()),
        }
    }

    /// How files are read.
    fn reading(&self) -> Reading {
        Reading {
            encoding: self.encoding.0,
            longest_whole: self.longest_whole,
            piece: self.piece,
            most_bytes: self.most_bytes,
            most_time: Duration::from_secs(self.most_seconds),
        }
    }
}

/// An encoding, or `None` for the likeliest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EncodingChoice(pub Option<Encoding>);

fn encoding(text: &str) -> Result<EncodingChoice, String> {
    match text.eq_ignore_ascii_case("auto") {
        true => Ok(EncodingChoice(None)),
        false => Encoding::from_str(text, true).map(|encoding| EncodingChoice(Some(encoding))),
    }
}

fn passed_m(text: &str) -> Result<u32, String> {
    let number = text.parse().map_err(|_| "write a number: 101")?;
    match linuxcnc_m(number) {
        None => Ok(number),
        Some(meaning) => Err(format!("M{number} is LinuxCNC's own: {meaning}")),
    }
}

fn variable(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write R5=12.5")?;
    let name = name.trim().to_ascii_uppercase();
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '#')
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "._[]#".contains(c));
    let value: Option<f64> = value
        .trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite());
    match (is_name, value) {
        (true, Some(value)) => Ok((name, value)),
        _ => Err("write R5=12.5".to_string()),
    }
}

fn edge(text: &str) -> Result<((u32, u32), u32), String> {
    let parse = || {
        let (edge, row) = text.split_once('=')?;
        let (tool, edge) = edge.split_once('.')?;
        let numbers = [tool, edge, row].map(|number| number.trim().parse().ok());
        match numbers {
            [Some(tool), Some(edge @ 2..=9), Some(row)] => Some(((tool, edge), row)),
            _ => None,
        }
    };
    parse().ok_or_else(|| "write 3.2=13 for edge D2 of tool 3 in row 13".to_string())
}

fn feed(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if f64::is_finite(value) && value > 0.0 => Ok(value),
        _ => Err("a feed above 0 is needed".to_string()),
    }
}

fn place(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if ini::PLACES.contains(&value) => Ok(value),
        _ => Err("a place from -100000 to 100000 mm is needed".to_string()),
    }
}

fn most_blocks(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(value) if (1..=100_000_000).contains(&value) => Ok(value),
        _ => Err("a number from 1 to 100000000 is needed".to_string()),
    }
}

fn tool_name(text: &str) -> Result<(String, u32), String> {
    let (name, number) = text.rsplit_once('=').ok_or("write NAME=NUMBER")?;
    let number = number.trim().parse().map_err(|_| "write NAME=NUMBER")?;
    Ok((name.trim().to_uppercase(), number))
}
