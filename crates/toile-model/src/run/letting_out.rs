//! Limits of cloth that is too tight to hold them, let out to what it needs.

use crate::cloth::aim;
use crate::{Arrays, CLUSTER_PAIRS, Cluster, Limit, Merge, Model};
use glam::Vec3;
use std::collections::HashMap;

/// How often stretch is evened out between neighbours on a line. Sweeps leave it on every second spring, which one round ends.
const ROUNDS: usize = 4;

/// How much more than its neighbours' a stretch may stay than a limit is let out by [1]. Nodes that are near to each other may lead half of
/// a garment each: what their limit takes back in a step throws it.
const SPIKE: f32 = 0.1;

/// By how much limits are let out, and what they were before.
#[derive(Clone, Debug, Default)]
pub(crate) struct LetOut {
    /// By how much each limit is longer than its fabric allows [1], shape [limit_count]; empty where none is.
    pub(crate) ratios: Vec<f32>,
    /// The maximum lengths of limits before [m].
    limits: Vec<f32>,
    clusters: Vec<Cluster>,
    guard_lengths: Vec<[f32; 6]>,
}

impl LetOut {
    /// Lets the limits of a model out by so much each; what was let out before is taken back first.
    pub(crate) fn apply(&mut self, model: &mut Model, ratios: &[f32]) {
        let model = model.arrays_mut();
        if !self.ratios.is_empty() {
            let before = std::mem::take(self);
            model.limits.iter_mut().zip(before.limits).for_each(|(limit, length)| limit.max_length = length);
            model.clusters = before.clusters;
            model.guard_lengths = before.guard_lengths;
        }
        // A saved state may be of another garment: its digest tells, not its number of limits.
        if ratios.len() != model.limits.len() {
            return;
        }
        *self = Self {
            ratios: ratios.to_vec(),
            limits: model.limits.iter().map(|limit| limit.max_length).collect(),
            clusters: model.clusters.clone(),
            guard_lengths: model.guard_lengths.clone(),
        };
        model.limits.iter_mut().zip(ratios).for_each(|(limit, ratio)| limit.max_length *= ratio);
        model.let_levels_out(ratios);
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
        let own: Vec<f32> = self.limits.iter().map(elongation).collect();
        let mut stretch = own.clone();
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
        stretch.iter_mut().zip(own).for_each(|(stretch, own)| *stretch = stretch.max(own - SPIKE));
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
}

impl Arrays {
    /// Lets the limits of all levels out: of the cloth itself by as much as the single ones, between coarse particles by what was needed the most
    /// around both ends.
    fn let_levels_out(&mut self, ratios: &[f32]) {
        let mut ratio_of: HashMap<[u32; 2], f32> =
            self.limits.iter().zip(ratios).map(|(limit, ratio)| (limit.ends, *ratio)).collect();
        let mut widest = vec![1.0_f32; self.positions.len()];
        for level in self.levels.clone() {
            let sites = |ends: [u32; 2]| ends.map(|node| self.site(node) as usize);
            if level.is_coarse() {
                let between = |ends: [u32; 2]| sites(ends).map(|site| widest[site]).iter().sum::<f32>() / 2.0;
                ratio_of = self.level_limits(&level).into_keys().map(|ends| (ends, between(ends))).collect();
            }
            for (ends, ratio) in &ratio_of {
                for site in sites(*ends) {
                    widest[site] = widest[site].max(*ratio);
                }
            }
            for index in level.colours.iter().flat_map(|colour| colour.clone()).map(|index| index as usize) {
                let Cluster { nodes, max_lengths } = &mut self.clusters[index];
                for (place, pair) in CLUSTER_PAIRS.iter().enumerate() {
                    let [a, b] = pair.map(|corner| nodes[corner]);
                    let Some(ratio) = ratio_of.get(&[a.min(b), a.max(b)]).filter(|ratio| **ratio != 1.0) else {
                        continue;
                    };
                    let own = max_lengths[place];
                    max_lengths[place] = own * ratio;
                    if let Some(guard) = self.guard_lengths.get_mut(index) {
                        // Twice as far from the rest length, which stays.
                        guard[place] += 2.0 * (max_lengths[place] - own);
                    }
                }
            }
        }
    }
}
