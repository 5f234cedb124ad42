//! The open model: sheets as grids, panels where they are placed, seams not yet closed.

use crate::cloth::flat_cloth::Cloth;
use crate::cloth::seams::seam_pairs;
use crate::cloth::soften::step_wanted;
use crate::cloth::springs::{Role, panel_springs};
use crate::mesh::geometry::{corners, element_area, signed_area};
use crate::mesh::panel_meshes;
use crate::union_find::UnionFind;
use crate::{Arrays, Hold, Model, ModelError, PanelMesh, Spring, SpringKind};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use toile_scene::{Garment, Rule, Settings, Sheet};

/// Stiffness of a seam spring as part of that of a structural one [1]. At full stiffness a gap of 30 cm would pull its
/// light edge particles together in some ten steps and crumple the panels behind them; closing is the seam pairs' task.
const SEAM_STIFFNESS: f32 = 1e-4;

impl Model {
    /// The grid of a sheet, of its own fabric or that of the settings. Its flat x runs along `right`, its flat y along `down`.
    ///
    /// # Panics
    /// When the sheet has fewer than two columns or rows, or a pin lies outside of it.
    pub fn from_sheet(sheet: &Sheet, settings: &Settings) -> Self {
        let [columns, rows] = [sheet.columns, sheet.rows];
        assert!(columns >= 2 && rows >= 2, "a sheet has at least two columns and two rows");
        let step = sheet.size / DVec2::new(f64::from(columns - 1), f64::from(rows - 1));
        let flat: Vec<DVec2> =
            (0..rows).flat_map(|r| (0..columns).map(move |c| DVec2::new(f64::from(c), f64::from(r)) * step)).collect();
        let places: Vec<DVec3> = flat.iter().map(|p| sheet.corner + sheet.right * p.x + sheet.down * p.y).collect();
        let quads = (0..rows - 1)
            .flat_map(|r| (0..columns - 1).map(move |c| r * columns + c))
            .map(|first| [first, first + 1, first + columns + 1, first + columns])
            .collect();
        let mut model = Arrays::from_flat(&flat, &places, quads, &settings.of_fabric(sheet.fabric.as_ref()));
        for pin in &sheet.pins {
            assert!(pin.column < columns && pin.row < rows, "the pins of a sheet are particles of it");
            model.inverse_masses[(pin.row * columns + pin.column) as usize] = 0.0;
        }
        model.panels = vec![PanelMesh {
            name: sheet.name.clone(),
            particles: 0..model.particle_count(),
            quads: 0..model.quad_count(),
            worst_angle: 90.0,
        }];
        model.add_flat_levels(&flat);
        if model.rule == Rule::Hierarchical {
            model.attachments = model.attachments(&flat, &pin_groups(sheet));
        }
        let mut model = model.complete();
        model.add_bending();
        Self::of(model)
    }

    /// The open model of a garment: panels where they are placed, seams as springs of zero rest length and as pairs to close.
    ///
    /// # Errors
    /// When the spacing is no positive length or gives too many particles, and when the outline of a panel encloses nothing, crosses
    /// itself, or cannot be meshed.
    ///
    /// # Panics
    /// When a seam names a panel or edge that does not exist.
    pub fn from_garment(garment: &Garment, settings: &Settings) -> Result<Self, ModelError> {
        let settings = &settings.of_fabric(garment.fabric.as_ref());
        let spacing = settings.spacing;
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(ModelError::Spacing { spacing });
        }
        check_size(garment, spacing)?;
        let meshes = panel_meshes(garment, spacing)?;
        let mut flat = Vec::new();
        let mut places = Vec::new();
        let mut quads: Vec<[u32; 4]> = Vec::new();
        let mut panels = Vec::new();
        let mut edge_particles = Vec::new();
        for (panel, mesh) in garment.panels.iter().zip(&meshes) {
            let first = flat.len() as u32;
            let first_quad = quads.len() as u32;
            flat.extend_from_slice(&mesh.points);
            places.extend(mesh.points.iter().map(|p| panel.placement.world(*p)));
            quads.extend(mesh.elements.iter().map(|e| placed(e, first, mesh.clockwise)));
            edge_particles
                .push(mesh.edges.iter().map(|e| e.iter().map(|i| i + first).collect()).collect::<Vec<Vec<u32>>>());
            panels.push(PanelMesh {
                name: panel.name.clone(),
                particles: first..flat.len() as u32,
                quads: first_quad..quads.len() as u32,
                worst_angle: mesh.worst_angle() as f32,
            });
        }
        let mut model = Arrays::from_flat(&flat, &places, quads, settings);
        model.panels = panels;
        model.add_flat_levels(&flat);
        (model.holds, model.held_particles) = holds(garment, &edge_particles, &places);
        (model.seam_pairs, model.seam_names) = seam_pairs(garment, &edge_particles, &model.positions);
        let stiffness = SEAM_STIFFNESS * settings.fabric.structural_stiffness as f32;
        let seam_springs = model.seam_pairs.iter().map(|p| Spring {
            ends: p.ends,
            rest_length: 0.0,
            stiffness,
            threshold: 0.0,
            kind: SpringKind::Seam,
        });
        model.springs.extend(seam_springs);
        model.springs.sort_by_key(|s| (s.ends, s.kind));
        let mut model = model.complete();
        model.add_bending();
        Ok(Self::of(model))
    }
}

impl Arrays {
    /// Particles, masses and springs of flat meshes.
    fn from_flat(flat: &[DVec2], places: &[DVec3], quads: Vec<[u32; 4]>, settings: &Settings) -> Self {
        let fabric = &settings.fabric;
        let mut masses = vec![0.0; flat.len()];
        for quad in &quads {
            let loop_ = corners(quad);
            let share = fabric.areal_density * element_area(quad, flat).abs() / loop_.len() as f64;
            loop_.iter().for_each(|&i| masses[i as usize] += share);
        }
        let stiffness = [fabric.structural_stiffness, fabric.shear_stiffness, fabric.bend_stiffness].map(|k| k as f32);
        let spring = |r: Role| Spring {
            ends: r.ends,
            rest_length: r.flat.length() as f32,
            threshold: fabric.threshold.along(r.flat) as f32,
            stiffness: stiffness[r.kind as usize],
            kind: r.kind,
        };
        Self {
            positions: places.iter().map(|p| p.as_vec3()).collect(),
            masses: masses.iter().map(|&m| m as f32).collect(),
            inverse_masses: masses.iter().map(|&m| (1.0 / m) as f32).collect(),
            springs: panel_springs(&quads, flat).into_iter().map(spring).collect(),
            flat: flat.iter().map(|p| p.as_vec2()).collect(),
            quads,
            stiffness,
            bending: fabric.bending_rigidity / fabric.areal_density,
            threshold: fabric.threshold,
            rule: settings.velocity_modification.rule,
            step_wanted: step_wanted(settings),
            ..Self::default()
        }
    }

    /// Levels of panels that are not sewn.
    fn add_flat_levels(&mut self, flat: &[DVec2]) {
        if self.rule == Rule::Hierarchical {
            let member_of: Vec<u32> = (0..flat.len() as u32).collect();
            let quads = self.quads.clone();
            let panels = self.panels.clone();
            let cloth = Cloth::new(&quads, &panels, flat, &member_of, flat.len(), self.threshold);
            self.add_levels(&cloth);
        }
    }
}

/// The pins of a sheet, those next to each other together.
fn pin_groups(sheet: &Sheet) -> Vec<Vec<u32>> {
    let mut groups = UnionFind::new(sheet.pins.len());
    for (i, one) in sheet.pins.iter().enumerate() {
        for (j, other) in sheet.pins.iter().enumerate().skip(i + 1) {
            if one.column.abs_diff(other.column) <= 1 && one.row.abs_diff(other.row) <= 1 {
                groups.unite(i as u32, j as u32);
            }
        }
    }
    let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, pin) in sheet.pins.iter().enumerate() {
        members.entry(groups.root(i as u32)).or_default().push(pin.row * sheet.columns + pin.column);
    }
    members.into_values().collect()
}

/// An element of a panel among all particles, counter-clockwise seen from outside: outside of a clockwise panel is its back.
fn placed(element: &[u32; 4], first: u32, clockwise: bool) -> [u32; 4] {
    let mut result = *element;
    let count = corners(element).len();
    result[..count].iter_mut().for_each(|i| *i += first);
    if clockwise {
        result[1..count].reverse();
    }
    result
}

/// Refuses a garment that the solvers' buffers are not meant for, before anything is allocated for it.
fn check_size(garment: &Garment, spacing: f64) -> Result<(), ModelError> {
    let count: f64 = garment
        .panels
        .iter()
        .map(|panel| {
            let points: Vec<DVec2> = (0..panel.edges.len()).flat_map(|e| panel.polyline(e, 0.01)).collect();
            let length: f64 = points.windows(2).map(|p| p[0].distance(p[1])).sum();
            signed_area(points.iter().copied()).abs() / (spacing * spacing) + length / spacing
        })
        .sum();
    // Written so that NaN passes: the outline check has the better message.
    if count > f64::from(Settings::PARTICLE_COUNT_MAX) {
        return Err(ModelError::TooManyParticles {
            garment: garment.name.clone(),
            spacing,
            count: count as u64,
            limit: Settings::PARTICLE_COUNT_MAX.into(),
        });
    }
    Ok(())
}

/// One hold for each label, and the particles of all of them. A particle between two labels is held by the first.
fn holds(garment: &Garment, edge_particles: &[Vec<Vec<u32>>], places: &[DVec3]) -> (Vec<Hold>, Vec<u32>) {
    let mut label_of: BTreeMap<u32, &str> = BTreeMap::new();
    let edges = garment.panels.iter().zip(edge_particles).flat_map(|(panel, edges)| panel.edges.iter().zip(edges));
    for (edge, particles) in edges {
        if let Some(label) = &edge.label {
            for &particle in particles {
                label_of.entry(particle).or_insert(label);
            }
        }
    }
    let mut groups: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
    for (particle, label) in label_of {
        groups.entry(label).or_default().push(particle);
    }
    let mut holds = Vec::new();
    let mut held_particles = Vec::new();
    for (label, particles) in groups {
        let first = held_particles.len() as u32;
        let sum: f64 = particles.iter().map(|&i| places[i as usize].y).sum();
        let height = (sum / particles.len() as f64) as f32;
        held_particles.extend(particles);
        holds.push(Hold { label: label.to_owned(), particles: first..held_particles.len() as u32, height });
    }
    (holds, held_particles)
}
