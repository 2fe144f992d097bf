//! Being asked to stop: by Ctrl-C, by `kill`, by a terminal that is closed.

use signal_hook::consts::{SIGINT, SIGTERM};
use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
#[cfg(feature = "linuxcnc")]
use std::sync::atomic::Ordering;

/// The signals that ask for it.
const SIGNALS: &[i32] = &[
    SIGINT,
    SIGTERM,
    #[cfg(unix)]
    signal_hook::consts::SIGHUP,
];

/// What is set when the process is asked to stop, which does not end it any more.
pub(crate) fn stop_on_signals() -> io::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in SIGNALS {
        signal_hook::flag::register(*signal, Arc::clone(&stop))?;
    }
    Ok(stop)
}

/// The same for a while, in which something would be left behind.
#[cfg(feature = "linuxcnc")]
#[derive(Debug)]
pub(crate) struct StopForAWhile {
    stop: Arc<AtomicBool>,
    over: Arc<AtomicBool>,
}

#[cfg(feature = "linuxcnc")]
impl StopForAWhile {
    /// From now on.
    pub(crate) fn new() -> io::Result<StopForAWhile> {
        let over = Arc::new(AtomicBool::new(false));
        // Before what stop_on_signals registers: what comes first is run first.
        for signal in SIGNALS {
            signal_hook::flag::register_conditional_default(*signal, Arc::clone(&over))?;
        }
        let stop = stop_on_signals()?;
        Ok(StopForAWhile { stop, over })
    }

    /// What is set when the process is asked to stop.
    pub(crate) fn stop(&self) -> &Arc<AtomicBool> {
        &self.stop
    }

    /// From now on the process ends when it is asked to. Whether it has been already.
    pub(crate) fn end(self) -> bool {
        self.over.store(true, Ordering::SeqCst);
        self.stop.load(Ordering::SeqCst)
    }
}
