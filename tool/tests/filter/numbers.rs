//! Every G number from 0 to 999 and every M number from 0 to 199, in every dialect: what it means there,
//! what it means to LinuxCNC, and what is written. The tables in `numbers/` have five columns:
//!
//! - the number, or several: `G641-645`;
//! - its meaning there, `none` where that is not known;
//! - its meaning to LinuxCNC: `-` for none, `=` for the same, `~` for the same function with its words
//!   otherwise, where LinuxCNC's own number is written as well; anything else is another meaning;
//! - a program, its blocks parted by `&`, `G#` and `M#` with the number;
//! - what is written, `nothing`, or the error.
//!
//! What is in none of them is refused, and LinuxCNC does not have it. Of the decimal numbers up to G99.9
//! those have a row that one of the controls knows; the others are refused, whatever LinuxCNC has there.

use crate::rs274;
use crate::shop::{Shop, commands};
use framepath_tool::diagnostics::Diagnostics;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::dialects::{Dialect, evaluate};
use framepath_tool::encoding::decode;
use framepath_tool::source::Sources;
use framepath_tool::write::{Backend, WriteSettings, write};
use std::collections::BTreeMap;
use std::path::Path;

const LINUXCNC: &str = include_str!("numbers/linuxcnc.txt");

const DIALECTS: [(Dialect, &str, &str); 5] = [
    (
        Dialect::Sinumerik,
        "",
        include_str!("numbers/sinumerik.txt"),
    ),
    (
        Dialect::Fagor,
        "%PART,MX--,\n",
        include_str!("numbers/fagor.txt"),
    ),
    (Dialect::Mefi, "%1\n", include_str!("numbers/mefi.txt")),
    (Dialect::Isg, "%MAIN\n", include_str!("numbers/isg.txt")),
    (Dialect::Fanuc, "O1\n", include_str!("numbers/fanuc.txt")),
];

/// The blocks before the one with the number.
const HEAD: &str = "G0 X0 Y0 Z9\nS500 M3\nF200\n";

struct Row<'a> {
    there: &'a str,
    to_linuxcnc: &'a str,
    block: &'a str,
    written: &'a str,
}

fn columns(line: &str) -> Vec<&str> {
    line.split(" | ").map(str::trim).collect()
}

/// `G641-645` as `G641` to `G645`; `G54.1` is one number.
fn numbers(range: &str) -> Vec<String> {
    if is_decimal(range) {
        return vec![range.to_string()];
    }
    let (letter, range) = range.split_at(1);
    let (first, last) = range.split_once('-').unwrap_or((range, range));
    let [first, last] = [first, last].map(|number| number.parse::<u32>().expect("a number"));
    let numbers = first..=last;
    numbers.map(|number| format!("{letter}{number}")).collect()
}

fn is_decimal(number: &str) -> bool {
    number.contains('.')
}

fn every_number() -> Vec<String> {
    let decimals = |whole: u32| (1..10).map(move |decimal| format!("G{whole}.{decimal}"));
    let decimals = (0..100).flat_map(decimals).collect();
    [numbers("G0-999"), decimals, numbers("M0-199")].concat()
}

/// What LinuxCNC has.
fn linuxcnc() -> BTreeMap<String, &'static str> {
    let mut known = BTreeMap::new();
    for line in LINUXCNC.lines() {
        let [range, meaning] = columns(line)[..] else {
            panic!("two columns: {line}");
        };
        known.extend(numbers(range).into_iter().map(|number| (number, meaning)));
    }
    known
}

fn rows(table: &str) -> BTreeMap<String, Row<'_>> {
    let mut rows = BTreeMap::new();
    for line in table.lines() {
        let [range, there, to_linuxcnc, block, written] = columns(line)[..] else {
            panic!("five columns: {line}");
        };
        for number in numbers(range) {
            let row = Row {
                there,
                to_linuxcnc,
                block,
                written,
            };
            assert!(rows.insert(number, row).is_none(), "twice: {line}");
        }
    }
    rows
}

/// What the filter writes, or its first error.
fn outcome(dialect: Dialect, begin: &str, blocks: &str) -> Result<Vec<String>, String> {
    let blocks = blocks.replace(" & ", "\n");
    let mut sources = Sources::default();
    let mut diagnostics = Diagnostics::default();
    let text = format!("{begin}{HEAD}{blocks}\nM30\n");
    sources.add("part.nc".to_string(), decode(text.as_bytes()));
    // The path lies nowhere: no subprogram file can be found.
    let path = Path::new("/nonexistent/part.nc");
    let settings = Settings::default();
    let program = evaluate(dialect, path, &settings, &mut sources, &mut diagnostics);
    let write_settings = WriteSettings {
        dialect: dialect.name(),
        machine_in_inch: false,
        diameters_before: false,
        path_mode: settings.path_mode,
        tolerance: settings.tolerance,
        chord_tolerance: 0.01,
        arc_tolerance: &settings.arc_tolerance,
    };
    let backend = Backend::Program;
    let (output, refused) =
        write(backend, &program, &write_settings, &sources, &[]).expect("memory");
    diagnostics.append(refused);
    if let Some(error) = diagnostics.iter().into_iter().find(|one| one.is_error()) {
        return Err(error.message.clone());
    }
    Ok(commands(&output))
}

/// The outcome as the tables have it.
fn shown(dialect: Dialect, begin: &str, head: usize, blocks: &str) -> String {
    match outcome(dialect, begin, blocks) {
        Err(error) => format!("refused: {error}"),
        Ok(lines) => {
            let ends = lines.last().is_some_and(|last| last == "M30") && !blocks.contains("M30");
            let written = &lines[head..lines.len() - usize::from(ends)];
            match written.is_empty() {
                true => "nothing".to_string(),
                false => written.join(" & "),
            }
        }
    }
}

#[test]
fn every_number_does_what_the_table_says() {
    let known = linuxcnc();
    let mut wrong = Vec::new();
    for (dialect, begin, table) in DIALECTS {
        let head = outcome(dialect, begin, "").expect("a head").len() - 1;
        let mut rows = rows(table);
        for number in every_number() {
            let Some(row) = rows.remove(&number) else {
                if known.contains_key(&number) && !is_decimal(&number) {
                    wrong.push(format!(
                        "{dialect:?} {number}: LinuxCNC has it, and there is no row"
                    ));
                }
                for blocks in [number.clone(), format!("{number} X1 Y2")] {
                    let found = shown(dialect, begin, head, &blocks);
                    let refusals = ["supported", "defined"]
                        .map(|what| format!("refused: {number} is not {what}"));
                    let is_refused = match is_decimal(&number) {
                        true => found.starts_with("refused: "),
                        false => refusals.contains(&found),
                    };
                    if !is_refused {
                        wrong.push(format!("{dialect:?} {blocks}: {found}"));
                    }
                }
                continue;
            };
            let holder = format!("{}#", &number[..1]);
            let blocks = row.block.replace(&holder, &number);
            let found = shown(dialect, begin, head, &blocks);
            if found != row.written.replace(&holder, &number) {
                wrong.push(format!("{dialect:?} {blocks} ({}): {found}", row.there));
            }
            let meaning = known.get(&number).copied();
            let names = |block: &str| block.split(' ').any(|word| word == number);
            let agrees = match row.to_linuxcnc {
                "-" => meaning.is_none(),
                "=" => meaning.is_some(),
                other => match other.strip_prefix("~ ") {
                    Some(other) => meaning == Some(other),
                    // To LinuxCNC it is something else: it must not get there.
                    None => {
                        meaning == Some(other) && (found.starts_with("refused") || !names(&found))
                    }
                },
            };
            if !agrees {
                wrong.push(format!(
                    "{dialect:?} {number}: LinuxCNC's meaning is {meaning:?}; {found}"
                ));
            }
        }
        assert!(rows.is_empty(), "{dialect:?}: {:?}", rows.keys());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Those blocks of a program, each a number of a function, that LinuxCNC does not know.
fn unknown(folder: &Path, program: &str) -> Vec<String> {
    rs274::run(folder, "T1 P1\n", program);
    let said = std::fs::read_to_string(folder.join("errors.txt")).expect("a file");
    let said: Vec<&str> = said.lines().collect();
    // The error, and then the block in which it is.
    let pairs = said.windows(2).filter(|pair| {
        let error = pair[0].to_ascii_lowercase();
        error.contains("unknown") || error.contains("out of range")
    });
    pairs.map(|pair| pair[1].trim().to_string()).collect()
}

/// The list of LinuxCNC's numbers is complete: its interpreter knows these and no others. M100 to M199 are
/// programs of the user.
#[test]
fn linuxcnc_knows_these_numbers_and_no_others() {
    let known = linuxcnc();
    let shop = Shop::new(&[]);
    let ends = ["M2", "M30", "M98", "M99"];
    let all = every_number();
    let asked: Vec<&String> = all
        .iter()
        .filter(|number| !ends.contains(&number.as_str()))
        .filter(|number| known.get(*number).copied() != Some("command of the user"))
        .collect();
    let blocks: Vec<&str> = asked.iter().map(|number| number.as_str()).collect();
    let unknown = unknown(&shop.path(""), &(blocks.join("\n") + "\nM30\n"));
    let wrong = asked
        .into_iter()
        .filter(|number| unknown.contains(number) == known.contains_key(*number));
    assert_eq!(wrong.collect::<Vec<_>>(), [""; 0]);
}
