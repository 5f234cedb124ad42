//! Normals to draw the cloth with.

use crate::support::Grid;
use glam::{Vec3, vec3};
use toile_model::{Csr, NO_CORNER};
use toile_reference::frame::particle_normals;

#[test]
fn a_flat_sheet_shows_its_outside() {
    let model = Grid::horizontal(3, 0.1).model();
    let normals = particle_normals(&model.positions, &model.quads, &model.particle_quads);
    let outside = vec3(1.0, 0.0, 0.0).cross(vec3(0.0, 0.0, -1.0));
    assert_eq!(normals, vec![outside; 9]);
}

#[test]
fn a_triangle_counts_by_its_area() {
    let positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z * 2.0, Vec3::ONE];
    let quads = [[0, 1, 2, NO_CORNER], [0, 2, 3, NO_CORNER]];
    let rows = Csr::from_rows([vec![0, 1], vec![0], vec![0, 1], vec![1], vec![]]);
    let normals = particle_normals(&positions, &quads, &rows);
    assert!((normals[0] - vec3(2.0, 0.0, 1.0).normalize()).length() < 1e-6);
    assert_eq!((normals[1], normals[3]), (Vec3::Z, Vec3::X));
    assert_eq!(normals[4], Vec3::Y, "a particle without a quad");
}
