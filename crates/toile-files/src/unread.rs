//! What a file has that is not read: told once each, with the first place.

use crate::error::Place;

/// So many kinds are told by name. Damaged files have any number.
const MOST_KINDS: usize = 16;

/// The beginning of a name, for a sentence. Those of damaged files can have any length.
pub(crate) fn shortened(name: &str) -> &str {
    &name[..name.floor_char_boundary(60)]
}

/// What a file has that is not read.
#[derive(Debug, Default)]
pub(crate) struct Unread {
    kinds: Vec<(String, Place)>,
    other_count: usize,
}

impl Unread {
    /// Notes a kind of thing once.
    pub fn note(&mut self, what: &str, place: impl FnOnce() -> Place) {
        if self.kinds.iter().any(|(known, _)| known == what) {
            return;
        }
        if self.kinds.len() < MOST_KINDS {
            self.kinds.push((what.into(), place()));
        } else {
            self.other_count += 1;
        }
    }

    /// A sentence for each kind.
    pub fn sentences(self) -> impl Iterator<Item = String> {
        let others = (self.other_count > 0).then(|| format!("not read, and not listed: {} more", self.other_count));
        let sentence = |(what, place): (String, Place)| match place.to_string().strip_prefix(", ") {
            Some(place) => format!("not read: {what} ({place})"),
            None => format!("not read: {what}"),
        };
        self.kinds.into_iter().map(sentence).chain(others)
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_KINDS, Unread};
    use crate::error::Place;

    #[test]
    fn each_kind_is_told_once_and_many_are_counted() {
        let mut unread = Unread::default();
        (1..4).for_each(|line| unread.note("lines", || Place::Line(line)));
        unread.note("the file", || Place::File);
        assert_eq!(unread.sentences().collect::<Vec<_>>(), ["not read: lines (line 1)", "not read: the file"]);
        let mut unread = Unread::default();
        (0..MOST_KINDS + 5).for_each(|kind| unread.note(&kind.to_string(), || Place::File));
        let sentences: Vec<String> = unread.sentences().collect();
        assert_eq!(
            (sentences.len(), sentences[MOST_KINDS].as_str()),
            (MOST_KINDS + 1, "not read, and not listed: 5 more")
        );
    }
}
