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
        let s = self.place();
        self.drop_plans();
        self.backwards = backwards;
        self.rested(s);
    }
}
