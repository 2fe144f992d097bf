//! Why there is no recording, or what is wrong with it. Every message says what was found and what to do.

use std::io;
use std::path::PathBuf;

/// Why there is no recording; with [`RecordError::Lost`] and [`RecordError::Ended`] there is one.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// A program of LinuxCNC that is needed does not run.
    #[error(
        "{program} cannot be run: {source}: install linuxcnc-uspace, or add its programs to PATH"
    )]
    Program {
        /// Its name.
        program: &'static str,
        /// Why.
        source: io::Error,
    },
    /// Nothing to record.
    #[error("no LinuxCNC is running here: start it, then call framepath record")]
    NotRunning,
    /// What is loaded by another user than that of LinuxCNC would be in another process than its threads.
    #[error(
        "LinuxCNC runs as user {theirs}, and this is user {own}: call framepath record as the user who has started it"
    )]
    OtherUser {
        /// Number of the user of LinuxCNC.
        theirs: u32,
        /// Number of the user of this process.
        own: u32,
    },
    /// No thread that moves the machine.
    #[error(
        "no servo thread: the function motion-controller is in no thread; the HAL files need \
         `addf motion-controller servo-thread`"
    )]
    NoServoThread,
    /// sampler can be there only once.
    #[error(
        "the component sampler is in use by this machine's HAL files or by somebody at halcmd, and can be loaded only \
         once: `halcmd unloadrt sampler` where it is not needed, or take its loadrt out of the HAL files"
    )]
    SamplerTaken,
    /// One of these is needed for the digits that halsampler does not print.
    #[error(
        "the components {0} are all in use by this machine's HAL files, and one of them is needed to record with enough \
         digits: take one of them out of the HAL files"
    )]
    ScalersTaken(String),
    /// Another recording.
    #[error("framepath record runs already, as process {0}: let it end, or end it with Ctrl-C")]
    Busy(u32),
    /// Pins of motion that every LinuxCNC has.
    #[error("there is no pin {0}: framepath record knows LinuxCNC 2.9")]
    NoPin(String),
    /// A sampler has only so many.
    #[error(
        "{joints} joints and {axes} axes are more than a sampler takes ({most} of both), and framepath record records all of \
         them: load sampler and halsampler by hand for those that matter, see man 9 sampler"
    )]
    TooMany {
        /// Of the machine.
        joints: usize,
        /// Of the machine.
        axes: usize,
        /// Of both.
        most: usize,
    },
    /// HAL keeps what a component took until LinuxCNC ends.
    #[error("HAL has only {0} bytes of memory left: restart LinuxCNC before recording again")]
    LittleMemory(u64),
    /// A command is refused.
    #[error("halcmd: {0}")]
    Halcmd(String),
    /// loadrt has reached another process than that of the threads.
    #[error(
        "loading sampler has started another rtapi_app: LinuxCNC was started with another HOME or RTAPI_FIFO_PATH; call \
         framepath record with the same"
    )]
    OtherProcess,
    /// Some of it could not be taken away.
    #[error("still in HAL: {0}; call framepath record again, or restart LinuxCNC")]
    LeftBehind(String),
    /// halsampler says something else than expected.
    #[error("{0}")]
    Sampler(String),
    /// The recording has gaps.
    #[error(
        "{told}\n{count} servo cycles are missing in the recording{}: it was read too slowly; --buffer gives it more room",
        first.map(|time| format!(", the first before {time:.3} s")).unwrap_or_default()
    )]
    Lost {
        /// What is there.
        told: String,
        /// How many are missing.
        count: u64,
        /// Seconds from the first row, where the numbers of the samples tell.
        first: Option<f64>,
    },
    /// Nothing came.
    #[error("nothing was recorded: no sample came from the servo thread")]
    Nothing,
    /// LinuxCNC, or halsampler, has come to an end before.
    #[error("the recording ends here because {0}")]
    Ended(&'static str),
    /// The recording cannot be written.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Signals of the operating system.
    #[error("Ctrl-C cannot be waited for: {0}")]
    Signals(io::Error),
}
