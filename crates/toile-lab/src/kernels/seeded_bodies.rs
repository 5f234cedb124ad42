//! Seeded bodies: shapes, maps of meshes, skinned ones and those of a host, and particles where they are met.

use super::input::{Input, Posed};
use super::seeded::Variant;
use crate::{DrawnMaps, Gpu, Random, with};
use glam::{Vec3, Vec4, vec3};
use toile::gpu::{GpuError, MapSpace, Surface};
use toile::model::{MapBox, ShapeKind, ShapeStep};
use toile::scene::{Displacement, Influence, MapKind, Mesh, Morphs, Pose, Skin};
use toile_kernels::{Kernel, structs};

/// Middle between two shapes that mirror each other [m]; few digits, so that a point there is as far from both.
const MIRROR: Vec3 = vec3(-0.25, -0.5, 0.0);

/// Edge length of a texel of the maps [m].
const TEXEL: f32 = 0.031;

/// Heights of the open sheets in the layered maps [m].
const SHEETS: [f32; 2] = [0.3, 0.35];

/// Spheres: one alone, two that mirror each other, and four in one place that move differently; a capsule and a plane. Of those that are
/// equally near now an earlier one answers, now a later one.
pub(super) fn shapes(kernel: Kernel) -> Vec<ShapeStep> {
    let sphere = ShapeStep {
        kind: ShapeKind::Sphere,
        centre: vec3(0.1, 0.0, -0.05),
        radius: 0.35,
        velocity: vec3(0.5, 0.0, 0.2),
        spin: vec3(0.3, -1.0, 2.0),
        axis: Vec3::ZERO,
        turn: [Vec3::X, Vec3::Y],
    };
    let mirrored = [1.0, -1.0].map(|side| ShapeStep {
        centre: vec3(MIRROR.x + side * 0.125, MIRROR.y, MIRROR.z),
        radius: 0.2,
        velocity: Vec3::ZERO,
        ..sphere
    });
    let alike = [[0.0, 0.5], [0.2, 0.1], [0.2, 0.3], [0.2, 0.0]].map(|[y, z]| ShapeStep {
        centre: vec3(-0.4, 0.4, 0.3),
        radius: 0.15,
        velocity: vec3(0.3, y, z),
        spin: Vec3::ZERO,
        ..sphere
    });
    let capsule = ShapeStep {
        kind: ShapeKind::Capsule,
        centre: vec3(0.3, 0.35, 0.2),
        radius: 0.08,
        velocity: vec3(0.2, -0.4, 0.1),
        spin: vec3(-2.0, 1.0, 3.0),
        axis: vec3(0.15, 0.1, -0.2),
        ..sphere
    };
    let plane = ShapeStep {
        kind: ShapeKind::Plane,
        centre: vec3(0.1, -0.56, -0.05),
        radius: 0.004,
        velocity: vec3(0.3, 0.1, -0.2),
        spin: vec3(0.1, 0.4, -0.2),
        axis: vec3(0.1, 1.0, -0.15).normalize(),
        ..sphere
    };
    let turned = glam::Quat::from_axis_angle(vec3(0.6, 0.0, 0.8), 0.7);
    let rounded = ShapeStep {
        kind: ShapeKind::Box,
        centre: vec3(-0.3, -0.2, 0.1),
        radius: 0.05,
        velocity: vec3(-0.3, 0.2, 0.4),
        spin: vec3(1.5, -2.0, 0.7),
        axis: vec3(0.16, 0.1, 0.2),
        turn: [turned * Vec3::X, turned * Vec3::Y],
    };
    let others = [[sphere].as_slice(), &mirrored, &alike, &[capsule, plane]].concat();
    // Points are moved to shapes by their number, and those of other kernels stay.
    if kernel == Kernel::SampleShapes { [others, vec![rounded]].concat() } else { others }
}

/// Maps of either kind of two bodies, of which the front and the back see different ones, cut off by the box on every side; at rest or on
/// their way. The layered ones show two open sheets too, of which one goes through a body.
pub(super) fn maps(gpu: &Gpu, moving: bool) -> Result<[DrawnMaps; 2], GpuError> {
    let random = &mut Random::new(7);
    let [ball, block] = bodies();
    let corners = [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]];
    let sheets = Mesh {
        positions: SHEETS.iter().flat_map(|y| corners.map(|[x, z]| vec3(x, *y, z))).collect(),
        normals: vec![Vec3::Y; 8],
        triangles: vec![[0, 2, 1], [0, 3, 2], [4, 6, 5], [4, 7, 6]],
    };
    let map_box = MapBox::around([vec3(-0.4, -0.38, -0.45), vec3(0.28, 0.33, 0.25)], TEXEL);
    let surfaces = [&ball, &block, &sheets].map(|mesh| {
        let velocities: Vec<Vec4> = mesh.positions.iter().map(|_| random.vector(2.0).extend(0.0)).collect();
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE;
        let velocities = moving.then(|| gpu.upload(bytemuck::cast_slice(&velocities), usage));
        with(Surface::new(&gpu.device, mesh, TEXEL), |surface| surface.velocities = velocities)
    });
    let [ball, block, mut sheets] = surfaces;
    sheets.open = true;
    let mut space = MapSpace::new(MapKind::Sides, map_box, 6.0);
    space.moving = moving;
    let sides = DrawnMaps::draw_surfaces(gpu, &[(&ball, 0.005), (&block, 0.01)], &space)?;
    space.kind = MapKind::Layers;
    let layers = DrawnMaps::draw_surfaces(gpu, &[(&ball, 0.0), (&block, 0.0), (&sheets, 0.0)], &space)?;
    Ok([sides, layers])
}

fn bodies() -> [Mesh; 2] {
    [Mesh::sphere(vec3(-0.05, 0.0, 0.0), 0.4, 16), Mesh::cuboid(vec3(0.0, -0.45, -0.55), vec3(0.25, 0.1, -0.1))]
}

/// A body whose vertices hang on none to a few joints and are displaced by none to a few morph targets.
pub(super) fn body(random: &mut Random, vertices: u32) -> (Skin, Pose, Posed) {
    const JOINTS: u32 = 7;
    const TARGETS: u32 = 3;
    let vectors =
        |random: &mut Random, largest: f32| -> Vec<Vec3> { (0..vertices).map(|_| random.vector(largest)).collect() };
    let mut skin = Skin {
        positions: vectors(random, 1.0),
        normals: (0..vertices).map(|_| random.direction()).collect(),
        influence_offsets: vec![0],
        ..Skin::default()
    };
    let mut morphs = Morphs { offsets: vec![0], ..Morphs::default() };
    for vertex in 0..vertices {
        // A vertex on no joint has no matrix, and so a normal without length.
        let joints = if vertex % 40 == 9 { 0 } else { 1 + random.below(5) };
        skin.influences
            .extend((0..joints).map(|_| Influence { joint: random.below(JOINTS), weight: random.between(0.0, 1.0) }));
        skin.influence_offsets.push(skin.influences.len() as u32);
        let targets = random.below(TARGETS);
        morphs.displacements.extend((0..targets).map(|target| Displacement {
            target,
            position: random.vector(0.1),
            normal: random.vector(0.2),
        }));
        morphs.offsets.push(morphs.displacements.len() as u32);
    }
    skin.morphs = Some(morphs);
    let mut row = || random.vector(1.0).extend(0.3);
    let joints = (0..JOINTS).map(|_| [row(), row(), row()]).collect();
    let pose = Pose { joints, morph_weights: (0..TARGETS).map(|_| random.between(-0.5, 1.0)).collect() };
    let body = Posed {
        morphed_positions: vectors(random, 1.0),
        morphed_normals: (0..vertices).map(|_| random.direction()).collect(),
        last_positions: vectors(random, 1.0),
        positions: vectors(random, 1.0),
        normals: vec![Vec3::ZERO; vertices as usize],
        velocities: vec![Vec3::ZERO; vertices as usize],
    };
    (skin, pose, body)
}

/// Vertices of a body among other words of a host's buffer, each attribute with a stride of its own.
pub(super) fn host(random: &mut Random, count: u32, variant: Variant) -> (Vec<f32>, structs::Gather) {
    let gather = structs::Gather {
        count,
        first_position: 5,
        position_stride: 3,
        first_normal: 8 + 3 * count,
        normal_stride: 5,
        first_motion: 9 + 3 * count,
        motion_stride: 7,
        is_last: u32::from(variant == Variant::Papers),
        ahead: match variant {
            Variant::Coulomb => 0.01,
            Variant::Papers => -0.4,
            Variant::Weightless => 0.0,
        },
    };
    let mut words: Vec<f32> = (0..16 + 10 * count).map(|_| random.between(-1.0, 1.0)).collect();
    for vertex in (0..count).filter(|vertex| vertex % 40 == 9) {
        let first = (gather.first_normal + vertex * gather.normal_stride) as usize;
        words[first..first + 3].fill(0.0);
    }
    (words, gather)
}

/// Moves some points to the borders of the maps, the centres and the surfaces of the shapes, and to where there is no number.
pub(super) fn place_at_the_edges(random: &mut Random, input: &mut Input) {
    let map_box = input.sides.sides().map_box;
    let count = input.particle_count();
    for i in 0..count + input.midpoints.positions.len() {
        let (position, velocity) = if i < count {
            (&mut input.particles.positions[i], &mut input.particles.velocities[i])
        } else {
            (&mut input.midpoints.positions[i - count], &mut input.midpoints.velocities[i - count])
        };
        match i % 31 {
            5 => {
                // On a border between two texels, also the outermost ones.
                *velocity = Vec3::ZERO;
                position.x = map_box.origin_x + map_box.texel * random.below(map_box.columns + 1) as f32;
                position.y = map_box.origin_y - map_box.texel * random.below(map_box.rows + 1) as f32;
            }
            13 => *position = input.shapes[0].centre,
            // Through the bodies within one step.
            20 | 21 => *velocity = (vec3(0.0, 0.1, 0.0) - *position) * (random.between(0.3, 2.0) / input.settings.dt),
            // Just at a shape.
            17 | 24 => {
                let shape = input.shapes[random.below(input.shapes.len() as u32) as usize];
                let core = shape.centre + shape.axis * random.between(-1.2, 1.2).clamp(-1.0, 1.0);
                *position = core + random.direction() * (shape.radius + random.between(-0.01, 0.01));
            }
            // Through the ends and the sides of one within the step.
            27 | 28 => {
                let shape = input.shapes[random.below(input.shapes.len() as u32) as usize];
                let core = |random: &mut Random| shape.centre + shape.axis * random.between(-1.3, 1.3);
                *position = core(random) + random.direction() * (shape.radius * random.between(1.1, 2.5));
                *velocity =
                    shape.velocity + (core(random) - *position) * (random.between(0.5, 2.0) / input.settings.dt);
            }
            // Before an end of one with a direction, and into that end.
            29 => {
                let mut ended = input.shapes.iter().filter(|shape| shape.kind == ShapeKind::Capsule);
                let shape = ended.next().expect("there is a capsule");
                let end = shape.axis + shape.axis.normalize() * (shape.radius * random.between(1.05, 1.4));
                *position = shape.centre + end + random.vector(1.5 * shape.radius);
                let way = shape.centre + shape.axis - *position;
                *velocity = shape.velocity + way * (random.between(0.3, 1.5) / input.settings.dt);
            }
            // As near to two of them.
            9 => *position = vec3(MIRROR.x, MIRROR.y, MIRROR.z + random.between(-0.1, 0.1)),
            _ => {}
        }
    }
}

/// Moves some points to the open sheets.
pub(super) fn place_at_the_sheets(random: &mut Random, input: &mut Input) {
    for i in (3..input.particle_count()).step_by(9) {
        input.particles.positions[i].y = SHEETS[random.below(2) as usize] + random.between(-0.03, 0.03);
        input.particles.velocities[i] *= 0.1;
    }
}
