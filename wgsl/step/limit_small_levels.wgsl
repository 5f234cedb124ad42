// Rule Hierarchical between the nodes of all small levels, from the coarsest to the finest of them: one workgroup, whose barriers cost less than
// dispatches do.
#import struct/SmallTurn
#import shared/lead
#import shared/hold_cluster

@group(0) var<storage, read> small_turns: array<SmallTurn>;

// Of the workgroup. What comes out is the same with any number of them.
override LANES: u32 = 256u;

@compute @workgroup_size(LANES)
fn limit_small_levels(@builtin(local_invocation_index) lane: u32) {
    for (var k = 0u; k < arrayLength(&small_turns); k += 1u) {
        let turn = small_turns[k];
        for (var node = turn.first_node + lane; node < turn.end_node; node += LANES) {
            lead(node);
        }
        for (var cluster = turn.first_cluster + lane; cluster < turn.end_cluster; cluster += LANES) {
            hold_cluster(cluster, turn.relaxation);
        }
        storageBarrier();
    }
}
