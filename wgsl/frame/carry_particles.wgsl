// The cloth goes along with a body that is set elsewhere at once: places are carried; velocities and what was touched are turned.
#import shared/item
#import shared/step_params
#import struct/Carry
#import struct/Contact
#import shared/particles writes positions velocities

@group(0) var<uniform> carry: Carry;
@group(0) var<storage, read_write> contacts: array<Contact>;

fn turned(v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(carry.row_x.xyz, v), dot(carry.row_y.xyz, v), dot(carry.row_z.xyz, v));
}

@compute @workgroup_size(64)
fn carry_particles(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    set_position(i, turned(position_of(i)) + vec3<f32>(carry.row_x.w, carry.row_y.w, carry.row_z.w));
    set_velocity(i, turned(velocity_of(i)));
    contacts[i].normal = turned(contacts[i].normal);
    contacts[i].velocity = turned(contacts[i].velocity);
}
