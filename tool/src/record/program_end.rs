//! When the program that is recorded has ended.

use super::rows::Sample;

/// Rest behind the end that is recorded, s; halui may also be that much later than the motion.
const REST: f64 = 0.1;

/// Without halui the program counts as ended when the machine has stood for so long, s: it may be dwelling.
pub const LONG_REST: f64 = 5.0;

/// Waits for the end of a program that has been seen running.
#[derive(Debug, Default)]
pub struct ProgramEnd {
    seen: bool,
    /// When the machine has begun to stand with no program running, s.
    rests_since: Option<f64>,
}

impl ProgramEnd {
    /// Whether the program has ended, by this sample at a time (s) at which a joint moves.
    pub fn has_come(&mut self, sample: &Sample, time: f64, moves: bool) -> bool {
        let runs = match sample.idle {
            Some(idle) => !idle,
            None => sample.motion != 0,
        };
        self.seen |= runs;
        if runs || moves {
            self.rests_since = None;
            return false;
        }
        let since = *self.rests_since.get_or_insert(time);
        let rest = match sample.idle {
            Some(_) => REST,
            None => LONG_REST,
        };
        self.seen && time - since >= rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When the end has come: of phases with their durations (ms), whether a move runs, whether a joint moves and
    /// whether the interpreter is idle.
    fn end(phases: &[(u32, bool, bool, Option<bool>)]) -> Option<u32> {
        let mut waits = ProgramEnd::default();
        let cycles = phases.iter().flat_map(|(duration, runs, moves, idle)| {
            (0..*duration).map(move |_| (runs, moves, idle))
        });
        cycles
            .enumerate()
            .position(|(number, (runs, moves, idle))| {
                let sample = Sample {
                    number: number as u64,
                    positions: Vec::new(),
                    line: 0,
                    motion: i64::from(*runs),
                    idle: *idle,
                };
                waits.has_come(&sample, number as f64 * 0.001, *moves)
            })
            .and_then(|number| u32::try_from(number).ok())
    }

    #[test]
    fn with_halui_a_dwell_is_no_end() {
        let dwell = (9000, false, false, Some(false));
        let program = [
            (7000, false, false, Some(true)),
            (100, true, true, Some(false)),
            dwell,
            (100, true, true, Some(false)),
        ];
        assert_eq!(end(&program), None);
        let rest = (1000, false, false, Some(true));
        assert_eq!(end(&[&program[..], &[rest]].concat()), Some(16_300));
    }

    #[test]
    fn without_halui_the_machine_has_to_stand_for_long() {
        let before = (9000, false, false, None);
        let program = [before, (100, true, true, None), (4900, false, false, None)];
        assert_eq!(end(&program), None);
        let jog = (100, false, true, None);
        let rest = (6000, false, false, None);
        assert_eq!(end(&[&program[..], &[jog, rest]].concat()), Some(19_100));
    }
}
