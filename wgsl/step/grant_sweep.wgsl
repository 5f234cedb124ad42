// Grants a further sweep while a spring is above the target and the step may have more; else the passes of that sweep get no
// workgroups. A step that may have no more and is still above the target has missed it. One workgroup.
#import shared/polish

@group(0) var<storage, read> sweep_workgroups: array<vec4<u32>>;
@group(0) var<storage, read_write> sweep_dispatches: array<vec4<u32>>;

@compute @workgroup_size(64)
fn grant_sweep(@builtin(local_invocation_index) local: u32) {
    let above = atomicLoad(&polish_state.elongation_max) > 0u;
    let granted = above && polish_state.granted < polish.sweeps;
    for (var k = local; k < arrayLength(&sweep_workgroups); k += 64u) {
        sweep_dispatches[k] = select(vec4<u32>(0u), sweep_workgroups[k], granted);
    }
    // All have read the state before one changes it.
    storageBarrier();
    if local > 0u {
        return;
    }
    if granted {
        polish_state.granted = polish_state.granted + 1u;
        polish_state.further_sweeps = polish_state.further_sweeps + 1u;
    } else {
        polish_state.granted = 0u;
        polish_state.missed_steps = polish_state.missed_steps + u32(above);
    }
    // A measurement that is not granted leaves this as it is: nothing is above the target.
    atomicStore(&polish_state.elongation_max, 0u);
}
