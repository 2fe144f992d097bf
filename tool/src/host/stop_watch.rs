//! Measures a call, and leaves out the time in which another process had the processor.

use std::time::Instant;

/// A call that is being measured.
pub(super) struct StopWatch {
    processor: u64,
    wall: Instant,
}

impl StopWatch {
    pub(super) fn start() -> Self {
        // The quicker clock is read last, so that it does not count the other one.
        let processor = processor_time();
        StopWatch {
            processor,
            wall: Instant::now(),
        }
    }

    /// Nanoseconds: those on the clock on the wall, but no more than this thread had the processor.
    pub(super) fn stop(self) -> u32 {
        let wall = self.wall.elapsed().as_nanos();
        let processor = u128::from(processor_time().saturating_sub(self.processor));
        u32::try_from(wall.min(processor)).unwrap_or(u32::MAX)
    }

    /// The shortest time that can be measured, ns.
    pub(super) fn shortest() -> u32 {
        (0..1000)
            .map(|_| StopWatch::start().stop())
            .min()
            .unwrap_or(0)
    }
}

/// How long this thread has had a processor, ns.
fn processor_time() -> u64 {
    let mut time = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: writes one structure of this type.
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &raw mut time) };
    time.tv_sec.unsigned_abs() * 1_000_000_000 + time.tv_nsec.unsigned_abs()
}
