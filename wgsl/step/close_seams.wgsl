// Each pair of an open seam comes nearer at a low speed, whatever cloth and bodies answered. One colour per dispatch.
#import shared/item
#import shared/span
#import shared/seam

@group(0) var<storage, read> seam_pairs: array<SeamPair>;

// Slow enough for the cloth to follow: a seam that is pulled through a limb stretches the cloth around it instead [m/s].
const FIRM_SPEED: f32 = 0.3;

@compute @workgroup_size(64)
fn close_seams(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let pair = seam_pairs[span.first + i];
    close_pair(pair, min(pair.closing_speed, FIRM_SPEED));
}
