//! Back along the path: the same path, run through from where the machine is to what it remembers.

use super::reference::Reference;

impl Reference {
    /// Whether the machine goes back along the path.
    pub fn is_backwards(&self) -> bool {
        self.backwards
    }

    /// From now on the machine goes back along the path, or forward again, from where it is. What
    /// was handed out behind that place is dropped: only at rest, with a path.
    pub fn reverse(&mut self, backwards: bool) {
        let s = match self.segments.front() {
            Some(segment) => {
                let state = segment.state(self.elapsed, self.elapsed);
                segment.path_distance(state.distance)
            }
            None => self.rest,
        };
        for run in &mut self.runs {
            run.clear();
        }
        self.backwards = backwards;
        self.rested(s);
    }
}
