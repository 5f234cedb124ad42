// Where an item of a list lies in a texture.
const PACKED_WIDTH: u32 = 2048u;

fn packed_at(item: u32) -> vec2<u32> {
    return vec2<u32>(item % PACKED_WIDTH, item / PACKED_WIDTH);
}
