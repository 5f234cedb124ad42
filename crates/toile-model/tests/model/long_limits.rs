//! Limits that span many cells: as long as the flat cloth, no shorter, across seams and around notches.

use crate::support::{garment, polygon, rectangle, settings};
use glam::{DVec2, DVec3, dvec2};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::ops::Range;
use toile_model::{Limit, Model, STRAND_PARTICLES_MAX, StepSettings, Strand};
use toile_scene::{Garment, Pin, Rule, Settings, Sheet, Threshold, VelocityModification};

/// Part of the threshold that the limits hold.
const AIM: f32 = 0.6;
/// Threshold of the fabric of [`settings`].
const THRESHOLD: f32 = 0.05;

/// Flat length [m] of a limit of so many metres.
fn rest_length(max_length: f32) -> f64 {
    f64::from(max_length / (1.0 + AIM * THRESHOLD))
}

fn hierarchical(spacing: f64) -> Settings {
    Settings { velocity_modification: VelocityModification::new(Rule::Hierarchical), ..settings(spacing) }
}

fn sheet(columns: u32, rows: u32, pins: Vec<Pin>) -> Model {
    sheet_of(columns, rows, pins, &hierarchical(0.01))
}

fn sheet_of(columns: u32, rows: u32, pins: Vec<Pin>, settings: &Settings) -> Model {
    let sheet = Sheet {
        name: "sheet".into(),
        size: DVec2::new(f64::from(columns - 1), f64::from(rows - 1)) * 0.01,
        columns,
        rows,
        corner: DVec3::ZERO,
        right: DVec3::X,
        down: DVec3::NEG_Y,
        pins,
    };
    Model::from_sheet(&sheet, settings)
}

/// No two strands of a colour share a particle, no strand has one twice, and where they go from edge to edge these are springs.
fn check_strands(model: &Model) {
    let mut end = 0;
    for colour in &model.strand_colours {
        assert_eq!(colour.start, end, "every strand has one colour");
        end = colour.end;
        let mut particles = BTreeSet::new();
        for strand in &model.strands[colour.start as usize..colour.end as usize] {
            assert!(strand.particles.len() >= 8 && strand.particles.len() <= STRAND_PARTICLES_MAX as usize);
            for k in strand.particles.clone() {
                let particle = model.strand_particles[k as usize];
                assert!(particles.insert(particle), "particle {particle} twice");
            }
        }
    }
    assert_eq!(end as usize, model.strands.len());
    let single = |strand: &Strand| {
        let line = &model.strand_particles[strand.particles.start as usize..strand.particles.end as usize];
        line.windows(2).map(|p| [p[0].min(p[1]), p[0].max(p[1])]).collect::<Vec<_>>()
    };
    let loose: Vec<[u32; 2]> = model.loose_limits().map(|l| l.ends).collect();
    let by_edges = model.strands.iter().filter(|strand| strand.stride == 1);
    let mut held: Vec<[u32; 2]> = by_edges.flat_map(single).chain(loose.iter().copied()).collect();
    held.sort_unstable();
    let is_loose = |ends: &[u32; 2]| loose.contains(ends);
    assert!(held.chunk_by(|a, b| a == b).all(|same| same.len() == 1 || !is_loose(&same[0])), "loose, and on a strand");
    held.dedup();
    let mut limits: Vec<[u32; 2]> = model.limits.iter().map(|l| l.ends).collect();
    limits.sort_unstable();
    assert_eq!(held, limits);
    let single: BTreeMap<[u32; 2], f32> = model.limits.iter().map(|l| (l.ends, l.max_length)).collect();
    for (ends, max_length) in model.strand_limits() {
        let wanted = single.get(&ends).copied().unwrap_or(max_length);
        assert!((max_length / wanted - 1.0).abs() < 1e-6, "{ends:?}: {max_length} m along a strand, {wanted} m alone");
    }
}

#[test]
fn on_a_grid_every_line_of_1_2_4_and_8_cells_has_its_length() {
    let model = sheet(12, 10, Vec::new());
    check_strands(&model);
    let cells: Vec<i64> = model
        .strand_limits()
        .map(|(ends, max_length)| {
            let [a, b] = ends.map(|i| [i64::from(i % 12), i64::from(i / 12)]);
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            let distance = model.positions[ends[0] as usize].distance(model.positions[ends[1] as usize]);
            let length = rest_length(max_length);
            assert!((length - f64::from(distance)).abs() < 1e-6, "{ends:?}: {length} m, {distance} m");
            assert!(x == 0 || y == 0 || x.abs() == y, "{x} columns and {y} rows");
            x.abs().max(y)
        })
        .collect();
    // Of each direction of diagonals two lines have 8 particles, two have 9 and three have 10; shorter ones are no strands.
    for (wanted, columns, rows, diagonals) in
        [(8, 4, 2, 2 + 3 * 2), (4, 8, 6, 8 + 10 + 18), (2, 10, 8, 12 + 14 + 24), (1, 11, 9, 14 + 16 + 27)]
    {
        let count = cells.iter().filter(|cells| **cells == wanted).count();
        assert_eq!(count, columns * 10 + rows * 12 + 2 * diagonals, "of {wanted} cells");
    }
    assert_eq!(model.strand_colours.len(), 4, "warp, weft and the two diagonals");
    let is_diagonal = |colour: &Range<u32>| {
        let first = model.strands[colour.start as usize].particles.start as usize;
        [11, 13].contains(&model.strand_particles[first].abs_diff(model.strand_particles[first + 1]))
    };
    let diagonals: Vec<bool> = model.strand_colours.iter().map(is_diagonal).collect();
    assert_eq!(diagonals, [true, true, false, false], "warp and weft have the last word");
    assert_eq!(model.loose_limits().count(), 84, "diagonals of the corners");
}

/// The first particle of each limit along the first row of a sheet, by the cells that it spans.
fn along_the_first_row(model: &Model, columns: u32) -> BTreeMap<u32, BTreeSet<u32>> {
    let mut firsts: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for (ends, max_length) in model.strand_limits().filter(|(ends, _)| ends[1] < columns) {
        let cells = ends[1] - ends[0];
        assert!((rest_length(max_length) - 0.01 * f64::from(cells)).abs() < 1e-6, "{ends:?}: {max_length} m");
        assert!(firsts.entry(cells).or_default().insert(ends[0]), "{ends:?} twice");
    }
    firsts
}

#[test]
fn strands_of_a_long_line_lie_between_one_another_so_that_no_long_limit_is_missing() {
    for (columns, rows) in [(513, 3), (1100, 3), (600, 300)] {
        let model = sheet(columns, rows, Vec::new());
        check_strands(&model);
        let stride = model.strands.iter().map(|strand| strand.stride).max().expect("it has strands");
        assert_eq!(stride, if columns > 1024 { 4 } else { 2 });
        let firsts = along_the_first_row(&model, columns);
        let cells_max = if rows == 300 { 32 } else { 8 };
        let cells: Vec<u32> = firsts.keys().copied().collect();
        assert_eq!(cells, (0..).map(|level| 1 << level).take_while(|c| *c <= cells_max).collect::<Vec<u32>>());
        for (cells, firsts) in firsts {
            // Shorter ones are missing where one of the strands that hold them ends and the next begins.
            let missing = if cells >= stride { 0 } else { (columns.div_ceil(512) - 1) * cells };
            assert_eq!(firsts.len() as u32, columns - cells - missing, "of {cells} cells in {columns} columns");
        }
    }
}

#[test]
fn a_ribbon_too_long_for_its_limits_has_strands_all_the_same() {
    let model = sheet(5000, 2, Vec::new());
    check_strands(&model);
    let longest: usize = along_the_first_row(&model, 5000)[&8].len();
    assert!(longest > 4900 && model.strands.iter().all(|strand| strand.level_count > 0), "{longest} of 8 cells");
}

#[test]
fn cloth_has_a_fourth_sweep_where_its_longest_limits_span_64_cells_and_more_guard_with_each_doubling() {
    let mut settings = hierarchical(0.01);
    let numbers = |settings: &Settings, model: &Model| {
        let step = StepSettings::new(settings, model);
        (step.sweeps, step.guard_passes)
    };
    for (stride, level_count, expected) in
        [(1, 1, (3, 2)), (1, 6, (3, 2)), (1, 7, (4, 4)), (1, 8, (4, 6)), (2, 5, (3, 2)), (2, 6, (4, 4)), (2, 8, (4, 8))]
    {
        let strand = Strand { particles: 0..100, stride, lengths: 0, level_count };
        let shorter = Strand { stride: 1, level_count: 1, ..strand.clone() };
        let model = Model { strands: vec![strand, shorter], ..Model::default() };
        settings.velocity_modification.sweeps = None;
        assert_eq!(numbers(&settings, &model), expected, "{level_count} levels of {stride}");
        settings.velocity_modification.sweeps = Some(2);
        assert_eq!(numbers(&settings, &model), (2, expected.1), "{level_count} levels of {stride}, two sweeps asked");
    }
    settings.velocity_modification.sweeps = None;
    assert_eq!(numbers(&settings, &sheet(20, 20, Vec::new())), (3, 2));
    settings.velocity_modification = VelocityModification::new(Rule::Predictive);
    assert_eq!(numbers(&settings, &sheet(20, 20, Vec::new())).0, 1);
}

#[test]
fn other_rules_have_no_long_limits() {
    let model = Model::from_garment(&tube(), &settings(0.02)).unwrap();
    assert!(model.strands.is_empty() && model.sewn().0.strands.is_empty());
    assert!(model.attachments.values.is_empty());
}

/// Front and back of a tube of 0.6 m around and 0.3 m along.
fn tube() -> Garment {
    let mut back = rectangle("back", [0.3, 0.3], -0.2);
    back.edges.reverse();
    garment(vec![rectangle("front", [0.3, 0.3], 0.2), back], &[([0, 1], [1, 1]), ([0, 3], [1, 3])])
}

/// Settings of a woven fabric.
fn woven() -> Settings {
    let mut settings = hierarchical(0.01);
    settings.fabric.threshold = Threshold { warp: 0.01, weft: 0.02, shear: 0.1 };
    settings
}

#[test]
fn each_direction_has_its_own_threshold() {
    let model = sheet_of(12, 10, vec![Pin { column: 0, row: 0 }], &woven());
    let check = |ends: [u32; 2], max_length: f32| {
        let [a, b] = ends.map(|i| model.flat[i as usize]);
        let way = (b - a).abs();
        let threshold = match way.to_array() {
            [x, _] if x < 1e-6 => 0.01,
            [_, y] if y < 1e-6 => 0.02,
            [x, y] if (x - y).abs() < 1e-6 => 0.1,
            // Of attachments alone.
            _ => return 0,
        };
        let stretch = max_length / way.length();
        assert!((stretch - 1.0 - AIM * threshold).abs() < 1e-5, "{way}: {stretch}");
        1
    };
    let strands: usize = model.strand_limits().map(|(ends, max_length)| check(ends, max_length)).sum();
    assert_eq!(strands, model.strand_lengths.len());
    assert_eq!(model.limits.iter().map(|l| check(l.ends, l.max_length)).sum::<usize>(), model.limits.len());
    let attachments =
        (1..model.particle_count()).flat_map(|i| model.attachments.row(i as usize).iter().map(move |a| (i, a)));
    let checked: usize = attachments.map(|(i, a)| check([a.pin, i], a.max_length)).sum();
    assert_eq!(checked, 9 + 11 + 9, "along the warp, the weft and the bias");
}

#[test]
fn where_the_grain_turns_at_a_seam_the_tightest_threshold_holds() {
    // Down the side of one panel and along the foot of the other.
    let panels = vec![rectangle("one", [0.1, 0.1], 0.2), rectangle("other", [0.1, 0.1], -0.2)];
    let open = Model::from_garment(&garment(panels, &[([0, 1], [1, 0])]), &woven()).unwrap();
    let (model, merge) = open.sewn();
    let is_in_seam = |i: &u32| merge.members.row(*i as usize).len() == 2;
    let seam: Vec<&Limit> = model.limits.iter().filter(|l| l.ends.iter().all(is_in_seam)).collect();
    assert_eq!(seam.len(), 10);
    for limit in seam {
        assert!((limit.max_length / limit.rest_length - 1.0 - AIM * 0.01).abs() < 1e-5, "{limit:?}");
    }
}

#[test]
fn they_reach_across_seams_and_let_a_tube_be_round() {
    let (model, merge) = Model::from_garment(&tube(), &hierarchical(0.02)).unwrap().sewn();
    check_strands(&model);
    let open = Model::from_garment(&tube(), &hierarchical(0.02)).unwrap();
    let front = open.panels[0].particles.end;
    // Angle and height of each particle on the round tube: the back goes on where the front ends.
    let place = |i: u32| {
        let member = merge.members.row(i as usize)[0];
        let flat = open.flat[member as usize].as_dvec2();
        let around = if member < front { flat.x } else { 0.6 - flat.x };
        dvec2(around / 0.6 * 2.0 * PI, flat.y)
    };
    let radius = 0.6 / (2.0 * PI);
    let mut across = 0;
    for (ends, max_length) in model.strand_limits() {
        let length = rest_length(max_length);
        let [a, b] = ends.map(place);
        let turn = (a.x - b.x).rem_euclid(2.0 * PI);
        let turn = turn.min(2.0 * PI - turn);
        let chord = (2.0 * radius * (0.5 * turn).sin()).hypot(a.y - b.y);
        let geodesic = (radius * turn).hypot(a.y - b.y);
        assert!(length > chord - 1e-6, "{ends:?}: {length} m, shorter than {chord} m");
        assert!(length < geodesic + 1e-6, "{ends:?}: {length} m, longer than {geodesic} m");
        let sides = ends.map(|i| merge.members.row(i as usize)[0] < front);
        across += usize::from(sides[0] != sides[1]);
    }
    assert!(across > 100, "{across} limits lead from the front to the back");
}

/// A ring is cut somewhere; a strand across the cut holds the cloth there.
#[test]
fn every_particle_of_a_ring_is_amid_long_limits() {
    let (tube, _) = Model::from_garment(&tube(), &hierarchical(0.02)).unwrap().sewn();
    check_strands(&tube);
    let hem: Vec<u32> = (0..tube.particle_count()).filter(|&i| tube.flat[i as usize].y == 0.0).collect();
    assert_eq!(hem.len(), 30);
    let amid: BTreeSet<u32> = tube
        .strands
        .iter()
        .flat_map(|strand| {
            let particles = &tube.strand_particles[strand.particles.start as usize..strand.particles.end as usize];
            particles.windows(9)
        })
        .filter(|window| window.iter().all(|particle| hem.contains(particle)))
        .map(|window| window[4])
        .collect();
    assert_eq!(amid, hem.into_iter().collect());
}

#[test]
fn around_a_notch_they_are_as_long_as_the_way_inside() {
    // A quarter of a circle is cut out of a square.
    let arc = (0..=12).map(|k| f64::from(k) * PI / 24.0).map(|a| dvec2(0.3 - 0.2 * a.cos(), 0.3 - 0.2 * a.sin()));
    let corners = [dvec2(0.3, 0.0), dvec2(0.3, 0.1), dvec2(0.1, 0.3), dvec2(0.0, 0.3), dvec2(0.0, 0.0)];
    let mut points: Vec<DVec2> = arc.collect();
    points.reverse();
    points.extend([corners[3], corners[4], corners[0]]);
    let bitten = garment(vec![polygon("bitten", &points, 0.0)], &[]);
    let model = Model::from_garment(&bitten, &hierarchical(0.02)).unwrap();
    check_strands(&model);
    let mut around = 0;
    for (ends, max_length) in model.strand_limits() {
        let [a, b] = ends.map(|i| model.flat[i as usize].as_dvec2());
        let (chord, length) = (a.distance(b), rest_length(max_length));
        assert!(length > chord - 1e-6, "{ends:?}: {length} m, shorter than the straight line, {chord} m");
        let outside = (a.midpoint(b) - dvec2(0.3, 0.3)).length() < 0.195;
        if outside {
            around += 1;
            // The way along the arc: a chord of 0.2 m · 2·sin(angle/2).
            let along = 0.4 * (chord / 0.4).asin();
            assert!(length > chord * 1.0001 && length < 1.05 * along, "{ends:?}: {length} m, {along} m along the arc");
        }
    }
    assert!(around > 5, "{around} limits lead around the notch");
}

#[test]
fn every_particle_hangs_on_the_nearest_pin_of_each_group() {
    let pin = |column, row| Pin { column, row };
    let model = sheet(12, 10, vec![pin(0, 0), pin(1, 0), pin(11, 0)]);
    for i in 0..model.particle_count() {
        let row = model.attachments.row(i as usize);
        if model.inverse_masses[i as usize] == 0.0 {
            assert!(row.is_empty(), "a pin hangs on nothing");
            continue;
        }
        let distance = |pin: u32| model.positions[i as usize].distance(model.positions[pin as usize]);
        let nearer = if distance(0) <= distance(1) { 0 } else { 1 };
        let mut pins: Vec<u32> = row.iter().map(|a| a.pin).collect();
        pins.sort_unstable();
        assert_eq!(pins, [nearer, 11]);
        for attachment in row {
            let stretch = attachment.max_length / distance(attachment.pin);
            assert!((stretch - 1.0 - AIM * THRESHOLD).abs() < 1e-5, "{stretch}");
        }
    }
}
