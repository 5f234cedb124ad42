// How far a structural or shear spring is stretched.
#import struct/Limit

@group(0) @binding(2) var<storage, read> limits: array<Limit>;
@group(0) @binding(3) var<storage, read> positions: array<vec4<f32>>;

fn elongation_of(i: u32) -> f32 {
    let limit = limits[i];
    return length(positions[limit.second].xyz - positions[limit.first].xyz) / limit.rest_length - 1.0;
}
