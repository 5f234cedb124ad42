// Each particle answers its own contact and those of its quads, averaged over those that ask something of it; its own contact
// has the last word. A midpoint that would enter asks each corner for what that corner itself does towards the body, and for
// no more than would stop the midpoint alone: contacts bring no energy in. D §6, W eq. 15.
#import shared/item
#import shared/response
#import struct/Contact
#import struct/Midpoint
#import shared/particles writes positions velocities

@group(0) var<storage, read> midpoints: array<Midpoint>;
@group(0) var<storage, read_write> probes: array<Probe>;
@group(0) var<storage, read> particle_quad_offsets: array<u32>;
@group(0) var<storage, read> particle_quads: array<u32>;
@group(0) var<storage, read_write> contacts: array<Contact>;

// Corners of a quad: the share of a midpoint's motion that one corner can have alone.
const CORNER_COUNT: f32 = 4.0;

@compute @workgroup_size(64)
fn collide(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let velocity = velocity_of(i);
    let probe = probes[i];
    let touching = touches(velocity, probe);
    var sum = vec3<f32>(0.0);
    var count = 0.0;
    if touching {
        let gain = missing_speed(velocity, probe);
        if gain > 0.0 {
            sum = sum + change_by(gain, velocity, probe);
            count = count + 1.0;
        }
    }
    let end = particle_quad_offsets[i + 1u];
    for (var k = particle_quad_offsets[i]; k < end; k++) {
        let quad = particle_quads[k];
        let quad_probe = probes[step.particle_count + quad];
        let middle = midpoints[quad].velocity;
        if touches(middle, quad_probe) {
            let asked = CORNER_COUNT * missing_speed(middle, quad_probe);
            let gain = min(missing_speed(velocity, quad_probe), asked);
            if gain > 0.0 {
                sum = sum + change_by(gain, velocity, quad_probe);
                count = count + 1.0;
            }
        }
    }
    var contact = Contact();
    if touching {
        contact = Contact(probe.normal, 1.0, probe.velocity, 0.0);
    }
    contacts[i] = contact;
    if !(inverse_mass_of(i) > 0.0) {
        return;
    }
    var answered = velocity;
    if count > 0.0 {
        answered = answered + sum / count;
    }
    if touching {
        let gain = missing_speed(answered, probe);
        if gain > 0.0 {
            answered = answered + change_by(gain, answered, probe);
        }
        // The way out moves the particle but gives it no velocity, so that it does not bounce off.
        let way = min(max(-probe.distance, 0.0), step.push_speed * step.dt);
        set_position(i, position_of(i) + probe.normal * way);
        probes[i].distance = probe.distance + way;
    }
    set_velocity(i, answered);
}
