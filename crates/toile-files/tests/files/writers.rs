//! What is written reads back the same, and bad meshes leave no file.

use crate::support::ellipsoid;
use glam::Vec3;
use std::fs;
use toile_files::{BodyOptions, NamedMesh, read_body, write_atomically, write_glb, write_obj};
use toile_scene::Mesh;

#[test]
fn an_obj_reads_back_exactly() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("garment.obj");
    let mesh = ellipsoid();
    write_obj(&path, &mesh).expect("a file");
    let body = read_body(&path, &BodyOptions::default()).expect("the file");
    assert_eq!(body.mesh.positions, mesh.positions);
    assert_eq!(body.mesh.triangles, mesh.triangles);
    for (normal, expected) in body.mesh.normals.iter().zip(&mesh.normals) {
        assert!(normal.distance(*expected) < 1e-6);
    }
}

#[test]
fn a_glb_is_valid_and_holds_every_mesh() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dressed.glb");
    let body = ellipsoid();
    let triangle = Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(0.1, 0.7, 0.3)],
        normals: vec![Vec3::Z; 3],
        triangles: vec![[0, 1, 2]],
    };
    let meshes = [
        NamedMesh::new("body", &body, [0.8, 0.6, 0.5]),
        NamedMesh::new("a \"quoted\" skirt", &triangle, [0.1, 0.2, 0.3]),
    ];
    write_glb(&path, &meshes).expect("a file");
    let bytes = fs::read(&path).expect("the file");
    assert_eq!(bytes.len() % 4, 0);
    // from_slice validates indices and required fields.
    let gltf = gltf::Gltf::from_slice(&bytes).expect("valid glTF");
    let blob = gltf.blob.as_deref().expect("a binary chunk");
    assert_eq!(gltf.nodes().count(), 2);
    for (node, named) in gltf.nodes().zip(&meshes) {
        assert_eq!(node.name(), Some(named.name));
        let mesh = node.mesh().expect("a mesh");
        let primitive = mesh.primitives().next().expect("a primitive");
        let reader = primitive.reader(|_| Some(blob));
        let positions: Vec<Vec3> = reader.read_positions().expect("positions").map(Vec3::from).collect();
        let normals: Vec<Vec3> = reader.read_normals().expect("normals").map(Vec3::from).collect();
        let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
        assert_eq!(positions, named.mesh.positions);
        assert_eq!(normals, named.mesh.normals);
        assert_eq!(indices, named.mesh.triangles.concat());
        let bounds = primitive.bounding_box();
        assert_eq!(Some([bounds.min, bounds.max].map(Vec3::from)), named.mesh.bounds());
        let [red, green, blue, alpha] = primitive.material().pbr_metallic_roughness().base_color_factor();
        assert_eq!(([red, green, blue], alpha), (named.colour, 1.0));
    }
    for view in gltf.views() {
        assert_eq!(view.offset() % 4, 0);
        assert!(view.offset() + view.length() <= blob.len());
    }
}

#[test]
fn a_glb_of_nothing_is_valid() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("nothing.glb");
    write_glb(&path, &[]).expect("a file");
    let gltf = gltf::Gltf::from_slice(&fs::read(&path).expect("the file")).expect("valid glTF");
    assert_eq!(gltf.nodes().count(), 0);
}

#[test]
fn a_mesh_that_is_not_finite_leaves_no_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut mesh = ellipsoid();
    mesh.positions[5].y = f32::NAN;
    let named = NamedMesh::new("skirt", &mesh, [1.0; 3]);
    let glb = write_glb(&folder.path().join("a.glb"), &[named]).expect_err("a refusal").to_string();
    assert!(glb.ends_with("a.glb: position 5 of mesh \"skirt\" is not a finite number"), "{glb}");
    mesh.positions[5].y = 0.0;
    mesh.normals[7].x = f32::INFINITY;
    let obj = write_obj(&folder.path().join("a.obj"), &mesh).expect_err("a refusal").to_string();
    assert!(obj.ends_with("a.obj: normal 7 of the mesh is not a finite number"), "{obj}");
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0);
}

#[test]
fn a_file_is_replaced_as_a_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("metrics.json");
    write_atomically(&path, b"first").expect("a file");
    write_atomically(&path, b"second").expect("a file");
    assert_eq!(fs::read(&path).expect("the file"), b"second");
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1);
    let error = write_atomically(&folder.path().join("none/a.txt"), b"x").expect_err("no folder");
    assert!(error.to_string().contains("none/a.txt: it cannot be written: No such file"), "{error}");
}

/// Temporary files are private by default; results are for others too, as far as the user's umask lets them.
#[cfg(unix)]
#[test]
fn a_file_has_the_rights_of_any_new_one() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let rights = |name: &str| fs::metadata(folder.path().join(name)).expect("it is there").permissions().mode();
    fs::write(folder.path().join("plain"), b"1").expect("written");
    write_atomically(&folder.path().join("whole"), b"1").expect("written");
    assert_eq!(rights("whole"), rights("plain"));
}
