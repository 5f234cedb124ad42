// Where the layered maps stand. The map along an axis has the extents of the two axes after it, in turn.
#import struct/LayerBox

@group(0) var<uniform> layer_box: LayerBox;

const AXIS_COUNT: u32 = 3u;

fn layer_size() -> vec3<u32> {
    return vec3<u32>(layer_box.size_x, layer_box.size_y, layer_box.size_z);
}

fn across_of(axis: u32) -> u32 {
    return (axis + 1u) % AXIS_COUNT;
}

fn up_of(axis: u32) -> u32 {
    return (axis + 2u) % AXIS_COUNT;
}

// Where the columns of the map along an axis begin.
fn first_column(axis: u32) -> u32 {
    if axis == 0u {
        return 0u;
    }
    let along_x = layer_box.size_y * layer_box.size_z;
    if axis == 1u {
        return along_x;
    }
    return along_x + layer_box.size_z * layer_box.size_x;
}
