// Rule Hierarchical: the predictive rule along each strand of a colour, from limits over many edges to single ones. One workgroup for
// each strand; it works on copies in its own memory. One colour per dispatch.
#import shared/step_params
#import shared/span
#import shared/strand

@group(0) @binding(2) var<storage, read> strands: array<Strand>;
@group(0) @binding(3) var<storage, read> strand_particles: array<u32>;
@group(0) @binding(4) var<storage, read> strand_lengths: array<f32>;
@group(0) @binding(5) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> velocities: array<vec4<f32>>;

// Lanes of most GPUs: few enough that the limits of a garment's strand keep them busy.
const LANES: u32 = 32u;
const STRAND_PARTICLES: u32 = 512u;

var<workgroup> places: array<vec4<f32>, STRAND_PARTICLES>;
var<workgroup> speeds: array<vec4<f32>, STRAND_PARTICLES>;

fn hold(a: u32, b: u32, max_length: f32) {
    let place_a = places[a];
    let place_b = places[b];
    let inverse_mass_sum = place_a.w + place_b.w;
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let speed_a = speeds[a];
    let speed_b = speeds[b];
    let predicted = (place_b.xyz - place_a.xyz) + (speed_b.xyz - speed_a.xyz) * step.dt;
    let predicted_length = length(predicted);
    if predicted_length > max_length {
        let change = predicted
            * ((predicted_length - max_length) / ((predicted_length * step.dt) * inverse_mass_sum));
        speeds[a] = vec4<f32>(speed_a.xyz + change * place_a.w, speed_a.w);
        speeds[b] = vec4<f32>(speed_b.xyz - change * place_b.w, speed_b.w);
    }
}

@compute @workgroup_size(32)
fn limit_strands(
    @builtin(local_invocation_index) lane: u32,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let item = group.x + group.y * groups.x;
    if item >= span.count {
        return;
    }
    let strand = strands[span.first + item];
    for (var k = lane; k < strand.count; k += LANES) {
        let i = strand_particles[strand.first + k];
        places[k] = positions[i];
        speeds[k] = velocities[i];
    }
    workgroupBarrier();
    for (var above = strand.level_count; above > 0u; above--) {
        let level = above - 1u;
        let reach = 1u << level;
        let lengths = strand.lengths + level * strand.count - (reach - 1u);
        // Every other limit of a level, so that no two share a particle.
        for (var parity = 0u; parity < 2u; parity++) {
            for (var k = lane; k < strand.count; k += LANES) {
                let a = ((k >> level) << (level + 1u)) + (parity << level) + (k & (reach - 1u));
                if a + reach >= strand.count {
                    break;
                }
                hold(a, a + reach, strand_lengths[lengths + a]);
            }
            workgroupBarrier();
        }
    }
    for (var k = lane; k < strand.count; k += LANES) {
        velocities[strand_particles[strand.first + k]] = speeds[k];
    }
}
