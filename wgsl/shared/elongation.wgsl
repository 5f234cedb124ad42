// How far a structural or shear spring is stretched.
#import struct/Limit
#import shared/particles reads positions

@group(0) var<storage, read> limits: array<Limit>;

fn elongation_of(i: u32) -> f32 {
    let limit = limits[i];
    return length(position_of(limit.second) - position_of(limit.first)) / limit.rest_length - 1.0;
}
