// Labelled edges (waistbands, collars, armholes) are drawn to their height while the garment is sewn, weaker than seams and
// limits are.
#import shared/item
#import shared/step_params

struct Hold {
    particle: u32,
    height: f32,    // [m]
}

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> holds: array<Hold>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn hold_edges(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= arrayLength(&holds) {
        return;
    }
    let hold = holds[i];
    let position = positions[hold.particle];
    if !(position.w > 0.0) {
        return;
    }
    let wanted = step.hold_stiffness * (hold.height - position.y);
    let acceleration = min(max(wanted, -step.hold_acceleration), step.hold_acceleration);
    velocities[hold.particle].y = velocities[hold.particle].y + acceleration * step.dt;
}
