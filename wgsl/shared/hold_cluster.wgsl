// Rule Hierarchical among the nodes of a cluster: what is over-long after the coming move is taken back, by inverse mass.
#import shared/cluster
#import shared/nodes reads places writes shifts

// What is no node has no mass that limits could move.
fn place_of(node: u32) -> vec4<f32> {
    if node == NO_NODE {
        return vec4<f32>(0.0);
    }
    return node_places[node];
}

fn shift_of(node: u32) -> vec3<f32> {
    if node == NO_NODE {
        return vec3<f32>(0.0);
    }
    return node_shifts[node].xyz;
}

fn set_shift(node: u32, shift: vec3<f32>) {
    if node != NO_NODE {
        node_shifts[node] = vec4<f32>(shift, 0.0);
    }
}

fn hold(
    place_a: vec4<f32>,
    place_b: vec4<f32>,
    shift_a: ptr<function, vec3<f32>>,
    shift_b: ptr<function, vec3<f32>>,
    max_length: f32,
    relaxation: f32,
) {
    let chord = (place_b.xyz + *shift_b) - (place_a.xyz + *shift_a);
    let chord_length = length(chord);
    let inverse_mass_sum = place_a.w + place_b.w;
    if chord_length > max_length && inverse_mass_sum > 0.0 {
        let pull = chord * (relaxation * (chord_length - max_length) / (chord_length * inverse_mass_sum));
        *shift_a = *shift_a + pull * place_a.w;
        *shift_b = *shift_b - pull * place_b.w;
    }
}

// `relaxation` times as much as the excess is taken back.
fn hold_cluster(index: u32, relaxation: f32) {
    let cluster = clusters[index];
    let place_a = place_of(cluster.a);
    let place_b = place_of(cluster.b);
    let place_c = place_of(cluster.c);
    let place_d = place_of(cluster.d);
    var shift_a = shift_of(cluster.a);
    var shift_b = shift_of(cluster.b);
    var shift_c = shift_of(cluster.c);
    var shift_d = shift_of(cluster.d);
    hold(place_a, place_b, &shift_a, &shift_b, cluster.ab, relaxation);
    hold(place_c, place_d, &shift_c, &shift_d, cluster.cd, relaxation);
    hold(place_a, place_c, &shift_a, &shift_c, cluster.ac, relaxation);
    hold(place_b, place_d, &shift_b, &shift_d, cluster.bd, relaxation);
    hold(place_a, place_d, &shift_a, &shift_d, cluster.ad, relaxation);
    hold(place_b, place_c, &shift_b, &shift_c, cluster.bc, relaxation);
    set_shift(cluster.a, shift_a);
    set_shift(cluster.b, shift_b);
    set_shift(cluster.c, shift_c);
    set_shift(cluster.d, shift_d);
}
