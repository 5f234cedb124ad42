//! Limits of cloth that is too tight to hold them, let out to what it needs.

use crate::cloth::aim;
use crate::{Limit, Merge, Model};
use glam::Vec3;
use std::collections::HashMap;

/// How often stretch is evened out between neighbours on a line. Sweeps leave it on every second spring, which one round ends.
const ROUNDS: usize = 4;

/// By how much limits are let out, and what they were before.
#[derive(Clone, Debug, Default)]
pub(crate) struct LetOut {
    /// By how much each limit is longer than its fabric allows [1], shape [limit_count]; empty where none is.
    pub(crate) ratios: Vec<f32>,
    /// The maximum lengths of limits and strands before [m].
    before: [Vec<f32>; 2],
}

impl LetOut {
    /// Lets the limits of a model out by so much each; what was let out before is taken back first.
    pub(crate) fn apply(&mut self, model: &mut Model, ratios: &[f32]) {
        if !self.ratios.is_empty() {
            let [limits, strands] = std::mem::take(&mut self.before);
            model.limits.iter_mut().zip(limits).for_each(|(limit, length)| limit.max_length = length);
            model.strand_lengths = strands;
            self.ratios.clear();
        }
        // A saved state may be of another garment: its digest tells, not its number of limits.
        if ratios.len() != model.limits.len() {
            return;
        }
        self.before = [model.limits.iter().map(|limit| limit.max_length).collect(), model.strand_lengths.clone()];
        self.ratios = ratios.to_vec();
        model.limits.iter_mut().zip(ratios).for_each(|(limit, ratio)| limit.max_length *= ratio);
        model.let_strands_out(ratios);
    }
}

impl Model {
    /// By how much each limit must be let out where the cloth lies [1], shape [limit_count]; empty where all can stay as they are.
    ///
    /// It was sewn of the open model by the merge. Positions [m], shape [particle_count]. What is stretched beyond its threshold is let out to as much, evened out along its line.
    pub(crate) fn room_at(&self, open: &Self, merge: &Merge, positions: &[Vec3]) -> Vec<f32> {
        let elongation = |limit: &Limit| {
            let [a, b] = limit.ends.map(|end| positions[end as usize]);
            a.distance(b) / limit.rest_length - 1.0
        };
        let next = self.next_on_lines(open, merge);
        let mut stretch: Vec<f32> = self.limits.iter().map(elongation).collect();
        for _ in 0..ROUNDS {
            let mut sums: Vec<[f32; 2]> = stretch.iter().map(|own| [2.0 * own, 2.0]).collect();
            for &[a, b] in &next {
                for [to, from] in [[a, b], [b, a]] {
                    let [sum, weight] = &mut sums[to as usize];
                    *sum += stretch[from as usize];
                    *weight += 1.0;
                }
            }
            stretch = sums.into_iter().map(|[sum, weight]| sum / weight).collect();
        }
        let aim = aim(self.rule);
        let ratio = |(limit, stretch): (&Limit, &f32)| {
            let threshold = (limit.max_length / limit.rest_length - 1.0) / aim;
            let needed = limit.rest_length * (1.0 + stretch);
            if *stretch > threshold { needed / limit.max_length } else { 1.0 }
        };
        let ratios: Vec<f32> = self.limits.iter().zip(&stretch).map(ratio).collect();
        if ratios.iter().any(|ratio| *ratio > 1.0) { ratios } else { Vec::new() }
    }

    /// Pairs of limits that follow one another on a line of cloth, across seams too.
    fn next_on_lines(&self, open: &Self, merge: &Merge) -> Vec<[u32; 2]> {
        let place: HashMap<[u32; 2], u32> = self.limits.iter().map(|limit| limit.ends).zip(0..).collect();
        let lines = open.lines_when_sewn(merge);
        let threes = lines.iter().flat_map(|particles| particles.windows(3));
        let pair = |three: &[u32]| {
            let [one, other] =
                [[three[0], three[1]], [three[1], three[2]]].map(|[a, b]| place.get(&[a.min(b), a.max(b)]).copied());
            Some([one?, other?])
        };
        threes.filter_map(pair).collect()
    }

    /// Lets the limits along strands out by the mean of the single ones on their way.
    fn let_strands_out(&mut self, ratios: &[f32]) {
        let mut widest = vec![1.0_f32; self.positions.len()];
        let mut ratio_of = HashMap::new();
        for (limit, ratio) in self.limits.iter().zip(ratios) {
            ratio_of.insert(limit.ends, *ratio);
            for end in limit.ends {
                widest[end as usize] = widest[end as usize].max(*ratio);
            }
        }
        for strand in &self.strands {
            let particles = &self.strand_particles[strand.particles.start as usize..strand.particles.end as usize];
            // The steps of a strand on every second particle are no single limits.
            let step_ratio = |pair: &[u32]| {
                let [a, b] = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                let between = || 0.5 * (widest[a as usize] + widest[b as usize]);
                ratio_of.get(&[a, b]).copied().unwrap_or_else(between)
            };
            let steps: Vec<f32> = particles.windows(2).map(step_ratio).collect();
            if steps.iter().all(|ratio| *ratio == 1.0) {
                continue;
            }
            let first = strand.lengths_from(0) as usize;
            let own = self.strand_lengths[first..first + steps.len()].to_vec();
            for level in 0..strand.level_count {
                let reach = 1 << level;
                let first = strand.lengths_from(level) as usize;
                let lengths = &mut self.strand_lengths[first..first + particles.len() - reach];
                for (place, length) in lengths.iter_mut().enumerate() {
                    let way = place..place + reach;
                    let whole: f32 = own[way.clone()].iter().sum();
                    let longer: f32 = own[way.clone()].iter().zip(&steps[way]).map(|(own, ratio)| own * ratio).sum();
                    *length *= longer / whole;
                }
            }
        }
    }
}
