//! The output of another program, which may take for ever.

use std::io::{self, ErrorKind, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::{Duration, Instant};

/// How much is read at once, bytes.
const CHUNK: usize = 1 << 16;

/// How many pieces may wait.
const WAITING: usize = 4;

/// Reads what another thread has read.
#[derive(Debug)]
pub struct Timed {
    chunks: Receiver<io::Result<Vec<u8>>>,
    chunk: Vec<u8>,
    at: usize,
    /// Nothing is read any more then: the error is [`ErrorKind::TimedOut`].
    pub deadline: Option<Instant>,
    /// The same when this is set: the error is [`ErrorKind::ConnectionAborted`].
    pub stop: Option<Arc<AtomicBool>>,
}

/// How long nothing is waited for without a look at what may be asked.
const WAIT: Duration = Duration::from_millis(50);

impl Timed {
    /// Reads `from` in a thread of its own, which ends with `from` or with this.
    pub fn new(mut from: impl Read + Send + 'static) -> Timed {
        let (sender, chunks) = sync_channel(WAITING);
        std::thread::spawn(move || {
            loop {
                let mut chunk = vec![0; CHUNK];
                let read = from.read(&mut chunk).map(|length| {
                    chunk.truncate(length);
                    chunk
                });
                let ends = !read.as_ref().is_ok_and(|chunk| !chunk.is_empty());
                if sender.send(read).is_err() || ends {
                    return;
                }
            }
        });
        Timed {
            chunks,
            chunk: Vec::new(),
            at: 0,
            deadline: None,
            stop: None,
        }
    }

    fn next_chunk(&mut self) -> io::Result<Vec<u8>> {
        if self.deadline.is_none() && self.stop.is_none() {
            return self.chunks.recv().unwrap_or(Ok(Vec::new()));
        }
        loop {
            let now = Instant::now();
            let left = self
                .deadline
                .map(|deadline| deadline.saturating_duration_since(now));
            if left.is_some_and(|left| left.is_zero()) {
                return Err(ErrorKind::TimedOut.into());
            }
            if self.is_stopped() {
                return Err(ErrorKind::ConnectionAborted.into());
            }
            match self.chunks.recv_timeout(left.unwrap_or(WAIT).min(WAIT)) {
                Ok(chunk) => return chunk,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(Vec::new()),
            }
        }
    }

    /// Whether it is to stop.
    pub fn is_stopped(&self) -> bool {
        let stop = self.stop.as_ref();
        stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}

impl Read for Timed {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.at == self.chunk.len() {
            self.chunk = self.next_chunk()?;
            self.at = 0;
        }
        let length = self.chunk.get(self.at..).unwrap_or(&[]).read(into)?;
        self.at += length;
        Ok(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn all_is_read_in_its_order() {
        let bytes: Vec<u8> = (0..300_000).map(|at| (at % 251) as u8).collect();
        let mut timed = Timed::new(io::Cursor::new(bytes.clone()));
        timed.deadline = Some(Instant::now() + Duration::from_secs(60));
        let mut read = Vec::new();
        assert!(timed.read_to_end(&mut read).is_ok());
        assert!(read == bytes);
    }

    #[test]
    fn what_never_comes_is_not_waited_for() {
        let (reader, _writer) = io::pipe().expect("a pipe");
        let mut timed = Timed::new(reader);
        timed.deadline = Some(Instant::now() + Duration::from_millis(20));
        let error = timed.read(&mut [0; 8]).expect_err("nothing came");
        assert_eq!(error.kind(), ErrorKind::TimedOut);
    }
}
