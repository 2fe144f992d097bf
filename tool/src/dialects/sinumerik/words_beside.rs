//! Words beside a function that uses only some of them: what is left would act nowhere, and is refused by name.

use super::approach::shape_of;
use super::block_words::BlockWords;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At};
use crate::program::moves::Corner;
use crate::source::Span;

/// G functions that use the axes of their block, or act in it only, by their numbers times ten.
const OF_THE_BLOCK: [u32; 18] = [
    40, 90, 520, 530, 580, 590, 630, 920, 1100, 1110, 1120, 1470, 1480, 1530, 2470, 2480, 3470,
    3480,
];

/// A word by its name.
type Named = (&'static str, Span);

impl BlockWords {
    /// Refuses what belongs to a motion and is neither an axis nor one of `used`. `function`: ten times the G
    /// number of what uses the axes.
    pub fn check_beside(&self, function: u32, used: &[&str]) -> Done {
        let left = self.of_a_motion();
        let left = left.into_iter().filter(|(name, _)| !used.contains(name));
        self.refuse_first(function, left.collect())
    }

    /// The same where nothing else is used either.
    pub fn check_alone(&self, function: u32, used: &[&str]) -> Done {
        let mut left = self.of_a_motion();
        left.extend(self.of_the_rest());
        left.retain(|(name, _)| !used.contains(name));
        self.refuse_first(function, left)
    }

    /// Refuses what is no word of a smooth approach or retraction, which this block is. (An arc beside it is refused
    /// as one.)
    pub fn check_of_approach(&self) -> Done {
        const WORDS: [&str; 8] = ["DISR", "DISCL", "FAD", "RNDM", "I", "J", "K", "CR"];
        match self.g.iter().find(|g| shape_of(g.value).is_some()) {
            Some(g) => self.check_beside(g.value, &WORDS),
            None => Ok(()),
        }
    }

    /// Refuses the words of a smooth approach or retraction, which this block is not.
    pub fn refuse_approach_words(&self) -> Done {
        let words = [
            named("DISR", self.approach_distance),
            named("DISCL", self.approach_height),
            named("FAD", self.approach_feed),
        ];
        match words.into_iter().flatten().next() {
            None => Ok(()),
            Some((name, span)) => Err(Diagnostic::error(
                span,
                format!("{name} belongs to a smooth approach or retraction"),
            )
            .help("write G147, G247 or G347, or G148, G248 or G348 in this block")),
        }
    }

    fn refuse_first(&self, function: u32, left: Vec<Named>) -> Done {
        let others = self.g.iter().filter(|g| {
            let suppresses = |code| matches!(code, 530 | 1530);
            let same = g.value == function || suppresses(g.value) && suppresses(function);
            OF_THE_BLOCK.contains(&g.value) && !same
        });
        let mut left: Vec<(String, Span)> = left
            .into_iter()
            .map(|(name, span)| (name.to_string(), span))
            .collect();
        left.extend(others.map(|g| (format!("G{}", g.value / 10), g.span)));
        match left.into_iter().min_by_key(|(_, span)| span.start) {
            None => Ok(()),
            Some((name, span)) => Err(Diagnostic::error(
                span,
                format!("{name} has no meaning beside G{}", function / 10),
            )
            .help("put it in another block")),
        }
    }

    /// The words that say how a motion goes, but the axes.
    fn of_a_motion(&self) -> Vec<Named> {
        let corner = self.corner.map(|corner| match corner.value {
            Corner::Round(_) => ("RND", corner.span),
            Corner::ChamferOf(_) => ("CHF", corner.span),
            _ => ("CHR", corner.span),
        });
        let [i, j, k] = self.motion.centre;
        let [i1, j1, k1] = self.middle;
        let words = [
            named("I", i),
            named("J", j),
            named("K", k),
            named("CR", self.motion.radius),
            named("TURN", self.motion.turns),
            named("AR", self.opening),
            named("I1", i1),
            named("J1", j1),
            named("K1", k1),
            named("ANG", self.contour_angle),
            named("AP", self.polar_angle),
            named("RP", self.polar_radius),
            named("RNDM", self.rounding),
            named("DISR", self.approach_distance),
            named("DISCL", self.approach_height),
            named("FAD", self.approach_feed),
            corner,
        ];
        words.into_iter().flatten().collect()
    }

    fn of_the_rest(&self) -> Vec<Named> {
        let axes = AXES.into_iter().zip(self.motion.axes);
        let mut words: Vec<Named> = axes.filter_map(|(name, word)| named(name, word)).collect();
        let others = [
            named("F", self.feed),
            named("S", self.speed),
            named("T", self.tool),
            named("D", self.offset),
            named("ADIS", self.rounding_distance),
            named("CTOL", self.contour_tolerance),
            named("SPOS", self.spindle_angle),
            named("LIMS", self.most_speed),
            self.supa.map(|span| ("SUPA", span)),
            self.end_of_routine.map(|span| ("RET", span)),
            self.m.first().map(|m| ("M", m.span)),
        ];
        words.extend(others.into_iter().flatten());
        words
    }
}

fn named<T>(name: &'static str, word: Option<At<T>>) -> Option<Named> {
    word.map(|word| (name, word.span))
}
