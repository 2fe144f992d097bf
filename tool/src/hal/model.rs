//! What is there when the HAL files have run: modules, functions of threads, values and links of pins.

use super::commands::{is_arrow, is_signal_type};
use super::values::is_value;
use super::{Fix, Problem, Statement};
use crate::machine::place::Place;
use std::collections::BTreeMap;

/// A module that `loadrt` loads.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    /// Its name.
    pub name: String,
    /// Its parameters: `num_aio`, `16`.
    pub parameters: Vec<(String, String)>,
    /// The line.
    pub statement: Statement,
}

impl Module {
    /// The value of a parameter.
    pub fn parameter(&self, name: &str) -> Option<&str> {
        let found = self.parameters.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }
}

/// A program that `loadusr` starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Its options: `-Wn`, `frame-guard`.
    pub options: Vec<String>,
    /// As it is written.
    pub program: String,
    /// The line.
    pub statement: Statement,
    /// How many modules were loaded before.
    pub modules_before: usize,
}

/// A function in a thread.
#[derive(Clone, Debug, PartialEq)]
pub struct Added {
    /// Its name.
    pub function: String,
    /// The thread.
    pub thread: String,
    /// Where it is added.
    pub place: Place,
}

/// A value that a pin is set to.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// With what variables stand for.
    pub value: String,
    /// The line.
    pub statement: Statement,
}

/// Everything at the end.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// In the order of loading.
    pub modules: Vec<Module>,
    /// In the order of starting.
    pub programs: Vec<Program>,
    /// In the order in which their threads run them.
    pub functions: Vec<Added>,
    /// The last value of each pin, by itself or by its signal.
    pub settings: BTreeMap<String, Setting>,
    /// The pins of each signal, with the places where they were linked.
    pub signals: BTreeMap<String, Vec<(String, Place)>>,
    /// What halcmd refuses.
    pub problems: Vec<Problem>,
    /// The last value of each signal that is given one.
    values: BTreeMap<String, Setting>,
    /// Other names of pins.
    aliases: BTreeMap<String, String>,
}

impl State {
    /// Runs the statements.
    pub fn run(statements: &[Statement]) -> State {
        let mut state = State::default();
        for statement in statements {
            state.take(statement);
        }
        state
    }

    /// The module of this name, if it is loaded.
    pub fn module(&self, name: &str) -> Option<&Module> {
        self.modules.iter().find(|module| module.name == name)
    }

    /// The signal that a pin is linked to.
    pub fn signal_of(&self, pin: &str) -> Option<&str> {
        let linked = |pins: &Vec<(String, Place)>| pins.iter().any(|(other, _)| other == pin);
        let found = self.signals.iter().find(|(_, pins)| linked(pins));
        found.map(|(signal, _)| signal.as_str())
    }

    /// The pins that share a signal with this one, and where these were linked.
    pub fn beside(&self, pin: &str) -> impl Iterator<Item = &(String, Place)> {
        let pins = self.signal_of(pin).and_then(|name| self.signals.get(name));
        pins.into_iter()
            .flatten()
            .filter(move |(other, _)| other != pin)
    }

    fn take(&mut self, statement: &Statement) {
        let word = |index: usize| statement.word(index);
        match word(0) {
            "loadrt" => self.load(statement),
            "loadusr" => self.start(statement),
            "addf" => self.add(statement),
            "delf" => {
                let named = |added: &Added| added.function == word(1) && added.thread == word(2);
                self.functions.retain(|added| !named(added));
            }
            "setp" => self.set(statement, word(1), 2),
            "sets" if statement.words.len() == 3 => self.set_signal(statement),
            _ if word(1) == "=" => self.set(statement, word(0), 2),
            "net" | "linksp" => {
                let pins = statement.words.iter().skip(2).map(|word| &word.text);
                let pins: Vec<&String> = pins.filter(|pin| !is_arrow(pin)).collect();
                if pins.is_empty() {
                    let found = format!("`{}` links no pin", statement.text);
                    self.refuse(statement, found, "name a pin, or remove this line");
                }
                for pin in pins {
                    self.link(statement, word(1), pin);
                }
            }
            "linkps" => {
                let signal = statement
                    .words
                    .iter()
                    .skip(2)
                    .find(|word| !is_arrow(&word.text));
                let signal = signal.map_or("", |word| word.text.as_str());
                self.link(statement, signal, word(1));
            }
            "linkpp" => {
                let pins = statement
                    .words
                    .iter()
                    .skip(1)
                    .filter(|word| !is_arrow(&word.text));
                for pin in pins {
                    self.link(statement, word(1), &pin.text);
                }
            }
            "unlinkp" => {
                let pin = self.named(word(1));
                for pins in self.signals.values_mut() {
                    pins.retain(|(other, _)| *other != pin);
                }
            }
            "newsig" if !is_signal_type(word(2)) => {
                let found = format!("`{}`: a signal has no type {}", statement.text, word(2));
                self.refuse(statement, found, "write bit, float, s32 or u32");
            }
            "delsig" => {
                self.signals.remove(word(1));
            }
            "alias" if word(1) == "pin" => {
                self.aliases.insert(word(3).to_owned(), word(2).to_owned());
            }
            "unloadrt" | "unload" => self.modules.retain(|module| module.name != word(1)),
            _ => {}
        }
    }

    fn named(&self, pin: &str) -> String {
        self.aliases
            .get(pin)
            .cloned()
            .unwrap_or_else(|| pin.to_owned())
    }

    fn refuse(&mut self, statement: &Statement, found: String, remedy: &str) {
        self.problems.push(Problem {
            place: statement.place.clone(),
            found,
            remedy: Fix::Advice(remedy.to_owned()),
        });
    }

    fn load(&mut self, statement: &Statement) {
        if self.module(statement.word(1)).is_some() {
            let found = format!("{} is loaded already, and loadrt fails", statement.word(1));
            self.refuse(statement, found, "remove one of the two lines");
        }
        let parameters = statement.words.iter().skip(2).map(|word| {
            // Of parameters alone halcmd takes the quotes away.
            let text = word.text.replace(['"', '\''], "");
            let (name, value) = text.split_once('=').unwrap_or((&text, ""));
            (name.to_owned(), value.to_owned())
        });
        self.modules.push(Module {
            name: statement.word(1).to_owned(),
            parameters: parameters.collect(),
            statement: statement.clone(),
        });
    }

    fn start(&mut self, statement: &Statement) {
        let mut words = statement.words.iter().skip(1).map(|word| word.text.clone());
        let mut options = Vec::new();
        let mut program = String::new();
        while let Some(word) = words.next() {
            if !word.starts_with('-') {
                program = word;
                break;
            }
            let has_name = word.contains('n');
            options.push(word);
            if has_name {
                options.extend(words.next());
            }
        }
        self.programs.push(Program {
            options,
            program,
            statement: statement.clone(),
            modules_before: self.modules.len(),
        });
    }

    /// `addf FUNCTION THREAD [POSITION]`: 1 is the first place of the thread, -1 the last one.
    fn add(&mut self, statement: &Statement) {
        let added = Added {
            function: statement.word(1).to_owned(),
            thread: statement.word(2).to_owned(),
            place: statement.place.clone(),
        };
        let position: i64 = statement.word(3).parse().unwrap_or(-1);
        let places = self.functions.iter().enumerate();
        let of_thread = places.filter(|(_, other)| other.thread == added.thread);
        let of_thread: Vec<usize> = of_thread.map(|(place, _)| place).collect();
        let count = of_thread.len() as i64;
        let index = if position > 0 {
            position - 1
        } else {
            count + position.max(-count - 1) + 1
        };
        let place = of_thread.get(index as usize).copied();
        self.functions
            .insert(place.unwrap_or(self.functions.len()), added);
    }

    fn set(&mut self, statement: &Statement, pin: &str, value: usize) {
        if statement.words.len() != value + 1 {
            let found = format!(
                "`{}` takes a pin and a value, {} words are there",
                statement.text,
                statement.words.len() - 1
            );
            let remedy = "one value, and in the INI file no comment behind it";
            return self.refuse(statement, found, remedy);
        }
        self.judge_value(statement);
        let setting = Setting {
            value: statement.word(value).to_owned(),
            statement: statement.clone(),
        };
        self.settings.insert(self.named(pin), setting);
    }

    fn set_signal(&mut self, statement: &Statement) {
        self.judge_value(statement);
        let signal = statement.word(1);
        let setting = Setting {
            value: statement.word(2).to_owned(),
            statement: statement.clone(),
        };
        for (pin, _) in self.signals.get(signal).into_iter().flatten() {
            self.settings.insert(pin.clone(), setting.clone());
        }
        self.values.insert(signal.to_owned(), setting);
    }

    /// The third word of a statement that sets something.
    fn judge_value(&mut self, statement: &Statement) {
        let value = statement.word(2);
        if !is_value(value) {
            let found = format!(
                "`{}`: halcmd takes {value} for no value of any type",
                statement.text
            );
            self.refuse(
                statement,
                found,
                "write a number with a decimal point, or 1, 0, TRUE or FALSE for a bit",
            );
        }
    }

    fn link(&mut self, statement: &Statement, signal: &str, pin: &str) {
        let pin = self.named(pin);
        match self.signal_of(&pin) {
            Some(other) if other != signal => {
                let found = format!("{pin} is linked to the signal {other} already");
                let remedy = format!("use the signal {other}, or remove one of the two lines");
                self.refuse(statement, found, &remedy);
            }
            Some(_) => {}
            None => {
                if let Some(value) = self.values.get(signal) {
                    self.settings.insert(pin.clone(), value.clone());
                }
                let pins = self.signals.entry(signal.to_owned()).or_default();
                pins.push((pin, statement.place.clone()));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hal::read_script;
    use crate::machine::ini::Ini;

    fn run(text: &str) -> State {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("m.hal"), text).expect("written");
        let ini = folder.path().join("m.ini");
        let (ini, _) = Ini::parse_all(&ini, "[HAL]\nHALFILE = m.hal\n");
        State::run(&read_script(&ini, &[]).statements)
    }

    #[test]
    fn functions_stand_where_their_positions_put_them() {
        let state =
            run("addf b t\naddf c t -1\naddf a t 1\naddf x u\naddf bc t -2\naddf far t 99\n");
        let order = state.functions.iter().filter(|added| added.thread == "t");
        let order: Vec<&str> = order.map(|added| added.function.as_str()).collect();
        assert_eq!(order, ["a", "b", "bc", "c", "far"]);
    }

    #[test]
    fn a_value_of_a_signal_is_one_of_its_pins() {
        let state = run("net s a b\nsets s 5\nlinkps c => s\nsetp d 1\nnet t d\n");
        let values = ["a", "b", "c", "d"].map(|pin| state.settings[pin].value.as_str());
        assert_eq!(values, ["5", "5", "5", "1"]);
    }

    #[test]
    fn pins_are_linked_in_all_the_ways() {
        let state = run(
            "net s a => b\nlinkps c => s\nlinksp s => d\nlinkpp e f\nnet s b\nunlinkp d\nnet z b\n",
        );
        let pins: Vec<&str> = state.beside("a").map(|(pin, _)| pin.as_str()).collect();
        assert_eq!(pins, ["b", "c"]);
        assert_eq!(state.signal_of("f"), state.signal_of("e"));
        assert_eq!(state.problems.len(), 1);
        assert!(state.problems[0].found.contains("signal s already"));
    }

    #[test]
    fn values_modules_and_programs_are_kept() {
        let state = run(
            "loadrt motmod num_aio=\"16\" x\nsetp p 1\np = 2\nloadusr -Wn guard ./g.py a\nsetp p 1 2\n",
        );
        assert_eq!(state.settings["p"].value, "2");
        assert_eq!(state.modules[0].parameter("num_aio"), Some("16"));
        assert_eq!(state.programs[0].program, "./g.py");
        assert_eq!(state.programs[0].options, ["-Wn", "guard"]);
        assert_eq!(state.problems.len(), 1);
    }

    #[test]
    fn what_halcmd_refuses_is_said() {
        for (text, words) in [
            ("net s =>\n", "links no pin"),
            ("newsig s bitt\n", "no type bitt"),
            ("newsig s\n", "no type"),
            ("setp and2.0.in0 yes\n", "takes yes for no value"),
            ("scale.0.gain = 5,5\n", "takes 5,5 for no value"),
            ("sets s on\n", "takes on for no value"),
            ("setp p \"5\"\n", "takes \"5\" for no value"),
            ("setp p \\\r\n5\r\n", "takes \\ for no value"),
            (
                "loadrt and2\nloadrt and2 count=2\n",
                "and2 is loaded already",
            ),
        ] {
            let problems = run(text).problems;
            assert_eq!(problems.len(), 1, "{text}: {problems:?}");
            assert!(problems[0].found.contains(words), "{problems:?}");
        }
        let taken = run(
            "setp p True\nsetp q 0x1F\nnewsig s BIT\nsets s 1\nnewsig t s64\nloadrt and2\nunloadrt and2\nloadrt and2\n",
        );
        assert_eq!(taken.problems, []);
    }
}
