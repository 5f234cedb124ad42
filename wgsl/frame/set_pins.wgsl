// Particles that the host holds are pinned and go straight to where it wants them; those that it lets go are free again.
#import shared/item
#import struct/PinTarget
#import shared/particles reads positions velocities writes positions velocities

@group(0) var<storage, read> pins: array<PinTarget>;

@compute @workgroup_size(64)
fn set_pins(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let k = item_index(id, groups);
    if k >= arrayLength(&pins) {
        return;
    }
    let pin = pins[k];
    if pin.is_held == 0u {
        set_inverse_mass(pin.particle, 1.0 / mass_of(pin.particle));
        return;
    }
    set_inverse_mass(pin.particle, 0.0);
    set_velocity(pin.particle, (pin.position - position_of(pin.particle)) * pin.rate);
}
