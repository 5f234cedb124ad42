//! The passes that a model gets: the rows of the kernel table whose needs hold.

use crate::needs::{Maps, Needs};
use std::fmt;
use std::ops::Range;
use toile_kernels::structs::Span;
use toile_kernels::{Domain, Kernel, Row, Stage, TABLE, WORKGROUP_SIZE};
use toile_model::{Level, Model, StepSettings};

/// Workgroups along one dimension that every device can dispatch.
const WORKGROUPS_MAX: u32 = 65_535;

/// The passes of one step and of the end of one frame, in order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// Passes of one step.
    pub step: Vec<Pass>,
    /// Passes at the end of a frame.
    pub frame: Vec<Pass>,
    /// The parts of arrays that passes by colour work on, each once.
    pub spans: Vec<Span>,
}

/// One dispatch of a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Pass {
    /// The kernel.
    pub kernel: Kernel,
    /// The items it works on: one colour of an array, or all of them.
    pub items: Range<u32>,
    /// For kernels that work by colour: its place in [`Plan::spans`].
    pub span: Option<u32>,
    /// Whether a whole workgroup works on each item.
    pub workgroup_per_item: bool,
    /// For passes that a polish must grant, where the device finds how many workgroups they get: their place in `sweep_dispatches`.
    pub grant: Option<u32>,
}

/// What one kernel does in a step or at the end of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct KernelRuns {
    /// The kernel.
    pub kernel: Kernel,
    /// How often its turn comes.
    pub runs: usize,
    /// Dispatches in all.
    pub dispatches: usize,
    /// Items in all dispatches.
    pub items: u64,
}

/// The kernels of some passes in order of first use: those of a sweep come again and again, but are told once.
pub fn kernel_runs(passes: &[Pass]) -> Vec<KernelRuns> {
    let mut kernels: Vec<KernelRuns> = Vec::new();
    for run in passes.chunk_by(|a, b| a.kernel == b.kernel) {
        let items: u64 = run.iter().map(|pass| u64::from(pass.items.end - pass.items.start)).sum();
        let kernel = run[0].kernel;
        match kernels.iter_mut().find(|known| known.kernel == kernel) {
            Some(known) => {
                known.runs += 1;
                known.dispatches += run.len();
                known.items += items;
            }
            None => kernels.push(KernelRuns { kernel, runs: 1, dispatches: run.len(), items }),
        }
    }
    kernels
}

impl Plan {
    /// The plan of a model, with or without maps and shapes around it.
    ///
    /// # Panics
    /// When the rule of the settings is hierarchical and that of the model is not, or when there is a polish under a rule that is not
    /// predictive.
    pub fn new(model: &Model, settings: &StepSettings, maps: Maps, shapes: bool) -> Self {
        let needs = Needs::new(model, settings, maps, shapes);
        let rows: Vec<&Row> = TABLE.iter().filter(|row| needs.hold(row.need)).collect();
        let mut spans = Vec::new();
        let mut step = Vec::new();
        let mut frame = Vec::new();
        let mut sweep: Vec<Pass> = Vec::new();
        for group in rows.chunk_by(|a, b| a.stage == b.stage || [a, b].iter().all(|row| is_of_sweep(row))) {
            let group_passes = by_level(group, model, settings, &mut spans);
            match group[0].stage {
                Stage::Step => step.extend(group_passes),
                Stage::Sweep | Stage::FirstSweep => {
                    let later: Vec<&Row> = group.iter().copied().filter(|row| row.stage == Stage::Sweep).collect();
                    sweep = by_level(&later, model, settings, &mut spans);
                    step.extend(group_passes);
                    step.extend(repeated(&sweep, settings.sweeps.saturating_sub(1)));
                }
                Stage::AfterSweeps => {
                    step.extend(group_passes.iter().cloned());
                    sweep.extend(group_passes);
                }
                Stage::Polish => {
                    step.extend(polish(&group_passes, &sweep, settings.polish.map_or(0, |polish| polish.sweeps)));
                }
                Stage::Frame => frame.extend(group_passes),
                Stage::Pose | Stage::Maps | Stage::Handover | Stage::Between | Stage::Measure => {}
            }
        }
        Self { step, frame, spans }
    }

    /// Every kernel of the plan, each once, in order of first use.
    pub fn kernels(&self) -> Vec<Kernel> {
        let mut kernels = Vec::new();
        for pass in self.step.iter().chain(&self.frame) {
            if !kernels.contains(&pass.kernel) {
                kernels.push(pass.kernel);
            }
        }
        kernels
    }

    /// The passes that a grant is for: a further sweep and the measurement after it.
    pub(crate) fn granted(&self) -> impl Iterator<Item = &Pass> {
        let all = self.step.iter().filter(|pass| pass.grant.is_some());
        all.zip(0..).take_while(|(pass, place)| pass.grant == Some(*place)).map(|(pass, _)| pass)
    }
}

/// The passes of a polish: measure and decide, and as often as it may sweep, a further sweep after which it measures and decides
/// again. All but the first measurement and the decisions must be granted.
fn polish(rows: &[Pass], sweep: &[Pass], sweeps: u32) -> Vec<Pass> {
    let (decision, measurement) = rows.split_last().expect("a polish measures and decides");
    let granted = sweep.iter().chain(measurement).zip(0..);
    let mut further: Vec<Pass> = granted.map(|(pass, place)| Pass { grant: Some(place), ..pass.clone() }).collect();
    further.push(decision.clone());
    let mut passes = rows.to_vec();
    passes.extend(repeated(&further, sweeps));
    passes
}

fn repeated(passes: &[Pass], times: u32) -> impl Iterator<Item = Pass> {
    (0..times).flat_map(|_| passes.iter().cloned())
}

impl Pass {
    /// One dispatch over so many items.
    pub fn over(kernel: Kernel, count: u32) -> Self {
        Self { kernel, items: 0..count, span: None, workgroup_per_item: false, grant: None }
    }

    /// Workgroups to dispatch along x and y.
    pub fn workgroups(&self) -> [u32; 2] {
        let count = self.items.end - self.items.start;
        let groups = if self.workgroup_per_item { count } else { count.div_ceil(WORKGROUP_SIZE) };
        [groups.min(WORKGROUPS_MAX), groups.div_ceil(WORKGROUPS_MAX)]
    }
}

/// The passes of some rows in their order. Rows by level take turns, the coarsest level first.
fn by_level(rows: &[&Row], model: &Model, settings: &StepSettings, spans: &mut Vec<Span>) -> Vec<Pass> {
    let mut result = Vec::new();
    for rows in rows.chunk_by(|a, b| is_by_level(a) == is_by_level(b)) {
        let levels = if is_by_level(rows[0]) { model.levels.as_slice() } else { &[Level::default()] };
        // Small ones have a kernel of their own.
        for level in levels.iter().rev().filter(|level| !is_by_level(rows[0]) || !level.is_small()) {
            result.extend(rows.iter().flat_map(|row| passes(row, model, settings, level, spans)));
        }
    }
    result
}

fn is_of_sweep(row: &Row) -> bool {
    matches!(row.stage, Stage::Sweep | Stage::FirstSweep)
}

fn is_by_level(row: &Row) -> bool {
    matches!(row.domain, Domain::LevelNode | Domain::LevelCluster)
}

fn passes(row: &Row, model: &Model, settings: &StepSettings, level: &Level, spans: &mut Vec<Span>) -> Vec<Pass> {
    let workgroup_per_item = row.domain == Domain::Hold;
    let pass = |items, span| Pass { kernel: row.kernel, items, span, workgroup_per_item, grant: None };
    let all = |count: u32| vec![pass(0..count, None)];
    let mut coloured = |colours: &[Range<u32>], times: u32, share_of: &dyn Fn(u32, u32) -> f32| -> Vec<Pass> {
        let mut passes = Vec::new();
        for time in 0..times {
            for (items, colour) in colours.iter().zip(0..) {
                let share = share_of(time, colour);
                let span = Span { first: items.start, count: items.end - items.start, share };
                passes.push(pass(items.clone(), Some(place(spans, span))));
            }
        }
        passes
    };
    let whole = |_, _| 1.0;
    match row.domain {
        Domain::Particle => all(model.particle_count()),
        Domain::Quad => all(model.quad_count()),
        Domain::Point => all(model.particle_count() + model.quad_count()),
        Domain::Hold => all(model.holds.len() as u32),
        Domain::Limit => all(model.limits.len() as u32),
        Domain::LimitColour => coloured(&model.limit_colours, 1, &whole),
        Domain::GuardedCluster => {
            let share = |pass, colour| settings.guard_share(pass, colour);
            let colours = model.levels.first().map_or(&[][..], |level| &level.colours);
            coloured(colours, settings.guard_passes, &share)
        }
        Domain::LevelNode => coloured(std::slice::from_ref(&level.nodes), 1, &whole),
        Domain::LevelCluster => {
            coloured(&level.colours, settings.level_passes(level), &|_, _| StepSettings::relaxation(level))
        }
        Domain::SeamPair => all(model.seam_pair_count()),
        Domain::SeamColour => coloured(&model.seam_colours, StepSettings::SEAM_PASSES, &whole),
        Domain::Workgroup => all(WORKGROUP_SIZE),
        Domain::Pin | Domain::Vertex | Domain::TrianglePart | Domain::Column => Vec::new(),
    }
}

/// Place of a span among those that there are, or at their end.
fn place(spans: &mut Vec<Span>, span: Span) -> u32 {
    let known = spans.iter().position(|known| *known == span);
    known.unwrap_or_else(|| {
        spans.push(span);
        spans.len() - 1
    }) as u32
}

impl fmt::Display for Plan {
    /// One line for each kernel.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (title, passes) in [("step", &self.step), ("frame", &self.frame)] {
            writeln!(f, "{title}: {} dispatches", passes.len())?;
            for KernelRuns { kernel, runs, dispatches, items } in kernel_runs(passes) {
                writeln!(f, "  {:<18} {runs} runs, {dispatches:>3} dispatches, {items} items", kernel.name())?;
            }
        }
        Ok(())
    }
}
