//! What the reference makes of an input.

use super::Input;
use toile::model::Arrays;
use toile_kernels::Kernel;
use toile_reference::{Probe, frame, maps, step};

/// Does to the input what the kernel does. There is no wildcard: a kernel without reference does not compile.
pub fn answer(kernel: Kernel, input: &mut Input) {
    let before = input.clone();
    let settings = &before.settings;
    let dt = settings.dt;
    let particles = &mut input.particles;
    match kernel {
        Kernel::SpringForces => input.forces = step::spring_forces(particles, &before.model.links, settings),
        Kernel::QuadWind => {
            let wind = settings.wind.as_ref().expect("the input has wind");
            input.quad_winds = step::quad_wind(particles, &before.model.quads, &before.model.particle_quads, wind, dt);
        }
        Kernel::WindForces => {
            step::wind_forces(&mut input.forces, &before.quad_winds, &before.model.quads, &before.model.particle_quads);
        }
        Kernel::PressureForces => {
            let pressure = settings.wind.expect("the input has wind").pressure as f32;
            let Arrays { quads, particle_quads, .. } = &before.model;
            step::pressure_forces(&mut input.forces, &particles.positions, quads, particle_quads, pressure);
        }
        Kernel::Reaction => step::reaction(&mut input.forces, particles, &before.contacts, settings),
        Kernel::Euler => step::euler(&mut particles.velocities, &before.forces, &before.particles.inverse_masses, dt),
        Kernel::HoldEdges => step::hold_edges(particles, &before.model.holds, &before.model.held_particles, settings),
        Kernel::DrawSeams => step::draw_seams(particles, before.colour_pairs(), dt),
        Kernel::CloseSeams => step::close_seams(particles, before.colour_pairs(), dt),
        Kernel::LimitZero => step::limit_zero(particles, before.colour_limits()),
        Kernel::LimitAverage => step::limit_average(particles, before.colour_limits()),
        Kernel::LimitDirectional => {
            step::limit_directional(particles, before.colour_limits(), Some(&before.contacts), settings);
        }
        Kernel::LimitSmallLevels => {
            step::limit_small_levels(&mut input.nodes, particles, &before.model, settings);
        }
        Kernel::LeadLevel => step::lead_level(&mut input.nodes, &before.span, particles, &before.model, dt),
        Kernel::LimitLevel => step::limit_level(&mut input.nodes, &before.model, &before.span, before.share),
        Kernel::ShiftVelocities => step::shift_velocities(particles, &before.nodes, &mut input.pulls, dt),
        Kernel::LimitAttachments => step::limit_attachments(particles, &before.model.attachments, dt),
        Kernel::WarmStart => step::warm_start(particles, &mut input.pulls),
        Kernel::LimitPredictive => {
            step::limit_predictive(particles, before.colour_limits(), &mut input.pulls, dt);
        }
        Kernel::LimitGuard => step::limit_guard(particles, &before.model, &before.span, before.share, settings),
        Kernel::KeepOut => step::keep_out(particles, &before.probes[..before.particles.positions.len()], settings),
        Kernel::LimitPosition => step::limit_position(particles, before.colour_limits()),
        Kernel::QuadMidpoints => {
            input.midpoints = step::quad_midpoints(&particles.positions, &particles.velocities, &before.model.quads);
        }
        Kernel::SampleSides => {
            let [positions, velocities] = before.points();
            input.probes = step::sample_sides(&positions, &velocities, before.sides.sides(), settings);
        }
        Kernel::SampleMovingSides => {
            let [positions, velocities] = before.points();
            input.probes =
                step::sample_moving_sides(&positions, &velocities, before.sides.sides(), before.lag, settings);
        }
        Kernel::MorphBody => {
            let body = &mut input.body;
            body.morphed_positions = before.skin.positions.clone();
            body.morphed_normals = before.skin.normals.clone();
            maps::morph_body(
                &mut body.morphed_positions,
                &mut body.morphed_normals,
                before.morphs(),
                &before.pose.morph_weights,
            );
        }
        Kernel::SkinBody => {
            let [positions, normals] = [&before.body.morphed_positions, &before.body.morphed_normals];
            let [positions, normals] = maps::skin_body(positions, normals, &before.skin, &before.pose.joints);
            input.body.positions = positions;
            input.body.normals = normals;
        }
        Kernel::GatherBody => {
            let (words, gather) = &before.host;
            let attribute =
                |first: u32, stride: u32| maps::Attribute { words, first: first as usize, stride: stride as usize };
            let motion = attribute(gather.first_motion, gather.motion_stride);
            let motion = match gather.is_last {
                1 => maps::HostMotion::LastPositions(motion),
                _ => maps::HostMotion::Velocities(motion),
            };
            let positions = attribute(gather.first_position, gather.position_stride);
            let normals = attribute(gather.first_normal, gather.normal_stride);
            let [positions, normals] =
                maps::gather_body(gather.count as usize, positions, normals, motion, gather.ahead);
            input.body.positions = positions;
            input.body.normals = normals;
        }
        Kernel::VertexVelocities => {
            input.body.velocities =
                maps::vertex_velocities(&before.body.last_positions, &before.body.positions, before.rate);
        }
        Kernel::SampleLayers => {
            let [positions, velocities] = before.points();
            input.probes = step::sample_layers(&positions, &velocities, before.layers.layers(), settings);
        }
        Kernel::SampleMovingLayers => {
            let [positions, velocities] = before.points();
            input.probes =
                step::sample_moving_layers(&positions, &velocities, before.layers.layers(), before.lag, settings);
        }
        Kernel::DrawLayers | Kernel::DrawMovingLayers | Kernel::SortLayers => {
            panic!("the maps are compared as a whole: columns come in no order")
        }
        Kernel::SampleShapes => {
            let [positions, velocities] = before.points();
            if !before.after_maps {
                input.probes.fill(Probe::default());
            }
            step::sample_shapes(&mut input.probes, &positions, &velocities, &before.shapes, settings);
        }
        Kernel::Collide => {
            let (particle_probes, quad_probes) = input.probes.split_at_mut(before.particle_count());
            let probes = step::Probes { particles: particle_probes, quads: quad_probes };
            input.contacts =
                step::collide(particles, &before.model.particle_quads, &before.midpoints, probes, settings);
        }
        Kernel::MeasureExcess => {
            let target = before.polish().target as f32;
            input.polish_state.elongation_max = step::measure_excess(particles, &before.model.limits, target, dt);
        }
        Kernel::GrantSweep => {
            let granted = step::grant_sweep(&mut input.polish_state, before.polish().sweeps);
            let nothing = vec![[0; 4]; before.sweep_workgroups.len()];
            input.sweep_dispatches = if granted { before.sweep_workgroups } else { nothing };
        }
        Kernel::MoveParticles => step::move_particles(&mut particles.positions, &before.particles.velocities, dt),
        Kernel::ParticleNormals => {
            input.normals =
                frame::particle_normals(&particles.positions, &before.model.quads, &before.model.particle_quads);
        }
        Kernel::ParticleStatus => {
            let status = frame::particle_status(particles);
            input.status.non_finite_count = status.non_finite_count;
            input.status.first_non_finite = status.first_non_finite.map_or(0, |first| u32::MAX - first);
            input.status.speed_max = status.speed_max.to_bits();
            input.energy_partials = status.energy_partials;
        }
        Kernel::TotalEnergy => input.status.kinetic_energy = frame::total_energy(&before.energy_partials),
        Kernel::LimitStatus => {
            let status = frame::limit_status(&particles.positions, &before.model.limits, settings.aim());
            input.status.elongation_max = status.elongation_max.to_bits();
            input.status.over_long_count = status.over_long_count;
        }
        Kernel::LongestLimit => {
            let longest = frame::longest_limit(&particles.positions, &before.model.limits);
            input.status.longest_limit = longest.map_or(0, |index| u32::MAX - index);
        }
        Kernel::SeamStatus => {
            input.status.seam_gap_max = frame::seam_status(&particles.positions, &before.model.seam_pairs).to_bits();
        }
        Kernel::MergeParticles => frame::merge_particles(&before.open, &before.members, particles),
        Kernel::CarryParticles => frame::carry_particles(particles, &mut input.contacts, before.carry),
        Kernel::SetPins => frame::set_pins(particles, &before.pins),
        Kernel::StateCopy => input.copies = frame::state_copy(particles),
    }
}
