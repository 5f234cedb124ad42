// The coarse particles of a level take the places where the cloth will be after the coming move, and are shifted from there as much as
// those of the next coarser level that lead them. One level per dispatch, the coarsest first.
#import shared/item
#import shared/step_params
#import shared/span
#import struct/CoarseParticle
#import shared/leaders
#import shared/coarse writes places writes shifts
#import shared/particles reads positions velocities

@group(0) var<storage, read> coarse_particles: array<CoarseParticle>;

@compute @workgroup_size(64)
fn lead_coarse(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let item = item_index(id, groups);
    if item >= span.count {
        return;
    }
    let i = span.first + item;
    let coarse = coarse_particles[i];
    let place = position_of(coarse.site) + velocity_of(coarse.site) * step.dt;
    coarse_places[i] = vec4<f32>(place, coarse.inverse_mass);
    coarse_shifts[i] = vec4<f32>(led_by(step.particle_count + i), 0.0);
}
