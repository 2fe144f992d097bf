//! Which HAL files an INI file names, where they are, and what they say.

use super::commands::is_known;
use super::line::{LONGEST, Reason, Refusal, joined, statement};
use super::tcl::Stock;
use super::variables::{HALLIB, Missing};
use super::{Fix, Problem, State, Statement, Unread, Word};
use crate::machine::ini::{Entry, Ini};
use crate::machine::place::Place;
use crate::machine::text_file;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How deep `source` may be nested, and how many lines are read at all.
const DEEPEST: usize = 20;
const MOST_STATEMENTS: usize = 200_000;

/// What LinuxCNC gives to `halcmd` at a start.
#[derive(Clone, Debug, Default)]
pub struct Script {
    /// In the order in which they are run.
    pub statements: Vec<Statement>,
    /// What `halcmd` or the script `linuxcnc` refuses.
    pub problems: Vec<Problem>,
    /// The same in the files of `POSTGUI_HALFILE`, which a screen runs behind the start.
    pub late_problems: Vec<Problem>,
    /// What was not read.
    pub unread: Vec<Unread>,
    /// The files that were read, in their order.
    pub files: Vec<PathBuf>,
    /// LinuxCNC's own in Tcl among them, whose statements stand where they are named.
    pub stock: Vec<Stock>,
}

/// Reads the HAL files of `[HAL]`, its commands, and what the screen runs behind them. `folders` are looked
/// through before that of the INI file, as with `linuxcnc -H`.
pub fn read_script(ini: &Ini, folders: &[PathBuf]) -> Script {
    let folder = match ini.file().parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let mut reader = Reader {
        script: Script::default(),
        ini,
        folder,
        folders,
    };
    for entry in ini.all("HAL", "HALFILE") {
        reader.take_named(entry);
    }
    for entry in ini.all("HAL", "HALCMD") {
        reader.take_command(entry);
    }
    let before = std::mem::take(&mut reader.script.problems);
    for entry in ini.all("HAL", "POSTGUI_HALFILE") {
        reader.take_named(entry);
    }
    reader.script.late_problems = std::mem::replace(&mut reader.script.problems, before);
    reader.script
}

struct Reader<'a> {
    script: Script,
    ini: &'a Ini,
    folder: PathBuf,
    folders: &'a [PathBuf],
}

impl Reader<'_> {
    fn refuse(&mut self, place: &Place, found: String, remedy: impl Into<String>) {
        self.script.problems.push(Problem {
            place: place.clone(),
            found,
            remedy: Fix::Advice(remedy.into()),
        });
    }

    fn leave(&mut self, place: &Place, name: &str, reason: &str) {
        self.script.unread.push(Unread {
            place: place.clone(),
            name: name.to_owned(),
            reason: reason.to_owned(),
            tcl: None,
        });
    }

    /// A HALFILE of the INI file; what stands behind its name is for Tcl.
    fn take_named(&mut self, entry: &Entry) {
        let Some(name) = entry.raw.split_whitespace().next() else {
            return;
        };
        let place = &entry.place;
        let path = match self.found(name) {
            Some(path) => path,
            None if name.starts_with("LIB:") && !Path::new(HALLIB).is_dir() => {
                return self.leave(
                    place,
                    name,
                    "LinuxCNC, whose file it is, is not installed here",
                );
            }
            None => {
                let found = format!("the HAL file {name} is not there");
                let remedy = format!("put it beside the INI file, or correct [HAL]{}", entry.key);
                return self.refuse(place, found, remedy);
            }
        };
        match Stock::in_file(&path) {
            Some(stock) => self.take_stock(entry, stock, path),
            None if path.extension().is_some_and(|ending| ending == "tcl") => {
                self.script.unread.push(Unread {
                    place: place.clone(),
                    name: name.to_owned(),
                    reason: "it is written in Tcl".to_owned(),
                    tcl: Some(path),
                });
            }
            None => self.take_file(place, &path, 0),
        }
    }

    /// One of LinuxCNC's in Tcl; all that it does stands at the line that names it.
    fn take_stock(&mut self, entry: &Entry, stock: Stock, path: PathBuf) {
        let place = &entry.place;
        let missing = |(section, key): &&(&str, &str)| self.ini.text(section, key).is_none();
        if let Some((section, key)) = stock.keys().iter().find(missing) {
            return self.script.problems.push(Problem {
                place: place.clone(),
                found: format!("{} needs [{section}]{key}", entry.value),
                remedy: Fix::Key {
                    section: (*section).to_owned(),
                    key: (*key).to_owned(),
                },
            });
        }
        self.script.files.push(path);
        self.script.stock.push(stock);
        let options: Vec<&str> = entry.raw.split_whitespace().skip(1).collect();
        let before = State::run(&self.script.statements);
        for line in joined(&stock.lines(self.ini, &options, &before)) {
            match statement(&place.file, &line, self.ini) {
                Ok(Some(mut statement)) => {
                    for word in &mut statement.words {
                        word.place = place.clone();
                    }
                    statement.place = place.clone();
                    self.script.statements.push(statement);
                }
                Ok(None) => {}
                Err(refusal) => self.tell(Refusal {
                    place: place.clone(),
                    ..refusal
                }),
            }
        }
    }

    /// Where the script `linuxcnc` finds a HALFILE.
    fn found(&self, name: &str) -> Option<PathBuf> {
        let name = match (name.strip_prefix("~/"), std::env::var_os("HOME")) {
            (Some(rest), Some(home)) => PathBuf::from(home).join(rest).display().to_string(),
            _ => name.to_owned(),
        };
        if let Some(name) = name.strip_prefix("LIB:") {
            return Some(Path::new(HALLIB).join(name)).filter(|path| path.is_file());
        }
        let own = [self.folder.as_path(), Path::new(HALLIB)];
        let folders = self.folders.iter().map(PathBuf::as_path).chain(own);
        let mut places = folders.map(|folder| folder.join(&name));
        places.find(|path| path.is_file())
    }

    fn take_file(&mut self, place: &Place, path: &Path, depth: usize) {
        let text = match text_file::read(path) {
            Ok(text) => text,
            Err(error) => {
                let found = format!("{} cannot be read: {error}", path.display());
                return self.refuse(place, found, "correct its name or its rights");
            }
        };
        if depth > DEEPEST {
            let found = format!("{} is in a circle of `source`", path.display());
            return self.refuse(place, found, "remove this line");
        }
        self.script.files.push(path.to_owned());
        let file: Arc<Path> = Arc::from(path);
        for line in joined(&text) {
            if self.script.statements.len() > MOST_STATEMENTS {
                return self.leave(
                    place,
                    &path.display().to_string(),
                    "there are too many lines",
                );
            }
            match statement(&file, &line, self.ini) {
                Ok(Some(statement)) => self.take(statement, depth),
                Ok(None) => {}
                Err(refusal) => self.tell(refusal),
            }
        }
    }

    /// A HALCMD of the INI file; the shell cuts it into words.
    fn take_command(&mut self, entry: &Entry) {
        let words = entry.raw.split_whitespace().map(|word| Word {
            text: word.to_owned(),
            place: entry.place.clone(),
        });
        let statement = Statement {
            words: words.collect(),
            text: entry.raw.clone(),
            place: entry.place.clone(),
        };
        if !statement.words.is_empty() {
            self.take(statement, 0);
        }
    }

    fn take(&mut self, statement: Statement, depth: usize) {
        let place = statement.place.clone();
        let word = statement.word(0);
        if word == "source" {
            let path = self.folder.join(statement.word(1));
            self.take_file(&place, &path, depth + 1);
        } else if is_known(word) || statement.word(1) == "=" {
            self.script.statements.push(statement);
        } else {
            let found = format!("`{word}` is no command of halcmd");
            self.refuse(&place, found, "correct or remove this line");
        }
    }

    fn tell(&mut self, refusal: Refusal) {
        let place = refusal.place;
        match refusal.reason {
            Reason::OpenQuote => {
                let found = "a quotation mark is not closed".to_owned();
                self.refuse(&place, found, "close it");
            }
            Reason::Long => {
                let found = format!(
                    "the line is longer than {LONGEST} bytes, and halcmd takes the rest for another one"
                );
                self.refuse(
                    &place,
                    found,
                    "write it in several lines, with \\ at the ends",
                );
            }
            Reason::Return => {
                let found = "a carriage return stands within the line".to_owned();
                let remedy = "end lines with a line feed, as dos2unix does";
                self.refuse(&place, found, remedy);
            }
            Reason::Variable(Missing::Form) => {
                let found = "`[` or `$` begins the name of a variable, and none follows".to_owned();
                self.refuse(&place, found, "write [SECTION]KEY or $NAME");
            }
            Reason::Variable(Missing::Key { section, key }) => {
                self.script.problems.push(Problem {
                    place,
                    found: format!("the INI file has no [{section}]{key}"),
                    remedy: Fix::Key { section, key },
                });
            }
            Reason::Variable(Missing::Environment(name)) => {
                self.leave(&place, &format!("${name}"), "this variable is not set here");
            }
        }
    }
}
