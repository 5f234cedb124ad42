// What each column meets, from low to high: the ends of the bodies, then the sheets. A triangle that looks down begins a body, one that
// looks up ends it, and each end closes the last beginning that is still open; what has no partner is a sheet. D §8, W §7.
#import shared/item
#import shared/layer_box
#import shared/packed
#import shared/crossings

@group(0) var drawn_columns: texture_storage_2d<rg32uint, write>;
@group(0) var drawn_depths: texture_storage_2d<rg32uint, write>;

// Most crossings of a column that are told apart: a word has a bit for each.
const CROSSINGS_MAX: u32 = 32u;

fn is_below(one: Crossing, other: Crossing) -> bool {
    return one.depth < other.depth || (one.depth == other.depth && one.triangle < other.triangle);
}

@compute @workgroup_size(64)
fn sort_layers(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= layer_box.column_count {
        return;
    }
    // One crossing after the other goes from the list to its place in a sorted one.
    var unsorted = atomicLoad(&crossing_lists[i]);
    var sorted = 0u;
    var count = 0u;
    while unsorted != 0u {
        let taken = crossings[unsorted - 1u];
        var before = 0u;
        var after = sorted;
        while after != 0u && is_below(crossings[after - 1u], taken) {
            before = after;
            after = crossings[after - 1u].next;
        }
        crossings[unsorted - 1u].next = after;
        if before == 0u {
            sorted = unsorted;
        } else {
            crossings[before - 1u].next = unsorted;
        }
        count = count + 1u;
        unsorted = taken.next;
    }
    atomicStore(&crossing_lists[i], sorted);
    if count > CROSSINGS_MAX {
        atomicAdd(&layer_counts.crowded_columns, 1u);
        count = 0u;
    }
    if count == 0u {
        textureStore(drawn_columns, packed_at(i), vec4<u32>(0u));
        return;
    }
    var begins = 0u;
    var closed = 0u;
    var next = sorted;
    for (var k = 0u; k < count; k++) {
        let crossing = crossings[next - 1u];
        begins = begins | ((crossing.kind & BEGINS) << k);
        if (crossing.kind & OPEN) == 0u {
            closed = closed | (1u << k);
        }
        next = crossing.next;
    }
    // An end has a partner when a beginning before it is still open, a beginning when an end after it is.
    var partnered = 0u;
    var open_count = 0u;
    for (var k = 0u; k < count; k++) {
        let bit = 1u << k;
        if (closed & bit) == 0u {
            continue;
        }
        if (begins & bit) != 0u {
            open_count = open_count + 1u;
        } else if open_count > 0u {
            open_count = open_count - 1u;
            partnered = partnered | bit;
        }
    }
    open_count = 0u;
    for (var left = count; left > 0u; left--) {
        let bit = 1u << (left - 1u);
        if (closed & bit) == 0u {
            continue;
        }
        if (begins & bit) == 0u {
            open_count = open_count + 1u;
        } else if open_count > 0u {
            open_count = open_count - 1u;
            partnered = partnered | bit;
        }
    }
    // Of the partners those count that lie within no other pair.
    var ends = 0u;
    var depth = 0u;
    for (var k = 0u; k < count; k++) {
        let bit = 1u << k;
        if (partnered & bit) == 0u {
            continue;
        }
        if (begins & bit) != 0u {
            depth = depth + 1u;
        }
        if depth == 1u {
            ends = ends | bit;
        }
        if (begins & bit) == 0u {
            depth = depth - 1u;
        }
    }
    let end_count = countOneBits(ends);
    let sheet_count = count - countOneBits(partnered);
    let first = atomicAdd(&layer_counts.layer_count, end_count + sheet_count);
    var end = first;
    var sheet = first + end_count;
    next = sorted;
    for (var k = 0u; k < count; k++) {
        let crossing = crossings[next - 1u];
        let bit = 1u << k;
        let layer = vec4<u32>(bitcast<u32>(crossing.depth), next - 1u, 0u, 0u);
        if (ends & bit) != 0u {
            textureStore(drawn_depths, packed_at(end), layer);
            end = end + 1u;
        } else if (partnered & bit) == 0u {
            textureStore(drawn_depths, packed_at(sheet), layer);
            sheet = sheet + 1u;
        }
        next = crossing.next;
    }
    textureStore(drawn_columns, packed_at(i), vec4<u32>(first, end_count | (sheet_count << 16u), 0u, 0u));
}
