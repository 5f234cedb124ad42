//! Saboteurs: with any one mistake in its WGSL, a kernel no longer agrees with its reference.

use crate::kernels::{Case, alone, seeds};
use crate::mutants::{Kind, Mutant, mutants};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use toile_kernels::Kernel;
use toile_lab::kernels::{Compiled, Seeds};
use toile_workspace::{Gpu, gpu};

/// How many mistakes of each kind there are at least, so that none is lost to a change of the text.
const LEAST: [(Kind, usize); 6] = [
    (Kind::Sign, 200),
    (Kind::Border, 30),
    (Kind::Turned, 100),
    (Kind::Extreme, 10),
    (Kind::Constant, 150),
    (Kind::Index, 150),
];

/// Mistakes that change no answer on these inputs: why, their kind, and parts of the lines that have them.
const SPARED: &[(&str, Kind, &[&str])] = &[
    (
        "the second dimension of a dispatch begins beyond 65 535 workgroups",
        Kind::Sign,
        &["id.x - id.y *", "group.x - group.y *"],
    ),
    (
        "the second dimension of a dispatch begins beyond 65 535 workgroups",
        Kind::Constant,
        &["const WORKGROUP_SIZE: u32 = 65u"],
    ),
    (
        "any length does whose square is no denormal number",
        Kind::Constant,
        &["const SHUT: f32 = 1e-13", "const SHUT: f32 = 2e-12"],
    ),
    (
        "the search for the way into a box has ended before",
        Kind::Constant,
        &["const BOX_TURNS: u32 = 7u", "var k = 1u; k < BOX_TURNS"],
    ),
    ("the search for the way into a box has ended before", Kind::Border, &["k <= BOX_TURNS"]),
    ("nothing is as far away as that", Kind::Border, &["seen.distance <= FAR"]),
    (
        "the rim of the maps is empty, so what lies beyond it is nothing too",
        Kind::Sign,
        &["left - 1.0 <", "top - 1.0 <"],
    ),
    (
        "the rim of the maps is empty, so what lies beyond it is nothing too",
        Kind::Constant,
        &["left + 1.5 <", "top + 1.5 <"],
    ),
    (
        "the rim of the maps is empty, so what lies beyond it is nothing too",
        Kind::Border,
        &["left + 1.0 <=", "top + 1.0 <=", "column > 0.0", "row > 0.0"],
    ),
    (
        "an item after the last has nothing to read, and what it writes is dropped",
        Kind::Border,
        &[
            "i + 1u > arrayLength",
            "i <= arrayLength",
            "i <= step.",
            "i > step.",
            "i > vertices.count",
            "i > gather.count",
            "item > span.count",
            "k <= arrayLength",
            "partial <= arrayLength",
        ],
    ),
    ("after the last pin the last is read once more", Kind::Border, &["k > arrayLength"]),
    ("what stands at the end of a way is answered in any case", Kind::Border, &["k < places"]),
    ("the sum beyond the half is not read", Kind::Border, &["local <= stride"]),
    ("every invocation of a workgroup has its sum", Kind::Turned, &["local != 0u"]),
    ("every invocation of a workgroup has its sum", Kind::Constant, &["local == 1u"]),
    ("two invocations that run in step write the same", Kind::Constant, &["local > 1u"]),
    ("no number lies between 0 and the least elongation", Kind::Constant, &["elongation_max) > 1u"]),
    ("a name that only has to be unlike others", Kind::Constant, &["const BESIDE: i32 = 4"]),
    ("what is no node has no limit that could move it", Kind::Constant, &["return vec4<f32>(1e9)"]),
    ("the program sets it", Kind::Constant, &["override LANES: u32 = 257u"]),
    ("a part of a way beyond all of it is never reached", Kind::Constant, &["const NEVER: f32 = 3.0"]),
    ("zero, or equal, has been answered before", Kind::Border, &["return turn >= 0.0", "return one.distance <="]),
    ("of two that are alike in all either may answer", Kind::Border, &["one.velocity - other.velocity) >= 0.0"]),
    ("more than 0 is a hit", Kind::Constant, &["velocity_back, 1.5)", "velocity_front, 1.5)"]),
    (
        "where one camera sees nothing the other sees nothing",
        Kind::Constant,
        &["depth_front < 1.5", "depth_back < 1.5"],
    ),
    (
        "where one camera sees nothing the other sees nothing",
        Kind::Border,
        &["depth_front <= 1.0", "depth_back <= 1.0"],
    ),
    ("the halves of the way are looked at after it", Kind::Constant, &["sight_from(next, next, 1e9)"]),
    ("along another axis the place is inside too", Kind::Constant, &["before % 3u"]),
    ("before the first layer nothing is read", Kind::Constant, &["var below = vec2<u32>(1u)"]),
    ("where nothing moves, the lag takes nothing of it", Kind::Constant, &["var drift = vec3<f32>(1e9)"]),
    ("a way that ends before the sphere ends within a hair of it for none of these", Kind::Constant, &["share < 1.5"]),
    (
        "with nothing to change, to divide or to blend the answer is nothing either",
        Kind::Border,
        &[
            "weight_second >= 0.0",
            "approach <= wanted",
            "b.touching >= 0.0",
            "chord_length >=",
            "closing <= 0.0",
            "contact.touching >= 0.0",
            "cosine >= 0.0",
            "current_length >= limit.max_length",
            "discriminant >= 0.0",
            "elongation >= 0.0",
            "gap >= 0.0",
            "normal_force <= 0.0",
            "normal_length >= 0.0",
            "outward_length >= 0.0",
            "outside >= 0.0",
            "predicted_length >= limit.max_length",
            "predicted_length >= attachment.max_length",
            "predicted_length >= guard_length",
            "predicted_length >= target_length",
            "probe.hit >= 0.0",
            "returned >= wanted",
            "seen.hit >= 0.0",
            "start_across) >= shape.radius",
            "speed >= step.hold_speed",
            "speed >= stopped",
            "through <= 0.0",
            "wanted >= speed",
            "weight_sum >= 0.0",
            "planes.weight >= 0.0",
            "sight.body.weight >= 0.0",
            "sight.sheet.weight >= 0.0",
            ">= atomicLoad",
        ],
    ),
    (
        "none of these numbers lies on the border to the last bit",
        Kind::Border,
        &[
            "abs(along) < 1.0",
            "abs(cosine) <= 0.3",
            "abs(next.z - column.front) < abs(",
            "column.front - start.z < start.z",
            "depth.y <= least",
            "depth.z <= least",
            "place >= 0.0",
            "step.dt <= step.contact_margin",
            "distance_front > distance_back",
            "elongation * step.aim >=",
            "elongation >= polish.target_elongation",
            "entry.z <= seen.front",
            "entry.z >= seen.back",
            "plane.distance > nearest",
            "share <= 1.0",
            "speed_squared <= RUNAWAY_SPEED",
            "z <= column.back",
            "z >= column.front",
            "start_lag()) >= layer_box.texel",
            "sheet.distance >= -SHEET_DEPTH",
            "spread <= SPREAD_MAX",
            "sight.sheet.spread <= sight.body.spread",
            "spread <= sum.spread",
            "way_length >= layer_box.texel",
            "sheet.distance <= probe.distance",
            "way_length < layer_box.texel",
            "sheet.hit >= 0.0",
        ],
    ),
];

/// The part of a line that spares it.
fn spares(mutant: &Mutant) -> Option<&'static str> {
    let lists = SPARED.iter().filter(|(_, kind, _)| *kind == mutant.kind);
    let mut parts = lists.flat_map(|(_, _, parts)| *parts);
    parts.find(|part| mutant.wrong.contains(**part) && !mutant.line.contains(**part)).copied()
}

/// What to change in kernels whose own lines have no mistake that is found.
fn other_sabotage(kernel: Kernel, source: &str) -> Option<String> {
    let (from, to) = match kernel {
        Kernel::StateCopy => ("vec4<f32>(velocity_of(i)", "vec4<f32>(-velocity_of(i)"),
        Kernel::LimitZero => (", -dot(", ", dot("),
        _ => return None,
    };
    assert!(source.contains(from), "{}: no {from}", kernel.name());
    Some(source.replacen(from, to, 1))
}

/// The mistakes that were made, each with whether a comparison found it. Shared files have functions that not every kernel calls, so
/// a mistake counts as found once one kernel finds it.
#[derive(Default)]
struct Report {
    found: BTreeMap<Mutant, bool>,
    spared: BTreeSet<&'static str>,
}

/// The mistakes of a kernel that nobody has made yet, and whether any was found.
struct Hunt {
    kernel: Kernel,
    left: Mutex<std::vec::IntoIter<(Mutant, String)>>,
    any: AtomicBool,
}

impl Hunt {
    fn new(kernel: Kernel) -> Self {
        Self { kernel, left: Mutex::new(mutants(&kernel.source()).into_iter()), any: AtomicBool::new(false) }
    }

    /// Makes mistakes until none is left.
    fn join(&self, gpu: &Gpu, seeds: &Seeds, report: &Mutex<Report>) {
        let cases = Case::variants(seeds, self.kernel);
        // `None` where a sabotage does not even compile, so that nobody makes it unseen.
        let is_found = |source: &str| {
            let compiled = Compiled::new(gpu, self.kernel, source)?;
            Some(cases.iter().any(|case| case.difference(gpu, &compiled).is_some()))
        };
        if other_sabotage(self.kernel, &self.kernel.source()).is_some_and(|source| is_found(&source) == Some(true)) {
            self.any.store(true, Ordering::Relaxed);
        }
        while let Some((mutant, source)) = self.next() {
            let mut lines = report.lock().expect("no hunter fails");
            if let Some(part) = spares(&mutant) {
                lines.spared.insert(part);
                continue;
            }
            if self.any.load(Ordering::Relaxed) && lines.found.get(&mutant) == Some(&true) {
                continue;
            }
            drop(lines);
            if let Some(here) = is_found(&source) {
                *report.lock().expect("no hunter fails").found.entry(mutant).or_default() |= here;
                self.any.fetch_or(here, Ordering::Relaxed);
            }
        }
    }

    fn next(&self) -> Option<(Mutant, String)> {
        self.left.lock().expect("no hunter fails").next()
    }
}

#[test]
fn every_mistake_is_found() {
    let hunts: Vec<Hunt> = alone().map(|row| Hunt::new(row.kernel)).collect();
    let report = Mutex::new(Report::default());
    let hunter = |gpu: &Gpu, seeds: &Seeds| hunts.iter().for_each(|hunt| hunt.join(gpu, seeds, &report));
    // A driver takes the longest for its own programs, which it makes for one device one after the other.
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let gpu = Gpu::open(wgpu::Backends::all()).expect("a second device");
            hunter(&gpu, &Seeds::new(&gpu, 0).expect("the device answers"));
        });
        hunter(gpu(), seeds());
    });
    for hunt in hunts {
        assert!(hunt.any.into_inner(), "{}: no sabotage is found", hunt.kernel.name());
    }
    let Report { found, spared } = report.into_inner().expect("no hunter failed");
    for (kind, least) in LEAST {
        let count = found.keys().filter(|mutant| mutant.kind == kind).count();
        assert!(count >= least, "only {count} mistakes of the kind {kind:?} were made");
    }
    let missed: Vec<_> = found.iter().filter(|(_, found)| !**found).map(|(mutant, _)| mutant).collect();
    assert!(
        missed.is_empty(),
        "nothing sees\n{}",
        missed.iter().map(|m| format!("{:?} {}", m.kind, m.wrong)).collect::<Vec<_>>().join("\n")
    );
    let idle: Vec<_> = SPARED.iter().flat_map(|(_, _, parts)| *parts).filter(|part| !spared.contains(*part)).collect();
    assert!(idle.is_empty(), "these spare nothing any more: {idle:#?}");
}
