//! Room for tests of what is too large for the stack of a test.

use std::panic::resume_unwind;
use std::thread;

/// Runs a test where a planner, some 18 MB, has room on the stack.
pub fn with_room<R: Send>(test: impl FnOnce() -> R + Send) -> R {
    thread::scope(|scope| {
        thread::Builder::new()
            .stack_size(64 << 20)
            .spawn_scoped(scope, test)
            .expect("a thread")
            .join()
            .unwrap_or_else(|panic| resume_unwind(panic))
    })
}
