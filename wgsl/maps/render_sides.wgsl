// Draws the surfaces of the bodies into the depth and normal maps, and those of moving bodies into the velocity map too, seen by
// the front or the back camera. W §4.1-4.3.
#import struct/SideBox
#import struct/Side

const FRONT: u32 = 0u;

struct Texel {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
}

struct MovingTexel {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) velocity: vec3<f32>,
}

struct Colours {
    @location(0) normal: vec4<f32>,
    @location(1) velocity: vec4<f32>,
}

@group(0) var<uniform> side_box: SideBox;
@group(0) var<uniform> camera: Side;

fn project(position: vec3<f32>, normal: vec3<f32>) -> vec4<f32> {
    let surface = position + normal * camera.thickness;
    let x = 2.0 * ((surface.x - side_box.origin_x) / (f32(side_box.columns) * side_box.texel)) - 1.0;
    let y = 1.0 - 2.0 * ((side_box.origin_y - surface.y) / (f32(side_box.rows) * side_box.texel));
    var depth = (side_box.z_front - surface.z) / (side_box.z_front - side_box.z_back);
    if camera.side != FRONT {
        depth = 1.0 - depth;
    }
    return vec4<f32>(x, y, depth, 1.0);
}

// An interpolated normal may lean away from the camera at the silhouette; the surface that the camera sees does not.
fn facing(interpolated: vec3<f32>) -> vec4<f32> {
    var normal = interpolated;
    normal.z = select(-abs(normal.z), abs(normal.z), camera.side == FRONT);
    let normal_length = length(normal);
    if normal_length > 0.0 {
        return vec4<f32>(normal / normal_length, 0.0);
    }
    return vec4<f32>(0.0, 0.0, select(-1.0, 1.0, camera.side == FRONT), 0.0);
}

@vertex
fn draw_surface(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Texel {
    return Texel(project(position, normal), normal);
}

@fragment
fn write_normal(texel: Texel) -> @location(0) vec4<f32> {
    return facing(texel.normal);
}

@vertex
fn draw_moving_surface(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) velocity: vec3<f32>,
) -> MovingTexel {
    return MovingTexel(project(position, normal), normal, velocity);
}

@fragment
fn write_normal_and_velocity(texel: MovingTexel) -> Colours {
    return Colours(facing(texel.normal), vec4<f32>(texel.velocity, 0.0));
}
