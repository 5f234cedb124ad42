//! Which branches of a kernel an input leads into, told from the input and from what the reference made of it: in words, where a kernel has
//! many.

use glam::Vec3;
use std::collections::BTreeMap;
use toile_kernels::Kernel;
use toile_lab::kernels::Input;
use toile_lab::with;
use toile_model::{NO_CORNER, ShapeKind};
use toile_reference::{Contact, Probe};

/// How many items went into each branch.
pub type Seen = BTreeMap<&'static str, usize>;

/// Adds the items of one input. `after` is the input once the kernel's reference has worked on it.
pub fn count(kernel: Kernel, before: &Input, after: &Input, seen: &mut Seen) {
    let mut see = |branch: &'static str, items: usize| *seen.entry(branch).or_default() += items;
    let weights = &before.particles.inverse_masses;
    let positions = &before.particles.positions;
    let changed = |i: usize| {
        after.particles.velocities[i] != before.particles.velocities[i] && before.particles.velocities[i].is_finite()
    };
    let particles = || 0..positions.len();
    match kernel {
        Kernel::SpringForces => {
            let lengths = || {
                particles().flat_map(|i| {
                    before.model.links.row(i).iter().map(move |l| (positions[l.other as usize] - positions[i]).length())
                })
            };
            see("is pulled", lengths().filter(|length| *length > 0.0).count());
            see("has a spring without length", lengths().filter(|length| *length == 0.0).count());
            see("has a neighbour that is no number", lengths().filter(|length| length.is_nan()).count());
            see("has no spring", particles().filter(|i| before.model.links.row(*i).is_empty()).count());
        }
        Kernel::QuadWind => wind(before, after, &mut see),
        Kernel::WindForces => {
            let has = |i: usize, triangle: bool| {
                before
                    .model
                    .particle_quads
                    .row(i)
                    .iter()
                    .any(|q| (before.model.quads[*q as usize][3] == NO_CORNER) == triangle)
            };
            see("has a triangle", particles().filter(|i| has(*i, true)).count());
            see("has a quad", particles().filter(|i| has(*i, false)).count());
            see("has neither", particles().filter(|i| before.model.particle_quads.row(*i).is_empty()).count());
        }
        Kernel::Reaction => {
            let pressed = |i: &usize| before.forces[*i].dot(before.contacts[*i].normal) < 0.0;
            let touching = |i: &usize| before.contacts[*i].touching && weights[*i] > 0.0;
            see("touches nothing", particles().filter(|i| !before.contacts[*i].touching).count());
            see(
                "touches but is pinned",
                particles().filter(|i| before.contacts[*i].touching && weights[*i] == 0.0).count(),
            );
            see("is drawn away", particles().filter(|i| touching(i) && !pressed(i)).count());
            see("is pressed on", particles().filter(|i| touching(i) && pressed(i)).count());
            let held = |i: &usize| touching(i) && pressed(i) && after.forces[*i].length() < 1e-9;
            see("is held by friction", particles().filter(held).count());
            see("slides", particles().filter(|i| touching(i) && pressed(i) && !held(i)).count());
        }
        Kernel::Euler => {
            see("is pinned", particles().filter(|i| weights[*i] == 0.0 && !changed(*i)).count());
            see("is accelerated", particles().filter(|i| changed(*i)).count());
        }
        Kernel::HoldEdges => {
            let bound = before.settings.hold_speed / before.settings.hold_rate;
            let members = |h: &toile_model::Hold| {
                &before.model.held_particles[h.particles.start as usize..h.particles.end as usize]
            };
            let way = |h: &toile_model::Hold| {
                let sum: f32 = members(h).iter().map(|i| positions[*i as usize].y).sum();
                h.height - sum / members(h).len() as f32
            };
            let holds = || before.model.holds.iter();
            see("is far below", holds().filter(|h| way(h) > bound).count());
            see("is far above", holds().filter(|h| way(h) < -bound).count());
            see("is near", holds().filter(|h| way(h).abs() < bound).count());
            see("is no number", holds().filter(|h| way(h).is_nan()).count());
            see("is one particle", holds().filter(|h| members(h).len() == 1).count());
            see("is more than a workgroup", holds().filter(|h| members(h).len() > 64 && way(h).is_finite()).count());
        }
        Kernel::DrawSeams | Kernel::CloseSeams => {
            let pairs: Vec<_> = before.colour_pairs().iter().map(|s| s.ends.map(|end| end as usize)).collect();
            ends(&pairs, before, after, &mut see);
            let shut = |s: &&toile_model::SeamPair| {
                let [a, b] = s.ends.map(|end| positions[end as usize]);
                (b - a).length() < s.closing_speed * before.settings.dt
            };
            see("closes within the step", before.colour_pairs().iter().filter(shut).count());
        }
        Kernel::LimitZero | Kernel::LimitAverage | Kernel::LimitPosition => {
            ends(&limit_ends(before), before, after, &mut see);
        }
        Kernel::LimitPredictive => {
            ends(&limit_ends(before), before, after, &mut see);
            let pulled = |i: &&usize| before.pulls[**i] != after.pulls[**i];
            see("keeps what it gave", limit_ends(before).iter().flatten().filter(|i| pulled(i)).count());
        }
        Kernel::LimitGuard => {
            let at = |i: u32| positions[i as usize] + before.particles.velocities[i as usize] * before.settings.dt;
            let first = |ends: [u32; 2], length: f32| (at(ends[1]) - at(ends[0])).length() - length;
            let firsts = before
                .span
                .clone()
                .map(|k| k as usize)
                .map(|k| (before.model.clusters[k].nodes, before.model.guard_lengths[k][0]));
            let excesses: Vec<f32> = firsts.map(|([a, b, ..], length)| first([a, b], length)).collect();
            let way = before.settings.guard_way();
            let count = |wanted: &dyn Fn(f32) -> bool| excesses.iter().filter(|excess| wanted(**excess)).count();
            see("is short enough", count(&|excess| excess <= 0.0));
            see("is shortened to where the guard begins", count(&|excess| excess > 0.0 && excess < way));
            see("is shortened as far as it may be at once", count(&|excess| excess > way));
            cluster_sizes(before, &mut see);
        }
        Kernel::KeepOut => {
            let probe = |i: usize| &before.probes[i];
            let deep = |i: usize| probe(i).distance < -before.settings.thickness;
            let meets = |i: &usize| probe(*i).hit && weights[*i] > 0.0;
            see("meets no body", particles().filter(|i| !probe(*i).hit).count());
            see("is pinned", particles().filter(|i| probe(*i).hit && weights[*i] == 0.0 && !changed(*i)).count());
            see(
                "is stopped within the thickness",
                particles().filter(|i| meets(i) && !deep(*i) && changed(*i)).count(),
            );
            see("is deeper and goes no farther", particles().filter(|i| meets(i) && deep(*i) && changed(*i)).count());
            see("is deeper and leaves", particles().filter(|i| meets(i) && deep(*i) && !changed(*i)).count());
            see("goes on within the thickness", particles().filter(|i| meets(i) && !deep(*i) && !changed(*i)).count());
        }
        Kernel::WarmStart => {
            see("was given nothing", particles().filter(|i| before.pulls[*i] == Vec3::ZERO && !changed(*i)).count());
            see("begins with half", particles().filter(|i| before.pulls[*i] != Vec3::ZERO && changed(*i)).count());
        }
        Kernel::LeadLevel => {
            let count = before.model.positions.len() as u32;
            let leaders = |node: u32| before.model.leaders.row(node as usize).len();
            see("is a particle", before.span.clone().filter(|node| *node < count).count());
            see("is a coarse particle", before.span.clone().filter(|node| *node >= count).count());
            let pinned = |node: &u32| weights[before.model.site(*node) as usize] == 0.0;
            see("is where a pin is", before.span.clone().filter(|node| pinned(node) && leaders(*node) > 0).count());
            see("is led by none", before.span.clone().filter(|node| leaders(*node) == 0).count());
            see("is led by several", before.span.clone().filter(|node| leaders(*node) > 1).count());
        }
        Kernel::ShiftVelocities => {
            see("is shifted", particles().filter(|i| changed(*i)).count());
            see("stays", particles().filter(|i| before.nodes.shifts[*i] == Vec3::ZERO && !changed(*i)).count());
        }
        Kernel::LimitLevel => {
            let weight = |node: u32| before.nodes.inverse_masses[node as usize];
            let shifted = |node: u32| before.nodes.shifts[node as usize] != after.nodes.shifts[node as usize];
            let lost = |node: u32| before.nodes.places[node as usize].is_nan();
            let pairs =
                || before.span.clone().map(|k| before.model.clusters[k as usize].nodes).map(|[a, b, ..]| [a, b]);
            see("shifts both ends", pairs().filter(|[a, b]| shifted(*a) && shifted(*b)).count());
            see(
                "shifts neither",
                pairs().filter(|ends| ends.iter().all(|i| !shifted(*i) && weight(*i) > 0.0 && !lost(*i))).count(),
            );
            see("has a pinned end", pairs().filter(|[a, b]| shifted(*a) && weight(*b) == 0.0).count());
            see("has both ends pinned", pairs().filter(|ends| ends.iter().all(|i| weight(*i) == 0.0)).count());
            see("has an end that is no number", pairs().filter(|ends| ends.iter().any(|i| lost(*i))).count());
            assert_eq!(pairs().flatten().filter(|i| weight(*i) == 0.0 && shifted(*i)).count(), 0, "pins stay");
            cluster_sizes(before, &mut see);
        }
        Kernel::LimitSmallLevels => {
            let nodes = || before.model.levels.iter().flat_map(|level| level.nodes.clone());
            let led = |node: &u32| !before.model.leaders.row(*node as usize).is_empty();
            let moved = |node: &u32| after.nodes.shifts[*node as usize] != Vec3::ZERO;
            let count = before.model.positions.len() as u32;
            see(
                "moves a coarse particle that none leads",
                nodes().filter(|n| *n >= count && !led(n) && moved(n)).count(),
            );
            see("leads a particle on", nodes().filter(|n| *n < count && led(n) && moved(n)).count());
            see("leaves a node where it is", nodes().filter(|n| !moved(n)).count());
        }
        Kernel::LimitAttachments => {
            let attached = |i: &usize| !before.model.attachments.row(*i).is_empty();
            let pinned = |i: &usize| weights[*i] == 0.0;
            see("has none", particles().filter(|i| !attached(i)).count());
            see("is pinned", particles().filter(|i| attached(i) && pinned(i) && !changed(*i)).count());
            see("is held", particles().filter(|i| attached(i) && changed(*i)).count());
            see("is near enough", particles().filter(|i| attached(i) && !pinned(i) && !changed(*i)).count());
        }
        Kernel::LimitDirectional => directional(before, after, &mut see),
        Kernel::QuadMidpoints => {
            see("is a triangle", before.model.quads.iter().filter(|q| q[3] == NO_CORNER).count());
            see("is a quad", before.model.quads.iter().filter(|q| q[3] != NO_CORNER).count());
        }
        Kernel::SampleSides | Kernel::SampleMovingSides => sides(before, after, &mut see),
        Kernel::SampleLayers | Kernel::SampleMovingLayers => layers(before, after, &mut see),
        Kernel::MorphBody => {
            let targets = |i: usize| before.morphs().offsets[i + 1] - before.morphs().offsets[i];
            let vertices = || 0..before.skin.positions.len();
            see("has no morph target", vertices().filter(|i| targets(*i) == 0).count());
            see("has several morph targets", vertices().filter(|i| targets(*i) > 1).count());
        }
        Kernel::SkinBody => {
            let joints = |i: usize| before.skin.influence_offsets[i + 1] - before.skin.influence_offsets[i];
            let vertices = || 0..before.skin.positions.len();
            see("hangs on no joint", vertices().filter(|i| joints(*i) == 0).count());
            see("hangs on one joint", vertices().filter(|i| joints(*i) == 1).count());
            see("hangs on several joints", vertices().filter(|i| joints(*i) > 1).count());
        }
        Kernel::GatherBody => {
            let ahead = before.host.1.ahead;
            let count = after.body.positions.len();
            see("stands where the host has it", if ahead == 0.0 { count } else { 0 });
            see("goes ahead by its velocity", if ahead != 0.0 && before.host.1.is_last == 0 { count } else { 0 });
            see("goes by where it was before", if before.host.1.is_last == 1 { count } else { 0 });
            see("has a normal without length", after.body.normals.iter().filter(|normal| **normal == Vec3::Y).count());
        }
        Kernel::VertexVelocities => {
            let still = after.body.velocities.iter().filter(|velocity| **velocity == Vec3::ZERO).count();
            see("stands still", still);
            see("moves", after.body.velocities.len() - still);
        }
        Kernel::SampleShapes => shapes(before, after, &mut see),
        Kernel::Collide => collide(before, after, &mut see),
        Kernel::MeasureExcess => {
            let above = after.polish_state.elongation_max;
            see("is above the target", usize::from(above > 0.0));
            let target = before.polish().target as f32;
            let at = |i: u32| positions[i as usize] + before.particles.velocities[i as usize] * before.settings.dt;
            let elongation = |l: &toile_model::Limit| (at(l.ends[1]) - at(l.ends[0])).length() / l.rest_length - 1.0;
            see("is not above it", before.model.limits.iter().filter(|l| elongation(l) <= target).count());
            see("has an end that is no number", before.model.limits.iter().filter(|l| elongation(l).is_nan()).count());
        }
        Kernel::GrantSweep => {
            let [old, new] = [&before.polish_state, &after.polish_state];
            see("grants a sweep", (new.further_sweeps - old.further_sweeps) as usize);
            see("misses the target", (new.missed_steps - old.missed_steps) as usize);
            see("holds the target", usize::from(old.elongation_max == 0.0));
        }
        Kernel::MoveParticles => {
            see("moves", particles().filter(|i| after.particles.positions[*i] != positions[*i]).count())
        }
        Kernel::ParticleNormals => {
            see("has no area", after.normals.iter().filter(|n| **n == Vec3::Y).count());
            see("has a normal", after.normals.iter().filter(|n| n.is_finite() && **n != Vec3::Y).count());
        }
        Kernel::ParticleStatus => {
            let velocities = &before.particles.velocities;
            see("has a position that is no number", positions.iter().filter(|p| p.is_nan()).count());
            see("has an infinite velocity", velocities.iter().filter(|v| !v.is_nan() && !v.is_finite()).count());
            see("is pinned", weights.iter().filter(|w| **w == 0.0).count());
            see("is counted", after.status.non_finite_count as usize);
        }
        Kernel::TotalEnergy => see("adds", before.energy_partials.len()),
        Kernel::LimitStatus => {
            see("is over-long", after.status.over_long_count as usize);
            see("is not over-long", before.model.limits.len() - after.status.over_long_count as usize);
            let at_rest = |l: &&toile_model::Limit| {
                let [a, b] = l.ends.map(|end| positions[end as usize]);
                (b - a).length() == l.rest_length
            };
            see("is at rest", before.model.limits.iter().filter(at_rest).count());
        }
        Kernel::LongestLimit => {
            let longest = after.status.longest_limit;
            see("is the longest", usize::from(longest > 0));
            see("is not the longest", before.model.limits.len() - 1);
        }
        Kernel::SeamStatus => {
            let gaps = before.model.seam_pairs.iter().map(|s| s.ends.map(|end| positions[end as usize]));
            see("is no number", gaps.filter(|[a, b]| (*b - *a).is_nan()).count());
            see("has a gap", usize::from(f32::from_bits(after.status.seam_gap_max) > 0.0));
        }
        Kernel::MergeParticles => {
            let sizes: Vec<usize> = particles().map(|i| before.members.row(i).len()).collect();
            see("stays alone", sizes.iter().filter(|size| **size == 1).count());
            see("has two members", sizes.iter().filter(|size| **size == 2).count());
            see("has more members", sizes.iter().filter(|size| **size > 2).count());
        }
        Kernel::CarryParticles => {
            see("touches a body", before.contacts.iter().filter(|contact| contact.touching).count());
            see("is turned", particles().filter(|i| changed(*i)).count());
        }
        Kernel::SetPins => {
            see("is held", before.pins.iter().filter(|pin| pin.is_held && pin.rate > 0.0).count());
            see("stands still", before.pins.iter().filter(|pin| pin.is_held && pin.rate == 0.0).count());
            see("is let go", before.pins.iter().filter(|pin| !pin.is_held).count());
        }
        // The saboteurs change each line of every kernel, and so tell of the others that the input reaches it.
        _ => {}
    }
}

/// Whether clusters of all sizes are there.
fn cluster_sizes(before: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let missing = |k: u32| before.model.clusters[k as usize].nodes.iter().filter(|node| **node == NO_CORNER).count();
    for (count, branch) in ["has four nodes", "has three nodes", "has two nodes"].into_iter().enumerate() {
        see(branch, before.span.clone().filter(|k| missing(*k) == count).count());
    }
}

/// Both ends of each limit of the colour.
fn limit_ends(before: &Input) -> Vec<[usize; 2]> {
    before.colour_limits().iter().map(|limit| limit.ends.map(|end| end as usize)).collect()
}

/// Both ends of limits or seam pairs.
fn ends(pairs: &[[usize; 2]], before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let [old, new] = [&before.particles, &after.particles];
    let moved = |i: usize| old.velocities[i] != new.velocities[i] || old.positions[i] != new.positions[i];
    let number = |i: usize| old.positions[i].is_finite() && old.velocities[i].is_finite();
    let pinned = |i: usize| old.inverse_masses[i] == 0.0;
    let select = |wanted: &dyn Fn(usize, usize) -> bool| {
        pairs.iter().filter(|[a, b]| number(*a) && number(*b) && wanted(*a, *b)).count()
    };
    see("changes both ends", select(&|a, b| moved(a) && moved(b)));
    see("changes neither", select(&|a, b| !pinned(a) && !pinned(b) && !moved(a) && !moved(b)));
    see("has its first end pinned", select(&|a, b| pinned(a) && moved(b) && !moved(a)));
    see("has its second end pinned", select(&|a, b| pinned(b) && moved(a) && !moved(b)));
    see("has both ends pinned", select(&|a, b| pinned(a) && pinned(b)));
    let broken = pairs.iter().filter(|pair| pair.iter().any(|i| old.positions[*i].is_nan()));
    see("has an end that is no number", broken.clone().count());
    for [a, b] in broken {
        let kept = |i: &usize| {
            old.velocities[*i].to_array().map(f32::to_bits) == new.velocities[*i].to_array().map(f32::to_bits)
        };
        assert!(kept(a) && kept(b), "an end that is no number does not spread along a limit");
    }
}

fn directional(before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let pairs = limit_ends(before);
    let [old, new] = [&before.particles, &after.particles];
    let moved = |i: usize| old.velocities[i] != new.velocities[i] && old.velocities[i].is_finite();
    let free = |i: usize| old.inverse_masses[i] > 0.0;
    let touching = |i: usize| before.contacts[i].touching;
    let select = |wanted: &dyn Fn(usize, usize) -> bool| pairs.iter().filter(|[a, b]| wanted(*a, *b)).count();
    let gravity = before.settings.gravity != Vec3::ZERO;
    see("averages", select(&|a, b| moved(a) && moved(b)));
    see("has the first end in the rear", select(&|a, b| free(b) && moved(a) && !moved(b)));
    see("has the second end in the rear", select(&|a, b| free(a) && moved(b) && !moved(a)));
    see("is not over-long", select(&|a, b| free(a) && free(b) && !moved(a) && !moved(b)));
    see("touches with both ends", select(&|a, b| touching(a) && touching(b)));
    see("touches with the first end", select(&|a, b| touching(a) && !touching(b)));
    see("touches with the second end", select(&|a, b| !touching(a) && touching(b)));
    see("has no direction", select(&|a, b| !gravity && !touching(a) && !touching(b) && moved(a) && moved(b)));
    see("has both ends pinned", select(&|a, b| !free(a) && !free(b)));
}

fn wind(before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let particles = &before.particles;
    let air = before.settings.wind.expect("the input has wind").velocity.as_vec3();
    let names = [
        "is a triangle in the wind",
        "is a quad in the wind",
        "turns its inside to the wind",
        "turns its outside to the wind",
        "flies with the wind",
        "has no area",
        "is no number",
    ];
    let mut counts = [0; 7];
    for (&[a, b, c, d], force) in before.model.quads.iter().zip(&after.quad_winds) {
        let corner = |i: u32| particles.positions[i as usize];
        let corners: Vec<u32> = [a, b, c, d].into_iter().filter(|i| *i != NO_CORNER).collect();
        let middle = corners.iter().map(|i| particles.velocities[*i as usize]).sum::<Vec3>() / corners.len() as f32;
        let end = if d == NO_CORNER { corner(c) - corner(a) } else { corner(d) - corner(b) };
        let start = if d == NO_CORNER { corner(b) - corner(a) } else { corner(c) - corner(a) };
        let area = start.cross(end);
        let through = (air - middle).dot(area);
        let pushed = *force != Vec3::ZERO;
        let happens = [
            pushed && d == NO_CORNER,
            pushed && d != NO_CORNER,
            pushed && through > 0.0,
            pushed && through < 0.0,
            !pushed && middle == air && air != Vec3::ZERO && area.length() > 0.0,
            !pushed && area == Vec3::ZERO,
            !pushed && (area.is_nan() || middle.is_nan()),
        ];
        counts.iter_mut().zip(happens).for_each(|(count, happens)| *count += usize::from(happens));
    }
    names.into_iter().zip(counts).for_each(|(name, count)| see(name, count));
}

fn sides(before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let maps = before.sides.sides();
    let map_box = maps.map_box;
    let [points, velocities] = before.points();
    let mut counts = [0; 8];
    for ((point, velocity), probe) in points.iter().zip(&velocities).zip(&after.probes) {
        let next = *point + *velocity * before.settings.dt;
        let column = ((next.x - map_box.origin_x) / map_box.texel).floor();
        let row = ((map_box.origin_y - next.y) / map_box.texel).floor();
        let [beside_x, beside_y] =
            [(column, map_box.columns), (row, map_box.rows)].map(|(i, n)| !(i >= 0.0 && i < n as f32));
        let texel = (row as usize * map_box.columns as usize + column as usize).min(maps.depth[0].len() - 1);
        let kind = match (beside_x || beside_y, probe.hit) {
            _ if next.is_nan() => 0,
            (true, _) if beside_x => 1,
            (true, _) => 2,
            (false, false) if maps.depth[0][texel] == 1.0 => 3,
            (false, false) => 4,
            (false, true) if probe.normal.z > 0.0 => 5,
            (false, true) => 6,
        };
        counts[kind] += 1;
        counts[7] += usize::from(((next.x - map_box.origin_x) / map_box.texel).fract() == 0.0);
    }
    let mut swept = before.settings.clone();
    swept.swept = true;
    let mut unswept = before.settings.clone();
    unswept.swept = false;
    let [with, without] = [swept, unswept]
        .map(|settings| toile_reference::step::sample_moving_sides(&points, &velocities, maps, before.lag, &settings));
    let differs = with.iter().zip(&without).filter(|(a, b)| a != b && a.distance.is_finite()).count();
    see("is answered where it enters", differs);
    let names = [
        "is no number",
        "is left or right of the maps",
        "is above or below the maps",
        "has a texel that sees nothing",
        "is before or behind the body",
        "is answered by the front",
        "is answered by the back",
        "is on the border of a texel",
    ];
    names.into_iter().zip(counts).for_each(|(name, count)| see(name, count));
}

fn layers(before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let maps = before.layers.layers();
    let [points, velocities] = before.points();
    let under = |axis: usize, point: Vec3| maps.column_under(axis, point).unwrap_or_default();
    let all = || points.iter().zip(&after.probes);
    see("is no number", points.iter().filter(|point| point.is_nan()).count());
    see("is beside all maps", points.iter().filter(|p| (0..3).all(|axis| under(axis, **p).end_count == 0)).count());
    for (name, axis) in [("meets a body along x", 0), ("meets a body along y", 1), ("meets a body along z", 2)] {
        see(name, points.iter().filter(|point| under(axis, **point).end_count > 0).count());
    }
    see("meets two bodies along z", points.iter().filter(|point| under(2, **point).end_count > 2).count());
    see("is inside", all().filter(|(_, probe)| probe.hit && probe.distance < -before.settings.thickness).count());
    see("is outside and near", all().filter(|(_, probe)| probe.hit && probe.distance > 0.0).count());
    see("is out of reach", all().filter(|(point, probe)| point.is_finite() && !probe.hit).count());
    let by_sheet = |point: Vec3, probe: &Probe| probe.hit && point.y > 0.28 && probe.normal.distance(Vec3::Y) < 1e-6;
    see("is answered by the sheet", all().filter(|(point, probe)| by_sheet(**point, probe)).count());
    let [swept, unswept] = [true, false]
        .map(|swept| with(before.settings.clone(), |step| step.swept = swept))
        .map(|settings| toile_reference::step::sample_moving_layers(&points, &velocities, maps, before.lag, &settings));
    let differs = swept.iter().zip(&unswept).filter(|(a, b)| a != b && a.distance.is_finite()).count();
    see("is answered where it enters", differs);
}

fn shapes(before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let [points, velocities] = before.points();
    let all = || 0..points.len();
    let kept = |i: &usize| before.after_maps && before.probes[*i].hit && same(&after.probes[*i], &before.probes[*i]);
    let answered = |i: &usize| after.probes[*i].hit && !kept(i);
    let near = |i: usize, probe: &Probe| {
        let approach = (velocities[i] - probe.velocity).dot(probe.normal);
        probe.distance + approach * before.settings.dt < before.settings.contact_margin
    };
    let reached = |i: &usize| answered(i) && near(*i, &after.probes[*i]);
    let inside = |i: &usize| {
        before
            .shapes
            .iter()
            .any(|shape| shape.kind == ShapeKind::Sphere && (points[*i] - shape.centre).length() < shape.radius)
    };
    see("is the centre", points.iter().filter(|p| **p == before.shapes[0].centre).count());
    see("is reached", all().filter(reached).count());
    see("is nearer than the maps", all().filter(|i| reached(i) && before.after_maps && before.probes[*i].hit).count());
    see("is farther than the maps", all().filter(|i| kept(i) && inside(i)).count());
    see("is not reached", all().filter(|i| answered(i) && !reached(i)).count());
    see("is no number", all().filter(|i| points[*i].is_nan() && !after.probes[*i].hit).count());
    see("is outside but comes near", all().filter(|i| reached(i) && !inside(i)).count());
    // What each shape alone would say.
    let alone: Vec<Vec<Probe>> = before
        .shapes
        .iter()
        .map(|shape| {
            let mut probes = vec![Probe::default(); points.len()];
            toile_reference::step::sample_shapes(&mut probes, &points, &velocities, &[*shape], &before.settings);
            probes
        })
        .collect();
    let equal = |i: &usize| {
        let answer = &after.probes[*i];
        alone
            .iter()
            .filter(|probes| probes[*i].hit && probes[*i].distance == answer.distance)
            .map(|probes| probes[*i])
            .collect::<Vec<_>>()
    };
    let passed_over = |i: &usize| {
        let answer = &after.probes[*i];
        alone.iter().any(|probes| probes[*i].hit && probes[*i].distance < answer.distance && !near(*i, &probes[*i]))
    };
    see("is reached by another than the nearest", all().filter(|i| reached(i) && passed_over(i)).count());
    let differ = |i: &usize, by: fn(&Probe) -> Vec3| equal(i).windows(2).any(|pair| by(&pair[0]) != by(&pair[1]));
    see("is as near to two shapes", all().filter(|i| reached(i) && differ(i, |probe| probe.normal)).count());
    see(
        "is at two shapes that move differently",
        all().filter(|i| reached(i) && !differ(i, |probe| probe.normal) && differ(i, |probe| probe.velocity)).count(),
    );
    let capsule = before.shapes.iter().position(|shape| shape.kind == ShapeKind::Capsule).expect("there is one");
    let by_capsule = |i: &usize| reached(i) && same(&after.probes[*i], &alone[capsule][*i]);
    let along = |i: &usize| {
        let shape = &before.shapes[capsule];
        (points[*i] - shape.centre).dot(shape.axis) / shape.axis.length_squared()
    };
    see("is reached by the side of a capsule", all().filter(|i| by_capsule(i) && along(i).abs() < 1.0).count());
    see("is reached by an end of a capsule", all().filter(|i| by_capsule(i) && along(i) > 1.0).count());
    see("is reached by its other end", all().filter(|i| by_capsule(i) && along(i) < -1.0).count());
    let cuboid = before.shapes.iter().position(|shape| shape.kind == ShapeKind::Box).expect("there is one");
    // How far beyond the core a point is along each axis of the box; below 0 within.
    let beyond = |i: usize| {
        let shape = &before.shapes[cuboid];
        let [right, up] = shape.turn;
        let from_centre = points[i] - shape.centre;
        (glam::vec3(right.dot(from_centre), up.dot(from_centre), right.cross(up).dot(from_centre)).abs() - shape.axis)
            .to_array()
    };
    for (what, axes) in [
        ("is reached within the core of a box", 0),
        ("is reached by a face of a box", 1),
        ("is reached by an edge of a box", 2),
        ("is reached by a corner of a box", 3),
    ] {
        let beside = |i: &usize| beyond(*i).into_iter().filter(|way| *way > 0.0).count() == axes;
        see(what, all().filter(|i| reached(i) && beside(i) && same(&after.probes[*i], &alone[cuboid][*i])).count());
    }
    let plane = before.shapes.iter().position(|shape| shape.kind == ShapeKind::Plane).expect("there is one");
    see("is reached by a plane", all().filter(|i| reached(i) && same(&after.probes[*i], &alone[plane][*i])).count());
    for order in
        [before.shapes.iter().rev().copied().collect::<Vec<_>>(), [&before.shapes[2..], &before.shapes[..2]].concat()]
    {
        let mut probes = if before.after_maps { before.probes.clone() } else { vec![Probe::default(); points.len()] };
        toile_reference::step::sample_shapes(&mut probes, &points, &velocities, &order, &before.settings);
        assert!(
            probes.iter().zip(&after.probes).all(|(one, other)| same(one, other)),
            "the order of the shapes does not matter"
        );
    }
}

fn collide(before: &Input, after: &Input, see: &mut impl FnMut(&'static str, usize)) {
    let settings = &before.settings;
    let papers = settings.law != toile_scene::Friction::Coulomb;
    let count = before.particle_count();
    let comes_near = |velocity: Vec3, probe: &Probe| {
        probe.hit
            && probe.distance + (velocity - probe.velocity).dot(probe.normal) * settings.dt < settings.contact_margin
    };
    let names = [
        "has no surface",
        "does not come near",
        "touches without approach",
        "is rubbed by the papers' law",
        "sticks by Coulomb's law",
        "slides by Coulomb's law",
        "is pushed out at once",
        "is pushed out at the largest speed",
        "has a normal that is no number",
        "collides with its quads",
        "is carried by its quads alone",
        "collides but is pinned",
    ];
    let mut counts = [0; 12];
    for i in 0..count {
        let [old, new] = [before.particles.velocities[i], after.particles.velocities[i]];
        let probe = &before.probes[i];
        let own = after.contacts[i].touching;
        assert!(own || after.contacts[i] == Contact::default(), "a contact ends when nothing is touched");
        let quads = before
            .model
            .particle_quads
            .row(i)
            .iter()
            .any(|q| comes_near(before.midpoints.velocities[*q as usize], &before.probes[count + *q as usize]));
        let pinned = before.particles.inverse_masses[i] == 0.0;
        let alone = own && !quads && !pinned && old.is_finite();
        let end = new - probe.velocity;
        let slip = (end - probe.normal * end.dot(probe.normal)).length();
        let way = (after.particles.positions[i] - before.particles.positions[i]).length();
        let longest = settings.push_speed * settings.dt;
        let happens = [
            !probe.hit,
            probe.hit && !own,
            alone && old == new,
            alone && old != new && papers,
            alone && old != new && !papers && slip < 1e-5,
            alone && old != new && !papers && slip > 1e-3,
            alone && way > 1e-5 && way < 0.99 * longest,
            alone && way > 0.99 * longest,
            probe.normal.is_nan() && !own,
            own && quads && !pinned,
            !own && quads && !pinned && old != new,
            own && pinned && same_bits(old, new),
        ];
        counts.iter_mut().zip(happens).for_each(|(count, happens)| *count += usize::from(happens));
    }
    names.into_iter().zip(counts).for_each(|(name, count)| see(name, count));
}

fn same(a: &Probe, b: &Probe) -> bool {
    a.hit == b.hit && a.distance.to_bits() == b.distance.to_bits() && same_bits(a.normal, b.normal)
}

fn same_bits(a: Vec3, b: Vec3) -> bool {
    a.to_array().map(f32::to_bits) == b.to_array().map(f32::to_bits)
}
