//! What the user sees while it works.

use indicatif::{ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// Time from one line to the next where there is no terminal: short enough to see that it goes on, long enough for a log.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// A line that says what is going on: on a terminal always the newest, in a log one every few seconds.
pub struct Progress {
    title: String,
    bar: ProgressBar,
    log: Option<Log>,
}

/// Lines for where there is no terminal.
struct Log {
    said: Cell<Instant>,
    /// Whether there was a line: only then the last word is worth one.
    has_said: Cell<bool>,
}

impl Progress {
    /// A line that begins with a title; none where it is hidden.
    pub fn new(title: &str, hidden: bool) -> Self {
        let style = ProgressStyle::with_template("{spinner} {prefix}: {msg} [{elapsed}]");
        Self::styled(title, hidden, ProgressBar::new_spinner(), style.ok())
    }

    /// The same with a bar for work of which `done` parts of `count` are done.
    pub fn counted(title: &str, hidden: bool, count: u32, done: u32) -> Self {
        let style = ProgressStyle::with_template("{prefix}: {bar:30} {msg}, {per_sec}, {eta} left");
        let progress = Self::styled(title, hidden, ProgressBar::new(u64::from(count)), style.ok());
        progress.bar.set_position(u64::from(done));
        progress.bar.reset_eta();
        progress
    }

    fn styled(title: &str, hidden: bool, bar: ProgressBar, style: Option<ProgressStyle>) -> Self {
        let is_terminal = io::stderr().is_terminal();
        let bar = if hidden || !is_terminal { ProgressBar::hidden() } else { bar };
        bar.set_style(style.unwrap_or_else(ProgressStyle::default_spinner));
        bar.set_prefix(title.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        let log = (!hidden && !is_terminal).then(|| Log::new(Instant::now()));
        Self { title: title.to_owned(), bar, log }
    }

    /// What is going on now.
    pub fn say(&self, message: String) {
        if self.log.as_ref().is_some_and(|log| log.is_due(Instant::now())) {
            self.line(&message);
        }
        self.bar.set_message(message);
    }

    /// So many parts are done.
    pub fn reach(&self, done: u32) {
        self.bar.set_position(u64::from(done));
    }

    /// The last word, which stays.
    pub fn finish(&self, message: String) {
        if self.log.as_ref().is_some_and(|log| log.has_said.get()) {
            self.line(&message);
        }
        self.bar.finish_with_message(message);
    }

    fn line(&self, message: &str) {
        // Nobody may listen any more.
        let _ = writeln!(io::stderr(), "{}: {message}", self.title);
    }
}

impl Log {
    fn new(now: Instant) -> Self {
        Self { said: Cell::new(now), has_said: Cell::new(false) }
    }

    /// Whether a line is due; the next one then has to wait again.
    fn is_due(&self, now: Instant) -> bool {
        let is_due = now.duration_since(self.said.get()) >= LINE_EVERY;
        if is_due {
            self.said.set(now);
            self.has_said.set(true);
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_has_a_line_every_few_seconds() {
        let start = Instant::now();
        let log = Log::new(start);
        let lines: Vec<u64> = (0..=12).filter(|second| log.is_due(start + Duration::from_secs(*second))).collect();
        assert_eq!(lines, [5, 10]);
        assert!(log.has_said.get() && !Log::new(start).has_said.get());
    }
}
