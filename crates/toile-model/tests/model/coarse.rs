//! Levels of coarse particles: on a grid every second particle of the level below, masses and parts that sum up, lengths of the flat cloth.

use crate::support::{check_colours, garment, rectangle, settings};
use glam::{DVec2, DVec3};
use toile_model::{Leader, Level, Model};
use toile_scene::{Pin, Rule, Settings, Sheet, Threshold, VelocityModification};

/// Part of the threshold that coarse limits hold.
const AIM: f32 = 0.3;
const THRESHOLD: f32 = 0.05;

fn coarse(spacing: f64) -> Settings {
    let mut settings = settings(spacing);
    settings.fabric.threshold = Threshold::even(f64::from(THRESHOLD));
    settings.velocity_modification =
        VelocityModification { coarse: true, ..VelocityModification::new(Rule::Hierarchical) };
    settings
}

fn sheet(columns: u32, rows: u32, pins: Vec<Pin>) -> Model {
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
    Model::from_sheet(&sheet, &coarse(0.01))
}

fn sites(model: &Model, level: &Level) -> Vec<u32> {
    model.coarse_particles[level.particles.start as usize..level.particles.end as usize]
        .iter()
        .map(|coarse| coarse.site)
        .collect()
}

/// What holds of the levels of every cloth.
fn check_levels(model: &Model) {
    assert!(!model.levels.is_empty() && model.strands.is_empty());
    let mut end = 0;
    for level in &model.levels {
        assert_eq!(level.particles.start, end, "one level after the other");
        end = level.particles.end;
        let first = level.colours[0].start;
        let colours: Vec<_> = level.colours.iter().map(|c| c.start - first..c.end - first).collect();
        let last = level.colours[level.colours.len() - 1].end;
        let limits = &model.coarse_limits[first as usize..last as usize];
        check_colours(&colours, &limits.iter().map(|limit| limit.ends).collect::<Vec<_>>());
        for limit in limits {
            assert!(limit.ends.iter().all(|end| level.particles.contains(end)), "a limit lies within its level");
            assert!(limit.max_length > limit.rest_length && limit.rest_length > 0.0);
        }
        let sites = sites(model, level);
        assert!(sites.windows(2).all(|pair| pair[0] < pair[1]), "no particle has two of a level");
    }
    assert_eq!(end as usize, model.coarse_particles.len());
    check_leaders(model);
}

/// Parts sum to one, and the mass that a coarse particle carries is that of what it leads.
fn check_leaders(model: &Model) {
    let count = model.positions.len();
    assert_eq!(model.leaders.row_count(), count + model.coarse_particles.len());
    let coarsest = &model.levels[model.levels.len() - 1].particles;
    let mut masses: Vec<f64> = model.masses.iter().map(|mass| f64::from(*mass)).collect();
    masses.resize(model.leaders.row_count(), 0.0);
    for row in 0..model.leaders.row_count() {
        let leaders: &[Leader] = model.leaders.row(row);
        let is_pinned = match row.checked_sub(count) {
            Some(coarse) => model.coarse_particles[coarse].inverse_mass == 0.0,
            None => model.inverse_masses[row] == 0.0,
        };
        if is_pinned || row >= count + coarsest.start as usize {
            assert!(leaders.is_empty(), "pins and the coarsest level follow nobody");
            continue;
        }
        let sum: f32 = leaders.iter().map(|leader| leader.part).sum();
        assert!((sum - 1.0).abs() < 1e-6, "the parts of {row} sum to {sum}");
        let mass = masses[row];
        for leader in leaders {
            masses[count + leader.coarse as usize] += f64::from(leader.part) * mass;
        }
    }
    for (coarse, mass) in model.coarse_particles.iter().zip(&masses[count..]) {
        let carried = f64::from(coarse.inverse_mass) * mass;
        assert!(coarse.inverse_mass == 0.0 || (carried - 1.0).abs() < 1e-5, "{carried}");
    }
}

#[test]
fn a_grid_has_every_second_particle_of_the_level_below_in_every_level() {
    let model = sheet(17, 9, Vec::new());
    check_levels(&model);
    for (level, stride) in model.levels.iter().zip([2, 4, 8]) {
        let grid = (0..9).step_by(stride).flat_map(|row| (0..17).step_by(stride).map(move |column| 17 * row + column));
        assert_eq!(sites(&model, level), grid.collect::<Vec<u32>>());
        assert!(level.colours.len() <= 8, "as many colours as single springs");
    }
    let middle = model.leaders.row(17 + 1);
    assert_eq!(middle.iter().map(|leader| leader.part).collect::<Vec<_>>(), [0.25; 4]);
}

#[test]
fn the_last_row_and_column_of_an_even_grid_are_led_from_both_sides() {
    let model = sheet(16, 16, Vec::new());
    check_levels(&model);
    let corner = 16 * 16 - 1;
    assert!(sites(&model, &model.levels[0]).contains(&(16 * 2 - 1 + 16)), "the last column is in the first level");
    assert_eq!(model.leaders.row(corner).len(), 1, "the corner is one of it");
    let sizes: Vec<usize> = model.levels.iter().map(|level| level.particles.len()).collect();
    assert!(sizes[0] <= 9 * 9 && sizes[1] <= 5 * 5, "{sizes:?}");
}

#[test]
fn lengths_are_those_of_the_flat_cloth() {
    let model = sheet(33, 20, Vec::new());
    for limit in &model.coarse_limits {
        let [a, b] = limit.ends.map(|end| model.flat[model.coarse_particles[end as usize].site as usize]);
        assert!((limit.rest_length / a.distance(b) - 1.0).abs() < 1e-5);
        assert!((limit.max_length / limit.rest_length - (1.0 + AIM * THRESHOLD)).abs() < 1e-5);
    }
}

#[test]
fn pins_are_coarse_particles_of_every_level_that_nothing_moves() {
    let pins = [(0, 0), (16, 0), (7, 5), (8, 5)].map(|(column, row)| Pin { column, row }).to_vec();
    let model = sheet(17, 17, pins);
    check_levels(&model);
    for level in &model.levels[..2] {
        let fixed = |coarse: &&toile_model::CoarseParticle| coarse.inverse_mass == 0.0;
        let range = level.particles.start as usize..level.particles.end as usize;
        let fixed: Vec<u32> = model.coarse_particles[range].iter().filter(fixed).map(|coarse| coarse.site).collect();
        // Of two pins side by side one is enough.
        assert_eq!(fixed, [0, 16, 5 * 17 + 7]);
    }
}

/// A tube of two panels: limits go across the seams, and as far as the cloth is long.
#[test]
fn limits_go_across_closed_seams_and_no_other() {
    let panels = vec![rectangle("front", [0.2, 0.2], 0.1), rectangle("back", [0.2, 0.2], -0.1)];
    let tube = garment(panels, &[([0, 1], [1, 3]), ([0, 3], [1, 1])]);
    let open = Model::from_garment(&tube, &coarse(0.02)).expect("it is a garment");
    check_levels(&open);
    let panel = |particle: u32| open.panels.iter().position(|panel| panel.particles.contains(&particle));
    for limit in &open.coarse_limits {
        let [a, b] = limit.ends.map(|end| panel(open.coarse_particles[end as usize].site));
        assert_eq!(a, b, "open panels are apart");
    }
    let (sewn, merge) = open.sewn();
    check_levels(&sewn);
    let panels =
        |site: u32| -> Vec<Option<usize>> { merge.members.row(site as usize).iter().map(|m| panel(*m)).collect() };
    let across = sewn.coarse_limits.iter().filter(|limit| {
        let [a, b] = limit.ends.map(|end| panels(sewn.coarse_particles[end as usize].site));
        a.iter().all(|panel| !b.contains(panel))
    });
    let lengths: Vec<f32> = across.map(|limit| limit.rest_length).collect();
    assert!(lengths.len() > 4, "limits go across the seams: {lengths:?}");
    assert!(lengths.iter().all(|length| *length < 0.25), "no farther than around the tube: {lengths:?}");
}
