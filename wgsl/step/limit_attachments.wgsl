// Rule Hierarchical where the cloth is pinned: what would take a particle farther from a pin in the coming move than the cloth
// between them is long is removed from its velocity. Kim, Chentanez and Müller 2012. Pins stay where they are.
#import shared/item
#import shared/step_params
#import struct/Attachment
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> attachment_offsets: array<u32>;
@group(0) var<storage, read> attachments: array<Attachment>;

@compute @workgroup_size(64)
fn limit_attachments(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    if !(inverse_mass_of(i) > 0.0) {
        return;
    }
    let position = position_of(i);
    var velocity = velocity_of(i);
    let end = attachment_offsets[i + 1u];
    for (var k = attachment_offsets[i]; k < end; k++) {
        let attachment = attachments[k];
        let predicted = (position_of(attachment.pin) - position) - velocity * step.dt;
        let predicted_length = length(predicted);
        // A pin that the host has let go holds nothing.
        if predicted_length > attachment.max_length && !(inverse_mass_of(attachment.pin) > 0.0) {
            velocity = velocity + predicted * ((predicted_length - attachment.max_length) / (predicted_length * step.dt));
        }
    }
    set_velocity(i, velocity);
}
