//! Where the last bit decides: a device that works in another order than the reference would give another answer.

use crate::kernels::{Case, input};
use glam::{Vec2, Vec3, vec3};
use toile_kernels::Kernel;
use toile_lab::Random;
use toile_lab::kernels::{Compiled, Input, Variant};
use toile_model::{CLUSTER_PAIRS, Cluster, NO_CORNER};
use toile_workspace::gpu;

fn agrees(kernel: Kernel, input: Input) {
    let compiled = Compiled::new(gpu(), kernel, &kernel.source()).expect("the kernel compiles");
    assert_eq!(Case::new(kernel, input).difference(gpu(), &compiled), None, "{}", kernel.name());
}

/// Particles that dive into the surfaces; the middle of the way of each lies on a corner of four texels, as exactly as its start can be
/// written.
fn dive_through_corners() -> Input {
    let mut input = input(Kernel::SampleSides, 1757, Variant::Coulomb);
    let random = &mut Random::new(1);
    let (maps, dt) = (input.sides.sides().clone(), input.settings.dt);
    let map_box = maps.map_box;
    let seen: Vec<usize> = (0..maps.depth[0].len()).filter(|texel| maps.depth[0][*texel] < 1.0).collect();
    for (position, velocity) in input.particles.positions.iter_mut().zip(&mut input.particles.velocities) {
        let texel = seen[random.below(seen.len() as u32) as usize];
        let columns = map_box.columns as usize;
        let corner = Vec2::new((texel % columns) as f32, (texel / columns) as f32) * map_box.texel;
        let surface = map_box.z_front - maps.depth[0][texel] * (map_box.z_front - map_box.z_back);
        let middle = vec3(map_box.origin_x + corner.x, map_box.origin_y - corner.y, surface - 0.2 * map_box.texel);
        // Longer than one texel and at most two: the middle is the one place that is tested before the end.
        let sideways = random.between(0.8, 1.1) * map_box.texel;
        let across = if random.one_in(2) { sideways } else { -sideways };
        let way = vec3(across, random.between(0.8, 1.1) * map_box.texel, random.between(-4.0, -1.0) * map_box.texel);
        *position = middle - way * 0.5;
        *velocity = way / dt;
    }
    input
}

#[test]
fn ways_over_the_corners_of_texels_agree() {
    agrees(Kernel::SampleSides, dive_through_corners());
}

/// Clusters like those of worn cloth: almost flat, a little too long, and of uneven masses.
fn worn_clusters() -> Input {
    let mut input = input(Kernel::LimitLevel, 500, Variant::Coulomb);
    let random = &mut Random::new(2);
    input.nodes.shifts.fill(Vec3::ZERO);
    input.nodes.inverse_masses.iter_mut().for_each(|weight| *weight = random.between(5e3, 15e3));
    for cluster in input.span.clone().map(|cluster| cluster as usize) {
        for (node, corner) in
            input.model.clusters[cluster].nodes.into_iter().zip([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])
        {
            if node != NO_CORNER {
                let place = vec3(0.0303 * corner[0], 0.9 + 0.0303 * corner[1], -0.1);
                input.nodes.places[node as usize] = place + random.vector(0.002);
            }
        }
        let Cluster { nodes, max_lengths } = &mut input.model.clusters[cluster];
        for ((length, pair), wanted) in
            max_lengths.iter_mut().zip(CLUSTER_PAIRS).zip([0.0424, 0.0424, 0.03, 0.03, 0.03, 0.03])
        {
            *length = if pair.iter().any(|corner| nodes[*corner] == NO_CORNER) { f32::INFINITY } else { wanted };
        }
    }
    input
}

#[test]
fn clusters_of_worn_cloth_agree() {
    agrees(Kernel::LimitLevel, worn_clusters());
}

/// Pairs of a seam that lie on one another and part so slowly that the squares of their ways are denormal numbers, or nothing.
fn shut_seams(kernel: Kernel) -> Input {
    let mut input = input(kernel, 1757, Variant::Coulomb);
    let random = &mut Random::new(3);
    for pair in &input.model.seam_pairs {
        let [a, b] = pair.ends.map(|end| end as usize);
        input.particles.positions[b] = input.particles.positions[a];
        input.particles.velocities[a] = Vec3::ZERO;
        let speed = 10.0f32.powf(random.between(-24.0, -12.0));
        input.particles.velocities[b] = random.vector(speed);
    }
    input
}

#[test]
fn seams_that_are_shut_agree_on_drivers_that_flush_denormal_numbers() {
    for kernel in [Kernel::DrawSeams, Kernel::CloseSeams] {
        agrees(kernel, shut_seams(kernel));
    }
}
