// What a body answers to the force that presses a particle onto it. W §5, eq. 16.
#import shared/item
#import shared/step_params
#import struct/Contact
#import shared/particles reads positions velocities

@group(0) var<storage, read> contacts: array<Contact>;
@group(0) var<storage, read_write> forces: array<vec4<f32>>;

@compute @workgroup_size(64)
fn reaction(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let contact = contacts[i];
    let inverse_mass = inverse_mass_of(i);
    if !(contact.touching > 0.0) || !(inverse_mass > 0.0) {
        return;
    }
    let force = forces[i].xyz;
    let normal_force = dot(force, contact.normal);
    // A force away from the body is not held back: cloth does not stick.
    if !(normal_force < 0.0) {
        return;
    }
    var tangential = force - contact.normal * normal_force;
    if step.friction_law == COULOMB {
        let relative = velocity_of(i) - contact.velocity;
        let rate = step.dt * inverse_mass;
        let sliding = (relative - contact.normal * dot(relative, contact.normal)) + tangential * rate;
        let speed = length(sliding);
        if speed > 0.0 {
            let removed = min(((step.friction * -normal_force) * step.dt) * inverse_mass, speed);
            tangential = tangential - sliding * (removed / (speed * rate));
        }
    } else {
        tangential = tangential * (1.0 - step.force_removed);
    }
    forces[i] = vec4<f32>(tangential, 0.0);
}
