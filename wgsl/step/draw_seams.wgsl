// Each pair of an open seam comes nearer at its closing speed, before cloth and bodies answer. One colour per dispatch.
#import shared/item
#import shared/span
#import shared/seam

@group(0) var<storage, read> seam_pairs: array<SeamPair>;

@compute @workgroup_size(64)
fn draw_seams(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let pair = seam_pairs[span.first + i];
    close_pair(pair, pair.closing_speed);
}
