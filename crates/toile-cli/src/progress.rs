//! What the user sees while it works.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// A line on the terminal that says what is going on; silent with `--quiet` or where there is no terminal.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A line that begins with a title.
    pub fn new(title: &str, quiet: bool) -> Self {
        let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new_spinner() };
        let style = ProgressStyle::with_template("{spinner} {prefix}: {msg} [{elapsed}]");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        bar.set_prefix(title.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar }
    }

    /// What is going on now.
    pub fn say(&self, message: String) {
        self.bar.set_message(message);
    }

    /// The last word, which stays.
    pub fn finish(&self, message: String) {
        self.bar.finish_with_message(message);
    }
}
