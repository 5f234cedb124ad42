// The area vector of a quad or triangle, twice as long, out of the cloth [m²].
#import shared/quad
#import shared/particles reads positions

fn doubled_area(corners: vec4<u32>) -> vec3<f32> {
    let a = position_of(corners.x);
    let b = position_of(corners.y);
    let c = position_of(corners.z);
    if corners.w == NO_CORNER {
        return cross(b - a, c - a);
    }
    return cross(c - a, position_of(corners.w) - b);
}
