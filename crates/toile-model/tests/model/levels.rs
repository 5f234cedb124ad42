//! Levels: on a grid every second particle of the level below, masses and parts that sum up, and lengths of the flat cloth, across seams and around
//! notches.

use crate::support::{check_colours, garment, polygon, rectangle, settings};
use glam::{DVec2, DVec3, Vec3, dvec2};
use std::f64::consts::PI;
use toile_model::{Arrays, CLUSTER_PAIRS, Cluster, Csr, Leader, Level, Limit, Model, NO_CORNER, StepSettings};
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
    let mut settings = settings(spacing);
    settings.velocity_modification = VelocityModification::new(Rule::Hierarchical);
    settings
}

fn sheet(columns: u32, rows: u32, pins: Vec<Pin>) -> Model {
    sheet_of(columns, rows, pins, &hierarchical(0.01))
}

fn sheet_of(columns: u32, rows: u32, pins: Vec<Pin>, settings: &Settings) -> Model {
    let mut sheet =
        Sheet::new("sheet", [columns, rows], DVec2::new(f64::from(columns - 1), f64::from(rows - 1)) * 0.01);
    sheet.down = DVec3::NEG_Y;
    sheet.pins = pins;
    Model::from_sheet(&sheet, settings)
}

/// The particles where the nodes of a level are.
fn sites(model: &Model, level: &Level) -> Vec<u32> {
    level.nodes.clone().map(|node| model.site(node)).collect()
}

/// Limits of all levels: the particles where their ends are, and their maximum lengths [m].
fn all_limits(model: &Model) -> Vec<([u32; 2], f32)> {
    let limits = model.levels.iter().flat_map(|level| model.level_limits(level));
    limits.map(|(ends, length)| (ends.map(|node| model.site(node)), length)).collect()
}

/// What holds of the levels of every cloth.
fn check_levels(model: &Model) {
    let mut end = 0;
    let mut cluster = 0;
    for level in &model.levels {
        assert_eq!(level.nodes.start, end, "one level after the other");
        end = level.nodes.end;
        let first = cluster;
        let colours: Vec<_> = level.colours.iter().map(|c| c.start - first..c.end - first).collect();
        assert_eq!(level.colours[0].start, cluster, "one level after the other");
        cluster = level.colours[level.colours.len() - 1].end;
        let nodes = |cluster: &Cluster| {
            let mut nodes: Vec<u32> = cluster.nodes.iter().copied().filter(|node| *node != NO_CORNER).collect();
            nodes.sort_unstable();
            nodes
        };
        let clusters: Vec<Vec<u32>> = model.clusters[first as usize..cluster as usize].iter().map(nodes).collect();
        check_colours(&colours, &clusters);
        assert!(clusters.iter().flatten().all(|node| level.nodes.contains(node)), "a cluster lies within its level");
        let sites = sites(model, level);
        assert!(sites.windows(2).all(|pair| pair[0] < pair[1]), "no particle has two nodes of a level");
    }
    assert_eq!(end, model.particle_count() + model.coarse_particles.len() as u32);
    assert_eq!(model.clusters.len(), cluster as usize);
    let springs: Vec<([u32; 2], f32)> = model.level_limits(&model.levels[0]).into_iter().collect();
    let mut limits: Vec<([u32; 2], f32)> = model.limits.iter().map(|limit| (limit.ends, limit.max_length)).collect();
    limits.sort_by_key(|limit| limit.0);
    assert_eq!(springs, limits, "the first level has the limits of single springs");
    check_guard(model);
    check_leaders(model);
}

/// The guard begins twice as far as limits allow.
fn check_guard(model: &Model) {
    let last = model.levels[0].colours.last().expect("the cloth has limits");
    assert_eq!(model.guard_lengths.len() as u32, last.end);
    for (cluster, guard) in model.guard_lengths.iter().enumerate() {
        for (pair, length) in CLUSTER_PAIRS.iter().zip(guard) {
            let ends = pair.map(|corner| model.clusters[cluster].nodes[corner]);
            let limit =
                model.limits.iter().find(|limit| ends.contains(&limit.ends[0]) && ends.contains(&limit.ends[1]));
            let expected = limit.map_or(f32::INFINITY, |limit| 2.0 * limit.max_length - limit.rest_length);
            assert!(
                *length == expected || (length / expected - 1.0).abs() < 1e-6,
                "{ends:?}: {length} m, {expected} m"
            );
        }
    }
}

/// Parts sum to one, and the mass that a coarse particle carries is that of what it leads.
fn check_leaders(model: &Model) {
    let count = model.positions.len();
    assert_eq!(model.leaders.row_count(), count + model.coarse_particles.len());
    let coarsest = &model.levels[model.levels.len() - 1].nodes;
    let mut masses: Vec<f64> = model.masses.iter().map(|mass| f64::from(*mass)).collect();
    masses.resize(model.leaders.row_count(), 0.0);
    for row in 0..model.leaders.row_count() {
        let leaders: &[Leader] = model.leaders.row(row);
        let is_pinned = model.inverse_masses[model.site(row as u32) as usize] == 0.0;
        if row >= coarsest.start as usize {
            assert!(leaders.is_empty(), "the coarsest level follows nobody");
            continue;
        }
        let sum: f32 = leaders.iter().map(|leader| leader.part).sum();
        assert!((sum - 1.0).abs() < 1e-6, "the parts of {row} sum to {sum}");
        let mass = masses[row];
        // What is pinned does not follow, but one that stands where it is has its mass.
        for leader in leaders.iter().filter(|leader| !is_pinned || leader.part == 1.0) {
            masses[leader.node as usize] += f64::from(leader.part) * mass;
        }
    }
    for (coarse, mass) in model.coarse_particles.iter().zip(&masses[count..]) {
        let carried = f64::from(coarse.inverse_mass) * mass;
        assert!((carried - 1.0).abs() < 1e-5, "{carried}");
    }
}

#[test]
fn a_grid_has_every_second_particle_of_the_level_below_in_every_level_and_its_cells_as_clusters() {
    let model = sheet(17, 9, Vec::new());
    check_levels(&model);
    for (level, stride) in model.levels.iter().zip([1, 2, 4, 8]) {
        let grid = (0..9).step_by(stride).flat_map(|row| (0..17).step_by(stride).map(move |column| 17 * row + column));
        assert_eq!(sites(&model, level), grid.collect::<Vec<u32>>());
        let clusters: u32 = level.colours.iter().map(|colour| colour.end - colour.start).sum();
        assert_eq!(clusters as usize, (16 / stride) * (8 / stride));
        assert!(level.colours.len() <= 4);
    }
    let middle = model.leaders.row(17 + 1);
    assert_eq!(middle.iter().map(|leader| leader.part).collect::<Vec<_>>(), [0.25; 4]);
}

#[test]
fn the_last_row_and_column_of_an_even_grid_are_led_from_both_sides() {
    let model = sheet(16, 16, Vec::new());
    check_levels(&model);
    let corner = 16 * 16 - 1;
    assert!(sites(&model, &model.levels[1]).contains(&(16 * 2 - 1 + 16)), "the last column is in the first level");
    assert_eq!(model.leaders.row(corner).len(), 1, "the corner is one of it");
    let sizes: Vec<usize> = model.levels.iter().map(|level| level.nodes.len()).collect();
    assert!(sizes[1] <= 9 * 9 && sizes[2] <= 5 * 5, "{sizes:?}");
}

#[test]
fn lengths_are_those_of_the_flat_cloth() {
    let model = sheet(33, 20, Vec::new());
    for (ends, max_length) in all_limits(&model) {
        let [a, b] = ends.map(|end| model.flat[end as usize]);
        assert!((max_length / a.distance(b) - (1.0 + AIM * THRESHOLD)).abs() < 1e-5);
    }
}

#[test]
fn pins_are_nodes_of_every_level_that_nothing_moves() {
    let pins = [(0, 0), (16, 0), (7, 5), (8, 5)].map(|(column, row)| Pin { column, row }).to_vec();
    let model = sheet(17, 17, pins);
    check_levels(&model);
    for level in &model.levels[1..3] {
        let fixed = level.nodes.clone().filter(|node| model.inverse_masses[model.site(*node) as usize] == 0.0);
        // Of two pins side by side one is enough.
        assert_eq!(fixed.map(|node| model.site(node)).collect::<Vec<_>>(), [0, 16, 5 * 17 + 7]);
    }
}

#[test]
fn fine_cloth_has_further_passes_with_each_doubling() {
    let mut settings = hierarchical(0.01);
    let numbers = |settings: &Settings, levels: usize| {
        let mut arrays = Arrays::of_particles(vec![Vec3::ZERO], vec![1.0]);
        arrays.leaders = Csr::from_rows([[]]);
        arrays.guard_lengths = Vec::new();
        arrays.levels =
            (0..levels).map(|level| Level { nodes: u32::from(level > 0)..1, colours: Vec::new() }).collect();
        let model = Model::new(arrays).expect("a particle that stands alone on every level");
        let step = StepSettings::new(settings, &model);
        [step.sweeps, step.limit_passes, step.guard_passes]
    };
    for (levels, expected) in [(1, [2, 2, 2]), (7, [2, 2, 2]), (8, [2, 3, 3]), (10, [2, 5, 5])] {
        assert_eq!(numbers(&settings, levels), expected, "{levels} levels");
    }
    settings.velocity_modification.sweeps = Some(4);
    assert_eq!(numbers(&settings, 8), [4, 3, 3], "four sweeps asked");
    settings.velocity_modification = VelocityModification::new(Rule::Predictive);
    assert_eq!(numbers(&settings, 0)[..2], [1, 1]);
    assert_eq!(sheet(64, 64, Vec::new()).levels.len(), 7);
}

#[test]
fn other_rules_have_no_levels() {
    let model = Model::from_garment(&tube(), &settings(0.02)).unwrap();
    assert!(model.levels.is_empty() && model.sewn().0.levels.is_empty());
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
    let limits = all_limits(&model);
    // Beside those of odd ends, which lie between the directions.
    assert!(10 * limits.iter().map(|(ends, length)| check(*ends, *length)).sum::<usize>() > 9 * limits.len());
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
    check_levels(&model);
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
    for (ends, max_length) in all_limits(&model) {
        let length = rest_length(max_length);
        let [a, b] = ends.map(place);
        let turn = (a.x - b.x).rem_euclid(2.0 * PI);
        let turn = turn.min(2.0 * PI - turn);
        let chord = (2.0 * radius * (0.5 * turn).sin()).hypot(a.y - b.y);
        let geodesic = (radius * turn).hypot(a.y - b.y);
        assert!(length > chord - 1e-6, "{ends:?}: {length} m, shorter than {chord} m");
        // By a particle of the seam, which need not lie on the straight way.
        assert!(length < 1.1 * geodesic, "{ends:?}: {length} m, longer than {geodesic} m");
        let sides = ends.map(|i| merge.members.row(i as usize)[0] < front);
        across += usize::from(sides[0] != sides[1]);
    }
    assert!(across > 100, "{across} limits lead from the front to the back");
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
    check_levels(&model);
    let mut around = 0;
    for (ends, max_length) in all_limits(&model) {
        let [a, b] = ends.map(|i| model.flat[i as usize].as_dvec2());
        let (chord, length) = (a.distance(b), rest_length(max_length));
        assert!(length > chord - 1e-6, "{ends:?}: {length} m, shorter than the straight line, {chord} m");
        let outside = (a.midpoint(b) - dvec2(0.3, 0.3)).length() < 0.195;
        if outside {
            around += 1;
            // The way along the arc: a chord of 0.2 m · 2·sin(angle/2).
            let along = 0.4 * (chord / 0.4).asin();
            assert!(length > chord * 1.0001 && length < 1.15 * along, "{ends:?}: {length} m, {along} m along the arc");
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
