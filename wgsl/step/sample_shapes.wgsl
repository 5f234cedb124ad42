// What each point sees of the analytic shapes, exactly: of those that it reaches within this step the nearest answers, where it is nearer than
// what the point sees in the maps. Where it reaches none, the nearest answers all the same: a later sweep may change its way. The whole
// way of the coming move is tested, relative to the shape: a point that would enter meets it where its way does.
#import shared/point
#import struct/Shape

const CAPSULE: u32 = 1u;
const PLANE: u32 = 2u;
const BOX: u32 = 3u;

@group(0) var<storage, read> shapes: array<Shape>;

// More than all of a way.
const NEVER: f32 = 2.0;

// After which part of its way a place outside of a sphere around the origin first meets it.
fn sphere_entry(start: vec3<f32>, way: vec3<f32>, radius: f32) -> f32 {
    let outside = dot(start, start) - radius * radius;
    let closing = dot(start, way);
    let way_squared = dot(way, way);
    let discriminant = closing * closing - way_squared * outside;
    if outside > 0.0 && closing < 0.0 && discriminant > 0.0 {
        return (-closing - sqrt(discriminant)) / way_squared;
    }
    return NEVER;
}

// Where a place meets a shape after this part of its way; the place itself when it does not.
fn met_at(start: vec3<f32>, way: vec3<f32>, share: f32) -> vec3<f32> {
    if step.swept == 1u && share < 1.0 {
        return start + way * share;
    }
    return start;
}

// The plane that touches a shape where it is met, as far from its core as the radius; none where no direction leads out of the core.
fn plane_of(shape: Shape, from_centre: vec3<f32>, met: vec3<f32>, core: vec3<f32>) -> Probe {
    let outward = met - core;
    let outward_length = length(outward);
    if !(outward_length > 0.0) {
        return Probe();
    }
    let normal = outward / outward_length;
    let distance = dot(normal, from_centre - core) - shape.radius;
    let surface_velocity = (shape.velocity + shape.spin.yzx * met.zxy) - shape.spin.zxy * met.yzx;
    return Probe(normal, distance, surface_velocity, 1.0);
}

// The same of a capsule. It lies within an endless cylinder: where the way enters that beyond an end, or begins there, only the sphere
// around that end can be met.
fn capsule_entry(shape: Shape, start: vec3<f32>, way: vec3<f32>) -> f32 {
    let axis_squared = dot(shape.axis, shape.axis);
    var along = dot(start, shape.axis) / axis_squared;
    let start_across = start - shape.axis * along;
    if dot(start_across, start_across) > shape.radius * shape.radius {
        let way_across = way - shape.axis * (dot(way, shape.axis) / axis_squared);
        let share = sphere_entry(start_across, way_across, shape.radius);
        if !(share < 1.0) {
            return NEVER;
        }
        along = dot(start + way * share, shape.axis) / axis_squared;
        if abs(along) <= 1.0 {
            return share;
        }
    } else if abs(along) <= 1.0 {
        return NEVER;
    }
    return sphere_entry(start - shape.axis * sign(along), way, shape.radius);
}

fn capsule_probe(shape: Shape, from_centre: vec3<f32>, velocity: vec3<f32>) -> Probe {
    // A place that turns with the capsule goes on, seen from it, as if it stood still.
    let turning = shape.spin.yzx * from_centre.zxy - shape.spin.zxy * from_centre.yzx;
    let way = ((velocity - shape.velocity) - turning) * step.dt;
    let met = met_at(from_centre, way, capsule_entry(shape, from_centre, way));
    let along = dot(met, shape.axis) / dot(shape.axis, shape.axis);
    return plane_of(shape, from_centre, met, shape.axis * clamp(along, -1.0, 1.0));
}

// A plane is met in one direction only, so it needs no way.
fn plane_probe(shape: Shape, from_centre: vec3<f32>) -> Probe {
    let height = dot(shape.axis, from_centre);
    let below = from_centre - shape.axis * height;
    let surface_velocity = (shape.velocity + shape.spin.yzx * below.zxy) - shape.spin.zxy * below.yzx;
    return Probe(shape.axis, height - shape.radius, surface_velocity, 1.0);
}

// Turns of the search for where a way enters a box. Each goes on to the plane that the nearest point of the box has, behind which all of it
// lies; so none goes too far.
const BOX_TURNS: u32 = 6u;

// The place of a box of these half extents around the origin that is nearest to another one.
fn within(place: vec3<f32>, half: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(clamp(place.x, -half.x, half.x), clamp(place.y, -half.y, half.y), clamp(place.z, -half.z, half.z));
}

// After which part of its way a place meets a box, all along the axes of the box; at once where it is inside.
fn box_entry(shape: Shape, start: vec3<f32>, way: vec3<f32>) -> f32 {
    var share = 0.0;
    for (var k = 0u; k < BOX_TURNS; k++) {
        let place = start + way * share;
        let outward = place - within(place, shape.axis);
        let outward_length = length(outward);
        let gap = outward_length - shape.radius;
        if !(gap > 0.0) {
            return share;
        }
        let closing = dot(outward, way) / outward_length;
        if !(closing < 0.0) {
            return NEVER;
        }
        share = share - gap / closing;
    }
    return share;
}

// On which side of the middle a place is.
fn side_of(place: f32) -> f32 {
    return select(-1.0, 1.0, place > 0.0);
}

fn box_probe(shape: Shape, from_centre: vec3<f32>, velocity: vec3<f32>) -> Probe {
    let forward = shape.right.yzx * shape.up.zxy - shape.right.zxy * shape.up.yzx;
    // A place that turns with the box goes on, seen from it, as if it stood still.
    let turning = shape.spin.yzx * from_centre.zxy - shape.spin.zxy * from_centre.yzx;
    let way = ((velocity - shape.velocity) - turning) * step.dt;
    let start = vec3<f32>(dot(shape.right, from_centre), dot(shape.up, from_centre), dot(forward, from_centre));
    let along = vec3<f32>(dot(shape.right, way), dot(shape.up, way), dot(forward, way));
    let met = met_at(start, along, box_entry(shape, start, along));
    let core = within(met, shape.axis);
    let outward = met - core;
    let outward_length = length(outward);
    var normal = outward / outward_length;
    var distance = dot(normal, start - core) - shape.radius;
    if !(outward_length > 0.0) {
        // Out of the core the nearest face leads.
        let depth = shape.axis - abs(met);
        let side = vec3<f32>(side_of(met.x), side_of(met.y), side_of(met.z));
        var least = depth.x;
        normal = vec3<f32>(side.x, 0.0, 0.0);
        if depth.y < least {
            least = depth.y;
            normal = vec3<f32>(0.0, side.y, 0.0);
        }
        if depth.z < least {
            least = depth.z;
            normal = vec3<f32>(0.0, 0.0, side.z);
        }
        distance = -least - shape.radius;
    }
    let x = vec3<f32>(shape.right.x, shape.up.x, forward.x);
    let y = vec3<f32>(shape.right.y, shape.up.y, forward.y);
    let z = vec3<f32>(shape.right.z, shape.up.z, forward.z);
    let outside = vec3<f32>(dot(x, normal), dot(y, normal), dot(z, normal));
    let place = vec3<f32>(dot(x, met), dot(y, met), dot(z, met));
    let surface_velocity = (shape.velocity + shape.spin.yzx * place.zxy) - shape.spin.zxy * place.yzx;
    return Probe(outside, distance, surface_velocity, 1.0);
}

fn look_at(shape: Shape, point: Midpoint) -> Probe {
    let from_centre = point.position - shape.centre;
    if shape.kind == BOX {
        return box_probe(shape, from_centre, point.velocity);
    }
    if shape.kind == PLANE {
        return plane_probe(shape, from_centre);
    }
    if shape.kind == CAPSULE {
        return capsule_probe(shape, from_centre, point.velocity);
    }
    let way = (point.velocity - shape.velocity) * step.dt;
    let met = met_at(from_centre, way, sphere_entry(from_centre, way, shape.radius));
    return plane_of(shape, from_centre, met, vec3<f32>(0.0));
}

// Farther than anything [m].
const FAR: f32 = 1e30;

// The first component that is not zero.
fn leading(way: vec3<f32>) -> f32 {
    if way.x != 0.0 {
        return way.x;
    }
    if way.y != 0.0 {
        return way.y;
    }
    return way.z;
}

// Whether a point reaches what it sees within this step.
fn is_reached(seen: Probe, velocity: vec3<f32>) -> bool {
    let approach = dot(velocity - seen.velocity, seen.normal);
    return seen.distance + approach * step.dt < step.contact_margin;
}

// Which of two shapes answers a point: one that it reaches, and the nearer; of two that are equally near the one whose normal, then whose velocity
// comes later by coordinates, so that the order of the shapes does not matter.
fn answers_before(one: Probe, other: Probe, velocity: vec3<f32>) -> bool {
    let reached = is_reached(one, velocity);
    if reached != is_reached(other, velocity) {
        return reached;
    }
    if one.distance != other.distance {
        return one.distance < other.distance;
    }
    let turn = leading(one.normal - other.normal);
    if turn != 0.0 {
        return turn > 0.0;
    }
    return leading(one.velocity - other.velocity) > 0.0;
}

@compute @workgroup_size(64)
fn sample_shapes(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count + step.quad_count {
        return;
    }
    let point = point_at(i);
    var answer = Probe();
    for (var k = 0u; k < arrayLength(&shapes); k++) {
        let seen = look_at(shapes[k], point);
        // What is no number has no distance.
        if seen.hit > 0.0 && seen.distance < FAR && (!(answer.hit > 0.0) || answers_before(seen, answer, point.velocity)) {
            answer = seen;
        }
    }
    if step.after_maps == 1u {
        let seen = probes[i];
        if seen.hit > 0.0 && (!(answer.hit > 0.0) || !answers_before(answer, seen, point.velocity)) {
            answer = seen;
        }
    }
    probes[i] = answer;
}
