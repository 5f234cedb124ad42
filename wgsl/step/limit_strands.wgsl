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
// From this level on a limit goes along four chords, each a quarter of its edges.
const PATH_LEVEL: u32 = 2u;

// Where the particles will be after the coming move, with their inverse masses; and by how much their velocities have changed.
var<workgroup> places: array<vec4<f32>, STRAND_PARTICLES>;
var<workgroup> changes: array<vec3<f32>, STRAND_PARTICLES>;

fn shift(k: u32, way: vec3<f32>) {
    let place = places[k];
    places[k] = vec4<f32>(place.xyz + way * place.w, place.w);
    changes[k] = changes[k] + way * (place.w / step.dt);
}

// A limit between two particles.
fn hold_chord(a: u32, b: u32, max_length: f32) {
    let place_a = places[a];
    let place_b = places[b];
    let chord = place_b.xyz - place_a.xyz;
    let squared_length = dot(chord, chord);
    let inverse_mass_sum = place_a.w + place_b.w;
    // Most limits are slack: they cost no root and no write.
    if squared_length > max_length * max_length && inverse_mass_sum > 0.0 {
        let predicted_length = sqrt(squared_length);
        let way = chord * ((predicted_length - max_length) / (predicted_length * inverse_mass_sum));
        shift(a, way);
        shift(b, -way);
    }
}

fn direction(chord: vec3<f32>, chord_length: f32) -> vec3<f32> {
    if chord_length > 0.0 {
        return chord / chord_length;
    }
    return vec3<f32>(0.0);
}

// A limit along four chords: it also holds where the strand lies around a body, which a single chord cuts short.
fn hold_path(a: u32, quarter: u32, max_length: f32) {
    let b = a + quarter;
    let c = b + quarter;
    let d = c + quarter;
    let e = d + quarter;
    let ab = places[b].xyz - places[a].xyz;
    let bc = places[c].xyz - places[b].xyz;
    let cd = places[d].xyz - places[c].xyz;
    let de = places[e].xyz - places[d].xyz;
    let squared = vec4<f32>(dot(ab, ab), dot(bc, bc), dot(cd, cd), dot(de, de));
    // No path is longer than four even chords with the same sum of squares: most cost no root.
    if 4.0 * (squared.x + squared.y + squared.z + squared.w) > max_length * max_length {
        let lengths = sqrt(squared);
        let excess = lengths.x + lengths.y + lengths.z + lengths.w - max_length;
        if excess > 0.0 {
            let along_ab = direction(ab, lengths.x);
            let along_bc = direction(bc, lengths.y);
            let along_cd = direction(cd, lengths.z);
            let along_de = direction(de, lengths.w);
            let at_b = along_bc - along_ab;
            let at_c = along_cd - along_bc;
            let at_d = along_de - along_cd;
            // One after the other: Mesa regroups (p + q) + r where p and q are products and r is none.
            var yielding = places[a].w * dot(along_ab, along_ab);
            yielding += places[b].w * dot(at_b, at_b);
            yielding += places[c].w * dot(at_c, at_c);
            yielding += places[d].w * dot(at_d, at_d);
            yielding += places[e].w * dot(along_de, along_de);
            if yielding > 0.0 {
                let pull = excess / yielding;
                shift(a, along_ab * pull);
                shift(b, at_b * pull);
                shift(c, at_c * pull);
                shift(d, at_d * pull);
                shift(e, along_de * -pull);
            }
        }
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
        if level >= PATH_LEVEL {
            // Every fifth quarter, so that no two paths share a particle.
            let shorter = level - PATH_LEVEL;
            let quarter = 1u << shorter;
            for (var phase = 0u; phase < 5u; phase++) {
                for (var k = lane; k < strand.count; k += LANES) {
                    let a = (5u * (k >> shorter) + phase) * quarter + (k & (quarter - 1u));
                    if a + reach >= strand.count {
                        break;
                    }
                    hold_path(a, quarter, strand_lengths[lengths + a]);
                }
                workgroupBarrier();
            }
        } else {
            // Every other limit, so that no two share a particle.
            for (var parity = 0u; parity < 2u; parity++) {
                for (var k = lane; k < strand.count; k += LANES) {
                    let a = ((k >> level) << (level + 1u)) + (parity << level) + (k & (reach - 1u));
                    if a + reach >= strand.count {
                        break;
                    }
                    hold_chord(a, a + reach, strand_lengths[lengths + a]);
                }
                workgroupBarrier();
            }
        }
    }
    for (var k = lane; k < strand.count; k += LANES) {
        let i = strand_particles[strand.first + k];
        let velocity = velocities[i];
        velocities[i] = vec4<f32>(velocity.xyz + changes[k], velocity.w);
    }
}
