// Rule Hierarchical between the nodes of a level. One colour of clusters per dispatch.
#import shared/item
#import shared/span
#import shared/hold_cluster

@compute @workgroup_size(64)
fn limit_level(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let item = item_index(id, groups);
    if item >= span.count {
        return;
    }
    hold_cluster(span.first + item, span.share);
}
