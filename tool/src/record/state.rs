//! HAL as it runs, as `halcmd -s show` prints it.

/// A component: a module, or a program with pins.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// Its name.
    pub name: String,
    /// The process of a program; `None` for a module.
    pub process: Option<i32>,
}

/// A pin.
#[derive(Clone, Debug, PartialEq)]
pub struct Pin {
    /// Name of its component.
    pub owner: String,
    /// Its own.
    pub name: String,
    /// As halcmd prints it.
    pub value: String,
    /// The signal that it is linked to.
    pub signal: Option<String>,
}

/// A signal.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Its name.
    pub name: String,
    /// As halcmd prints it.
    pub value: String,
}

/// A thread with its functions in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Thread {
    /// Its name.
    pub name: String,
    /// Seconds.
    pub period: f64,
    /// Names.
    pub functions: Vec<String>,
}

/// Everything that matters to a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// All of them.
    pub components: Vec<Component>,
    /// All of them.
    pub pins: Vec<Pin>,
    /// All of them.
    pub signals: Vec<Signal>,
    /// All of them.
    pub threads: Vec<Thread>,
}

/// The words of each line that has some.
fn rows(text: &str) -> impl Iterator<Item = Vec<&str>> {
    let words = text.lines().map(|line| line.split_whitespace().collect());
    words.filter(|words: &Vec<&str>| !words.is_empty())
}

impl State {
    /// From what halcmd prints for `comp`, `pin`, `sig` and `thread`. What is not understood is left out: a pin that
    /// is needed is missing then, and named.
    pub fn parse(components: &str, pins: &str, signals: &str, threads: &str) -> State {
        State {
            components: rows(components)
                .filter_map(|words| component(&words))
                .collect(),
            pins: rows(pins).filter_map(|words| pin(&words)).collect(),
            signals: rows(signals).filter_map(|words| signal(&words)).collect(),
            threads: all_threads(threads),
        }
    }

    /// Whether there is a component of this name.
    pub fn has_component(&self, name: &str) -> bool {
        self.components.iter().any(|known| known.name == name)
    }

    /// A pin by its name.
    pub fn pin(&self, name: &str) -> Option<&Pin> {
        self.pins.iter().find(|known| known.name == name)
    }

    /// A signal by its name.
    pub fn signal(&self, name: &str) -> Option<&Signal> {
        self.signals.iter().find(|known| known.name == name)
    }

    /// The thread that runs a function.
    pub fn thread_of(&self, function: &str) -> Option<&Thread> {
        let runs = |thread: &&Thread| thread.functions.iter().any(|known| known == function);
        self.threads.iter().find(runs)
    }
}

/// `12 User halui 4711 ready`, `3 RT motmod ready`.
fn component(words: &[&str]) -> Option<Component> {
    let [_, kind, name, rest @ ..] = words else {
        return None;
    };
    let process = rest.first().filter(|_| *kind == "User");
    Some(Component {
        name: (*name).to_owned(),
        process: process.and_then(|number| number.parse().ok()),
    })
}

/// `motmod float OUT 0 joint.0.pos-cmd ==> joint-0`.
fn pin(words: &[&str]) -> Option<Pin> {
    let [owner, _, _, value, name, link @ ..] = words else {
        return None;
    };
    Some(Pin {
        owner: (*owner).to_owned(),
        name: (*name).to_owned(),
        value: (*value).to_owned(),
        signal: link.get(1).map(|signal| (*signal).to_owned()),
    })
}

/// `float 0.5 joint-0 <== joint.0.pos-cmd`.
fn signal(words: &[&str]) -> Option<Signal> {
    let [_, value, name, ..] = words else {
        return None;
    };
    Some(Signal {
        name: (*name).to_owned(),
        value: (*value).to_owned(),
    })
}

/// Threads, each with its functions behind it: in its line, or in lines of their own (LinuxCNC 2.10).
fn all_threads(text: &str) -> Vec<Thread> {
    let mut threads: Vec<Thread> = Vec::new();
    for words in rows(text) {
        if let Some(found) = thread(&words) {
            threads.push(found);
        } else if let ([function], Some(last)) = (words.as_slice(), threads.last_mut()) {
            last.functions.push((*function).to_owned());
        }
    }
    threads
}

/// `1000000 YES servo-thread 5000 9000 motion-command-handler motion-controller`.
fn thread(words: &[&str]) -> Option<Thread> {
    let [period, _, name, _, _, functions @ ..] = words else {
        return None;
    };
    Some(Thread {
        name: (*name).to_owned(),
        period: period.parse::<f64>().ok()? * 1e-9,
        functions: functions.iter().map(|&name| name.to_owned()).collect(),
    })
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A mill as halcmd shows it: joint 0 is linked, nothing else.
    pub fn mill() -> State {
        State::parse(
            "    12  User  halcmd4711                                 4711 ready\n     3  RT    motmod      \
             ready\n\n",
            "motmod float OUT 0 joint.0.pos-cmd ==> joint-0\nmotmod float OUT 0 joint.1.pos-cmd\n\
             motmod float OUT 1.5 axis.x.pos-cmd\nmotmod float OUT 0 axis.y.pos-cmd\n\
             motmod float OUT 0 axis.w.pos-cmd\nmotmod s32 OUT 0 motion.program-line\n\
             motmod s32 OUT 0 motion.motion-type\ninihal float IN 100 ini.x.max_velocity\n\
             inihal float IN 100 ini.y.max_velocity\ninihal float IN 0 ini.w.max_velocity\n\n",
            "float 0.5 joint-0 <== joint.0.pos-cmd ==> joint.0.motor-pos-fb\n\n",
            "1000000 YES servo-thread 5000 9000 motion-command-handler motion-controller\n\n",
        )
    }

    #[test]
    fn functions_have_lines_of_their_own_in_2_10() {
        let shown = "1000000 YES servo-thread 0 0\n motion-command-handler\n motion-controller\n2000000 NO slow 0 0\n pid.0\n\n";
        let state = State::parse("", "", "", shown);
        let functions = state
            .threads
            .iter()
            .map(|thread| thread.functions.join(" "));
        assert_eq!(
            functions.collect::<Vec<_>>(),
            ["motion-command-handler motion-controller", "pid.0"]
        );
        assert_eq!(
            state.thread_of("pid.0").map(|thread| thread.period),
            Some(0.002)
        );
    }

    #[test]
    fn what_halcmd_shows_is_read() {
        let state = mill();
        assert!(state.has_component("motmod") && !state.has_component("sampler"));
        assert_eq!(state.components[0].process, Some(4711));
        assert_eq!(state.components[1].process, None);
        let joint = state.pin("joint.0.pos-cmd").expect("a pin");
        assert_eq!(
            (joint.owner.as_str(), joint.signal.as_deref()),
            ("motmod", Some("joint-0"))
        );
        assert_eq!(state.pin("joint.1.pos-cmd").expect("a pin").signal, None);
        assert_eq!(state.signal("joint-0").expect("a signal").value, "0.5");
        let thread = state.thread_of("motion-controller").expect("a thread");
        assert_eq!(
            (thread.name.as_str(), thread.period),
            ("servo-thread", 0.001)
        );
        assert!(state.thread_of("sampler.0").is_none());
    }
}
