// The index of this invocation's item: a dispatch is two-dimensional once it has more than 65535 workgroups.
const WORKGROUP_SIZE: u32 = 64u;

fn item_index(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    return id.x + id.y * (groups.x * WORKGROUP_SIZE);
}
