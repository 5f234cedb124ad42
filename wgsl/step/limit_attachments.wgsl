// Rule Hierarchical where the cloth is pinned: what would take a particle farther from a pin in the coming move than the cloth
// between them is long is removed from its velocity. Kim, Chentanez and Müller 2012. Pins stay where they are.
#import shared/item
#import shared/step_params
#import struct/Attachment

@group(0) @binding(2) var<storage, read> attachment_offsets: array<u32>;
@group(0) @binding(3) var<storage, read> attachments: array<Attachment>;
@group(0) @binding(4) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn limit_attachments(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let position = positions[i];
    if !(position.w > 0.0) {
        return;
    }
    var velocity = velocities[i];
    let end = attachment_offsets[i + 1u];
    for (var k = attachment_offsets[i]; k < end; k++) {
        let attachment = attachments[k];
        let predicted = (positions[attachment.pin].xyz - position.xyz) - velocity.xyz * step.dt;
        let predicted_length = length(predicted);
        if predicted_length > attachment.max_length {
            let change = predicted * ((predicted_length - attachment.max_length) / (predicted_length * step.dt));
            velocity = vec4<f32>(velocity.xyz + change, velocity.w);
        }
    }
    velocities[i] = velocity;
}
