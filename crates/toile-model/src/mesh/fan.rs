//! Which two sides at a particle continue each other: the rule behind bend springs.

/// Largest deviation from a straight way across a particle [degrees].
const STRAIGHT_TOLERANCE: f64 = 30.0;

/// One element as a particle sees it: its two neighbours in the element and the flat angle between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sector {
    /// The two neighbours.
    pub(crate) neighbours: [u32; 2],
    /// Angle between them [degrees].
    pub(crate) angle: f64,
}

/// Pairs of neighbours that lie opposite to each other across a particle, each the straightest way on for the other. Sorted, the
/// lower index first.
///
/// The sectors are laid out around the particle one after the other, so a seam needs no common flat panel. Around an inner particle
/// opposite means half of the whole turn (360°, less at the tip of a dart), at an edge of the cloth 180°.
pub(crate) fn opposite_neighbours(sectors: &[Sector]) -> Vec<[u32; 2]> {
    let mut result = Vec::new();
    let mut used = vec![false; sectors.len()];
    let touch = |s: usize, neighbour: u32| sectors[s].neighbours.contains(&neighbour);
    let manifold =
        sectors.iter().flat_map(|s| s.neighbours).all(|n| (0..sectors.len()).filter(|&s| touch(s, n)).count() <= 2);
    if !manifold {
        return result;
    }
    while let Some(first) = used.iter().position(|u| !u) {
        // Start at an open end of the fan if it has one; a closed fan is back at the first sector after one round.
        let mut start = sectors[first].neighbours[0];
        let mut sector = first;
        while let Some(next) = (0..sectors.len()).find(|&s| s != sector && touch(s, start)) {
            start = other(sectors[next], start);
            sector = next;
            if sector == first {
                break;
            }
        }
        let mut fan = vec![(start, 0.0)];
        let (mut here, mut turn) = (start, 0.0);
        while let Some(next) = (0..sectors.len()).find(|&s| !used[s] && touch(s, here)) {
            used[next] = true;
            here = other(sectors[next], here);
            turn += sectors[next].angle;
            fan.push((here, turn));
        }
        result.extend(opposite_in_fan(&fan));
    }
    result.sort_unstable();
    result
}

fn other(sector: Sector, neighbour: u32) -> u32 {
    let [a, b] = sector.neighbours;
    if a == neighbour { b } else { a }
}

/// Pairs in one fan of neighbours with the turn to each; a closed fan ends with the neighbour it starts with.
fn opposite_in_fan(fan: &[(u32, f64)]) -> Vec<[u32; 2]> {
    let closed = fan.len() > 2 && fan[0].0 == fan[fan.len() - 1].0;
    let whole = fan[fan.len() - 1].1;
    let neighbours = if closed { &fan[..fan.len() - 1] } else { fan };
    let deviation = |i: usize, j: usize| {
        let turn = (neighbours[i].1 - neighbours[j].1).abs();
        if closed { (turn - 0.5 * whole).abs() * 360.0 / whole } else { (turn - 180.0).abs() }
    };
    let straightest = |i: usize| {
        (0..neighbours.len()).filter(|&j| j != i).min_by(|&j, &k| deviation(i, j).total_cmp(&deviation(i, k)))
    };
    (0..neighbours.len())
        .filter_map(|i| {
            let j = straightest(i)?;
            let mutual = i < j && straightest(j) == Some(i) && deviation(i, j) <= STRAIGHT_TOLERANCE;
            let [a, b] = [neighbours[i].0, neighbours[j].0];
            mutual.then_some([a.min(b), a.max(b)])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sectors(neighbours: &[u32], angles: &[f64]) -> Vec<Sector> {
        angles
            .iter()
            .enumerate()
            .map(|(k, &angle)| Sector { neighbours: [neighbours[k], neighbours[(k + 1) % neighbours.len()]], angle })
            .collect()
    }

    #[test]
    fn inside_a_grid_warp_and_weft_go_straight_on() {
        assert_eq!(opposite_neighbours(&sectors(&[1, 2, 3, 4], &[90.0; 4])), [[1, 3], [2, 4]]);
    }

    #[test]
    fn at_an_edge_only_the_edge_goes_straight_on_whatever_the_order_of_the_sectors() {
        let mut fan = sectors(&[7, 8, 9], &[90.0, 90.0]);
        assert_eq!(opposite_neighbours(&fan), [[7, 9]]);
        fan.reverse();
        assert_eq!(opposite_neighbours(&fan), [[7, 9]]);
    }

    #[test]
    fn a_corner_has_no_opposite_neighbours() {
        assert_eq!(opposite_neighbours(&sectors(&[1, 2], &[90.0])), [] as [[u32; 2]; 0]);
    }

    #[test]
    fn at_the_tip_of_a_dart_half_of_what_is_left_counts_as_straight() {
        assert_eq!(opposite_neighbours(&sectors(&[1, 2, 3, 4], &[80.0; 4])), [[1, 3], [2, 4]]);
    }

    #[test]
    fn of_six_triangles_three_ways_go_straight_on() {
        assert_eq!(opposite_neighbours(&sectors(&[1, 2, 3, 4, 5, 6], &[60.0; 6])), [[1, 4], [2, 5], [3, 6]]);
    }
}
