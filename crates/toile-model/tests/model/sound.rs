//! What does not fit together is no model.

use crate::support::{garment, rectangle, settings};
use glam::Vec3;
use toile_model::{Arrays, Model, ModelError, NO_CORNER};
use toile_scene::{Rule, VelocityModification};

/// A tube before it is sewn, with levels and seams.
fn tube() -> Model {
    let mut back = rectangle("back", [0.3, 0.2], -0.2);
    back.edges.reverse();
    let tube = garment(vec![rectangle("front", [0.3, 0.2], 0.2), back], &[([0, 1], [1, 1]), ([0, 3], [1, 3])]);
    let mut settings = settings(0.02);
    settings.velocity_modification = VelocityModification::new(Rule::Hierarchical);
    Model::from_garment(&tube, &settings).expect("it meshes")
}

fn refused(change: impl FnOnce(&mut Arrays)) -> String {
    match tube().changed(change) {
        Err(ModelError::Arrays { what }) => what,
        other => panic!("{:?} is a model, or no such error", other.map(|model| model.particle_count())),
    }
}

#[test]
fn what_is_made_fits_together_open_and_sewn() {
    let open = tube();
    assert!(open.levels.len() > 2 && !open.seam_pairs.is_empty());
    let (sewn, _) = open.sewn();
    for model in [open, sewn] {
        assert_eq!(model.clone().changed(|_| ()), Ok(model));
    }
    let free = Model::new(Arrays::of_particles(vec![Vec3::X, Vec3::Y], vec![1.0, 2.0])).expect("two particles");
    assert_eq!(free.inverse_masses, [1.0, 0.5]);
}

/// The count of particles that each message names is that of the tube.
#[test]
fn nothing_leads_beyond_its_array() {
    let count = tube().particle_count();
    let beyond = |name: &str| format!("{name} leads to {count} of {count}");
    assert_eq!(refused(|m| m.springs[3].ends[1] = count), beyond("springs"));
    assert_eq!(refused(|m| m.links.values[3].other = count), beyond("links"));
    assert_eq!(refused(|m| m.limits[3].ends[0] = count), beyond("limits"));
    assert_eq!(refused(|m| m.seam_pairs[0].ends[0] = count), beyond("seam_pairs"));
    assert_eq!(refused(|m| m.quads[1][0] = count), beyond("quads"));
    assert_eq!(refused(|m| m.quads[1][2] = NO_CORNER), format!("quads leads to {NO_CORNER} of {count}"));
    assert_eq!(refused(|m| m.coarse_particles[0].site = count), beyond("coarse_particles"));
    assert_eq!(refused(|m| m.held_particles.push(count)), beyond("held_particles"));
    assert!(refused(|m| m.particle_quads.values[0] = u32::MAX).starts_with("particle_quads leads to"));
    assert!(refused(|m| m.seam_pairs[0].seam = 2).starts_with("seam_pairs leads to 2 of 2"));
    assert!(refused(|m| m.panels[1].quads.end += 1).contains("panel back"));
    assert!(refused(|m| m.held_particles.push(0)).starts_with("holds ends at 0 of 1"));
}

#[test]
fn every_particle_has_everything() {
    assert!(refused(|m| m.positions.clear()).contains("0 particles"));
    assert!(refused(|m| m.masses.truncate(5)).starts_with("masses has 5 entries"));
    assert!(refused(|m| m.inverse_masses.truncate(5)).starts_with("inverse_masses has 5 entries"));
    assert!(refused(|m| m.flat.truncate(5)).starts_with("flat has 5 entries"));
    assert!(refused(|m| m.links = Default::default()).starts_with("links has 0 rows"));
    assert!(refused(|m| m.attachments = Default::default()).starts_with("attachments has 0 rows"));
    assert!(refused(|m| m.leaders = Default::default()).starts_with("leaders has 0 rows"));
    assert!(refused(|m| m.particle_quads.offsets.swap(3, 4)).contains("do not follow one another"));
    assert!(refused(|m| *m.links.offsets.last_mut().expect("rows") += 1).contains("do not follow one another"));
}

#[test]
fn numbers_are_numbers() {
    assert_eq!(refused(|m| m.positions[7].z = f32::NAN), "positions 7 is no number that it may be");
    assert_eq!(refused(|m| m.masses[2] = 0.0), "masses 2 is no number that it may be");
    assert_eq!(refused(|m| m.inverse_masses[2] = f32::INFINITY), "inverse_masses 2 is no number that it may be");
    assert!(refused(|m| m.links.values[0].stiffness = -1.0).starts_with("links 0"));
    assert!(refused(|m| m.springs[4].rest_length = f32::NAN).starts_with("springs 4"));
    assert!(refused(|m| m.limits[5].max_length = f32::INFINITY).starts_with("limits 5"));
    assert!(refused(|m| m.clusters[5].max_lengths[0] = f32::NAN).starts_with("clusters 5"));
    assert!(refused(|m| m.guard_lengths[5][0] = -1.0).starts_with("guard_lengths 5"));
    assert!(refused(|m| m.leaders.values[5].part = f32::NAN).starts_with("leaders 5"));
    assert!(refused(|m| m.coarse_particles[1].inverse_mass = f32::NAN).starts_with("coarse_particles 1"));
    assert!(refused(|m| m.seam_pairs[1].closing_speed = -1.0).starts_with("seam_pairs 1"));
}

#[test]
fn no_two_of_a_colour_share_a_particle() {
    let merged = |colours: &mut Vec<std::ops::Range<u32>>| colours[0].end = colours.remove(1).end;
    assert!(refused(|m| merged(&mut m.limit_colours)).starts_with("limit_colours: two of colour 0 share"));
    assert!(refused(|m| merged(&mut m.levels[0].colours)).starts_with("colours of a level: two of colour 0 share"));
    assert!(refused(|m| m.seam_pairs[1].ends = m.seam_pairs[0].ends).starts_with("seam_colours: two of colour 0"));
    assert!(refused(|m| m.limit_colours[1].start += 1).starts_with("limit_colours has a part"));
    assert!(refused(|m| m.seam_colours[0].end -= 1).starts_with("seam_colours ends at"));
}

#[test]
fn levels_are_led_by_the_next_alone() {
    assert!(refused(|m| m.leaders.values[0].node = 0).contains("which is none of the next level"));
    assert!(refused(|m| m.clusters[0].nodes[0] = m.levels[1].nodes.start).contains("which is none of the level"));
    assert!(refused(|m| m.levels[1].nodes.end += 1).starts_with("levels has a part"));
    assert!(refused(|m| m.levels[0].colours[0].start = 1).starts_with("colours of a level has a part"));
    assert!(refused(|m| m.clusters.truncate(3)).contains("of 3"));
    assert!(refused(|m| m.levels.clear()).contains("no level"));
    assert!(refused(|m| m.guard_lengths.truncate(3)).starts_with("guard_lengths has 3 entries"));
    let more = refused(|m| m.clusters.push(m.clusters[0]));
    assert!(more.ends_with("are of no level"), "{more}");
}
