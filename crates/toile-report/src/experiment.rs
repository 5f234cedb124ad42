//! One section of the report, before it is measured.

use crate::page::Section;
use toile_lab::{Lab, LabError, Scale};

/// One section of the report, before it is measured.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Name, as `--only` takes it.
    pub name: &'static str,
    /// Title of the section.
    pub title: &'static str,
    /// How long it takes on two cores and software Vulkan, quick and full [min]. An estimate, for the time that is left.
    pub minutes: [f64; 2],
    /// Measures it.
    pub run: fn(&mut Lab) -> Result<Section, LabError>,
}

impl Experiment {
    /// How long it takes at a scale [min].
    pub fn minutes_at(&self, scale: Scale) -> f64 {
        self.minutes[usize::from(scale == Scale::Full)]
    }

    /// Its section, without any block yet.
    pub fn section(&self, lead: impl Into<String>) -> Section {
        Section { name: self.name.to_owned(), title: self.title.to_owned(), lead: lead.into(), blocks: Vec::new() }
    }
}
