//! Rows of different lengths in one array.

use std::ops::Range;

/// Rows of different lengths in one array (compressed sparse rows).
#[derive(Clone, Debug, PartialEq)]
pub struct Csr<T> {
    /// Start of each row in `values`, then their number; shape [row_count + 1].
    pub offsets: Vec<u32>,
    /// All rows, one after the other.
    pub values: Vec<T>,
}

impl<T> Default for Csr<T> {
    fn default() -> Self {
        Self { offsets: vec![0], values: Vec::new() }
    }
}

impl<T> Csr<T> {
    /// Rows in the order in which the iterator gives them.
    pub fn from_rows<R: IntoIterator<Item = T>>(rows: impl IntoIterator<Item = R>) -> Self {
        let mut offsets = vec![0];
        let mut values = Vec::new();
        for row in rows {
            values.extend(row);
            offsets.push(values.len() as u32);
        }
        Self { offsets, values }
    }

    /// Number of rows.
    pub fn row_count(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    /// One row.
    ///
    /// # Panics
    /// When `index` is not below [`Csr::row_count`].
    pub fn row(&self, index: usize) -> &[T] {
        &self.values[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }

    /// Where the values of one row stand.
    pub fn range(&self, index: usize) -> Range<u32> {
        self.offsets[index]..self.offsets[index + 1]
    }
}
