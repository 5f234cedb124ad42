// Each particle takes its own response and those of its quads, averaged over those that collided. D §6. Its own
// answer has the last word.
#import shared/item
#import shared/response
#import shared/contact

@group(0) @binding(2) var<storage, read> probes: array<Probe>;
@group(0) @binding(3) var<storage, read> responses: array<Response>;
@group(0) @binding(4) var<storage, read> particle_quad_offsets: array<u32>;
@group(0) @binding(5) var<storage, read> particle_quads: array<u32>;
@group(0) @binding(6) var<storage, read_write> positions: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> velocities: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> contacts: array<Contact>;

@compute @workgroup_size(64)
fn collide(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let position = positions[i];
    let velocity = velocities[i];
    let probe = probes[i];
    let own = respond(velocity.xyz, probe);
    var change = vec3<f32>(0.0);
    var push = vec3<f32>(0.0);
    var count = 0.0;
    var contact = Contact();
    if own.touching > 0.0 {
        change = own.change;
        push = own.push;
        count = 1.0;
        contact = Contact(probe.normal, 1.0, probe.velocity, 0.0);
    }
    let end = particle_quad_offsets[i + 1u];
    for (var k = particle_quad_offsets[i]; k < end; k++) {
        let response = responses[particle_quads[k]];
        if response.touching > 0.0 {
            change = change + response.change;
            push = push + response.push;
            count = count + 1.0;
        }
    }
    contacts[i] = contact;
    if count > 0.0 && position.w > 0.0 {
        var averaged = velocity.xyz + change / count;
        if own.touching > 0.0 {
            // The mean with its quads may still lead the particle into the body.
            averaged = averaged + respond(averaged, probe).change;
        }
        velocities[i] = vec4<f32>(averaged, velocity.w);
        positions[i] = vec4<f32>(position.xyz + push / count, position.w);
    }
}
