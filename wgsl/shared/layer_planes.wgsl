// What a point sees of the bodies in the layered maps: along each axis the layers next below and above it. Each is a plane, whose weight
// falls with the eighth power of the square of its distance and with its slant: no choice is made among them. A second look from
// the foot of the point on what it saw removes what the slant of a surface does; one that stays clear needs none. A point whose way is longer than a texel is
// answered at the first place on it where it enters a body. D §8, W §7.
//
// The maps show the surfaces at one time, and the surfaces move straight on: at `lag` seconds before that time a surface stood
// back by its velocity. Whoever imports this says how: `MOVING`, `layer_velocity` and the two lags of a step. W §4.3.
#import shared/point
#import shared/layer_box
#import shared/packed

@group(0) var layer_columns: texture_2d<u32>;
@group(0) var layer_depths: texture_2d<u32>;
@group(0) var layer_normals: texture_2d<f32>;

// How deep behind a sheet a point is still drawn out of it [m].
const SHEET_DEPTH: f32 = 0.01;
// Least part of a normal along the axis of its map that counts.
const SLANT_MIN: f32 = 0.1;
// Most places on the way of a point that are looked at.
const WAY_PLACES: f32 = 16.0;
// How often the part of a way in which a point enters is halved.
const HALVINGS: u32 = 4u;
// The spread of a layer that is four texels away: what is farther is not seen from outside of all bodies.
const SPREAD_MAX: f32 = 17.0;
// The spread of nothing.
const FAR: f32 = 1e30;

// The weighted sum of planes, in weights of the nearest.
struct Planes {
    normal: vec3<f32>,
    distance: f32,
    velocity: vec3<f32>,
    weight: f32,
    // One more than the square of the distance of the nearest [texel²].
    spread: f32,
}

// What is seen from a place.
struct Sight {
    body: Planes,
    sheet: Planes,
    // Whether the place lies between two ends of a body along some axis.
    inside: bool,
}

fn place_along(vector: vec3<f32>, axis: u32) -> f32 {
    return select(select(vector.z, vector.y, axis == 1u), vector.x, axis == 0u);
}

// First layer of the column under a place, number of its ends, and of its sheets.
fn column_under(axis: u32, texel: vec3<f32>) -> vec3<u32> {
    let size = layer_size();
    let local = texel - layer_box.low;
    let across = select(select(local.x, local.z, axis == 1u), local.y, axis == 0u);
    let up = select(select(local.y, local.x, axis == 1u), local.z, axis == 0u);
    let width = size[across_of(axis)];
    if !(across >= 0.0 && across < f32(width) && up >= 0.0 && up < f32(size[up_of(axis)])) {
        return vec3<u32>(0u);
    }
    let column = first_column(axis) + u32(up) * width + u32(across);
    let found = textureLoad(layer_columns, packed_at(column), 0).xy;
    return vec3<u32>(found.x, found.y & 0xffffu, found.y >> 16u);
}

fn with_plane(
    planes: Planes,
    axis: u32,
    layer: vec2<u32>,
    centre: vec3<f32>,
    place: vec3<f32>,
    point: vec3<f32>,
    lag_seconds: f32,
) -> Planes {
    let depth = bitcast<f32>(layer.x);
    let on_axis = vec3<u32>(0u, 1u, 2u) == vec3<u32>(axis);
    let sample = select(centre, vec3<f32>(depth), on_axis);
    let apart = (place - sample) * layer_box.texels_per_metre;
    let spread = dot(apart, apart) + 1.0;
    let at = packed_at(layer.y);
    let normal = textureLoad(layer_normals, at, 0).xyz;
    let velocity = layer_velocity(at);
    var sum = planes;
    let is_nearer = spread < sum.spread;
    var part = sum.spread / spread;
    if is_nearer {
        part = spread / sum.spread;
    }
    let part2 = part * part;
    let part4 = part2 * part2;
    let part8 = part4 * part4;
    if is_nearer {
        sum.weight = sum.weight * part8;
        sum.normal = sum.normal * part8;
        sum.distance = sum.distance * part8;
        sum.velocity = sum.velocity * part8;
        sum.spread = spread;
    }
    let slant = max(abs(place_along(normal, axis)), SLANT_MIN);
    let slant2 = slant * slant;
    var weight = slant2 * slant2;
    if !is_nearer {
        weight = part8 * weight;
    }
    sum.weight = sum.weight + weight;
    sum.normal = sum.normal + normal * weight;
    sum.distance = sum.distance + dot(normal, (point + velocity * lag_seconds) - sample) * weight;
    sum.velocity = sum.velocity + velocity * weight;
    return sum;
}

// What is seen from a place, with the distances of `point` when the surfaces stand back by `lag_seconds`.
fn sight_from(place: vec3<f32>, point: vec3<f32>, lag_seconds: f32) -> Sight {
    var sight = Sight();
    sight.body.spread = FAR;
    sight.sheet.spread = FAR;
    let texel = floor(place * layer_box.texels_per_metre);
    let centre = (texel + 0.5) * layer_box.texel;
    for (var axis = 0u; axis < AXIS_COUNT; axis++) {
        let column = column_under(axis, texel);
        let height = place_along(place, axis);
        var below = vec2<u32>(0u);
        let ends = column.x + column.y;
        for (var k = column.x; k < ends; k++) {
            let layer = textureLoad(layer_depths, packed_at(k), 0).xy;
            let is_above = bitcast<f32>(layer.x) > height;
            if is_above || k + 1u == ends {
                let before = k - column.x;
                if is_above && before > 0u {
                    sight.body = with_plane(sight.body, axis, below, centre, place, point, lag_seconds);
                }
                sight.inside = sight.inside || (is_above && before % 2u == 1u);
                sight.body = with_plane(sight.body, axis, layer, centre, place, point, lag_seconds);
                break;
            }
            below = layer;
        }
        let sheets = ends + column.z;
        for (var k = ends; k < sheets; k++) {
            let layer = textureLoad(layer_depths, packed_at(k), 0).xy;
            let is_above = bitcast<f32>(layer.x) > height;
            if is_above || k + 1u == sheets {
                if is_above && k > ends {
                    sight.sheet = with_plane(sight.sheet, axis, below, centre, place, point, lag_seconds);
                }
                sight.sheet = with_plane(sight.sheet, axis, layer, centre, place, point, lag_seconds);
                break;
            }
            below = layer;
        }
    }
    return sight;
}

fn mean_of(planes: Planes) -> Probe {
    let normal_length = length(planes.normal);
    if !(planes.weight > 0.0 && normal_length > 0.0) {
        return Probe();
    }
    return Probe(planes.normal / normal_length, planes.distance / planes.weight, planes.velocity / planes.weight, 1.0);
}

// Velocity of the nearer of body and sheet.
fn drift_of(sight: Sight) -> vec3<f32> {
    if sight.sheet.spread < sight.body.spread {
        return sight.sheet.velocity / sight.sheet.weight;
    }
    return sight.body.velocity / sight.body.weight;
}

fn look(position: vec3<f32>, velocity: vec3<f32>) -> Probe {
    // A cloth that is carried along goes the way of its surface.
    var drift = vec3<f32>(0.0);
    if MOVING {
        drift = velocity;
    }
    var place = position + drift * start_lag();
    var sight = sight_from(place, position, start_lag());
    if MOVING && (sight.body.weight > 0.0 || sight.sheet.weight > 0.0) {
        drift = drift_of(sight);
        place = position + drift * start_lag();
        if length((drift - velocity) * start_lag()) > layer_box.texel {
            // The surface goes another way than the point: from where it stands to it, it may see something else.
            sight = sight_from(place, position, start_lag());
        }
    }
    let way = velocity * step.dt + drift * (end_lag() - start_lag());
    let way_length = length(way);
    if step.swept != 0u && !sight.inside && way_length > layer_box.texel {
        let places = min(ceil(way_length / layer_box.texel), WAY_PLACES);
        let start = place;
        for (var k = 1.0; k <= places; k += 1.0) {
            let next = start + way * (k / places);
            let there = sight_from(next, next, 0.0);
            if there.inside {
                place = next;
                sight = there;
                // Deeper, another side than that of the entry may be nearer.
                var outside = (k - 1.0) / places;
                var inside = k / places;
                for (var halving = 0u; halving < HALVINGS; halving++) {
                    let part = 0.5 * (outside + inside);
                    let middle = start + way * part;
                    let halfway = sight_from(middle, middle, 0.0);
                    if halfway.inside {
                        inside = part;
                        place = middle;
                        sight = halfway;
                    } else {
                        outside = part;
                    }
                }
                break;
            }
        }
    }
    var probe = Probe();
    if sight.inside || sight.body.spread < SPREAD_MAX {
        probe = mean_of(sight.body);
        // A point that stays clear needs no second look.
        if probe.hit > 0.0 && probe.distance - way_length <= layer_box.texel {
            let foot = place - probe.normal * probe.distance;
            probe = mean_of(sight_from(foot, position, start_lag()).body);
        }
        probe.distance = probe.distance - step.thickness;
    }
    if sight.sheet.spread < SPREAD_MAX {
        var sheet = mean_of(sight.sheet);
        if sheet.hit > 0.0 && sheet.distance - way_length <= layer_box.texel {
            let foot = place - sheet.normal * sheet.distance;
            sheet = mean_of(sight_from(foot, position, start_lag()).sheet);
        }
        sheet.distance = sheet.distance - step.thickness;
        let nearer = !(probe.hit > 0.0) || sheet.distance < probe.distance;
        if sheet.hit > 0.0 && sheet.distance > -SHEET_DEPTH && nearer {
            return sheet;
        }
    }
    if probe.hit > 0.0 {
        return probe;
    }
    return Probe();
}
