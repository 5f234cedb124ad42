// How the nodes of a level begin: where the cloth will be after the coming move, shifted from there as much as those of the next coarser level that
// lead them.
#import shared/step_params
#import struct/Node
#import struct/Leader
#import shared/nodes writes places writes shifts
#import shared/particles reads positions velocities

@group(0) var<storage, read> nodes: array<Node>;
@group(0) var<storage, read> leaders: array<Leader>;

fn lead(index: u32) {
    let node = nodes[index];
    let place = position_of(node.site) + velocity_of(node.site) * step.dt;
    var shift = vec3<f32>(0.0);
    // A particle that is pinned, or a coarse particle where one is, follows nobody.
    var inverse_mass = inverse_mass_of(node.site);
    if inverse_mass > 0.0 {
        for (var k = node.first_leader; k < node.end_leader; k += 1u) {
            let leader = leaders[k];
            shift = shift + node_shifts[leader.node].xyz * leader.part;
        }
        if index >= step.particle_count {
            inverse_mass = node.inverse_mass;
        }
    }
    node_places[index] = vec4<f32>(place, inverse_mass);
    node_shifts[index] = vec4<f32>(shift, 0.0);
}
