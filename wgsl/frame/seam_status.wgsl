// The largest gap of the open seams.
#import shared/item
#import struct/Status
#import struct/SeamPair
#import shared/particles reads positions

@group(0) var<storage, read> seam_pairs: array<SeamPair>;
@group(0) var<storage, read_write> status: Status;

@compute @workgroup_size(64)
fn seam_status(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < arrayLength(&seam_pairs) {
        let pair = seam_pairs[i];
        let gap = length(position_of(pair.second) - position_of(pair.first));
        if gap > 0.0 {
            atomicMax(&status.seam_gap_max, bitcast<u32>(gap));
        }
    }
}
