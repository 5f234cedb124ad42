//! Seeded input of any size that leads into every branch of a kernel.

use super::input::Input;
use super::seeded_bodies::{body, host, maps, place_at_the_edges, place_at_the_sheets, shapes};
use super::seeded_levels::{BESIDE, levels};
use crate::fixtures::free_particle;
use crate::{DrawnMaps, Gpu, Random, with};
use glam::{DVec3, Mat4, Quat, Vec3, Vec4, dvec3, vec3};
use toile::gpu::GpuError;
use toile::model::{Arrays, Attachment, Csr, Hold, Limit, Link, NO_CORNER, PinTarget, SeamPair, StepSettings};
use toile::scene::{Fabric, Friction, Polish, Settings, Wind};
use toile_kernels::{Domain, Kernel, TABLE};
use toile_reference::step::PolishState;
use toile_reference::{Contact, Lag, Midpoints, Particles, Probe, frame};

/// What the numbers of a step are: together these lead into every branch that the settings decide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Coulomb friction, everything on.
    Coulomb,
    /// The papers' friction, and another wind.
    Papers,
    /// No gravity, and the shapes alone.
    Weightless,
}

/// All of them.
pub const VARIANTS: [Variant; 3] = [Variant::Coulomb, Variant::Papers, Variant::Weightless];

/// Velocity of the air [m/s]; few digits, so that the mean of four such velocities is exact.
const WIND: DVec3 = dvec3(1.5, 0.25, -2.0);

/// How many of each thing there are.
struct Counts {
    particles: u32,
    quads: u32,
    /// Limits or seam pairs of the colour, and of colours before and after it.
    pairs: u32,
    others: u32,
    partials: u32,
    holds: u32,
}

/// Maps that the input of the kernels looks into.
#[derive(Debug)]
pub struct Seeds {
    seed: u64,
    still: [DrawnMaps; 2],
    moving: [DrawnMaps; 2],
}

impl Seeds {
    /// Draws the maps. Another seed gives other numbers everywhere else.
    ///
    /// # Errors
    /// [`GpuError`] when the device is lost.
    pub fn new(gpu: &Gpu, seed: u64) -> Result<Self, GpuError> {
        Ok(Self { seed, still: maps(gpu, false)?, moving: maps(gpu, true)? })
    }

    /// Input on which `kernel` works on `items` items.
    pub fn input(&self, kernel: Kernel, items: u32, variant: Variant) -> Input {
        // By its name, not its place in the table: a new kernel leaves the input of all others as it is.
        let name = kernel.name().bytes().fold(0u64, |sum, byte| sum.wrapping_mul(31).wrapping_add(u64::from(byte)));
        let random = &mut Random::new((self.seed << 40) ^ (u64::from(items) << 16) ^ (name << 4) ^ variant as u64);
        let domain = TABLE.iter().find(|row| row.kernel == kernel).expect("every kernel has a row").domain;
        let counts = counts(domain, items);
        let settings = step_settings(variant);
        let contacts: Vec<Contact> = (0..counts.particles).map(|_| contact(random)).collect();
        let particles = particles(random, &contacts);
        let (mut span, limits, seam_pairs) = pairs(random, &particles, &counts, domain);
        let levels = levels(random, kernel, &particles, items, settings.dt);
        match domain {
            // The first are particles, the others coarse ones.
            Domain::LevelNode => span = counts.particles - items / 2..counts.particles - items / 2 + items,
            Domain::LevelCluster | Domain::GuardedCluster => span = BESIDE..BESIDE + items,
            _ => {}
        }
        let quads = quads(random, &counts);
        let midpoints = Midpoints {
            positions: (0..counts.quads).map(|_| random.vector(0.6)).collect(),
            velocities: (0..counts.quads).map(|_| random.vector(2.0)).collect(),
        };
        let (open, members) = open_particles(random, counts.particles);
        let (holds, held_particles) = holds(random, &particles, counts.holds);
        let (skin, pose, body) = body(random, if domain == Domain::Vertex { items } else { 1 });
        let moving = matches!(kernel, Kernel::SampleMovingSides | Kernel::SampleMovingLayers);
        let [sides, layers] = if moving { &self.moving } else { &self.still };
        let mut input = Input {
            // Holds take a whole workgroup.
            invocations: match domain {
                Domain::Hold => 64 * items,
                Domain::Workgroup => 64,
                _ => items,
            },
            shapes: shapes(kernel),
            after_maps: variant != Variant::Weightless,
            lag: Lag::of(3, 8, settings.dt),
            sides: sides.clone(),
            layers: layers.clone(),
            host: host(
                &mut Random::new(!self.seed ^ u64::from(items) ^ 2),
                if domain == Domain::Vertex { items } else { 1 },
                variant,
            ),
            rate: if variant == Variant::Weightless { 0.0 } else { 120.0 },
            // Of numbers of its own, so that those of all other kernels stay.
            carry: carry(&mut Random::new(!self.seed ^ u64::from(items))),
            pins: pins(&mut Random::new(!self.seed ^ u64::from(items)), items),
            open,
            members,
            copies: particles.clone(),
            quad_winds: (0..counts.quads).map(|_| random.vector(0.02)).collect(),
            forces: (0..counts.particles).map(|i| force(random, i, &contacts[i as usize])).collect(),
            pulls: pulls(&mut Random::new(!self.seed ^ u64::from(items) ^ 1), counts.particles),
            model: with(Arrays::default(), |arrays| {
                arrays.positions = particles.positions.clone();
                arrays.masses = particles.masses.clone();
                arrays.links = links(random, counts.particles);
                arrays.attachments = attachments(random, &particles);
                arrays.particle_quads = particle_quads(random, &counts);
                arrays.limits = limits;
                arrays.seam_pairs = seam_pairs;
                arrays.inverse_masses = particles.inverse_masses.clone();
                arrays.coarse_particles = levels.coarse_particles;
                arrays.levels = levels.levels;
                arrays.guard_lengths = levels.clusters.iter().map(|cluster| cluster.max_lengths).collect();
                arrays.clusters = levels.clusters;
                arrays.leaders = levels.leaders;
                arrays.holds = holds;
                arrays.held_particles = held_particles;
                arrays.quads = quads;
            }),
            span,
            nodes: levels.nodes,
            share: if variant == Variant::Weightless { 1.0 } else { 1.5 },
            midpoints,
            probes: (0..counts.particles + counts.quads).map(|_| probe(random)).collect(),
            contacts,
            normals: vec![Vec3::ZERO; counts.particles as usize],
            energy_partials: (0..counts.partials).map(|_| random.between(0.0, 1e-3)).collect(),
            polish_state: polish_state(kernel, variant),
            sweep_workgroups: (0..counts.partials).map(|k| [1 + k % 7, 1 + k % 3, 1, 0]).collect(),
            sweep_dispatches: vec![[9; 4]; counts.partials as usize],
            status: Default::default(),
            settings,
            particles,
            skin,
            pose,
            body,
        };
        input.copies.positions.fill(Vec3::ZERO);
        input.copies.velocities.fill(Vec3::ZERO);
        place_at_the_edges(random, &mut input);
        if matches!(kernel, Kernel::SampleLayers | Kernel::SampleMovingLayers) {
            place_at_the_sheets(random, &mut input);
        }
        if kernel == Kernel::LimitAttachments {
            // What the host has let go holds nothing, and so would most of them, which are any particles.
            for attachment in input.model.attachments.values.iter().filter(|attachment| attachment.pin % 2 == 0) {
                input.particles.inverse_masses[attachment.pin as usize] = 0.0;
            }
        }
        if kernel == Kernel::LongestLimit {
            let status = frame::limit_status(&input.particles.positions, &input.model.limits, input.settings.aim());
            input.status.elongation_max = status.elongation_max.to_bits();
        }
        if kernel == Kernel::SeamStatus && variant == Variant::Coulomb {
            let gap = |pair: &SeamPair| {
                let [a, b] = pair.ends.map(|end| input.particles.positions[end as usize]);
                // What is no number comes last.
                a.distance(b).max(0.0)
            };
            // The first is the widest.
            input.model.seam_pairs.sort_by(|one, other| gap(other).total_cmp(&gap(one)));
        }
        if kernel == Kernel::MeasureExcess {
            // An infinite elongation would be the largest, whatever the kernel does.
            input.particles.velocities.iter_mut().filter(|v| !v.is_finite()).for_each(|v| *v = Vec3::ZERO);
        }
        carry_by_the_wind(&mut input);
        input
    }
}

/// Rows of a rigid transform.
fn carry(random: &mut Random) -> [Vec4; 3] {
    let turn = Quat::from_axis_angle(random.direction(), random.between(0.5, 3.0));
    let matrix = Mat4::from_rotation_translation(turn, random.vector(2.0));
    [0, 1, 2].map(|row| matrix.row(row))
}

/// Every second particle, held or let go; some have no time for their way.
fn pins(random: &mut Random, count: u32) -> Vec<PinTarget> {
    let pin = |index: u32| {
        let (particle, position, seconds) = (2 * index, random.vector(0.6), f64::from(random.between(0.001, 0.1)));
        match index % 4 {
            1 => PinTarget::free(particle),
            2 => PinTarget::still(particle),
            _ => PinTarget::held(particle, position, seconds),
        }
    };
    (0..count).map(pin).collect()
}

/// None to four quads of each particle, whatever their corners.
fn particle_quads(random: &mut Random, counts: &Counts) -> Csr<u32> {
    Csr::from_rows((0..counts.particles).map(|_| {
        let row = if counts.quads == 0 { 0 } else { random.below(5) };
        (0..row).map(|_| random.below(counts.quads)).collect::<Vec<_>>()
    }))
}

fn counts(domain: Domain, items: u32) -> Counts {
    let few = items / 2 + 3;
    let none = Counts { particles: items, quads: few, pairs: 5, others: 2, partials: items.div_ceil(64), holds: 1 };
    match domain {
        Domain::Particle => none,
        Domain::Quad => Counts { particles: items + 8, quads: items, ..none },
        Domain::Point => Counts { particles: items - items / 3, quads: items / 3, ..none },
        Domain::Hold => Counts { particles: 4 * items + 200, holds: items, ..none },
        // Kernels over all pairs take the length of the array; those over a colour take its span.
        Domain::Limit | Domain::SeamPair => Counts { particles: 2 * items + 4, pairs: items, others: 0, ..none },
        Domain::LimitColour | Domain::SeamColour => {
            Counts { particles: 2 * items + 4, pairs: items, others: 2, ..none }
        }
        Domain::LevelNode => none,
        Domain::LevelCluster => Counts { particles: 2 * items + 4, ..none },
        Domain::GuardedCluster => Counts { particles: 4 * items + 4, ..none },
        Domain::Pin => Counts { particles: 2 * items, ..none },
        Domain::Workgroup => Counts { partials: items, particles: items + 8, ..none },
        Domain::Vertex => Counts { particles: 1, ..none },
        Domain::TrianglePart | Domain::Column => panic!("maps are drawn of whole bodies"),
    }
}

/// Before a decision: a spring above the target in a step that may have more sweeps, in one that may not, and none.
fn polish_state(kernel: Kernel, variant: Variant) -> PolishState {
    let counted = PolishState { further_sweeps: 11, missed_steps: 5, ..PolishState::default() };
    match (kernel, variant) {
        (Kernel::GrantSweep, Variant::Coulomb) => PolishState { elongation_max: 0.2, granted: 2, ..counted },
        (Kernel::GrantSweep, Variant::Papers) => PolishState { elongation_max: 0.2, granted: 3, ..counted },
        (Kernel::GrantSweep, Variant::Weightless) => PolishState { granted: 2, ..counted },
        _ => counted,
    }
}

fn step_settings(variant: Variant) -> StepSettings {
    let cotton = Fabric::preset("cotton").expect("cotton is a preset");
    let mut step = StepSettings::new(&Settings::new(cotton), &free_particle());
    step.dt = 1.0 / 700.0;
    step.damping = 0.7;
    step.wind = Some(air(WIND, variant));
    step.push_speed = 1.5;
    step.pressing = 200.0;
    step.sweeps = 1;
    step.polish = Some(Polish { target: 0.1, sweeps: 3 });
    step.contact_margin = 1e-3;
    step.friction = 0.8;
    step.hold_rate = 10.0;
    step.hold_speed = 0.5;
    step.swept = true;
    match variant {
        Variant::Coulomb => {
            step.law = Friction::Coulomb;
            step.reflection = 0.0;
        }
        Variant::Papers => {
            step.law = Friction::Papers { velocity_kept: 0.7, force_removed: 0.4 };
            step.reflection = 0.3;
            step.gravity = vec3(0.3, -9.81, 0.1);
            step.wind = Some(air(-4.0 * WIND, variant));
        }
        Variant::Weightless => {
            step.gravity = Vec3::ZERO;
            step.wind = Some(Wind::new(DVec3::ZERO));
            step.law = Friction::Coulomb;
            step.reflection = 0.1;
            step.swept = false;
        }
    }
    step
}

/// Air of which every number is other than zero.
fn air(velocity: DVec3, variant: Variant) -> Wind {
    let random = &mut Random::new(variant as u64);
    let mut wind = Wind::new(velocity);
    for number in Wind::NUMBERS {
        *(number.of)(&mut wind) = f64::from(random.between(0.4, 1.7));
    }
    wind
}

fn contact(random: &mut Random) -> Contact {
    if random.one_in(2) {
        return Contact::default();
    }
    let velocity = if random.one_in(4) { Vec3::ZERO } else { random.vector(0.5) };
    Contact { normal: random.direction(), velocity, touching: true }
}

fn particles(random: &mut Random, contacts: &[Contact]) -> Particles {
    let mut particles = Particles::default();
    for (i, contact) in contacts.iter().enumerate() {
        let mass = random.between(5e-4, 2e-3);
        particles.positions.push(match i % 50 {
            7 => particles.positions[i - 1],
            _ => random.vector(0.6),
        });
        // Some are carried by what they touch, so that friction can hold them.
        particles.velocities.push(match i % 5 {
            2 => contact.velocity,
            _ => random.vector(2.0),
        });
        particles.masses.push(mass);
        particles.inverse_masses.push(if random.one_in(8) { 0.0 } else { 1.0 / mass });
    }
    for i in (41..contacts.len()).step_by(97) {
        particles.positions[i].y = f32::NAN;
    }
    for i in (29..contacts.len()).step_by(211) {
        particles.velocities[i].z = f32::INFINITY;
    }
    particles
}

fn force(random: &mut Random, i: u32, contact: &Contact) -> Vec3 {
    // Straight onto the surface: nothing is left to rub.
    if i % 5 == 2 && random.one_in(4) { contact.normal * -0.01 } else { random.vector(0.05) }
}

fn links(random: &mut Random, particles: u32) -> Csr<Link> {
    Csr::from_rows((0..particles).map(|i| {
        let count = if particles < 2 { 0 } else { random.below(9) };
        let other = |random: &mut Random| match (i % 50, random.one_in(3)) {
            (7, true) => i - 1,
            _ => (i + 1 + random.below(particles - 1)) % particles,
        };
        let link = |random: &mut Random| Link {
            other: other(random),
            rest_length: random.between(0.01, 0.5),
            stiffness: random.between(1.0, 50.0),
        };
        (0..count).map(|_| link(random)).collect::<Vec<_>>()
    }))
}

/// Nothing, or some.
fn pulls(random: &mut Random, count: u32) -> Vec<Vec3> {
    (0..count).map(|_| if random.one_in(3) { Vec3::ZERO } else { random.vector(0.4) }).collect()
}

/// Distances from other particles, a little more or less than they are.
fn attachments(random: &mut Random, particles: &Particles) -> Csr<Attachment> {
    let count = particles.positions.len() as u32;
    Csr::from_rows((0..count).map(|i| {
        let attachment = |random: &mut Random| {
            let pin = random.below(count);
            let distance = particles.positions[i as usize].distance(particles.positions[pin as usize]);
            let max_length = if distance > 0.0 { distance * random.between(0.9, 1.2) } else { 0.1 };
            Attachment { pin, max_length }
        };
        (0..random.below(4)).map(|_| attachment(random)).collect::<Vec<_>>()
    }))
}

/// Disjoint pairs as limits and as seam pairs, with others before and after the span of the colour.
fn pairs(
    random: &mut Random,
    particles: &Particles,
    counts: &Counts,
    domain: Domain,
) -> (std::ops::Range<u32>, Vec<Limit>, Vec<SeamPair>) {
    let order = random.shuffled(counts.particles);
    let count = if matches!(domain, Domain::Limit | Domain::LimitColour | Domain::SeamPair | Domain::SeamColour) {
        counts.pairs
    } else {
        0
    };
    let mut limits = Vec::new();
    let mut seam_pairs = Vec::new();
    for k in 0..if counts.particles < 2 { 0 } else { count + 2 * counts.others } {
        let inside = (counts.others..counts.others + count).contains(&k);
        // Those of other colours may share particles: nothing may touch them.
        let ends = if inside {
            [order[2 * (k - counts.others) as usize], order[2 * (k - counts.others) as usize + 1]]
        } else {
            [order[0], order[1]]
        };
        let [a, b] = ends.map(|end| particles.positions[end as usize]);
        let distance = (b - a).length();
        let rest_length = match k % 9 {
            5 if distance > 0.0 => distance,
            _ if distance > 0.0 => distance * random.between(0.7, 1.3),
            _ => 0.1,
        };
        let max_length = match k % 9 {
            // Exactly as long as it may be.
            4 if distance > 0.0 => distance,
            _ => 1.05 * rest_length,
        };
        limits.push(Limit { ends, rest_length, max_length });
        let closing_speed = if random.one_in(3) { 1000.0 } else { random.between(0.0, 2.0) };
        seam_pairs.push(SeamPair { ends, closing_speed, seam: 0 });
    }
    (counts.others..counts.others + count, limits, seam_pairs)
}

/// Holds of one to a few particles, and some of more than a workgroup has invocations.
fn holds(random: &mut Random, particles: &Particles, count: u32) -> (Vec<Hold>, Vec<u32>) {
    let order = random.shuffled(particles.positions.len() as u32);
    let mut holds: Vec<Hold> = Vec::new();
    for left in (0..count).rev() {
        let first = holds.last().map_or(0, |hold| hold.particles.end);
        let wanted = if random.one_in(40) { 20 + random.below(130) } else { 1 + random.below(3) };
        let end = first + wanted.min(order.len() as u32 - first - left);
        let members = &order[first as usize..end as usize];
        let mean = members.iter().map(|i| particles.positions[*i as usize].y).sum::<f32>() / members.len() as f32;
        holds.push(Hold { label: String::new(), particles: first..end, height: mean + random.between(-0.1, 0.1) });
    }
    (holds, order)
}

fn quads(random: &mut Random, counts: &Counts) -> Vec<[u32; 4]> {
    (0..counts.quads)
        .map(|k| {
            let mut corner = || random.below(counts.particles);
            let [a, b, c, d] = [corner(), corner(), corner(), corner()];
            [a, b, c, if k % 4 == 1 { NO_CORNER } else { d }]
        })
        .collect()
}

fn probe(random: &mut Random) -> Probe {
    if random.one_in(6) {
        return Probe::default();
    }
    let normal = if random.one_in(60) { Vec3::splat(f32::NAN) } else { random.direction() };
    let distance = random.between(-0.004, 0.004);
    Probe { normal, distance, velocity: random.vector(0.5), hit: true }
}

/// Twice as many open particles as sewn ones, joined in groups of one to a few.
fn open_particles(random: &mut Random, sewn: u32) -> (Particles, Csr<u32>) {
    let count = 2 * sewn;
    let nothing = vec![Contact::default(); count as usize];
    let open = particles(random, &nothing);
    let mut rows: Vec<Vec<u32>> = random.shuffled(count)[..sewn as usize].iter().map(|i| vec![*i]).collect();
    let taken: Vec<u32> = rows.iter().flatten().copied().collect();
    for i in (0..count).filter(|i| !taken.contains(i)) {
        rows[random.below(sewn) as usize].push(i);
    }
    rows.iter_mut().for_each(|row| row.sort_unstable());
    (open, Csr::from_rows(rows))
}

/// Lets some quads fly with the air.
fn carry_by_the_wind(input: &mut Input) {
    let velocity = input.settings.wind.expect("the input has wind").velocity.as_vec3();
    for corners in input.model.quads.iter().skip(2).step_by(40) {
        for corner in corners.iter().filter(|corner| **corner != NO_CORNER) {
            input.particles.velocities[*corner as usize] = velocity;
        }
    }
}
