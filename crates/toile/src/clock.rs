//! The one clock of a simulation: any seconds of the host in, whole parts of the simulation out.

use std::ops::Range;

/// Most simulated seconds of one call, unless a frame of the scene is longer [s]. A host that falls behind would otherwise ask for more
/// with each call, and fall behind for good.
const SECONDS_MAX: f64 = 0.25;

/// So much of a part may be missing and it still counts as whole: sums of seconds are rounded [1].
const TOLERANCE: f64 = 1e-6;

/// What a call of [`Simulation::advance`](crate::Simulation::advance) did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Advance {
    /// Steps that were recorded, of the cloth that has most; 0 when not enough time has passed for one.
    pub step_count: u32,
    /// Part of the next step that has passed by the host's clock [1], from 0 to below 1; where several cloths lie over one another, of the
    /// next interval of the maps. `position + velocity · fraction · step` is where a particle is drawn in between.
    pub fraction: f64,
    /// Time that was asked for and not simulated, because one call does at most 0.25 s, or one frame of the scene if that is longer [s].
    pub dropped_seconds: f64,
}

/// Time asked for and parts done, since the clock was started.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Clock {
    /// Simulated time asked for [s].
    asked: f64,
    /// Whole parts done.
    done: u64,
}

impl Clock {
    /// A clock that goes on.
    pub(crate) fn new(asked: f64, done: u64) -> Self {
        Self { asked, done }
    }

    /// The same clock in parts of another length, each `ratio` of the present ones; whole parts stay whole.
    pub(crate) fn in_parts(&self, ratio: u64) -> Self {
        Self { done: self.done * ratio, ..*self }
    }

    /// The same clock once so many more parts are done than were asked for.
    pub(crate) fn ahead(&self, parts: u64) -> Self {
        Self { done: self.done + parts, ..*self }
    }

    /// The same clock in parts of which each has `ratio` of the present ones; a part that has begun counts as done.
    pub(crate) fn in_longer_parts(&self, ratio: u64) -> Self {
        Self { done: self.done.div_ceil(ratio), ..*self }
    }

    /// Simulated time asked for [s].
    pub(crate) fn asked(&self) -> f64 {
        self.asked
    }

    /// Parts done so far.
    pub(crate) fn done(&self) -> u64 {
        self.done
    }

    /// Goes on by some seconds, and by as many whole parts of `part` seconds as are now due; the rest is kept.
    ///
    /// # Panics
    /// When the seconds are negative or no number.
    pub(crate) fn go_on(&mut self, seconds: f64, part: f64, frame: f64) -> (Range<u64>, Advance) {
        assert!(seconds >= 0.0, "time goes on by 0 s or more, not by {seconds} s");
        let most = SECONDS_MAX.max(frame);
        let taken = seconds.min(most);
        self.asked += taken;
        let parts = self.asked / part;
        let before = self.done;
        self.done = before.max((parts + TOLERANCE).floor() as u64);
        let fraction = (parts - self.done as f64).clamp(0.0, 1.0 - TOLERANCE);
        (before..self.done, Advance { step_count: 0, fraction, dropped_seconds: seconds - taken })
    }
}

#[cfg(test)]
mod tests {
    use super::Clock;

    #[test]
    fn every_rate_has_done_as_many_parts_at_the_same_time() {
        let part = 1.0 / 960.0;
        for rate in [24.0, 30.0, 60.0, 144.0, 1000.0] {
            let mut clock = Clock::default();
            let mut next = 0;
            for second in 1..=3u64 {
                for _ in 0..rate as u32 {
                    let (parts, _) = clock.go_on(1.0 / rate, part, 1.0 / 60.0);
                    assert_eq!(parts.start, next, "no part is done twice or left out");
                    next = parts.end;
                }
                assert_eq!(clock.done(), 960 * second, "{rate} calls per second");
            }
        }
    }

    #[test]
    fn the_rest_is_kept_and_told() {
        let mut clock = Clock::default();
        let (parts, advance) = clock.go_on(0.025, 0.01, 0.01);
        assert_eq!(parts, 0..2);
        assert!((advance.fraction - 0.5).abs() < 1e-9 && advance.dropped_seconds == 0.0);
        let (parts, advance) = clock.go_on(0.004, 0.01, 0.01);
        assert!(parts.is_empty() && (advance.fraction - 0.9).abs() < 1e-9, "{advance:?}");
        assert_eq!(clock.go_on(0.001, 0.01, 0.01).0, 2..3);
    }

    #[test]
    fn a_host_that_falls_behind_loses_time_and_is_told() {
        let mut clock = Clock::default();
        let (parts, advance) = clock.go_on(2.0, 0.01, 0.01);
        assert_eq!((parts, advance.dropped_seconds), (0..25, 1.75));
        // A frame is never cut.
        assert_eq!(clock.go_on(2.0, 0.01, 1.0).1.dropped_seconds, 1.0);
    }

    #[test]
    #[should_panic(expected = "time goes on by 0 s or more")]
    fn time_that_is_no_number_is_refused() {
        Clock::default().go_on(f64::NAN, 0.01, 0.01);
    }
}
