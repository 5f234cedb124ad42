// Rule Hierarchical: the predictive rule along each strand of a colour, from limits over many steps to those over one. One workgroup for
// each strand; it works on copies in its own memory. One colour per dispatch.
#import shared/step_params
#import shared/span
#import struct/Strand
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> strands: array<Strand>;
@group(0) var<storage, read> strand_particles: array<u32>;
@group(0) var<storage, read> strand_lengths: array<f32>;

// Of a workgroup. What comes out is the same with any number of them.
override LANES: u32 = 64u;
const STRAND_PARTICLES: u32 = 512u;

// Where the particles will be after the coming move, with their inverse masses; and how far the limits have moved them since.
var<workgroup> places: array<vec4<f32>, STRAND_PARTICLES>;
var<workgroup> shifts: array<vec3<f32>, STRAND_PARTICLES>;

// A limit along one chord.
fn hold_chord(a: u32, b: u32, max_length: f32) {
    let place_a = places[a];
    let place_b = places[b];
    let shift_a = shifts[a];
    let shift_b = shifts[b];
    let chord = (place_b.xyz + shift_b) - (place_a.xyz + shift_a);
    let chord_length = length(chord);
    let inverse_mass_sum = place_a.w + place_b.w;
    if chord_length > max_length && inverse_mass_sum > 0.0 {
        let pull = chord * ((chord_length - max_length) / (chord_length * inverse_mass_sum));
        shifts[a] = shift_a + pull * place_a.w;
        shifts[b] = shift_b - pull * place_b.w;
    }
}

fn direction(chord: vec3<f32>, chord_length: f32) -> vec3<f32> {
    if chord_length > 0.0 {
        return chord / chord_length;
    }
    return vec3<f32>(0.0);
}

// A limit along four chords: it also holds where the strand lies around a body, which a single chord cuts short. Each particle moves
// along the gradient of the length.
fn hold_path(a: u32, quarter: u32, max_length: f32) {
    let b = a + quarter;
    let c = b + quarter;
    let d = c + quarter;
    let e = d + quarter;
    let place_a = places[a];
    let place_b = places[b];
    let place_c = places[c];
    let place_d = places[d];
    let place_e = places[e];
    let shift_a = shifts[a];
    let shift_b = shifts[b];
    let shift_c = shifts[c];
    let shift_d = shifts[d];
    let shift_e = shifts[e];
    let now_b = place_b.xyz + shift_b;
    let now_c = place_c.xyz + shift_c;
    let now_d = place_d.xyz + shift_d;
    let ab = now_b - (place_a.xyz + shift_a);
    let bc = now_c - now_b;
    let cd = now_d - now_c;
    let de = (place_e.xyz + shift_e) - now_d;
    let length_ab = length(ab);
    let length_bc = length(bc);
    let length_cd = length(cd);
    let length_de = length(de);
    let excess = length_ab + length_bc + length_cd + length_de - max_length;
    let gradient_a = direction(ab, length_ab);
    let along_bc = direction(bc, length_bc);
    let along_cd = direction(cd, length_cd);
    let along_de = direction(de, length_de);
    let gradient_b = along_bc - gradient_a;
    let gradient_c = along_cd - along_bc;
    let gradient_d = along_de - along_cd;
    let gradient_e = -along_de;
    // One after the other: Mesa regroups (p + q) + r where p and q are products and r is none.
    var yielding = place_a.w * dot(gradient_a, gradient_a);
    yielding += place_b.w * dot(gradient_b, gradient_b);
    yielding += place_c.w * dot(gradient_c, gradient_c);
    yielding += place_d.w * dot(gradient_d, gradient_d);
    yielding += place_e.w * dot(gradient_e, gradient_e);
    if excess > 0.0 && yielding > 0.0 {
        let pull = excess / yielding;
        shifts[a] = shift_a + gradient_a * (pull * place_a.w);
        shifts[b] = shift_b + gradient_b * (pull * place_b.w);
        shifts[c] = shift_c + gradient_c * (pull * place_c.w);
        shifts[d] = shift_d + gradient_d * (pull * place_d.w);
        shifts[e] = shift_e + gradient_e * (pull * place_e.w);
    }
}

@compute @workgroup_size(LANES)
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
        places[k] = vec4<f32>(position_of(i) + velocity_of(i) * step.dt, inverse_mass_of(i));
        shifts[k] = vec3<f32>(0.0);
    }
    workgroupBarrier();
    for (var levels = strand.level_count; levels > 2u; levels--) {
        let level = levels - 1u;
        let reach = 1u << level;
        let lengths = strand.lengths + level * strand.count - (reach - 1u);
        let shorter = level - 2u;
        let quarter = 1u << shorter;
        // Every fifth quarter, so that no two paths share a particle.
        for (var turn = 0u; turn < 5u; turn++) {
            for (var k = lane; k < strand.count; k += LANES) {
                let a = (5u * (k >> shorter) + turn) * quarter + (k & (quarter - 1u));
                if a + reach >= strand.count {
                    break;
                }
                hold_path(a, quarter, strand_lengths[lengths + a]);
            }
            workgroupBarrier();
        }
    }
    for (var levels = min(strand.level_count, 2u); levels > 0u; levels--) {
        let level = levels - 1u;
        let reach = 1u << level;
        let lengths = strand.lengths + level * strand.count - (reach - 1u);
        // Every other one, or pair, so that no two share a particle.
        for (var turn = 0u; turn < 2u; turn++) {
            for (var k = lane; k < strand.count; k += LANES) {
                let a = (2u * (k >> level) + turn) * reach + (k & (reach - 1u));
                if a + reach >= strand.count {
                    break;
                }
                hold_chord(a, a + reach, strand_lengths[lengths + a]);
            }
            workgroupBarrier();
        }
    }
    for (var k = lane; k < strand.count; k += LANES) {
        let i = strand_particles[strand.first + k];
        set_velocity(i, velocity_of(i) + shifts[k] / step.dt);
    }
}
