//! Whether an outline crosses or touches itself.

use glam::DVec2;

/// A straight piece of an outline.
#[derive(Clone, Copy)]
struct Piece {
    edge: usize,
    /// Number of the piece in the whole outline.
    number: usize,
    ends: [DVec2; 2],
}

/// The leftmost two edges of a closed outline that meet anywhere but at the end that neighbours share, and where [m].
/// Polylines are in loop order, each ends where the next starts.
pub(crate) fn first_crossing(polylines: &[Vec<DVec2>]) -> Option<([usize; 2], DVec2)> {
    let mut pieces = Vec::new();
    for (edge, polyline) in polylines.iter().enumerate() {
        for pair in polyline.windows(2) {
            pieces.push(Piece { edge, number: pieces.len(), ends: [pair[0], pair[1]] });
        }
    }
    let count = pieces.len();
    // A sweep along x: only pieces whose x ranges overlap are compared.
    pieces.sort_by(|a, b| low(a).total_cmp(&low(b)));
    let mut open: Vec<Piece> = Vec::new();
    for piece in &pieces {
        open.retain(|other| high(other) >= low(piece));
        for other in &open {
            let (a, b) = if other.number < piece.number { (other, piece) } else { (piece, other) };
            let neighbours = b.number - a.number == 1 || (a.number == 0 && b.number == count - 1);
            if let Some(at) = meeting(a, b, neighbours) {
                return Some(([a.edge, b.edge], at));
            }
        }
        open.push(*piece);
    }
    None
}

fn low(piece: &Piece) -> f64 {
    piece.ends[0].x.min(piece.ends[1].x)
}

fn high(piece: &Piece) -> f64 {
    piece.ends[0].x.max(piece.ends[1].x)
}

/// Where two pieces meet; the end that neighbours share does not count.
fn meeting(a: &Piece, b: &Piece, neighbours: bool) -> Option<DVec2> {
    let [p, q] = [a.ends[0], b.ends[0]];
    let [r, s] = [a.ends[1] - p, b.ends[1] - q];
    let cross = r.perp_dot(s);
    let parallel = cross.abs() <= 1e-12 * r.length() * s.length();
    if neighbours {
        // They share an end, so they meet elsewhere only when one folds back onto the other.
        return (parallel && folds_back(a, b)).then_some(b.ends[0]);
    }
    if parallel {
        return overlap(a, b);
    }
    let t = (q - p).perp_dot(s) / cross;
    let u = (q - p).perp_dot(r) / cross;
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)).then(|| p + r * t)
}

fn folds_back(a: &Piece, b: &Piece) -> bool {
    let [r, s] = [a.ends[1] - a.ends[0], b.ends[1] - b.ends[0]];
    r.dot(s) < 0.0
}

/// A common point of two parallel pieces that lie on one line.
fn overlap(a: &Piece, b: &Piece) -> Option<DVec2> {
    let along = a.ends[1] - a.ends[0];
    let length = along.length();
    if length == 0.0 || (along.perp_dot(b.ends[0] - a.ends[0]) / length).abs() > 1e-12 {
        return None;
    }
    let at = |point: DVec2| along.dot(point - a.ends[0]) / (length * length);
    let [from, to] = [at(b.ends[0]), at(b.ends[1])];
    let start = from.min(to).max(0.0);
    let end = from.max(to).min(1.0);
    (start <= end).then(|| a.ends[0] + along * start)
}

#[cfg(test)]
mod tests {
    use super::first_crossing;
    use glam::{DVec2, dvec2};

    /// Polylines of a polygon with straight edges.
    fn polygon(corners: &[[f64; 2]]) -> Vec<Vec<DVec2>> {
        let corner = |i: usize| DVec2::from(corners[i % corners.len()]);
        (0..corners.len()).map(|i| vec![corner(i), corner(i + 1)]).collect()
    }

    #[test]
    fn convex_and_concave_outlines_do_not_cross() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&square)), None);
        let dart = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.6, 1.0], [0.5, 0.2], [0.4, 1.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&dart)), None);
        let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&triangle)), None);
    }

    #[test]
    fn a_bow_tie_crosses_in_its_middle() {
        let tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&tie)), Some(([0, 2], dvec2(0.5, 0.5))));
    }

    #[test]
    fn a_corner_on_another_edge_counts() {
        let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&touching)).map(|(_, at)| at), Some(dvec2(1.0, 0.0)));
    }

    #[test]
    fn an_edge_that_runs_back_on_its_neighbour_counts() {
        let spike = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&spike)).map(|(edges, _)| edges), Some([0, 1]));
    }

    #[test]
    fn collinear_edges_that_do_not_overlap_are_fine() {
        let notched = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0], [1.5, 0.5], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&polygon(&notched)), None);
    }

    #[test]
    fn a_curve_can_cross_itself() {
        let looped = vec![dvec2(0.0, 0.0), dvec2(2.0, 1.0), dvec2(1.0, 2.0), dvec2(1.0, -1.0)];
        let back = vec![dvec2(1.0, -1.0), dvec2(0.0, -1.0), dvec2(0.0, 0.0)];
        assert_eq!(first_crossing(&[looped, back]).map(|(edges, _)| edges), Some([0, 0]));
    }
}
