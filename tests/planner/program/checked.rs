//! What a random test says of the program that it has found.

use std::fmt::Display;

use proptest::test_runner::TestError;

/// Fails with the case that does, as text, which can be kept as it is: why is a comment in it.
pub fn checked<T: Display>(result: Result<(), TestError<T>>) {
    match result {
        Ok(()) => {}
        Err(TestError::Abort(why)) => panic!("no cases: {why}"),
        Err(TestError::Fail(why, case)) => {
            panic!("\n# {}\n\n{case}", why.to_string().replace('\n', "\n# "))
        }
    }
}
