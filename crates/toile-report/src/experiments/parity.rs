//! The device against the reference, kernel by kernel.

use crate::Experiment;
use crate::page::{Axis, Block, Cell, Plot, Section, Series, SeriesStyle, Table};
use toile_kernels::{Kernel, Stage, TABLE};
use toile_lab::kernels::{Compiled, Inputs, Seeds, VARIANTS, answer, ulps};
use toile_lab::{Gpu, Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "parity", title: "GPU against reference", minutes: [0.1, 0.1], run };

/// Upper ends of the classes of the histogram [units in the last place].
const CLASSES: [u32; 6] = [0, 1, 3, 15, 255, u32::MAX];
const CLASS_NAMES: [&str; 6] = ["0 ULP", "1", "2 to 3", "4 to 15", "16 to 255", "more"];

/// How far the words that a kernel writes are from those of its reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Histogram {
    /// Words of each class: 0, 1, 2 to 3, 4 to 15, 16 to 255 and more units in the last place.
    pub counts: [u64; 6],
    /// Largest distance [units in the last place].
    pub worst: u32,
}

impl Histogram {
    fn add(&mut self, device: u32, reference: u32) {
        let distance = ulps(device, reference);
        let class = CLASSES.iter().position(|end| distance <= *end).expect("the last class has no end");
        self.counts[class] += 1;
        self.worst = self.worst.max(distance);
    }

    /// Number of words.
    pub fn words(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// Whether all bits agree.
    pub fn is_equal(&self) -> bool {
        self.worst == 0
    }
}

/// Runs a kernel alone on seeded input that leads into all its branches, of so many items in each of three variants (Coulomb and the papers'
/// friction, and weightless), and compares all that it writes. Two NaN agree.
///
/// `sabotage` changes the WGSL, for tests of this measure; `None` when what it makes does not compile.
///
/// # Errors
/// [`LabError::Toile`] when the device is lost.
pub fn kernel_histogram(
    gpu: &Gpu,
    seeds: &Seeds,
    kernel: Kernel,
    items: u32,
    sabotage: impl FnOnce(String) -> String,
) -> Result<Option<Histogram>, LabError> {
    let Some(compiled) = Compiled::new(gpu, kernel, &sabotage(kernel.source())) else { return Ok(None) };
    let mut histogram = Histogram::default();
    for variant in VARIANTS {
        let input = seeds.input(kernel, items, variant);
        let written = compiled.run(gpu, input.invocations, &input)?;
        let mut expected = input;
        answer(kernel, &mut expected);
        for (name, device) in written {
            let reference: Vec<u32> = bytemuck::pod_collect_to_vec(&expected.bytes(&name));
            device.iter().zip(&reference).for_each(|(device, reference)| histogram.add(*device, *reference));
        }
    }
    Ok(Some(histogram))
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let gpu = lab.gpu();
    let seeds = Seeds::new(&gpu, lab.seed)?;
    let items = lab.pick(257, 1757);
    let caption = format!(
        "Each kernel alone on seeded input of {items} items that leads into all its branches, in three variants (Coulomb friction, the papers' friction, \
         weightless); 32-bit words that it writes, by their distance from those of the CPU reference in units in the last place. \
         Kernels in the order of the algorithm. {}",
        lab.place()
    );
    let mut columns = vec![["kernel", ""], ["words", ""]];
    columns.extend(CLASS_NAMES.map(|name| [name, ""]));
    columns.push(["worst", "ULP"]);
    let mut table = Table::new(caption.clone(), &columns);
    let mut total = [0; 6];
    let mut first = None;
    // Kernels that draw maps leave columns in no order: the tests compare the maps as a whole.
    let rows: Vec<_> = TABLE.iter().filter(|row| row.stage != Stage::Maps).collect();
    for (index, row) in rows.iter().enumerate() {
        let name = row.kernel.name();
        lab.say(index as f64 / rows.len() as f64, &format!("parity of {name}"))?;
        let Some(histogram) = kernel_histogram(&gpu, &seeds, row.kernel, items, |source| source)? else {
            table.push([Cell::text(name)].into_iter().chain((0..8).map(|_| Cell::text("does not compile"))).collect());
            first.get_or_insert(name);
            continue;
        };
        if !histogram.is_equal() {
            first.get_or_insert(name);
        }
        total.iter_mut().zip(histogram.counts).for_each(|(total, count)| *total += count);
        let counts = [histogram.words()].into_iter().chain(histogram.counts).chain([u64::from(histogram.worst)]);
        table.push([Cell::text(name)].into_iter().chain(counts.map(Cell::Count)).collect());
    }
    let words: u64 = total.iter().sum();
    let lead = match first {
        None => {
            format!("All {} kernels agree with the reference in all bits of {words} words on this adapter.", rows.len())
        }
        Some(name) => format!(
            "The first kernel of the algorithm that differs from the reference on this adapter is {name}. {} of {words} words agree in all bits.",
            total[0]
        ),
    };
    let bars = CLASS_NAMES.iter().zip(total).enumerate().map(|(class, (_, count))| [class as f64, count as f64]);
    let plot = Plot {
        caption: format!("Words of all kernels by class: 0 is 0 ULP, then {}. {caption}", CLASS_NAMES[1..].join(", ")),
        x: Axis::linear("class of distance", ""),
        y: Axis::log("words", ""),
        series: vec![Series::new("words", SeriesStyle::Marks, bars)],
    };
    let mut section = EXPERIMENT.section(lead);
    section.blocks = vec![Block::Table(table), Block::Plot(plot)];
    Ok(section)
}
