// Where the nodes of all levels would be after the coming move, and how far limits have moved them since: how that lies in memory.

#section places
// [m], with the inverse masses [1/kg].
@group(0) var<storage, $access> node_places: array<vec4<f32>>;

#section shifts
// [m]
@group(0) var<storage, $access> node_shifts: array<vec4<f32>>;
