//! The operations of a program while it is read: long programs need not fit into memory.

use super::builder::merged;
use super::{Layer, LayerSettings};
use crate::canon::call::Call;
use crate::layer::program::{Operation, Piece};
use crate::path::Position;
use std::mem::take;

/// What the task controller does next.
#[derive(Clone, Debug)]
pub(crate) struct Laid {
    pub operation: Operation,
    /// For a move: the pieces of the program that it stands for; none where it goes nowhere.
    pub pieces: Vec<Piece>,
}

/// A layer that hands out what is finished after each call.
pub(crate) struct LayerStream<'a> {
    layer: Layer<'a>,
    /// Moves handed out.
    moves: usize,
}

impl<'a> LayerStream<'a> {
    /// `start` is where the machine stands, mm and degrees.
    pub(crate) fn new(settings: &'a LayerSettings, start: Position) -> Self {
        let mut layer = Layer::new(settings);
        layer.end = start;
        layer.programmed_end = start;
        LayerStream { layer, moves: 0 }
    }

    /// What the call, or `None` for the end of the program, finishes.
    pub(crate) fn take(&mut self, call: Option<&Call>, mut give: impl FnMut(Laid)) {
        match call {
            Some(call) => self.layer.take(call),
            None => self.layer.flush(),
        }
        let builder = &mut self.layer.builder;
        if builder.program.operations.is_empty() {
            return;
        }
        let ranges = take(&mut builder.program.ranges);
        let handed = take(&mut builder.program.handed);
        let mut moves = ranges.iter().zip(&handed);
        for mut operation in builder.program.operations.drain(..) {
            let mut pieces = Vec::new();
            if let Operation::Move(a_move) = &mut operation {
                a_move.index = self.moves;
                if let Some((&(first, last), handed)) = moves.next() {
                    let of_it = builder.program.programmed.get(first..=last);
                    pieces = of_it.unwrap_or_default().to_vec();
                    note_merging(&mut pieces, handed, self.moves);
                }
                self.moves += 1;
            }
            give(Laid { operation, pieces });
        }
        builder.program.programmed.drain(..builder.first_free);
        builder.first_free = 0;
    }
}

/// Notes in the pieces how far merging has taken the move from them.
fn note_merging(pieces: &mut [Piece], handed: &Piece, move_index: usize) {
    let far = pieces
        .iter()
        .map(|piece| merged(piece, &handed.segment))
        .fold(0.0, f64::max);
    for piece in pieces {
        piece.merged_within = far;
        piece.move_index = move_index;
    }
}

#[cfg(test)]
mod tests {
    use super::super::lay;
    use super::*;

    /// All that a whole program gives, piece by piece.
    fn assert_same(calls: &[Call]) {
        let settings = LayerSettings::default();
        let whole = lay(calls, &settings);
        let mut stream = LayerStream::new(&settings, [0.0; 9]);
        let mut laid = Vec::new();
        for call in calls.iter().map(Some).chain([None]) {
            stream.take(call, |step| laid.push(step));
        }
        let mut operations = Vec::new();
        for step in &laid {
            // Waits that follow each other are one in a whole program.
            let waits = |operation: &Operation| matches!(operation, Operation::WaitForMotion);
            if !(waits(&step.operation) && operations.last().is_some_and(waits)) {
                operations.push(step.operation.clone());
            }
        }
        assert_eq!(operations, whole.operations);
        let pieces: Vec<&Vec<Piece>> = laid
            .iter()
            .filter(|step| matches!(step.operation, Operation::Move(_)))
            .map(|step| &step.pieces)
            .collect();
        assert_eq!(pieces.len(), whole.ranges.len());
        for (pieces, &(first, last)) in pieces.iter().zip(&whole.ranges) {
            let expected = &whole.programmed[first..=last];
            assert_eq!(pieces.len(), expected.len());
            for (piece, expected) in pieces.iter().zip(expected) {
                assert_eq!(piece.segment, expected.segment);
                assert_eq!(piece.line, expected.line);
            }
        }
    }

    #[test]
    fn a_stream_is_the_whole_program() {
        let mut text = "TERM 3 0.1\nNAIVECAM 0.05\nRATE 600\n".to_owned();
        for x in 1..=250 {
            text += &format!("FEED {x} {x} {} 0 0 0 0 0 0 0\n", x / 70);
        }
        // A flat arc goes over its middle, in two moves where it does not fit the line before.
        text += "ARC 251 252 3 0 0 0 0 0 0 0 251 -46.995 0 0 0 1 -1 0 0\n";
        text +=
            "FEED 252 252 90 0 0 0 0 0 0 0\nWAIT\nDWELL 1\nWAIT\nTAP 253 252 90 -5 0 0 0 0 0 0\n";
        text += "TRAVERSE 254 0 0 0 0 0 0 0 0 0\nFEED 255 1 0 0 5 0 0 0 0 0\nFEED 256 2 0 0 5 0 0 0 0 0";
        let calls: Vec<Call> = text
            .lines()
            .map(|line| Call::parse(line).expect("a call"))
            .collect();
        assert_same(&calls);
    }
}
