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

// Few, because the strands of a garment are short: on a driver that runs on the CPU more lanes cost more than they do.
const LANES: u32 = 8u;
const STRAND_PARTICLES: u32 = 512u;

// Where the particles will be after the coming move, with their inverse masses; and by how much their velocities have changed.
var<workgroup> places: array<vec4<f32>, STRAND_PARTICLES>;
var<workgroup> changes: array<vec3<f32>, STRAND_PARTICLES>;

fn hold(a: u32, b: u32, max_length: f32) {
    let place_a = places[a];
    let place_b = places[b];
    let difference = place_b.xyz - place_a.xyz;
    let squared_length = dot(difference, difference);
    let inverse_mass_sum = place_a.w + place_b.w;
    // Most limits are slack: they cost no root and no write.
    if squared_length > max_length * max_length && inverse_mass_sum > 0.0 {
        let predicted_length = sqrt(squared_length);
        let impulse = difference
            * ((predicted_length - max_length) / ((predicted_length * step.dt) * inverse_mass_sum));
        let change_a = impulse * place_a.w;
        let change_b = impulse * place_b.w;
        places[a] = vec4<f32>(place_a.xyz + change_a * step.dt, place_a.w);
        places[b] = vec4<f32>(place_b.xyz - change_b * step.dt, place_b.w);
        changes[a] = changes[a] + change_a;
        changes[b] = changes[b] - change_b;
    }
}

@compute @workgroup_size(8)
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
        let position = positions[i];
        places[k] = vec4<f32>(position.xyz + velocities[i].xyz * step.dt, position.w);
        changes[k] = vec3<f32>(0.0);
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
        let i = strand_particles[strand.first + k];
        let velocity = velocities[i];
        velocities[i] = vec4<f32>(velocity.xyz + changes[k], velocity.w);
    }
}
